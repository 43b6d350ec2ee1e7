// Reads the scene of a render request.
#pragma once

#include "celltrace/pov.hpp"
#include "cli/command_line.hpp"
#include "cli/resume_state.hpp"

#include <functional>
#include <optional>
#include <string_view>

namespace celltrace::cli {

/// Returns the options for reading a request's scene. `frame` is a frame of the animation, if there is one.
ParseOptions parse_options(const RenderRequest& request, int frame);

struct ReadScene {
  std::optional<Scene> scene; ///< nothing if the user interrupted the reading
  Settings files;             ///< files that it was read from, with their stamps
  double seconds = 0;
};

/// Reads the scene of a frame, see parse_options(). `message` and `progress` are those of ParseOptions, but
/// `progress` need not check for interrupts. Throws the exceptions of load_scene().
ReadScene read_scene(const RenderRequest& request, int frame,
                     const std::function<void(std::string_view)>& message,
                     const std::function<void(double fraction)>& progress);

} // namespace celltrace::cli

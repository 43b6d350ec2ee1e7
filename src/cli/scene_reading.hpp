// Reads a scene as a request to render it says.
#pragma once

#include "celltrace/pov.hpp"
#include "cli/command_line.hpp"
#include "cli/resume_state.hpp"

#include <functional>
#include <optional>
#include <string_view>

namespace celltrace::cli {

/// What a request says of reading its scene. `frame`: of the animation, if there is one.
ParseOptions parse_options(const RenderRequest& request, int frame);

struct ReadScene {
  std::optional<Scene> scene; ///< none: the user interrupted it
  Settings files;             ///< that it was read from, with their stamps
  double seconds = 0;
};

/// `frame` as for parse_options(). `message` and `progress` are those of ParseOptions, but that
/// the latter need not look for interrupts. Throws what load_scene() throws.
ReadScene read_scene(const RenderRequest& request, int frame,
                     const std::function<void(std::string_view)>& message,
                     const std::function<void(double fraction)>& progress);

} // namespace celltrace::cli

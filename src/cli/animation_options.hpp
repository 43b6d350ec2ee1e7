// The options of `render` that make an animation of it.
#pragma once

#include "cli/command_line.hpp"

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

namespace celltrace::cli {

/// What CLI11 fills in besides the request.
struct AnimationTexts {
  std::optional<int> initial_frame, final_frame;
  std::string cyclic = "off";
  std::string frame_rate = "25";
};

void add_animation_options(CLI::App& command, RenderRequest& request, AnimationTexts& texts);

/// Sets an animation's frames as POV-Ray does: 0 to 0 and 1 to 1 are a still picture, but one end alone that
/// is not 0 makes an animation, and the final frame is at least the initial one.
void set_frames(Animation& animation, const AnimationTexts& texts);

/// After the request's output is known. Throws InputError for frames and clocks that make no sense, and for
/// what films cannot be.
void finish_animation(RenderRequest& request, const AnimationTexts& texts);

} // namespace celltrace::cli

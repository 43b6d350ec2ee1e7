// The options of `render` that request an animation.
#pragma once

#include "cli/command_line.hpp"

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

namespace celltrace::cli {

/// Texts that CLI11 fills in besides the request.
struct AnimationTexts {
  std::optional<int> initial_frame, final_frame;
  std::string cyclic = "off";
  std::string frame_rate = "25";
};

void add_animation_options(CLI::App& command, RenderRequest& request, AnimationTexts& texts);

/// Sets an animation's frames as POV-Ray does: 0 to 0 and 1 to 1 are a still picture, but one end alone that
/// is not 0 makes an animation, and the final frame is at least the initial one.
void set_frames(Animation& animation, const AnimationTexts& texts);

/// Completes the animation, after the request's output is known. Throws InputError for frames and clocks that
/// make no sense, and for combinations that films do not support.
void finish_animation(RenderRequest& request, const AnimationTexts& texts);

} // namespace celltrace::cli

// The options of `render` that make an animation of it.
#pragma once

#include "cli/command_line.hpp"

#include <string>

#include <CLI/CLI.hpp>

namespace celltrace::cli {

/// What CLI11 fills in besides the request.
struct AnimationTexts {
  std::string cyclic = "off";
  std::string frame_rate = "25";
};

void add_animation_options(CLI::App& command, RenderRequest& request, AnimationTexts& texts);

/// After the request's output is known. Throws InputError for frames and clocks that make no sense, and for
/// what films cannot be.
void finish_animation(RenderRequest& request, const AnimationTexts& texts);

} // namespace celltrace::cli

// What a window says about the frame that it shows.
#pragma once

#include "viewer/frame_source.hpp"
#include "viewer/window.hpp"

#include <string>
#include <vector>

namespace celltrace::viewer {

/// What is not in the frame itself.
struct Situation {
  std::string scene;
  std::string mode, view;
  double frames_per_second = 0;
  bool is_still = false; ///< nothing has been asked for since the frame is as good as it gets
  bool is_paused = false;
};

/// Lines about a frame and how it was made.
std::vector<std::string> information_on(const Frame& frame, const Situation& situation);
/// How busy the SPEs were, the busiest one being 1.
std::vector<Overlay::Bar> load_of(const Frame& frame);
/// Where which SPE has been at work.
std::vector<Overlay::Patch> strips_of(const Frame& frame);
/// What took how long, from blue to red, by the logarithm.
std::vector<Overlay::Patch> costs_of(const Frame& frame);
/// The keys and what they do.
std::vector<std::pair<std::string, std::string>> help_table();

} // namespace celltrace::viewer

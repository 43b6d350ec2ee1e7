// The information that a window shows about its frame.
#pragma once

#include "viewer/frame_source.hpp"
#include "viewer/window.hpp"

#include <string>
#include <vector>

namespace celltrace::viewer {

/// Facts that are not in the frame itself.
struct Situation {
  std::string scene;
  std::string mode, view;
  double frames_per_second = 0;
  bool is_still = false; ///< true: no input since the frame became final
  bool is_paused = false;
};

/// Returns lines about a frame and how it was made.
std::vector<std::string> information_on(const Frame& frame, const Situation& situation);
/// Returns the load of the SPEs, with 1 for the busiest one.
std::vector<Overlay::Bar> load_of(const Frame& frame);
/// Returns the regions that each SPE has worked on.
std::vector<Overlay::Patch> strips_of(const Frame& frame);
/// Returns the cost of the regions, from blue to red on a logarithmic scale.
std::vector<Overlay::Patch> costs_of(const Frame& frame);
/// Returns the keys and their actions.
std::vector<std::pair<std::string, std::string>> help_table();

} // namespace celltrace::viewer

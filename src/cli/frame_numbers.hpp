// The frames of an animation: which of them are rendered, at which clock, and into which files. All as
// POV-Ray has it.
#pragma once

#include "celltrace/pov.hpp"

#include <filesystem>
#include <optional>
#include <vector>

namespace celltrace::cli {

/// By default a still picture.
struct Animation {
  int initial_frame = 1, final_frame = 1;
  double initial_clock = 0, final_clock = 1;
  bool cyclic = false; ///< the frame after the last one would be the first one
  /// The part that is rendered: frames, or below 1 parts of final_frame. None: from the first, to the last.
  std::optional<double> start_frame, end_frame;
  int step = 1;               ///< from each frame that is rendered to the next one
  bool has_one_frame = false; ///< frame 1 only, and yet no still picture

  bool is_on() const { return has_one_frame || initial_frame != 1 || final_frame != 1; }
};

/// Frames of an animation at most.
inline constexpr int kMaxFrame = 9'999'999;

/// Returns the frames of an animation that is on, one at least. As in POV-Ray, they may end behind the final
/// frame if the subset does. Throws InputError for frames beyond kMaxFrame.
std::vector<int> frames_to_render(const Animation& animation);

/// What a scene's clock is in a frame, and what else it may know of it. In POV-Ray's precision: of a clock
/// the single one, of the step between frames six digits.
double clock_of(const Animation& animation, int frame);
AnimationFrame frame_of(const Animation& animation, int frame);

/// The picture of a frame: as many digits as the last number has, before the extension. Of a still picture
/// the name itself.
std::filesystem::path picture_of(const std::filesystem::path& output, const Animation& animation, int frame);

} // namespace celltrace::cli

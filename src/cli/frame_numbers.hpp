// The frames of an animation, as in POV-Ray: those that are rendered, their clock, and their files.
#pragma once

#include "celltrace/pov.hpp"

#include <filesystem>
#include <optional>
#include <vector>

namespace celltrace::cli {

/// The frames of an animation; by default, of a still picture.
struct Animation {
  int initial_frame = 1, final_frame = 1;
  double initial_clock = 0, final_clock = 1;
  bool cyclic = false; ///< the frame after the last one would be the first one
  /// The subset to render, as frame numbers, or below 1 as fractions of final_frame; by default, all frames.
  std::optional<double> start_frame, end_frame;
  int step = 1;               ///< distance of rendered frames
  bool has_one_frame = false; ///< only frame 1, but as an animation

  bool is_on() const { return has_one_frame || initial_frame != 1 || final_frame != 1; }
};

/// Limit on frames in an animation.
inline constexpr int kMaxFrame = 9'999'999;

/// Returns the frames of an animation, at least one. As in POV-Ray, they may end after the final frame if the
/// subset does. Throws InputError for frames beyond kMaxFrame.
std::vector<int> frames_to_render(const Animation& animation);

/// Returns a scene's clock in a frame; frame_of() returns it with other properties of the frame. The
/// precision is POV-Ray's: single precision for the clock, six digits for the step between frames.
double clock_of(const Animation& animation, int frame);
AnimationFrame frame_of(const Animation& animation, int frame);

/// Returns the file for a frame's picture: the number is padded to the digits of the last one, and stands
/// before the extension. For a still picture returns `output`.
std::filesystem::path picture_of(const std::filesystem::path& output, const Animation& animation, int frame);

} // namespace celltrace::cli

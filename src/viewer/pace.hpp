// Chooses how coarse a picture has to be to be ready in time.
#pragma once

#include <algorithm>

namespace celltrace::viewer {

/// Learns the time of a pixel from frames.
class Pace {
public:
  /// Seconds in which the first picture after an input should come.
  static constexpr double kFirst = 0.025;
  static constexpr int kCoarsest = 32; ///< pixels a side that are shown as one

  void learn(double seconds, double pixels) {
    if (pixels < 1 || seconds <= 0) return;
    // An increase counts at once, a decrease gradually.
    const double each = seconds / pixels;
    pixel_ = pixel_ == 0 || each > pixel_ ? each : 0.5 * (pixel_ + each);
  }
  void forget() { pixel_ = 0; }
  /// Returns the expected seconds of a picture for a window of `pixels` pixels.
  double expected(double pixels, int scale) const { return pixel_ * pixels / (double{1} * scale * scale); }
  /// Returns the scale of the first picture, a power of two; a coarse one as long as nothing is known.
  int first_scale(double pixels) const {
    int scale = 1;
    if (pixel_ == 0) return pixels > 40000 ? 8 : 1;
    while (scale < kCoarsest && expected(pixels, scale) > kFirst)
      scale *= 2;
    return scale;
  }
  /// Returns the scale after a complete picture: full size at once if that is quick.
  int next_scale(double pixels, int scale) const {
    constexpr double kQuick = 0.25;
    if (expected(pixels, 1) <= kQuick) return 1;
    return std::max(scale / 2, 1);
  }

private:
  double pixel_ = 0; ///< seconds
};

} // namespace celltrace::viewer

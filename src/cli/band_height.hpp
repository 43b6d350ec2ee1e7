// How many rows of a picture are rendered at a time.
#pragma once

#include "celltrace/render.hpp"

namespace celltrace::cli {

/// Chooses bands that take some seconds each where threads of this computer render; emulated machines and
/// models other than `shared` get all rows at once, unless memory has no room for them.
class BandHeight {
public:
  explicit BandHeight(const RenderOptions& options);

  /// Returns how many of `rows` rows that follow each other come next, in a picture of `height` rows.
  int of(int rows, int height) const;
  /// Takes note of how long the last band took.
  void learn(int rows, double seconds) { seconds_a_row_ = seconds / rows; }

private:
  int wanted(int rows, int height) const;

  bool in_bands_;
  int most_;                  ///< rows that there is room for; 0: all
  double seconds_a_row_ = -1; ///< of the last band; below 0: not known
};

} // namespace celltrace::cli

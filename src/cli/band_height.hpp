// How many rows of a picture are rendered at a time.
#pragma once

#include "celltrace/render.hpp"

namespace celltrace::cli {

/// Bands of rows that take some seconds each, on threads of this computer; what else there is is rendered at
/// once, unless memory has no room for it.
class BandHeight {
public:
  explicit BandHeight(const RenderOptions& options);

  /// Of a picture of `height` rows `rows` follow each other that are missing.
  int of(int rows, int height) const;
  /// A band of so many rows has taken so long.
  void learn(int rows, double seconds) { seconds_a_row_ = seconds / rows; }

private:
  int wanted(int rows, int height) const;

  bool in_bands_;
  int most_;                  ///< rows that there is room for; 0: all
  double seconds_a_row_ = -1; ///< of the last band; below 0: not known
};

} // namespace celltrace::cli

// How many rows of a picture are rendered at a time.
#pragma once

#include "celltrace/render.hpp"
#include "cli/row_costs.hpp"

namespace celltrace::cli {

/// Chooses bands that take some seconds each where threads of this computer render; emulated machines and
/// models other than `shared` get all rows at once, unless memory has no room for them.
class BandHeight {
public:
  BandHeight(const RenderOptions& options, const RowCosts& costs);

  /// Returns how many of the `rows` rows that follow each other from `top` on come next.
  int of(int top, int rows) const;
  /// Takes note of how long a band took.
  void learn(int top, int rows, double seconds) { seconds_ = seconds / costs_.of(top, top + rows); }

private:
  int wanted(int top, int rows) const;

  bool in_bands_;
  bool loses_bands_; ///< of one that is broken off nothing is kept
  int most_;         ///< rows that there is room for; 0: all
  RowCosts costs_;
  double seconds_ = -1; ///< that all rows would take, by the last band; below 0: not known
};

} // namespace celltrace::cli

// Chooses how many rows of a picture are rendered at a time.
#pragma once

#include "celltrace/render.hpp"
#include "cli/row_costs.hpp"

namespace celltrace::cli {

/// Chooses bands that take some seconds each if threads of this computer render; emulated machines and models
/// other than `shared` get all rows at once, unless memory has no room for them.
class BandHeight {
public:
  BandHeight(const RenderOptions& options, const RowCosts& costs);

  /// Returns how many of the `rows` consecutive rows from `top` on come next.
  int of(int top, int rows) const;
  /// Records how long a band took.
  void learn(int top, int rows, double seconds) { seconds_ = seconds / costs_.of(top, top + rows); }

private:
  int wanted(int top, int rows) const;

  bool in_bands_;
  bool loses_bands_; ///< nothing is kept of a band that was stopped
  int most_;         ///< rows that memory has room for; 0: all
  RowCosts costs_;
  double seconds_ = -1; ///< estimate for all rows by the last band; below 0 if unknown
};

} // namespace celltrace::cli

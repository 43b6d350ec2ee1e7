// The share of each of a picture's rows in the time of rendering.
#pragma once

#include "celltrace/render.hpp"

#include <chrono>
#include <optional>
#include <vector>

namespace celltrace::cli {

/// The shares of a picture's rows in the time of rendering; rows count from the top of its region.
class RowCosts {
public:
  /// Makes all rows cost the same.
  explicit RowCosts(int height) : RowCosts(height, {1}) {}
  /// Takes the costs of parts of equal heights, from the top, in any unit.
  RowCosts(int height, const std::vector<double>& parts);

  bool are_measured() const { return sums_.size() > 2; }
  /// Returns the share of all rows above `row`, which need not be an integer: 0 to 1.
  double above(double row) const;
  double of(int top, int bottom) const { return above(bottom) - above(top); }
  /// Returns how many rows from `top` on have this share together.
  double rows_with(double share, int top) const;

private:
  double height_;
  std::vector<double>
      sums_; ///< sums of the costs of all parts before each part; the last sum is that of all parts
};

/// Returns the number of rows in the rendered region.
int height_of(const RenderOptions& options);

/// Measures the costs with a picture of the same scene that has some thousandths of the pixels of `options`,
/// with which the renderer continues afterwards. Pictures that are small, or rendered by an emulated machine,
/// are not measured: their rows cost the same. Rows also cost the same if `progress` stops the measurement or
/// it takes longer than `longest`. `preparation` gets the first picture's statistics of preparing the scene,
/// which later pictures no longer have.
RowCosts measured_costs(Renderer& renderer, const RenderOptions& options, const Progress& progress,
                        std::optional<RenderStatistics>& preparation,
                        std::chrono::seconds longest = std::chrono::seconds(2));

/// Copies the statistics of the scene's preparation.
void take_preparation(RenderStatistics& to, const RenderStatistics& from);

} // namespace celltrace::cli

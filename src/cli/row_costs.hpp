// The shares of a picture's rows in the time that it takes.
#pragma once

#include "celltrace/render.hpp"

#include <chrono>
#include <optional>
#include <vector>

namespace celltrace::cli {

/// Shares of the time that a picture takes, by its rows from the top of its region.
class RowCosts {
public:
  /// All rows take the same.
  explicit RowCosts(int height) : RowCosts(height, {1}) {}
  /// `parts`: what parts of equal heights take, from the top, in any unit.
  RowCosts(int height, const std::vector<double>& parts);

  bool are_measured() const { return sums_.size() > 2; }
  /// Returns the share of all rows above `row`, which need not be whole: 0 to 1.
  double above(double row) const;
  double of(int top, int bottom) const { return above(bottom) - above(top); }
  /// Returns how many rows from `top` on take so much of the whole.
  double rows_with(double share, int top) const;

private:
  double height_;
  std::vector<double> sums_; ///< of all parts before each, and of all
};

/// Returns how many rows the region has that is rendered.
int height_of(const RenderOptions& options);

/// Measures by a picture of the same scene that has some pixels in a thousand of those of `options`, with
/// which the renderer goes on afterwards. Pictures that are small, or rendered by an emulated machine, are
/// not measured, and neither is one that `progress` breaks off or that takes longer than `longest`: their
/// rows count alike. `preparation` gets what the first picture's statistics say of the scene's preparation,
/// which the next one's do not any more.
RowCosts measured_costs(Renderer& renderer, const RenderOptions& options, const Progress& progress,
                        std::optional<RenderStatistics>& preparation,
                        std::chrono::seconds longest = std::chrono::seconds(2));

/// Copies what statistics say of the scene's preparation.
void take_preparation(RenderStatistics& to, const RenderStatistics& from);

} // namespace celltrace::cli

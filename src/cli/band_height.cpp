#include "cli/band_height.hpp"

#include <algorithm>
#include <cmath>

namespace celltrace::cli {

BandHeight::BandHeight(const RenderOptions& options, const RowCosts& costs)
    : in_bands_(options.backend == Backend::native && options.model == Model::shared),
      loses_bands_(options.antialiasing || options.blocks), most_(options.rows_at_once), costs_(costs) {
}

int BandHeight::of(int top, int rows) const {
  const int wanted = this->wanted(top, rows);
  return most_ == 0 ? wanted : std::min(wanted, most_);
}

int BandHeight::wanted(int top, int rows) const {
  if (!in_bands_) return rows;
  constexpr double kBandSeconds = 5, kQuickSeconds = 0.5;
  constexpr double kPart = 1.0 / 8;
  double share = kPart;
  if (seconds_ >= 0) {
    const double left = costs_.of(top, top + rows) * seconds_;
    // Uses small bands, since an interrupt loses the current band, whose progress has been shown.
    const bool is_watched = loses_bands_ && costs_.are_measured();
    if (left < (is_watched ? kQuickSeconds : 2 * kBandSeconds)) return rows;
    share = kBandSeconds / seconds_;
    if (is_watched) share = std::min(share, kPart);
  }
  const double steps = std::ceil(std::max(costs_.rows_with(share, top), 1.0) / Renderer::kRowStep - 1e-9);
  return static_cast<int>(std::min<double>(rows, steps * Renderer::kRowStep));
}

} // namespace celltrace::cli

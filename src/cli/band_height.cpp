#include "cli/band_height.hpp"

#include <algorithm>
#include <cmath>

namespace celltrace::cli {

BandHeight::BandHeight(const RenderOptions& options)
    : in_bands_(options.backend == Backend::native && options.model == Model::shared),
      most_(options.rows_at_once) {
}

int BandHeight::of(int rows, int height) const {
  const int wanted = this->wanted(rows, height);
  return most_ == 0 ? wanted : std::min(wanted, most_);
}

int BandHeight::wanted(int rows, int height) const {
  if (!in_bands_) return rows;
  constexpr double kBandSeconds = 5;
  constexpr int kFirstPart = 8;
  double wanted = static_cast<double>(height) / kFirstPart;
  if (seconds_a_row_ >= 0) {
    if (rows * seconds_a_row_ < 2 * kBandSeconds) return rows;
    wanted = kBandSeconds / seconds_a_row_;
  }
  const double steps = std::ceil(std::max(wanted, 1.0) / Renderer::kRowStep);
  return static_cast<int>(std::min<double>(rows, steps * Renderer::kRowStep));
}

} // namespace celltrace::cli

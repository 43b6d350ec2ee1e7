#include "cli/row_costs.hpp"

#include "render/picture_options.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>

namespace celltrace::cli {

namespace {

/// The share of the picture's pixels that is worth measuring. More pixels tell no more.
constexpr double kShare = 0.002;
/// The number of measurements: other programs may delay a part, but hardly the same one each time.
constexpr int kTimes = 2;
constexpr int kFewestColumns = 4, kMostColumns = 16, kFewestParts = 6, kMostParts = 32;

/// Returns the costs of the region's parts of Renderer::kRowStep rows.
std::vector<double> parts_of(const PictureRegion& region, const std::vector<WorkRecord>& work) {
  std::vector<double> parts(static_cast<std::size_t>((region.bottom - region.top) / Renderer::kRowStep));
  for (const WorkRecord& record : work)
    for (int y = record.region.top; y < record.region.bottom; ++y)
      parts[static_cast<std::size_t>((y - region.top) / Renderer::kRowStep)] +=
          record.ticks_per_pixel * (record.region.right - record.region.left);
  return parts;
}

} // namespace

RowCosts::RowCosts(int height, const std::vector<double>& parts) : height_(height) {
  double sum = 0;
  for (const double part : parts)
    sum += part;
  // Parts that took no time count a little, so that each row advances the progress.
  const double least = sum > 0 ? 1e-3 * sum / static_cast<double>(parts.size()) : 1;
  sums_ = {0};
  for (const double part : parts)
    sums_.push_back(sums_.back() + std::max(part, least));
  for (double& each : sums_)
    each /= sums_.back();
}

double RowCosts::above(double row) const {
  const auto parts = static_cast<double>(sums_.size() - 1);
  const double at = std::clamp(row / height_, 0.0, 1.0) * parts;
  const auto part = std::min(static_cast<std::size_t>(at), sums_.size() - 2);
  return sums_[part] + (at - static_cast<double>(part)) * (sums_[part + 1] - sums_[part]);
}

double RowCosts::rows_with(double share, int top) const {
  const double wanted = above(top) + share;
  if (wanted >= 1) return height_ - top;
  const auto after = std::upper_bound(sums_.begin(), sums_.end(), wanted);
  const auto part = static_cast<std::size_t>(after - sums_.begin()) - 1;
  const double at = static_cast<double>(part) + (wanted - sums_[part]) / (sums_[part + 1] - sums_[part]);
  return at / static_cast<double>(sums_.size() - 1) * height_ - top;
}

int height_of(const RenderOptions& options) {
  const PictureRegion region = region_of(options);
  return region.bottom - region.top;
}

RowCosts measured_costs(Renderer& renderer, const RenderOptions& options, const Progress& progress,
                        std::optional<RenderStatistics>& preparation, std::chrono::seconds longest) {
  const PictureRegion region = region_of(options);
  const int width = region.right - region.left, height = region.bottom - region.top;
  const RowCosts alike(height);
  // The small picture would not have the shape of a narrow region.
  const bool is_large_part = 4 * width >= options.width && 4 * height >= options.height;
  if (options.backend != Backend::native || options.model != Model::shared || !is_large_part) return alike;
  const double pixels = kShare * width * height, step = Renderer::kRowStep;
  const int columns =
      std::clamp(static_cast<int>(pixels / (step * kMostColumns)) / 4 * 4, kFewestColumns, kMostColumns);
  const int parts = std::min(static_cast<int>(pixels / (step * columns)), kMostParts);
  if (parts < kFewestParts) return alike;

  RenderOptions small = options;
  const int rows = parts * Renderer::kRowStep;
  const double across = static_cast<double>(columns) / width, down = static_cast<double>(rows) / height;
  small.width = std::max(static_cast<int>(std::lround(across * options.width)), columns);
  small.height = std::max(static_cast<int>(std::lround(down * options.height)), rows);
  const int left = std::min(static_cast<int>(across * region.left), small.width - columns);
  const int top = std::min(static_cast<int>(down * region.top), small.height - rows);
  small.region = PictureRegion{left, left + columns, top, top + rows};
  small.rows_at_once = 0;
  small.colours = small.first_hits = small.blocks = false;
  small.finished_block = nullptr;
  small.work_map = true;

  std::vector<double> costs(static_cast<std::size_t>(parts));
  bool is_complete = true;
  const auto end = std::chrono::steady_clock::now() + longest;
  const auto goes_on = [&](double) {
    return std::chrono::steady_clock::now() < end && (!progress || progress(0));
  };
  const auto measure = [&](const std::optional<Antialiasing>& antialiasing) {
    small.antialiasing = antialiasing;
    renderer.set_picture(small);
    std::vector<double> least;
    for (int time = 0; time < kTimes; ++time) {
      const RenderResult result = renderer.render_rows(0, rows, goes_on);
      if (!preparation) preparation = result.statistics;
      is_complete = result.complete;
      if (!is_complete) break;
      const std::vector<double> took = parts_of(*small.region, result.work);
      if (time == 0) least = took;
      std::transform(least.begin(), least.end(), took.begin(), least.begin(),
                     [](double a, double b) { return std::min(a, b); });
    }
    if (!least.empty())
      std::transform(costs.begin(), costs.end(), least.begin(), costs.begin(), std::plus<>());
  };
  // With antialiasing the work map has the samples alone, which are added to one ray per pixel.
  measure(std::nullopt);
  if (options.antialiasing && is_complete) measure(options.antialiasing);
  renderer.set_picture(options);
  const bool has_any = std::any_of(costs.begin(), costs.end(), [](double cost) { return cost > 0; });
  return has_any ? RowCosts(height, costs) : alike;
}

void take_preparation(RenderStatistics& to, const RenderStatistics& from) {
  to.preparation = from.preparation;
  to.prepare = from.prepare;
  to.prepare_cycles = from.prepare_cycles;
  to.build_seconds = from.build_seconds;
  to.prepare_seconds = from.prepare_seconds;
  to.stale_lines = from.stale_lines;
}

} // namespace celltrace::cli

#include "cli/poster.hpp"

#include "celltrace/error.hpp"
#include "cli/band_height.hpp"
#include "cli/picture_rows.hpp"
#include "cli/row_costs.hpp"
#include "cli/row_keeper.hpp"
#include "cli/row_output.hpp"
#include "image/file.hpp"
#include "render/picture_options.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace celltrace::cli {

namespace {

/// Limit on pixels in a picture that is completely in memory, which may take 100 bytes per
/// pixel.
constexpr std::int64_t kMostPixelsOfWhole = std::int64_t{1} << 24;
/// The number of pixels in a poster's band, unless the least number of rows has more. Colours as numbers take
/// four times the memory.
constexpr std::int64_t kPixelsOfBand = std::int64_t{1} << 20, kPixelsOfColours = kPixelsOfBand / 4;
/// The rate, in bytes per second, below which rendered rows are worth keeping: above it, rendering them again
/// takes no longer than reading them.
constexpr double kBytesToKeepPerSecond = 50e6;

/// Allocates rows of the region in each requested form.
PictureRows make_rows(const RenderOptions& options, int count) {
  const PictureRegion region = region_of(options);
  const int width = region.right - region.left;
  PictureRows rows;
  if (options.colours)
    rows.colours = ColourImage(width, count);
  else
    rows.image = Image(width, count);
  if (options.first_hits) {
    const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(count);
    rows.first_hits = {width, count, {}, {}, {}};
    rows.first_hits.depth.resize(pixels);
    rows.first_hits.normal.resize(3 * pixels);
    rows.first_hits.object.resize(pixels);
  }
  return rows;
}

class PosterRun {
public:
  PosterRun(Renderer& renderer, const RenderRequest& request, const std::filesystem::path& path,
            RowsFile& kept, const RowCosts& costs, const Progress& progress)
      : renderer_(renderer), options_(request.options), region_(region_of(options_)),
        width_(region_.right - region_.left), height_(region_.bottom - region_.top), kept_(kept),
        keeps_all_(request.resume), keeper_(kept), costs_(costs), progress_(progress),
        output_(request, path) {
    options_.rows_at_once = rows_at_once(request);
  }

  PictureOutcome run() {
    BandHeight bands(options_, costs_);
    for (int top = 0; top < height_;) {
      if (const std::optional<RowsFile::Rows> part = kept_.next(top);
          part && part->top == top && take_kept(*part)) {
        top = part->bottom;
        continue;
      }
      const std::optional<RowsFile::Rows> later = kept_.next(top + 1);
      const int gap = (later ? std::min(later->top, height_) : height_) - top;
      if (!result_.complete) {
        output_.write_blank(gap);
        top += gap;
        continue;
      }
      const int rows = bands.of(top, gap);
      bands.learn(top, rows, render(top, top + rows));
      top += rows;
    }
    output_.finish();
    result_.rows_to_go = height_ - kept_.count();
    return std::move(result_);
  }

private:
  /// Writes rows that were kept. Returns false if they are missing after all.
  bool take_kept(const RowsFile::Rows& part) {
    const int count = part.bottom - part.top;
    const bool is_band = part.bottom <= height_ && count <= options_.rows_at_once;
    const std::optional<std::string> bytes = is_band ? kept_.read(part.top) : std::nullopt;
    if (!bytes) return false;
    PictureRows rows = make_rows(options_, count);
    if (!take_bytes(*bytes, rows, {0, width_, 0, count})) return false;
    output_.write(rows);
    return true;
  }

  /// Renders a band. Returns the time in seconds.
  double render(int top, int bottom) {
    RenderResult result = renderer_.render_rows(top, bottom, [&](double fraction) {
      return progress_(costs_.above(top + fraction * (bottom - top)));
    });
    const double seconds = result.statistics.render_seconds;
    if (has_statistics_)
      add_rows(result_.statistics, result.statistics);
    else
      result_.statistics = result.statistics;
    has_statistics_ = true;
    result_.complete = result.complete;
    const std::vector<PictureRegion> finished = finished_parts(result, bottom - top);
    if (options_.colours) result.image = Image();
    const PictureRows rows = rows_of(std::move(result));
    output_.write(rows);
    for (const PictureRegion& part : finished)
      keep(rows, part, top, seconds);
    return seconds;
  }

  /// Returns the parts of a band that need not be rendered again: the whole band or, if it was stopped, the
  /// final blocks. With antialiasing, a pixel with a colour may have its first ray only.
  std::vector<PictureRegion> finished_parts(const RenderResult& result, int rows) const {
    if (result.complete) return {{0, width_, 0, rows}};
    std::vector<PictureRegion> parts;
    if (options_.antialiasing) return parts;
    for (int top = 0; top < rows; top += Renderer::kRowStep) {
      const PictureRegion part = {0, width_, top, std::min(top + Renderer::kRowStep, rows)};
      if (has_all_pixels(result.image, part)) parts.push_back(part);
    }
    return parts;
  }

  void keep(const PictureRows& rows, const PictureRegion& part, int top, double seconds) {
    if (!kept_.is_kept()) return;
    const double pixels = static_cast<double>(width_) * (part.bottom - part.top);
    const int bytes_a_pixel = (options_.colours ? 16 : 4) + (options_.first_hits ? 20 : 0);
    if (!keeps_all_ && seconds * kBytesToKeepPerSecond < pixels * bytes_a_pixel) return;
    keeper_.keep(
        [&](RowsFile& file) { file.append(top + part.top, top + part.bottom, bytes_of(rows, part)); });
  }

  Renderer& renderer_;
  RenderOptions options_;
  PictureRegion region_;
  int width_, height_; ///< size of the region
  RowsFile& kept_;
  bool keeps_all_; ///< true: all rows are kept, whatever the speed of rendering
  RowKeeper keeper_;
  const RowCosts& costs_;
  const Progress& progress_;
  RowOutput output_;
  PictureOutcome result_;
  bool has_statistics_ = false;
};

} // namespace

int rows_at_once(const RenderRequest& request) {
  const RenderOptions& options = request.options;
  const std::int64_t pixels = std::int64_t{options.width} * options.height;
  const bool is_whole = request.film != FilmFormat::none || options.model != Model::shared ||
                        (!request.output.empty() && request.format == ImageFormat::dds);
  if (is_whole && pixels > kMaxImagePixels)
    throw InputError("a picture of " + std::to_string(options.width) + "x" + std::to_string(options.height) +
                     " pixels is too large: films, DirectDraw surfaces and models other than shared are in "
                     "memory as a whole, of " +
                     std::to_string(kMaxImagePixels) + " pixels at most");
  if (is_whole) return 0;
  const PictureRegion region = region_of(options);
  const int height = region.bottom - region.top;
  const bool is_large = pixels > kMostPixelsOfWhole;
  if (!is_large) {
    const bool is_read = request.output == kStandardOutput || image::is_stream(request.output);
    return is_read && options.backend == Backend::native ? height : 0;
  }
  const std::int64_t wanted =
      options.colours || options.alpha || options.first_hits ? kPixelsOfColours : kPixelsOfBand;
  const std::int64_t steps = wanted / (region.right - region.left) / Renderer::kRowStep;
  return static_cast<int>(
      std::min<std::int64_t>(std::max<std::int64_t>(steps, 1) * Renderer::kRowStep, height));
}

PictureOutcome render_poster(Renderer& renderer, const RenderRequest& request,
                             const std::filesystem::path& path, RowsFile& kept, const RowCosts& costs,
                             const Progress& progress) {
  return PosterRun(renderer, request, path, kept, costs, progress).run();
}

} // namespace celltrace::cli

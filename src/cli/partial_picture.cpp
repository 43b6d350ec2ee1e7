#include "cli/partial_picture.hpp"

#include "cli/band_height.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <string>

namespace celltrace::cli {

namespace {

constexpr int kStep = Renderer::kRowStep;

/// Copies a part of one picture to the same place in another.
template <class Picture> void copy_part(const Picture& from, Picture& to, const PictureRegion& part) {
  const std::size_t row = 4 * static_cast<std::size_t>(part.right - part.left);
  for (int y = part.top; y < part.bottom; ++y)
    std::copy_n(from.pixel(part.left, y), row, to.pixel(part.left, y));
}
template <class Picture> void clear_part(Picture& picture, const PictureRegion& part) {
  for (int y = part.top; y < part.bottom; ++y)
    std::fill_n(picture.pixel(part.left, y), 4 * (part.right - part.left), 0);
}

/// Copies whole rows of first hits.
void copy_rows(const FirstHits& from, FirstHits& to, int top, int bottom) {
  const auto width = static_cast<std::ptrdiff_t>(to.width);
  const auto copy = [&](const auto& numbers, auto& copied, std::ptrdiff_t channels) {
    const std::ptrdiff_t row = width * channels;
    std::copy(numbers.begin() + top * row, numbers.begin() + bottom * row, copied.begin() + top * row);
  };
  copy(from.depth, to.depth, 1);
  copy(from.normal, to.normal, 3);
  copy(from.object, to.object, 1);
}
/// Copies whole rows of blocks that begin in these rows.
void copy_rows(const BlockImage& from, BlockImage& to, int top, int bottom) {
  const std::ptrdiff_t row = std::ptrdiff_t{8} * to.columns();
  const std::ptrdiff_t first = top / 4 * row, end = (bottom + 3) / 4 * row;
  std::copy(from.blocks.begin() + first, from.blocks.begin() + end, to.blocks.begin() + first);
}

} // namespace

PartialPicture::PartialPicture(const RenderOptions& options)
    : region_(options.region.value_or(PictureRegion{0, options.width, 0, options.height})) {
  pictures_.image = Image(options.width, options.height);
  clear_part(pictures_.image, region_);
  if (options.colours) {
    pictures_.colours = ColourImage(options.width, options.height);
    clear_part(pictures_.colours, region_);
  }
  const std::size_t pixels = pictures_.image.rgba.size() / 4;
  if (options.first_hits) {
    FirstHits& hits = pictures_.first_hits;
    hits.width = options.width;
    hits.height = options.height;
    hits.depth.assign(pixels, std::numeric_limits<float>::infinity());
    hits.normal.assign(3 * pixels, 0);
    hits.object.assign(pixels, 0);
  }
  if (options.blocks) {
    BlockImage& blocks = pictures_.blocks;
    blocks.width = options.width;
    blocks.height = options.height;
    blocks.blocks.resize(8 * static_cast<std::size_t>(blocks.columns()) *
                         static_cast<std::size_t>(blocks.rows()));
  }
  finished_.assign(static_cast<std::size_t>((height() + kStep - 1) / kStep), false);
}

bool PartialPicture::is_complete() const {
  return std::find(finished_.begin(), finished_.end(), false) == finished_.end();
}
bool PartialPicture::is_empty() const {
  return std::find(finished_.begin(), finished_.end(), true) == finished_.end();
}

int PartialPicture::missing_rows() const {
  int missing = 0;
  for (std::size_t block = 0; block < finished_.size(); ++block)
    if (!finished_[block]) missing += block_rows(block).bottom - block_rows(block).top;
  return missing;
}

double PartialPicture::finished_share(const RowCosts& costs) const {
  double share = 0;
  for (std::size_t block = 0; block < finished_.size(); ++block)
    if (finished_[block]) share += costs.of(block_rows(block).top, block_rows(block).bottom);
  return share;
}

PartialPicture::Rows PartialPicture::block_rows(std::size_t block) const {
  const int top = static_cast<int>(block) * kStep;
  return {top, std::min(top + kStep, height())};
}
PictureRegion PartialPicture::place_of(const Rows& rows) const {
  return {region_.left, region_.right, region_.top + rows.top, region_.top + rows.bottom};
}

PartialPicture::Rows PartialPicture::next() const {
  const auto first = std::find(finished_.begin(), finished_.end(), false);
  const auto end = std::find(first, finished_.end(), true);
  return {static_cast<int>(first - finished_.begin()) * kStep,
          std::min(static_cast<int>(end - finished_.begin()) * kStep, height())};
}

void PartialPicture::take(const RenderResult& result, const Rows& rows, bool keeps_parts) {
  const PictureRegion place = place_of(rows);
  copy_part(result.image, pictures_.image, place);
  if (!pictures_.colours.rgba.empty()) {
    copy_part(result.colours, pictures_.colours, place);
    pictures_.colours.gamma = result.colours.gamma;
  }
  if (!pictures_.first_hits.depth.empty())
    copy_rows(result.first_hits, pictures_.first_hits, place.top, place.bottom);
  if (!pictures_.blocks.blocks.empty()) copy_rows(result.blocks, pictures_.blocks, place.top, place.bottom);
  for (std::size_t block = static_cast<std::size_t>(rows.top / kStep); block < finished_.size(); ++block) {
    const Rows its = block_rows(block);
    if (its.top >= rows.bottom) break;
    finished_[block] = result.complete || (keeps_parts && has_all_pixels(pictures_.image, place_of(its)));
  }
}

void PartialPicture::append_to(RowsFile& file) const {
  for (std::size_t block = 0; block < finished_.size(); ++block) {
    const Rows rows = block_rows(block);
    const std::optional<RowsFile::Rows> known = file.next(rows.top);
    if (finished_[block] && !(known && known->top == rows.top))
      file.append(rows.top, rows.bottom, bytes_of(pictures_, place_of(rows)));
  }
}

void PartialPicture::take(RowsFile& file) {
  for (auto part = file.next(0); part; part = file.next(part->bottom)) {
    const auto block = static_cast<std::size_t>(part->top / kStep);
    if (part->top % kStep != 0 || block >= finished_.size() || block_rows(block).bottom != part->bottom)
      continue;
    const std::optional<std::string> bytes = file.read(part->top);
    finished_[block] = bytes && take_bytes(*bytes, pictures_, place_of(block_rows(block)));
  }
}

RenderResult render_remaining(Renderer& renderer, const RenderOptions& options, PartialPicture& picture,
                              const RowCosts& costs, const Progress& progress,
                              const std::function<void()>& save) {
  RenderResult sum;
  BandHeight bands(options, costs);
  bool first = true;
  while (!picture.is_complete() && sum.complete) {
    PartialPicture::Rows rows = picture.next();
    rows.bottom = rows.top + bands.of(rows.top, rows.bottom - rows.top);
    const int count = rows.bottom - rows.top;
    const double done = picture.finished_share(costs) - costs.above(rows.top);
    const RenderResult result = renderer.render_rows(rows.top, rows.bottom, [&](double fraction) {
      return progress(std::clamp(done + costs.above(rows.top + fraction * count), 0.0, 1.0));
    });
    bands.learn(rows.top, count, result.statistics.render_seconds);
    // Missing blocks are black.
    picture.take(result, rows, !options.antialiasing && !options.blocks);
    sum.complete = result.complete;
    if (first)
      sum.statistics = result.statistics;
    else
      add_rows(sum.statistics, result.statistics);
    first = false;
    save();
  }
  return sum;
}

} // namespace celltrace::cli

#include "cli/partial_picture.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <limits>

namespace celltrace::cli {

namespace {

constexpr int kStep = Renderer::kRowStep;

template <class Value> void append(std::string& bytes, const Value* values, std::size_t count) {
  bytes.append(reinterpret_cast<const char*>(values), count * sizeof(Value));
}

/// Takes values from the front of bytes. After a failure all others fail, too.
class ByteReader {
public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

  template <class Value> void take(Value* values, std::size_t count) {
    const std::size_t size = count * sizeof(Value);
    good_ = good_ && bytes_.size() >= size;
    if (!good_) return;
    std::memcpy(values, bytes_.data(), size);
    bytes_.remove_prefix(size);
  }
  bool is_good() const { return good_; }
  bool is_at_end() const { return good_ && bytes_.empty(); }

private:
  std::string_view bytes_;
  bool good_ = true;
};

/// What is in front of the rows.
struct Header {
  std::int32_t width, height, top, bottom, has_colours, has_gamma, has_first_hits, has_blocks;
  double gamma;
};

/// Calls `handle` with each row's place in the picture.
template <class Handle>
void for_rows(const PartialPicture::Rows& rows, const PictureRegion& region, Handle handle) {
  for (int y = region.top + rows.top; y < region.top + rows.bottom; ++y)
    handle(y);
}

/// Calls `visit(to, from, count)` with where a row of numbers lies in both: of what is seen first, in the
/// columns of the region.
template <class To, class From, class Visit>
void visit_first_hits(To& to, From& from, const PartialPicture::Rows& rows, const PictureRegion& region,
                      Visit visit) {
  if (to.depth.empty()) return;
  const auto count = static_cast<std::size_t>(region.right - region.left);
  for_rows(rows, region, [&](int y) {
    const std::size_t first = static_cast<std::size_t>(y) * static_cast<std::size_t>(to.width) +
                              static_cast<std::size_t>(region.left);
    visit(&to.depth[first], &from.depth[first], count);
    visit(&to.normal[3 * first], &from.normal[3 * first], 3 * count);
    visit(&to.object[first], &from.object[first], count);
  });
}
/// Likewise of blocks, of pictures that are all one region. Rows of theirs are whole.
template <class To, class From, class Visit>
void visit_blocks(To& to, From& from, const PartialPicture::Rows& rows, Visit visit) {
  if (to.blocks.empty()) return;
  const std::size_t row = 8 * static_cast<std::size_t>(to.columns());
  const std::size_t top = static_cast<std::size_t>(rows.top) / 4,
                    bottom = (static_cast<std::size_t>(rows.bottom) + 3) / 4;
  visit(&to.blocks[top * row], &from.blocks[top * row], (bottom - top) * row);
}

} // namespace

PartialPicture::PartialPicture(const RenderOptions& options)
    : region_(options.region.value_or(PictureRegion{0, options.width, 0, options.height})),
      image_(options.width, options.height) {
  if (options.colours) colours_ = ColourImage(options.width, options.height);
  const auto clear = [&](auto& image) {
    for_rows({0, height()}, region_, [&](int y) {
      std::fill(image.pixel(region_.left, y),
                image.pixel(region_.left, y) + 4 * (region_.right - region_.left), 0);
    });
  };
  clear(image_);
  if (options.colours) clear(colours_);
  const std::size_t pixels = image_.rgba.size() / 4;
  if (options.first_hits) {
    first_hits_.width = options.width;
    first_hits_.height = options.height;
    first_hits_.depth.assign(pixels, std::numeric_limits<float>::infinity());
    first_hits_.normal.assign(3 * pixels, 0);
    first_hits_.object.assign(pixels, 0);
  }
  if (options.blocks) {
    blocks_.width = options.width;
    blocks_.height = options.height;
    blocks_.blocks.resize(8 * static_cast<std::size_t>(blocks_.columns()) *
                          static_cast<std::size_t>(blocks_.rows()));
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

PartialPicture::Rows PartialPicture::block_rows(std::size_t block) const {
  const int top = static_cast<int>(block) * kStep;
  return {top, std::min(top + kStep, height())};
}

PartialPicture::Rows PartialPicture::next() const {
  const auto first = std::find(finished_.begin(), finished_.end(), false);
  const auto end = std::find(first, finished_.end(), true);
  return {static_cast<int>(first - finished_.begin()) * kStep,
          std::min(static_cast<int>(end - finished_.begin()) * kStep, height())};
}

/// Where no ray arrived, alpha is 0.
bool PartialPicture::has_all_pixels(const Image& image, const Rows& rows) const {
  bool all = true;
  for_rows(rows, region_, [&](int y) {
    for (int x = region_.left; x < region_.right; ++x)
      all = all && image.pixel(x, y)[3] != 0;
  });
  return all;
}

void PartialPicture::take(const RenderResult& result, const Rows& rows, bool keeps_parts) {
  const auto copy = [&](auto& to, const auto& from) {
    const std::size_t row = 4 * static_cast<std::size_t>(region_.right - region_.left);
    for_rows(rows, region_,
             [&](int y) { std::copy_n(from.pixel(region_.left, y), row, to.pixel(region_.left, y)); });
  };
  copy(image_, result.image);
  if (!colours_.rgba.empty()) {
    copy(colours_, result.colours);
    colours_.gamma = result.colours.gamma;
  }
  const auto copy_numbers = [](auto* to, const auto* from, std::size_t count) {
    std::copy_n(from, count, to);
  };
  visit_first_hits(first_hits_, result.first_hits, rows, region_, copy_numbers);
  visit_blocks(blocks_, result.blocks, rows, copy_numbers);
  for (std::size_t block = static_cast<std::size_t>(rows.top / kStep); block < finished_.size(); ++block) {
    const Rows its = block_rows(block);
    if (its.top >= rows.bottom) break;
    finished_[block] = result.complete || (keeps_parts && has_all_pixels(image_, its));
  }
}

std::string PartialPicture::to_bytes() const {
  const bool has_colours = !colours_.rgba.empty();
  const Header header = {image_.width,
                         image_.height,
                         region_.top,
                         region_.bottom,
                         has_colours,
                         colours_.gamma.has_value(),
                         !first_hits_.depth.empty(),
                         !blocks_.blocks.empty(),
                         colours_.gamma.value_or(0)};
  std::string bytes;
  append(bytes, &header, 1);
  const std::size_t row = 4 * static_cast<std::size_t>(image_.width);
  for (std::size_t block = 0; block < finished_.size(); ++block) {
    bytes += finished_[block] ? '\1' : '\0';
    if (!finished_[block]) continue;
    for_rows(block_rows(block), region_, [&](int y) {
      append(bytes, image_.pixel(0, y), row);
      if (has_colours) append(bytes, colours_.pixel(0, y), row);
    });
    const auto append_numbers = [&](const auto* numbers, const auto*, std::size_t count) {
      append(bytes, numbers, count);
    };
    visit_first_hits(first_hits_, first_hits_, block_rows(block), region_, append_numbers);
    visit_blocks(blocks_, blocks_, block_rows(block), append_numbers);
  }
  return bytes;
}

bool PartialPicture::take_bytes(std::string_view bytes) {
  PartialPicture read = *this;
  ByteReader reader(bytes);
  Header header{};
  reader.take(&header, 1);
  const bool has_colours = !colours_.rgba.empty();
  if (!reader.is_good() || header.width != image_.width || header.height != image_.height ||
      header.top != region_.top || header.bottom != region_.bottom ||
      (header.has_colours != 0) != has_colours || (header.has_first_hits != 0) == first_hits_.depth.empty() ||
      (header.has_blocks != 0) == blocks_.blocks.empty())
    return false;
  if (header.has_gamma != 0)
    read.colours_.gamma = header.gamma;
  else
    read.colours_.gamma = std::nullopt;
  const std::size_t row = 4 * static_cast<std::size_t>(image_.width);
  for (std::size_t block = 0; block < finished_.size(); ++block) {
    char is_finished = 0;
    reader.take(&is_finished, 1);
    read.finished_[block] = is_finished != 0;
    if (is_finished == 0) continue;
    for_rows(block_rows(block), region_, [&](int y) {
      reader.take(read.image_.pixel(0, y), row);
      if (has_colours) reader.take(read.colours_.pixel(0, y), row);
    });
    const auto take_numbers = [&](auto* numbers, const auto*, std::size_t count) {
      reader.take(numbers, count);
    };
    visit_first_hits(read.first_hits_, first_hits_, block_rows(block), region_, take_numbers);
    visit_blocks(read.blocks_, blocks_, block_rows(block), take_numbers);
  }
  if (!reader.is_at_end()) return false;
  *this = std::move(read);
  return true;
}

namespace {

using Clock = std::chrono::steady_clock;

/// How many rows are rendered at once: all that take no longer than a band.
class BandHeight {
public:
  explicit BandHeight(const RenderOptions& options)
      : in_bands_(options.backend == Backend::native && options.model == Model::shared) {}

  int of(int rows, int height) const {
    if (!in_bands_) return rows;
    constexpr double kBandSeconds = 5;
    constexpr int kFirstPart = 8;
    double wanted = static_cast<double>(height) / kFirstPart;
    if (seconds_a_row_ >= 0) {
      if (rows * seconds_a_row_ < 2 * kBandSeconds) return rows;
      wanted = kBandSeconds / seconds_a_row_;
    }
    const int steps = static_cast<int>(std::ceil(std::max(wanted, 1.0) / kStep));
    return std::min(rows, steps * kStep);
  }
  void learn(int rows, double seconds) { seconds_a_row_ = seconds / rows; }

private:
  bool in_bands_;
  double seconds_a_row_ = -1; ///< of the last band; below 0: not known
};

} // namespace

RenderResult render_remaining(Renderer& renderer, const RenderOptions& options, PartialPicture& picture,
                              const Progress& progress, const std::function<void()>& save) {
  RenderResult sum;
  BandHeight bands(options);
  const int height = picture.height();
  int done = height - picture.missing_rows();
  bool first = true;
  while (!picture.is_complete() && sum.complete) {
    PartialPicture::Rows rows = picture.next();
    rows.bottom = rows.top + bands.of(rows.bottom - rows.top, height);
    const int count = rows.bottom - rows.top;
    const RenderResult result = renderer.render_rows(
        rows.top, rows.bottom, [&](double fraction) { return progress((done + fraction * count) / height); });
    done += count;
    bands.learn(count, result.statistics.render_seconds);
    // What is missing of blocks is black.
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

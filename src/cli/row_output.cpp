#include "cli/row_output.hpp"

#include "celltrace/error.hpp"
#include "render/picture_options.hpp"

#include <algorithm>
#include <cerrno>
#include <limits>
#include <string>
#include <system_error>

namespace celltrace::cli {
namespace fs = std::filesystem;

namespace {

image::RowFormat format_of(const RenderRequest& request, const std::optional<double>& gamma) {
  image::RowFormat format;
  format.width = request.options.width;
  format.height = request.options.height;
  format.channels =
      (request.file.grey ? 1 : 3) + (request.file.alpha.value_or(request.options.alpha) ? 1 : 0);
  format.bits = request.bits;
  format.gamma = request.file.gamma;
  format.jpeg_quality = request.file.jpeg_quality;
  format.run_lengths = request.file.run_lengths;
  format.colour_gamma = gamma;
  format.first_hits = request.options.first_hits;
  return format;
}

image::FirstHitRows first_hits_of(const PictureRows& rows, std::size_t pixel) {
  const FirstHits& hits = rows.first_hits;
  if (hits.depth.empty()) return {};
  return {&hits.depth[pixel], &hits.normal[3 * pixel], &hits.object[pixel]};
}

void write_rows(image::RowWriter& writer, const PictureRows& rows) {
  if (rows.colours.rgba.empty())
    writer.write(rows.image.rgba.data(), rows.image.height);
  else
    writer.write(rows.colours.rgba.data(), rows.colours.height, first_hits_of(rows, 0));
}

/// Copies a row into the middle of another one.
template <class Picture> void copy_row(const Picture& from, int row, Picture& to, int left) {
  if (from.rgba.empty()) return;
  std::copy_n(from.pixel(0, row), 4 * static_cast<std::size_t>(from.width), to.pixel(left, 0));
}
void copy_row(const FirstHits& from, int row, FirstHits& to, int left) {
  if (from.depth.empty()) return;
  const auto copy = [&](const auto& numbers, auto& copied, std::ptrdiff_t channels) {
    const std::ptrdiff_t count = channels * from.width;
    std::copy_n(numbers.begin() + row * count, count, copied.begin() + channels * left);
  };
  copy(from.depth, to.depth, 1);
  copy(from.normal, to.normal, 3);
  copy(from.object, to.object, 1);
}

} // namespace

RowOutput::RowOutput(const RenderRequest& request, const fs::path& path)
    : request_(request), path_(path), region_(region_of(request.options)),
      flows_(path == kStandardOutput || image::is_stream(path)) {
  if (path.empty()) return;
  if (path == kStandardOutput) {
    stream_ = stdout;
    return;
  }
  naming_the_file([&] { file_.emplace(path); });
  stream_ = file_->get();
}

template <class Work> void RowOutput::naming_the_file(Work work) {
  try {
    work();
  } catch (const InputError& error) {
    throw InputError((path_ == kStandardOutput ? "standard output " : path_.string() + ": ") + error.what());
  }
}

void RowOutput::write(const PictureRows& rows) {
  if (stream_ == nullptr) return;
  naming_the_file([&] {
    if (!writer_) open(rows.colours.gamma);
    put(rows);
    if (flows_ && (std::fflush(stream_) != 0 || std::ferror(stream_) != 0))
      throw InputError("cannot be written: " + std::generic_category().message(errno));
  });
}

void RowOutput::write_blank(int count) {
  if (stream_ == nullptr) return;
  naming_the_file([&] {
    if (!writer_) open(ColourImage().gamma);
    put_blank(count);
  });
}

void RowOutput::finish() {
  if (stream_ == nullptr) return;
  naming_the_file([&] {
    if (!writer_) open(ColourImage().gamma);
    put_blank(request_.options.height - region_.bottom);
    writer_->finish();
    if (file_) file_->commit();
  });
}

void RowOutput::open(const std::optional<double>& gamma) {
  writer_ = image::open_rows(stream_, request_.format, format_of(request_, gamma));
  make_blank_row();
  put_blank(region_.top);
}

void RowOutput::make_blank_row() {
  const RenderOptions& options = request_.options;
  const auto clear = [&](auto& picture) {
    if (options.alpha) std::fill(picture.rgba.begin(), picture.rgba.end(), 0);
  };
  if (options.colours) {
    blank_.colours = ColourImage(options.width, 1);
    clear(blank_.colours);
  } else {
    blank_.image = Image(options.width, 1);
    clear(blank_.image);
  }
  if (!options.first_hits) return;
  const auto pixels = static_cast<std::size_t>(options.width);
  blank_.first_hits = {options.width, 1, {}, {}, {}};
  blank_.first_hits.depth.assign(pixels, std::numeric_limits<float>::infinity());
  blank_.first_hits.normal.assign(3 * pixels, 0);
  blank_.first_hits.object.assign(pixels, 0);
}

void RowOutput::put_blank(int count) {
  for (int row = 0; row < count; ++row)
    write_rows(*writer_, blank_);
}

void RowOutput::put(const PictureRows& rows) {
  if (region_.right - region_.left == request_.options.width) return write_rows(*writer_, rows);
  const int count = rows.colours.rgba.empty() ? rows.image.height : rows.colours.height;
  // Margins stay blank.
  PictureRows row = blank_;
  for (int y = 0; y < count; ++y) {
    copy_row(rows.image, y, row.image, region_.left);
    copy_row(rows.colours, y, row.colours, region_.left);
    copy_row(rows.first_hits, y, row.first_hits, region_.left);
    write_rows(*writer_, row);
  }
}

} // namespace celltrace::cli

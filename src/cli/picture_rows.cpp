#include "cli/picture_rows.hpp"

#include <cstddef>
#include <cstring>
#include <optional>
#include <utility>

namespace celltrace::cli {

namespace {

/// Appends values to bytes.
class ByteWriter {
public:
  template <class Value> void visit(const Value* values, std::size_t count) {
    bytes_.append(reinterpret_cast<const char*>(values), count * sizeof(Value));
  }
  std::string take() { return std::move(bytes_); }

private:
  std::string bytes_;
};

/// Reads values from the front of bytes. After a failure, all further reads fail, too.
class ByteReader {
public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

  template <class Value> void visit(Value* values, std::size_t count) {
    const std::size_t size = count * sizeof(Value);
    good_ = good_ && bytes_.size() >= size;
    if (!good_) return;
    std::memcpy(values, bytes_.data(), size);
    bytes_.remove_prefix(size);
  }
  bool is_at_end() const { return good_ && bytes_.empty(); }

private:
  std::string_view bytes_;
  bool good_ = true;
};

/// Calls visitor.visit(numbers, count) for all data of a part. `Rows` may be constant.
template <class Rows, class Visitor>
void visit_part(Rows& rows, const PictureRegion& part, double& gamma, Visitor& visitor) {
  const auto columns = static_cast<std::size_t>(part.right - part.left);
  if (!rows.colours.rgba.empty()) visitor.visit(&gamma, 1);
  for (int y = part.top; y < part.bottom; ++y) {
    if (!rows.image.rgba.empty()) visitor.visit(rows.image.pixel(part.left, y), 4 * columns);
    if (!rows.colours.rgba.empty()) visitor.visit(rows.colours.pixel(part.left, y), 4 * columns);
    if (auto& hits = rows.first_hits; !hits.depth.empty()) {
      const std::size_t first = static_cast<std::size_t>(y) * static_cast<std::size_t>(hits.width) +
                                static_cast<std::size_t>(part.left);
      visitor.visit(&hits.depth[first], columns);
      visitor.visit(&hits.normal[3 * first], 3 * columns);
      visitor.visit(&hits.object[first], columns);
    }
  }
  if (auto& blocks = rows.blocks; !blocks.blocks.empty()) {
    const std::size_t row = 8 * static_cast<std::size_t>(blocks.columns());
    const std::size_t top = static_cast<std::size_t>(part.top) / 4,
                      bottom = (static_cast<std::size_t>(part.bottom) + 3) / 4;
    visitor.visit(&blocks.blocks[top * row], (bottom - top) * row);
  }
}

/// The gamma, in bytes, of colours without one.
constexpr double kNoGamma = 0;

} // namespace

PictureRows rows_of(RenderResult&& result) {
  return {std::move(result.image), std::move(result.colours), std::move(result.first_hits),
          std::move(result.blocks)};
}

std::string bytes_of(const PictureRows& rows, const PictureRegion& part) {
  double gamma = rows.colours.gamma.value_or(kNoGamma);
  ByteWriter writer;
  visit_part(rows, part, gamma, writer);
  return writer.take();
}

bool take_bytes(std::string_view bytes, PictureRows& rows, const PictureRegion& part) {
  double gamma = kNoGamma;
  ByteReader reader(bytes);
  visit_part(rows, part, gamma, reader);
  rows.colours.gamma = gamma == kNoGamma ? std::nullopt : std::optional(gamma);
  return reader.is_at_end();
}

bool has_all_pixels(const Image& image, const PictureRegion& part) {
  for (int y = part.top; y < part.bottom; ++y)
    for (int x = part.left; x < part.right; ++x)
      if (image.pixel(x, y)[3] == 0) return false;
  return true;
}

} // namespace celltrace::cli

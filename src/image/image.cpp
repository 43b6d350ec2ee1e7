#include "celltrace/image.hpp"

#include "image/huge_pages.hpp"
#include "image/limits.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace celltrace {

namespace {

/// The largest value of a channel.
template <class Channel> constexpr Channel kOpaque = std::numeric_limits<Channel>::max();
template <> constexpr float kOpaque<float> = 1.0f;

std::uint16_t encoded(double colour, const std::optional<double>& gamma) {
  if (!(colour > 0)) return 0;
  double value = std::min(colour, 1.0);
  if (gamma) {
    value = std::pow(value, *gamma);
    value = value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1 / 2.4) - 0.055;
  }
  return static_cast<std::uint16_t>(std::lround(value * 65535));
}

} // namespace

template <class Channel>
BasicImage<Channel>::BasicImage(int image_width, int image_height)
    : width(image_width), height(image_height) {
  image::check_size(image_width, image_height);
  const std::size_t count = 4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  rgba.reserve(count);
  use_huge_pages(rgba.data(), count * sizeof(Channel));
  rgba.resize(count);
  for (std::size_t alpha = 3; alpha < rgba.size(); alpha += 4)
    rgba[alpha] = kOpaque<Channel>;
}
template struct BasicImage<std::uint8_t>;
template struct BasicImage<std::uint16_t>;
template struct BasicImage<float>;

DeepImage to_deep_image(const ColourImage& colours) {
  image::check_image(colours);
  DeepImage deep(colours.width, colours.height);
  for (std::size_t i = 0; i < deep.rgba.size(); ++i) {
    const double value = static_cast<double>(colours.rgba[i]);
    deep.rgba[i] = i % 4 == 3 ? encoded(value, std::nullopt) : encoded(value, colours.gamma);
  }
  return deep;
}

namespace image {

void check_size(std::int64_t width, std::int64_t height) {
  const std::string size = std::to_string(width) + "x" + std::to_string(height);
  if (width < 1 || height < 1) throw InputError("a picture of " + size + " pixels is empty");
  if (width > kMaxImageSide || height > kMaxImageSide || width * height > kMaxImagePixels)
    throw InputError("a picture of " + size + " pixels is too large: " + std::to_string(kMaxImageSide) +
                     " pixels a side and " + std::to_string(kMaxImagePixels) + " in all are the limits");
}

} // namespace image
} // namespace celltrace

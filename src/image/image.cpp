#include "celltrace/image.hpp"

#include "image/encoding.hpp"
#include "image/limits.hpp"

#include <limits>
#include <string>

namespace celltrace {

namespace {

/// Largest value of a channel.
template <class Channel> constexpr Channel kOpaque = std::numeric_limits<Channel>::max();
template <> constexpr float kOpaque<float> = 1.0f;

template <class Channel> BasicImage<Channel> for_display(const ColourImage& colours) {
  image::check_image(colours);
  BasicImage<Channel> image(colours.width, colours.height);
  image::Encoding(colours.gamma)
      .encode(colours.rgba.data(), colours.rgba.size() / 4, image.rgba.data(), image::Alpha::kept, false);
  return image;
}

} // namespace

template <class Channel>
BasicImage<Channel>::BasicImage(int image_width, int image_height)
    : width(image_width), height(image_height) {
  image::check_size(image_width, image_height);
  const std::size_t count = 4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  rgba.resize(count);
  for (std::size_t alpha = 3; alpha < rgba.size(); alpha += 4)
    rgba[alpha] = kOpaque<Channel>;
}
template struct BasicImage<std::uint8_t>;
template struct BasicImage<std::uint16_t>;
template struct BasicImage<float>;

DeepImage to_deep_image(const ColourImage& colours) {
  return for_display<std::uint16_t>(colours);
}
Image to_image(const ColourImage& colours) {
  return for_display<std::uint8_t>(colours);
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

#include "celltrace/image.hpp"

#include "image/formats.hpp"
#include "image/limits.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace celltrace {

namespace {

/// The largest value of a channel.
template <class Channel> constexpr Channel kOpaque = std::numeric_limits<Channel>::max();
template <> constexpr float kOpaque<float> = 1.0f;

/// Of a channel: 0 to 1.
double encoded(double colour, const std::optional<double>& gamma) {
  if (!(colour > 0)) return 0;
  double value = std::min(colour, 1.0);
  if (gamma) {
    value = std::pow(value, *gamma);
    value = value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1 / 2.4) - 0.055;
  }
  return value;
}

/// POV-Ray's luminance.
double grey(const float* rgb) {
  return 0.297 * static_cast<double>(rgb[0]) + 0.589 * static_cast<double>(rgb[1]) +
         0.114 * static_cast<double>(rgb[2]);
}

template <class Channel> BasicImage<Channel> for_display(const ColourImage& colours) {
  image::check_image(colours);
  BasicImage<Channel> image(colours.width, colours.height);
  const auto rounded = [](double value) {
    return static_cast<Channel>(std::lround(value * std::numeric_limits<Channel>::max()));
  };
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
    const float* const pixel = colours.rgba.data() + i;
    double alpha = encoded(static_cast<double>(pixel[3]), std::nullopt);
    double share = 1;
    if (alpha < 1) {
      // Luminance that is not a number leaves alpha as it is.
      if (const double bright = std::min(grey(pixel), 1.0); bright > alpha) alpha = bright;
      if (alpha > 0) share = 1 / alpha;
    }
    for (std::size_t channel = 0; channel < 3; ++channel)
      image.rgba[i + channel] = rounded(encoded(static_cast<double>(pixel[channel]) * share, colours.gamma));
    image.rgba[i + 3] = rounded(alpha);
  }
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

ColourImage to_linear(const ColourImage& colours) {
  ColourImage linear = colours;
  linear.gamma = 1.0;
  if (colours.gamma == 1.0) return linear;
  const auto decoded = [&](double value) {
    if (colours.gamma) return std::pow(value, *colours.gamma);
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4); // sRGB
  };
  for (std::size_t i = 0; i < linear.rgba.size(); ++i)
    if (i % 4 != 3) {
      float& value = linear.rgba[i];
      value = static_cast<float>(std::copysign(decoded(std::fabs(static_cast<double>(value))), value));
    }
  return linear;
}

void check_size(std::int64_t width, std::int64_t height) {
  const std::string size = std::to_string(width) + "x" + std::to_string(height);
  if (width < 1 || height < 1) throw InputError("a picture of " + size + " pixels is empty");
  if (width > kMaxImageSide || height > kMaxImageSide || width * height > kMaxImagePixels)
    throw InputError("a picture of " + size + " pixels is too large: " + std::to_string(kMaxImageSide) +
                     " pixels a side and " + std::to_string(kMaxImagePixels) + " in all are the limits");
}

} // namespace image
} // namespace celltrace

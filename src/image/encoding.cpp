#include "image/encoding.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace celltrace::image {

namespace {

/// Returns POV-Ray's luminance.
double luminance(const float* rgb) {
  return 0.297 * static_cast<double>(rgb[0]) + 0.589 * static_cast<double>(rgb[1]) +
         0.114 * static_cast<double>(rgb[2]);
}

template <class Channel> Channel rounded(double value) {
  return static_cast<Channel>(std::lround(value * std::numeric_limits<Channel>::max()));
}

/// Returns the value clipped to 0..1, and 0 for NaN.
double clipped(double value) {
  return value > 0 ? std::min(value, 1.0) : 0;
}

} // namespace

double Encoding::encoded(double colour) const {
  double value = clipped(colour);
  if (!colour_gamma_ || value == 0) return value;
  value = std::pow(value, *colour_gamma_);
  if (power_) return std::pow(value, 1 / *power_);
  return value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1 / 2.4) - 0.055;
}

template <class Channel>
void Encoding::encode(const float* rgba, std::size_t pixels, Channel* out, Alpha kept, bool grey) const {
  for (std::size_t i = 0; i < 4 * pixels; i += 4) {
    const float* const pixel = rgba + i;
    double alpha = kept == Alpha::kept ? clipped(static_cast<double>(pixel[3])) : 1;
    double share = 1;
    if (alpha < 1) {
      // A luminance that is NaN leaves alpha unchanged.
      if (const double bright = std::min(luminance(pixel), 1.0); bright > alpha) alpha = bright;
      if (alpha > 0) share = 1 / alpha;
    }
    if (grey) {
      // POV-Ray weighs colours before it makes them linear.
      out[i] = out[i + 1] = out[i + 2] = rounded<Channel>(encoded(luminance(pixel) * share));
    } else {
      for (std::size_t channel = 0; channel < 3; ++channel)
        out[i + channel] = rounded<Channel>(encoded(static_cast<double>(pixel[channel]) * share));
    }
    out[i + 3] = rounded<Channel>(alpha);
  }
}
template void Encoding::encode(const float*, std::size_t, std::uint8_t*, Alpha, bool) const;
template void Encoding::encode(const float*, std::size_t, std::uint16_t*, Alpha, bool) const;

double decoded(double value, const FileGamma& gamma) {
  if (gamma.power) return std::pow(value, *gamma.power);
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4); // sRGB
}

void make_linear(float* rgba, std::size_t pixels, std::optional<double> gamma) {
  if (gamma == 1.0) return;
  for (std::size_t i = 0; i < 4 * pixels; ++i)
    if (i % 4 != 3) {
      const auto value = static_cast<double>(rgba[i]);
      rgba[i] = static_cast<float>(std::copysign(decoded(std::fabs(value), {gamma}), value));
    }
}

} // namespace celltrace::image

// Converts the colours that rays bring to the encoded values of files.
#pragma once

#include "celltrace/image.hpp"

#include <cstddef>
#include <optional>

namespace celltrace::image {

/// The treatment of alpha.
enum class Alpha {
  kept,    ///< colours are divided by their alpha, for files with alpha
  left_out ///< colours are not divided: they appear in front of black
};

/// Encodes colours for files of 8 or 16 bits a channel.
class Encoding {
public:
  /// Makes an encoding. `colour_gamma` is as ColourImage::gamma; if it is empty, colours are for display
  /// already, and `file` is ignored.
  explicit Encoding(std::optional<double> colour_gamma, const FileGamma& file = {})
      : colour_gamma_(colour_gamma), power_(file.power) {}

  /// Returns the encoded value, 0 to 1, of one channel. NaN becomes 0.
  double encoded(double colour) const;
  /// Encodes `pixels` pixels of four channels. `grey` replaces the three colours by their luminance.
  template <class Channel>
  void encode(const float* rgba, std::size_t pixels, Channel* out, Alpha alpha, bool grey) const;

private:
  std::optional<double> colour_gamma_;
  std::optional<double> power_;
};

/// Returns the light, 0 to 1, that an encoded value from 0 to 1 stands for.
double decoded(double value, const FileGamma& gamma);

/// Makes the colours of `pixels` pixels linear, in place. `gamma` is as ColourImage::gamma.
void make_linear(float* rgba, std::size_t pixels, std::optional<double> gamma);

} // namespace celltrace::image

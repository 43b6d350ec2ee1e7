// What the picture tests share: files, and a picture without symmetry.
#pragma once

#include "celltrace/image.hpp"
#include "files.hpp"

namespace celltrace::test {

inline Image asymmetric_image(int width, int height) {
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int channel = 0; channel < 3; ++channel)
        image.pixel(x, y)[channel] = static_cast<std::uint8_t>(31 * x + 57 * y + 101 * channel);
  return image;
}

inline Image uniform(int width, int height, std::uint8_t value) {
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int channel = 0; channel < 3; ++channel)
        image.pixel(x, y)[channel] = value;
  return image;
}

} // namespace celltrace::test

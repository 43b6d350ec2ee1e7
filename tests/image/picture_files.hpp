// What the picture tests share: files, and a picture without symmetry.
#pragma once

#include "celltrace/image.hpp"
#include "files.hpp"

namespace celltrace::test {

template <class Channel = std::uint8_t> BasicImage<Channel> asymmetric_image(int width, int height) {
  BasicImage<Channel> image(width, height);
  constexpr int kStep = sizeof(Channel) == 1 ? 1 : 107; // all bytes of a channel differ
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int channel = 0; channel < 3; ++channel)
        image.pixel(x, y)[channel] = static_cast<Channel>(kStep * (31 * x + 57 * y + 101 * channel));
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

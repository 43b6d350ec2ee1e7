// Checks of the limits of image.hpp, which throw InputError.
#pragma once

#include "celltrace/image.hpp"

namespace celltrace::image {

/// Throws unless 1 <= width, height <= kMaxImageSide and width * height <= kMaxImagePixels. Does not overflow
/// for values up to 2^31.
void check_size(std::int64_t width, std::int64_t height);

/// Calls check_size(), and throws unless there are four channels a pixel.
template <class Channel> void check_image(const BasicImage<Channel>& image) {
  check_size(image.width, image.height);
  if (image.rgba.size() != 4 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height))
    throw InputError("a picture's pixels do not match its size");
}

} // namespace celltrace::image

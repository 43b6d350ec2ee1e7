// The limits of image.hpp, as checks that throw InputError.
#pragma once

#include "celltrace/image.hpp"

namespace celltrace::image {

/// Throws unless 1 <= width, height <= kMaxImageSide and width * height <= kMaxImagePixels. Any values are
/// safe up to 2^31 each.
void check_size(std::int64_t width, std::int64_t height);

/// check_size(), and that there are four channels a pixel.
template <class Channel> void check_image(const BasicImage<Channel>& image) {
  check_size(image.width, image.height);
  if (image.rgba.size() != 4 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height))
    throw InputError("a picture's pixels do not match its size");
}

} // namespace celltrace::image

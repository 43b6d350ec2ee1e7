// The limits of image.hpp, as checks that throw InputError.
#pragma once

#include "celltrace/image.hpp"

namespace celltrace::image {

/// Throws unless 1 <= width, height <= kMaxImageSide and width * height <= kMaxImagePixels. Any values are
/// safe up to 2^31 each.
void check_size(std::int64_t width, std::int64_t height);

/// check_size(), and that there are four bytes a pixel.
void check_image(const Image& image);

} // namespace celltrace::image

// The picture formats. Errors are InputError without the file's name; image_io.cpp puts it in front.
#pragma once

#include "celltrace/image.hpp"

#include <cstdio>

namespace celltrace::image {

/// The file is positioned at its first byte and is `file_bytes` long.
Image read_png(std::FILE* file, std::uintmax_t file_bytes);
Image read_ppm(std::FILE* file, std::uintmax_t file_bytes);

/// Of Image and DeepImage.
template <class Channel> void write_png(std::FILE* file, const BasicImage<Channel>& image);
template <class Channel> void write_ppm(std::FILE* file, const BasicImage<Channel>& image);

} // namespace celltrace::image

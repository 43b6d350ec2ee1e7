// The picture formats. Errors are InputError without the file's name; image_io.cpp puts it in front.
#pragma once

#include "celltrace/image.hpp"

#include <cstdio>

namespace celltrace::image {

/// The file is positioned at its first byte and is `file_bytes` long.
Image read_png(std::FILE* file, std::uintmax_t file_bytes);
Image read_ppm(std::FILE* file, std::uintmax_t file_bytes);

void write_png(std::FILE* file, const Image& image);
void write_ppm(std::FILE* file, const Image& image);

} // namespace celltrace::image

// The picture formats. Errors are InputError without the file's name; image_io.cpp puts it in front.
#pragma once

#include "celltrace/image.hpp"

#include <cstdio>

namespace celltrace::image {

/// The file is positioned at its first byte and is `file_bytes` long.
Image read_png(std::FILE* file, std::uintmax_t file_bytes);
Image read_ppm(std::FILE* file, std::uintmax_t file_bytes);
Image read_tga(std::FILE* file, std::uintmax_t file_bytes);
Image read_bmp(std::FILE* file, std::uintmax_t file_bytes);
/// Throws InputError if the build has no libjpeg, too.
Image read_jpeg(std::FILE* file, std::uintmax_t file_bytes);
/// Whether the file ends as a TGA does. It is left at its first byte.
bool is_tga(std::FILE* file, std::uintmax_t file_bytes);

/// Throws InputError if the size has no pixels, too many, or not as many as there are blocks.
void check_blocks(const BlockImage& blocks);
void write_dds(std::FILE* file, const BlockImage& blocks);

/// Throws InputError for a write that has failed, as errno says.
void write_bytes(std::FILE* file, const void* bytes, std::size_t count);

} // namespace celltrace::image

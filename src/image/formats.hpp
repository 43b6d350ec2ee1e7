// The picture formats. Errors are InputError without the file's name; image_io.cpp puts it in front.
#pragma once

#include "celltrace/image.hpp"

#include <cstdio>

namespace celltrace::image {

/// Read a picture from the beginning of a file that is `file_bytes` long.
Image read_png(std::FILE* file, std::uintmax_t file_bytes);
Image read_ppm(std::FILE* file, std::uintmax_t file_bytes);
Image read_tga(std::FILE* file, std::uintmax_t file_bytes);
Image read_bmp(std::FILE* file, std::uintmax_t file_bytes);
/// Reads a JPEG. Throws InputError also if the build has no libjpeg.
Image read_jpeg(std::FILE* file, std::uintmax_t file_bytes);
/// Returns whether the file ends as a TGA does, and goes back to its first byte.
bool is_tga(std::FILE* file, std::uintmax_t file_bytes);

/// Throws InputError if the size has no pixels or too many, or does not match the number of blocks.
void check_blocks(const BlockImage& blocks);
void write_dds(std::FILE* file, const BlockImage& blocks);

/// Writes bytes. Throws InputError with the text of errno if that fails.
void write_bytes(std::FILE* file, const void* bytes, std::size_t count);

} // namespace celltrace::image

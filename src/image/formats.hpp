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
/// Colours that are amounts of light, whatever they were.
ColourImage to_linear(const ColourImage& colours);
/// `linear` has such colours.
void write_hdr(std::FILE* file, const ColourImage& linear);
/// Throws InputError if the size has no pixels, too many, or not as many as there are blocks.
void check_blocks(const BlockImage& blocks);
void write_dds(std::FILE* file, const BlockImage& blocks);
/// Throws InputError if the build has no OpenEXR.
void check_has_exr();
void write_exr(std::FILE* file, const ColourImage& linear, const ExrOptions& options);

/// Throws InputError for a write that has failed, as errno says.
void write_bytes(std::FILE* file, const void* bytes, std::size_t count);

} // namespace celltrace::image

// Writes Y4M (YUV4MPEG2), as MJPEG Tools define it: uncompressed video that most video programs read. Chroma
// is not subsampled (C444); ITU-R BT.601 in its limited range, which these programs assume.
#pragma once

#include "celltrace/image.hpp"

#include <cstdio>

namespace celltrace::image {

/// Writes the head of a film with a rate of `frames` frames in `seconds` seconds. Throws InputError without
/// the file's name if that fails, as write_y4m_frame() does.
void write_y4m_header(std::FILE* file, int width, int height, unsigned frames, unsigned seconds);
/// Writes a frame, without its alpha.
void write_y4m_frame(std::FILE* file, const Image& image);

} // namespace celltrace::image

// Y4M (YUV4MPEG2), as MJPEG Tools define it: uncompressed video that most programs for films read. No chroma
// is left out (C444); ITU-R BT.601 in its limited range, which is what those programs take it for.
#pragma once

#include "celltrace/image.hpp"

#include <cstdio>

namespace celltrace::image {

/// What begins a film of `frames` a `seconds`. Throws InputError without the file's name, as the next one
/// does, if it cannot be written.
void write_y4m_header(std::FILE* file, int width, int height, unsigned frames, unsigned seconds);
/// A frame. Alpha is left out.
void write_y4m_frame(std::FILE* file, const Image& image);

} // namespace celltrace::image

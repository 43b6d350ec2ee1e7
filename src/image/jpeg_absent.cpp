// Replaces jpeg_read.cpp and jpeg_write.cpp in builds without libjpeg.
#include "image/format_table.hpp"
#include "image/formats.hpp"

namespace celltrace::image {

const bool kHasJpeg = false;

std::unique_ptr<RowWriter> open_jpeg(std::FILE*, const RowFormat&) {
  return nullptr; // not called
}

Image read_jpeg(std::FILE*, std::uintmax_t) {
  throw InputError("is a JPEG, which this build cannot read: libjpeg was not there when it was configured");
}

} // namespace celltrace::image

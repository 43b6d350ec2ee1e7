// Builds without OpenEXR.
#include "image/formats.hpp"

namespace celltrace::image {

void check_has_exr() {
  throw InputError("this build cannot write OpenEXR files: its library was not there when it was configured");
}

void write_exr(std::FILE*, const ColourImage&, const ExrOptions&) {
  check_has_exr();
}

} // namespace celltrace::image

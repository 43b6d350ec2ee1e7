// libjpeg's errors. libjpeg leaves by longjmp when it fails; a function that calls setjmp therefore has
// no locals with a destructor, and owners live in its caller.
#pragma once

#include <csetjmp>
#include <cstdio>

#include <jpeglib.h>

namespace celltrace::image {

struct JpegFailure {
  jpeg_error_mgr manager; ///< first, because libjpeg knows only this part
  std::jmp_buf leave;
  char text[JMSG_LENGTH_MAX] = "";

  /// Returns the value for the `err` of a compressor or decompressor.
  jpeg_error_mgr* begin() {
    jpeg_error_mgr* const errors = jpeg_std_error(&manager);
    errors->error_exit = [](j_common_ptr info) {
      auto* failure = reinterpret_cast<JpegFailure*>(info->err);
      failure->manager.format_message(info, failure->text);
      std::longjmp(failure->leave, 1);
    };
    errors->output_message = [](j_common_ptr) {}; // warnings
    return errors;
  }
};

} // namespace celltrace::image

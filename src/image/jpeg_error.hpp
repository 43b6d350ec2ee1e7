// libjpeg's errors. It leaves by longjmp when it fails; every function that calls setjmp therefore keeps
// nothing with a destructor, and owners live in its caller.
#pragma once

#include <csetjmp>
#include <cstdio>

#include <jpeglib.h>

namespace celltrace::image {

struct JpegFailure {
  jpeg_error_mgr manager; ///< first: libjpeg knows this part only
  std::jmp_buf leave;
  char text[JMSG_LENGTH_MAX] = "";

  /// Returns what a compressor's or decompressor's `err` is to be.
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

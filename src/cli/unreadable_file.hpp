// Messages about a file that a command needs and cannot read.
#pragma once

#include "celltrace/error.hpp"

#include <filesystem>
#include <string>
#include <system_error>

namespace celltrace::cli {

/// Returns the error for a file that could not be read, in the words used for scenes and pictures.
inline InputError unreadable(const std::filesystem::path& path) {
  std::error_code none;
  const std::filesystem::file_status status = std::filesystem::status(path, none);
  const char* const what = !std::filesystem::exists(status)        ? "there is no such file"
                           : std::filesystem::is_directory(status) ? "this is a directory, not a file"
                                                                   : "cannot be read";
  return InputError(path.string() + ": " + what);
}

} // namespace celltrace::cli

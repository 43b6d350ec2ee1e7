// Keeps finished rows of a picture while it is rendered.
#pragma once

#include "celltrace/error.hpp"
#include "cli/partial_picture.hpp"
#include "cli/rows_file.hpp"

#include <chrono>

namespace celltrace::cli {

/// Appends finished rows to a file. If that fails, it prints one warning and keeps no more rows: the picture
/// matters more.
class RowKeeper {
public:
  explicit RowKeeper(RowsFile& file) : file_(file) {}

  /// Appends the new rows of a picture in memory every ten seconds or so; at once if it is the last call.
  void save(const PartialPicture& picture, bool at_once);
  /// Calls append(file), unless that has failed before.
  template <class Append> void keep(Append append) {
    if (has_failed_) return;
    try {
      append(file_);
    } catch (const InputError& error) {
      fail(error);
    }
  }

private:
  using Clock = std::chrono::steady_clock;

  void fail(const InputError& error);

  RowsFile& file_;
  bool has_failed_ = false;
  Clock::time_point last_ = Clock::now();
};

} // namespace celltrace::cli

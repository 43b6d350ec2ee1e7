// Lets a writer seek back in any stream.
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <vector>

#include "image/file.hpp"

namespace celltrace::image {

/// A file whose bytes may be written in any order. A regular file is written to directly; bytes for a pipe,
/// or for a file opened for appending, are kept in memory or in a temporary file until
/// finish(). Errors are InputErrors without the file's name.
class SeekableFile {
public:
  /// Begins at the stream's position. `expected` is the approximate number of bytes.
  SeekableFile(std::FILE* target, std::uint64_t expected);

  void write(const void* bytes, std::size_t count);
  std::uint64_t position() const { return position_; }
  void seek(std::uint64_t position);
  /// Writes kept bytes, and leaves the target behind the last byte.
  void finish();

private:
  std::FILE* target_;
  std::int64_t origin_ = -1; ///< position in the target; -1 if bytes are kept elsewhere
  File spool_;               ///< null if bytes are kept in memory
  std::vector<std::uint8_t> memory_;
  std::uint64_t position_ = 0, end_ = 0;
};

} // namespace celltrace::image

// A file to which finished rows of a picture are appended, for a run that continues. Each part has a
// checksum, so that the intact parts of a truncated or damaged file can be used.
#pragma once

#include "image/file.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace celltrace::cli {

class RowsFile {
public:
  /// Makes an object that keeps nothing.
  RowsFile() = default;
  /// Opens a file. `head` identifies the picture. If the file at `path` has the same head, its parts are
  /// available; else there are none, and the first append() replaces the file.
  RowsFile(std::filesystem::path path, std::string head);

  /// Returns the head of a file; nothing if there is no such file, or if it is damaged.
  static std::optional<std::string> head_of(const std::filesystem::path& path);

  bool is_kept() const { return !path_.empty(); }
  struct Rows {
    int top, bottom;
  };
  /// Returns the first part that begins with this row or below it; nothing if there is no such part.
  std::optional<Rows> next(int top) const;
  int count() const;
  /// Returns the bytes of the part that begins with this row; nothing if there is no such part, or if it is
  /// damaged, in which case it is forgotten.
  std::optional<std::string> read(int top);
  /// Appends a part. Throws InputError if the file cannot be written.
  void append(int top, int bottom, std::string_view bytes);

private:
  struct Part {
    int bottom;
    std::uint64_t at, bytes; ///< position and size in the file
    std::uint64_t checksum;
  };

  void find_parts();
  void begin();

  std::filesystem::path path_;
  std::string head_;
  std::map<int, Part> parts_; ///< key: first row
  std::uint64_t end_ = 0;     ///< end of the last intact part in the file; 0 if there is no file yet
  image::File file_;          ///< open for appending
};

} // namespace celltrace::cli

// A file that finished rows of a picture are appended to, for a run that goes on. Each part has a checksum:
// of a file that is cut off or damaged the parts that are whole count.
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
  /// Keeps nothing.
  RowsFile() = default;
  /// `head` says what the rows are of. Has the parts of the file at `path` if that has the same head, else
  /// none; then the first append() replaces the file.
  RowsFile(std::filesystem::path path, std::string head);

  /// Returns the head of a file; none if there is no such file, or if it is damaged.
  static std::optional<std::string> head_of(const std::filesystem::path& path);

  bool is_kept() const { return !path_.empty(); }
  /// Rows [top, bottom) of a part.
  struct Rows {
    int top, bottom;
  };
  /// Returns the first part that begins with this row or one below; none if there is no such part.
  std::optional<Rows> next(int top) const;
  /// Counts the rows of all parts.
  int count() const;
  /// Returns the bytes of the part that begins with this row; none if there is no such part, or if it is
  /// damaged, which is forgotten then.
  std::optional<std::string> read(int top);
  /// Throws InputError if the file cannot be written.
  void append(int top, int bottom, std::string_view bytes);

private:
  struct Part {
    int bottom;
    std::uint64_t at, bytes; ///< in the file
    std::uint64_t checksum;
  };

  void find_parts();
  void begin();

  std::filesystem::path path_;
  std::string head_;
  std::map<int, Part> parts_; ///< by their first rows
  std::uint64_t end_ = 0;     ///< of the last part that is whole, in the file; 0: there is no file yet
  image::File file_;          ///< that parts are appended to
};

} // namespace celltrace::cli

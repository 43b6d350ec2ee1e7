// Where reports go.
#pragma once

#include <filesystem>
#include <fstream>
#include <iosfwd>
#include <string>

namespace celltrace::cli {

/// A file that is written while a command works, such as a trace; or none.
class OutputFile {
public:
  /// Throws InputError if the file cannot be written. `path` empty: there is none.
  explicit OutputFile(const std::filesystem::path& path);
  /// Null: there is none.
  std::ostream* stream() { return path_.empty() ? nullptr : &file_; }
  /// As the constructor, for what was written since.
  void finish();

private:
  void check() const;

  std::filesystem::path path_;
  std::ofstream file_;
};

/// Writes all of a report at once. `where` is a file, or "-" for stdout. Throws InputError if it cannot be
/// written.
void write_report(const std::string& where, const std::string& text);

} // namespace celltrace::cli

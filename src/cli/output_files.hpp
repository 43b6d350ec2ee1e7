// Where reports go.
#pragma once

#include "image/file.hpp"

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <ostream>
#include <streambuf>
#include <string>

namespace celltrace::cli {

/// A file that is written while a command works, such as a trace; or none. It takes its name when it is
/// finished. Of a command that fails in between, what says how it came to that stays: it is `useful_in_part`,
/// unless it is empty.
class OutputFile {
public:
  /// Throws InputError if the file cannot be written. `path` empty: there is none.
  explicit OutputFile(const std::filesystem::path& path, bool useful_in_part = false);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile();
  /// Null: there is none.
  std::ostream* stream() { return file_ ? &stream_ : nullptr; }
  /// Throws InputError if not all could be written.
  void finish();

private:
  /// Hands on to a C stream, which has a buffer.
  class Buffer : public std::streambuf {
  public:
    void write_to(std::FILE* file) { file_ = file; }
    bool is_empty() const { return bytes_ == 0; }

  private:
    int_type overflow(int_type character) override;
    std::streamsize xsputn(const char* text, std::streamsize size) override;

    std::FILE* file_ = nullptr;
    std::uint64_t bytes_ = 0;
  };

  std::filesystem::path path_;
  bool useful_in_part_;
  std::optional<image::OutputFile> file_;
  Buffer buffer_;
  std::ostream stream_{&buffer_};
};

/// Writes all of a report at once. `where` is a file, or "-" for stdout. Throws InputError if it cannot be
/// written.
void write_report(const std::string& where, const std::string& text);

/// Gives what is to come to stdout, a file that fails where it is closed. For the start of the program: files
/// that it opens must not take the places of those that it was started without.
void occupy_standard_streams();

/// Throws InputError if stdout is closed, so that a program can tell before it makes what is to go there.
void check_standard_output_is_open();

/// For the end: throws InputError if something that was to go to stdout did not.
void check_standard_output();

} // namespace celltrace::cli

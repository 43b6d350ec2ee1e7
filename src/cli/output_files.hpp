// Writes reports to files and to stdout.
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

/// A file that is written while a command runs, such as a trace; or none. The file gets its name when it is
/// finished. If the command fails before, the file is removed; a file that is `useful_in_part`, since it may
/// show the cause, is kept unless it is empty.
class OutputFile {
public:
  /// Opens a file; none if `path` is empty. Throws InputError if the file cannot be written.
  explicit OutputFile(const std::filesystem::path& path, bool useful_in_part = false);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile();
  /// Returns the stream; null if there is no file.
  std::ostream* stream() { return file_ ? &stream_ : nullptr; }
  /// Finishes the file. Throws InputError if not everything could be written.
  void finish();

private:
  /// A buffer that passes everything on to a C stream, which has a buffer of its own.
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

/// Writes a whole report. `where` is a file, or "-" for stdout. Throws InputError if it cannot be written.
void write_report(const std::string& where, const std::string& text);

/// Fills standard streams that are closed with files on which reading and writing fail. Called when the
/// program starts, so that files that it opens do not get the numbers of the missing streams.
void occupy_standard_streams();

/// Throws InputError if stdout is closed, so that a program can tell before it starts the work.
void check_standard_output_is_open();

/// Throws InputError if some output to stdout was lost; called at the end.
void check_standard_output();

} // namespace celltrace::cli

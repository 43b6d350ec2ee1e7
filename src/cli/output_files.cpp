#include "cli/output_files.hpp"

#include "celltrace/error.hpp"

#include <cerrno>
#include <cstdio>
#include <iostream>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

namespace celltrace::cli {

namespace {

/// Runs `work`, and puts the name of the file in front of its errors.
template <class Work> void naming(const std::filesystem::path& path, Work work) {
  try {
    work();
  } catch (const InputError& error) {
    throw InputError(path.string() + ": " + error.what());
  }
}

} // namespace

std::streambuf::int_type OutputFile::Buffer::overflow(int_type character) {
  if (traits_type::eq_int_type(character, traits_type::eof())) return traits_type::not_eof(character);
  ++bytes_;
  return std::fputc(traits_type::to_char_type(character), file_);
}

std::streamsize OutputFile::Buffer::xsputn(const char* text, std::streamsize size) {
  bytes_ += static_cast<std::uint64_t>(size);
  return static_cast<std::streamsize>(std::fwrite(text, 1, static_cast<std::size_t>(size), file_));
}

OutputFile::OutputFile(const std::filesystem::path& path, bool useful_in_part)
    : path_(path), useful_in_part_(useful_in_part) {
  if (path.empty()) return;
  naming(path_, [&] { file_.emplace(path); });
  buffer_.write_to(file_->get());
}

OutputFile::~OutputFile() {
  if (!file_ || !useful_in_part_ || buffer_.is_empty()) return;
  try {
    file_->commit();
  } catch (const InputError&) {
    // Drops this error: the one that led here is reported.
  }
}

void OutputFile::finish() {
  if (!file_) return;
  useful_in_part_ = false; // tried once only, even if it fails
  naming(path_, [&] { file_->commit(); });
}

void write_report(const std::string& where, const std::string& text) {
  if (where == "-") {
    std::cout << text << std::flush;
    return;
  }
  OutputFile file(where);
  *file.stream() << text;
  file.finish();
}

void occupy_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(stream, F_GETFD) >= 0 || errno != EBADF) continue;
    // Writing to a file that is open for reading fails, as writing to a closed one would; errors of stderr
    // could not be reported anyway.
    static_cast<void>(open("/dev/null", stream == STDERR_FILENO ? O_WRONLY : O_RDONLY));
  }
}

void check_standard_output_is_open() {
  const int flags = fcntl(STDOUT_FILENO, F_GETFL);
  if (flags < 0 || (flags & O_ACCMODE) == O_RDONLY)
    throw InputError("standard output cannot be written: it is closed");
}

void check_standard_output() {
  errno = 0;
  if (!(std::cout << std::flush) || std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
    throw InputError("standard output cannot be written" +
                     (errno != 0 ? ": " + std::generic_category().message(errno) : std::string()));
}

} // namespace celltrace::cli

#include "cli/output_files.hpp"

#include "celltrace/error.hpp"

#include <algorithm>
#include <cerrno>
#include <compare>
#include <csignal>
#include <cstdio>
#include <iostream>
#include <map>
#include <system_error>
#include <vector>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace celltrace::cli {

namespace {

/// Errors of a file with its name in front.
template <class Work> void naming(const std::filesystem::path& path, Work work) {
  try {
    work();
  } catch (const InputError& error) {
    throw InputError(path.string() + ": " + error.what());
  }
}

/// A file that a render reads or writes.
struct UsedFile {
  std::string what;
  std::filesystem::path path;
};

std::vector<UsedFile> used_files(const RenderRequest& request) {
  std::vector<UsedFile> files = {{"the statistics", request.stats},
                                 {"the trace", request.trace},
                                 {"the cache trace", request.cache_trace}};
  const auto is_unused = [](const UsedFile& file) { return file.path.empty(); };
  files.erase(std::remove_if(files.begin(), files.end(), is_unused), files.end());
  if (request.animation.is_on() && request.film == FilmFormat::none && !request.output.empty()) {
    if (files.empty()) return files;
    for (const int frame : frames_to_render(request.animation))
      files.push_back({"the picture", picture_of(request.output, request.animation, frame)});
  } else if (!request.output.empty()) {
    files.push_back({"the picture", request.output});
  }
  return files;
}

/// What is the same for all names of a file.
struct Identity {
  dev_t device = 0;
  ino_t file = 0;
  std::filesystem::path path; ///< where the file is not there yet

  auto operator<=>(const Identity&) const = default;
};

/// Returns none for what any number of files may be: a device.
std::optional<Identity> identity_of(const std::filesystem::path& path) {
  struct stat status;
  const bool is_there =
      path == kStandardOutput ? fstat(STDOUT_FILENO, &status) == 0 : stat(path.c_str(), &status) == 0;
  if (!is_there) return Identity{0, 0, image::follow_links(path)};
  if (S_ISCHR(status.st_mode) || S_ISBLK(status.st_mode)) return {};
  return Identity{status.st_dev, status.st_ino, {}};
}

void check_are_different(const RenderRequest& request, const std::vector<UsedFile>& files) {
  std::map<Identity, const UsedFile*> known;
  const UsedFile scene = {"the scene", request.scene};
  if (const auto identity = identity_of(scene.path); identity && scene.path != kStandardOutput)
    known.emplace(*identity, &scene);
  for (const UsedFile& file : files) {
    const auto identity = identity_of(file.path);
    if (!identity) continue;
    const auto [first, is_new] = known.emplace(*identity, &file);
    if (is_new) continue;
    const UsedFile& other = *first->second;
    const std::string names =
        file.path == other.path ? file.path.string() : file.path.string() + " is " + other.path.string();
    throw InputError(names + ": " + other.what + " and " + file.what + " cannot be the same file");
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
    // The error that brought this about is the one to report.
  }
}

void OutputFile::finish() {
  if (!file_) return;
  useful_in_part_ = false; // once is enough if it fails
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

void prepare_outputs(const RenderRequest& request) {
  const std::vector<UsedFile> files = used_files(request);
  check_are_different(request, files);
  for (const UsedFile& file : files) {
    if (file.path == kStandardOutput) continue;
    if (image::is_stream(file.path)) std::signal(SIGPIPE, SIG_IGN);
    if (file.what != "the picture") naming(file.path, [&] { image::check_output(file.path); });
  }
}

void occupy_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(stream, F_GETFD) >= 0 || errno != EBADF) continue;
    // Writing to what is open for reading fails, as it would without; nobody could be told of that of stderr.
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

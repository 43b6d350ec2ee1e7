#include "image/file.hpp"

#include "celltrace/error.hpp"

#include <atomic>
#include <cerrno>
#include <string>
#include <system_error>

#include <unistd.h>

namespace celltrace::image {
namespace fs = std::filesystem;

namespace {

std::string reason(int error) {
  return std::generic_category().message(error);
}

/// Also where they lead to what is not there yet.
fs::path follow_links(fs::path path) {
  constexpr int kMostLinks = 40;
  std::error_code error;
  for (int i = 0; i < kMostLinks && fs::is_symlink(fs::symlink_status(path, error)); ++i) {
    const fs::path target = fs::read_symlink(path, error);
    if (error) break;
    path = path.parent_path() / target;
  }
  const fs::path followed = fs::weakly_canonical(path, error);
  return error ? path : followed;
}

/// A name beside the target that no other thread or process takes.
fs::path temporary_name(const fs::path& target) {
  static std::atomic<unsigned> counter{0};
  fs::path name = target;
  name += '.';
  name += std::to_string(getpid());
  name += '-';
  name += std::to_string(counter++);
  name += ".part";
  return name;
}

} // namespace

File open_for_reading(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) throw InputError("no such file");
  if (error) throw InputError("cannot be opened: " + error.message());
  if (fs::is_directory(status)) throw InputError("is a folder");
  if (!fs::is_regular_file(status)) throw InputError("is not a regular file");
  File file(std::fopen(path.c_str(), "rb"));
  if (!file) throw InputError("cannot be opened: " + reason(errno));
  return file;
}

OutputFile::OutputFile(const fs::path& path) : target_(follow_links(path)) {
  std::error_code error;
  const fs::file_status status = fs::status(target_, error);
  if (fs::is_directory(status)) throw InputError("is a folder");
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    file_.reset(std::fopen(target_.c_str(), "wb"));
  } else {
    temporary_ = temporary_name(target_);
    file_.reset(std::fopen(temporary_.c_str(), "wbx"));
  }
  if (!file_) throw InputError("cannot be written: " + reason(errno));
}

OutputFile::~OutputFile() {
  if (!file_ || temporary_.empty()) return;
  file_.reset();
  std::error_code ignored;
  fs::remove(temporary_, ignored);
}

void OutputFile::commit() {
  const bool failed = std::ferror(file_.get()) != 0;
  const bool closed = std::fclose(file_.release()) == 0;
  const int close_error = errno;
  std::error_code error;
  if (!failed && closed && !temporary_.empty()) fs::rename(temporary_, target_, error);
  if (!failed && closed && !error) return;

  std::error_code ignored;
  if (!temporary_.empty()) fs::remove(temporary_, ignored);
  if (failed) throw InputError("cannot be written to its end"); // why, the write that failed has known
  throw InputError("cannot be written: " + (error ? error.message() : reason(close_error)));
}

} // namespace celltrace::image

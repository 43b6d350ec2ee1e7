#include "image/file.hpp"

#include "image/formats.hpp"

#include "celltrace/error.hpp"

#include <atomic>
#include <cerrno>
#include <charconv>
#include <string>
#include <system_error>

#include <signal.h>
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

void write_bytes(std::FILE* file, const void* bytes, std::size_t count) {
  if (std::fwrite(bytes, 1, count, file) != count) throw InputError("cannot be written: " + reason(errno));
}

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

void remove_abandoned_parts(const std::set<fs::path>& paths) {
  std::set<fs::path> targets, folders;
  for (const fs::path& path : paths) {
    const fs::path target = follow_links(path);
    targets.insert(target);
    folders.insert(target.parent_path());
  }
  for (const fs::path& folder : folders) {
    std::error_code ignored;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
      // As temporary_name() makes them: TARGET.PROCESS-NUMBER.part
      const fs::path file = entry.path();
      if (file.extension() != ".part" || targets.count(file.parent_path() / file.stem().stem()) == 0)
        continue;
      const std::string number = file.stem().extension().string(); // begins with its dot
      long process = 0;
      const auto end = std::from_chars(number.data() + 1, number.data() + number.size(), process).ptr;
      if (process <= 0 || end == number.data() + number.size() || *end != '-') continue;
      const bool is_gone = kill(static_cast<pid_t>(process), 0) != 0 && errno == ESRCH;
      if (is_gone) fs::remove(file, ignored);
    }
  }
}

} // namespace celltrace::image

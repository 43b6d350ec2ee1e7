#include "image/file.hpp"

#include "image/formats.hpp"

#include "celltrace/error.hpp"

#include <atomic>
#include <cerrno>
#include <charconv>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/xattr.h>
#include <unistd.h>

namespace celltrace::image {
namespace fs = std::filesystem;

namespace {

std::string reason(int error) {
  return std::generic_category().message(error);
}

/// Returns a name beside the target that no other thread or process uses.
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

[[noreturn]] void fail(int error) {
  throw InputError("cannot be written: " + reason(error));
}

bool is_writable(const fs::path& path) {
  return faccessat(AT_FDCWD, path.c_str(), W_OK, AT_EACCESS) == 0;
}

/// Throws InputError for an existing regular file that must not be written.
void check_permission(const fs::path& file, const struct stat& status) {
  if ((status.st_mode & 0222) == 0) throw InputError("is write-protected");
  if (!is_writable(file)) fail(errno);
}

/// Gives a new file the mode and the owner of the file that it is to replace. Returns false if that is not
/// possible, or if the old file has other properties that would be lost.
bool takes_after(int descriptor, const fs::path& path, const struct stat& old) {
  struct stat status;
  if (old.st_nlink > 1 || fstat(descriptor, &status) != 0) return false;
  if (listxattr(path.c_str(), nullptr, 0) > 0) return false; // access control lists
  if ((status.st_uid != old.st_uid || status.st_gid != old.st_gid) &&
      fchown(descriptor, old.st_uid, old.st_gid) != 0)
    return false;
  return fchmod(descriptor, old.st_mode & 07777) == 0;
}

/// Replaces the contents of a file by those of another file.
void copy_into(const fs::path& target, int source) {
  struct Descriptor {
    int number;
    ~Descriptor() {
      if (number >= 0) close(number);
    }
  } const out{open(target.c_str(), O_WRONLY | O_CLOEXEC)};
  if (out.number < 0 || lseek(source, 0, SEEK_SET) != 0) fail(errno);
  std::vector<char> bytes(1u << 20);
  off_t size = 0;
  while (true) {
    const ssize_t count = read(source, bytes.data(), bytes.size());
    if (count == 0) break;
    if (count < 0) fail(errno);
    for (ssize_t written = 0; written < count;) {
      const ssize_t some =
          write(out.number, bytes.data() + written, static_cast<std::size_t>(count - written));
      if (some < 0 && errno != EINTR) fail(errno);
      if (some > 0) written += some;
    }
    size += count;
  }
  if (ftruncate(out.number, size) != 0) fail(errno);
}

} // namespace

void write_bytes(std::FILE* file, const void* bytes, std::size_t count) {
  if (std::fwrite(bytes, 1, count, file) != count) fail(errno);
}

File open_for_reading(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) throw InputError("there is no such file");
  if (error) throw InputError("cannot be opened: " + error.message());
  if (fs::is_directory(status)) throw InputError("is a folder");
  if (!fs::is_regular_file(status)) throw InputError("is not a regular file");
  File file(std::fopen(path.c_str(), "rb"));
  if (!file) throw InputError("cannot be opened: " + reason(errno));
  return file;
}

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

int descriptor_named(const fs::path& path) {
  constexpr int kMostLinks = 40;
  const fs::path descriptors = "/proc/" + std::to_string(getpid()) + "/fd";
  std::error_code error;
  fs::path at = fs::absolute(path, error);
  for (int i = 0; i < kMostLinks && !error; ++i) {
    const fs::path folder = fs::weakly_canonical(at.parent_path(), error);
    if (folder == descriptors) {
      const std::string name = at.filename().string();
      int number = -1;
      const auto [end, failure] = std::from_chars(name.data(), name.data() + name.size(), number);
      return failure == std::errc() && end == name.data() + name.size() ? number : -1;
    }
    if (!fs::is_symlink(fs::symlink_status(at, error))) break;
    at = folder / fs::read_symlink(at, error);
  }
  return -1;
}

bool is_stream(const fs::path& path) {
  if (descriptor_named(path) >= 0) return true;
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

void check_output(const fs::path& path) {
  if (const int descriptor = descriptor_named(path); descriptor >= 0) {
    const int flags = fcntl(descriptor, F_GETFL);
    if (flags < 0 || (flags & O_ACCMODE) == O_RDONLY)
      throw InputError("cannot be written: it is not open for writing");
    return;
  }
  const fs::path target = follow_links(path);
  struct stat status;
  if (stat(target.c_str(), &status) == 0) {
    if (S_ISDIR(status.st_mode)) throw InputError("is a folder");
    return check_permission(target, status);
  }
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  std::error_code error;
  if (!fs::is_directory(folder, error))
    throw InputError("there is no folder " + (path.has_parent_path() ? path.parent_path() : folder).string());
  if (!is_writable(folder)) fail(errno);
}

OutputFile::OutputFile(const fs::path& path) {
  if (const int descriptor = descriptor_named(path); descriptor >= 0) {
    const int copy = fcntl(descriptor, F_DUPFD_CLOEXEC, 0);
    if (copy < 0) fail(errno);
    file_.reset(fdopen(copy, "wb"));
    if (file_) return;
    const int error = errno;
    close(copy);
    fail(error);
  }
  if (is_stream(path)) {
    file_.reset(std::fopen(path.c_str(), "wb"));
    if (!file_) fail(errno);
    return;
  }
  target_ = follow_links(path);
  struct stat status;
  const bool is_there = stat(target_.c_str(), &status) == 0;
  if (is_there && S_ISDIR(status.st_mode)) throw InputError("is a folder");
  if (is_there) check_permission(target_, status);
  temporary_ = temporary_name(target_);
  // A file that only some may read is closed to others from the beginning.
  const mode_t mode = is_there ? 0600 : 0666;
  const int descriptor = open(temporary_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, mode);
  const int error = errno;
  if (descriptor >= 0) {
    file_.reset(fdopen(descriptor, "w+b"));
  } else {
    temporary_.clear();
    if (is_there) file_.reset(std::tmpfile()); // the folder cannot be written, but the file can
  }
  if (!file_) fail(error);
}

OutputFile::~OutputFile() {
  if (!file_ || temporary_.empty()) return;
  std::error_code ignored;
  file_.reset();
  fs::remove(temporary_, ignored);
}

void OutputFile::take_name() {
  struct stat old;
  const bool is_there = stat(target_.c_str(), &old) == 0 && S_ISREG(old.st_mode);
  const int descriptor = fileno(file_.get());
  if (!temporary_.empty() && (!is_there || takes_after(descriptor, target_, old))) {
    if (std::rename(temporary_.c_str(), target_.c_str()) == 0) {
      temporary_.clear();
      return;
    }
    if (!is_there) fail(errno);
  }
  copy_into(target_, descriptor);
}

void OutputFile::commit() {
  if (std::ferror(file_.get()) != 0)
    throw InputError("cannot be written to its end"); // the reason is known only to the write that failed
  if (std::fflush(file_.get()) != 0) fail(errno);
  if (!target_.empty()) take_name();
  const bool closed = std::fclose(file_.release()) == 0;
  const int error = errno;
  if (!temporary_.empty()) { // the bytes were copied
    std::error_code ignored;
    fs::remove(std::exchange(temporary_, {}), ignored);
  }
  if (!closed) fail(error);
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
      // Names have the form of temporary_name(): TARGET.PROCESS-NUMBER.part.
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

// The folders of the host that programs may use, and nothing else of it.
#pragma once

#include "backends/cell_emu/simulator/ppe/spu_errno.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace celltrace::cell_emu {

/// A file descriptor of the host, closed at the end.
class HostDescriptor {
public:
  HostDescriptor() = default;
  explicit HostDescriptor(int fd) : fd_(fd) {}
  HostDescriptor(HostDescriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  HostDescriptor& operator=(HostDescriptor&& other) noexcept {
    std::swap(fd_, other.fd_);
    return *this;
  }
  ~HostDescriptor();

  int get() const { return fd_; }
  explicit operator bool() const { return fd_ >= 0; }

private:
  int fd_ = -1;
};

/// Names, as programs give them, are looked up relative to a current folder, with symbolic links; where they
/// lead out of the allowed folders they fail with EACCES, without a word on whether there is something. Links
/// that are put in the way in the meantime are not followed. All functions throw CallFailed. Thread safety:
/// none.
class AllowedFolders {
public:
  /// A name in a folder: what openat() and its like take. The name has no slash and may be ".".
  struct Place {
    HostDescriptor folder;
    std::string name;
    std::string path; ///< without links, for messages and the current folder
  };
  enum class LastLink { follow, keep };

  /// The first folder is the current one. Without any, all names fail. Throws InputError for what is no
  /// folder.
  explicit AllowedFolders(const std::vector<std::filesystem::path>& folders);

  /// The last part of the name need not exist.
  Place locate(std::string_view name, LastLink last = LastLink::follow) const;

  /// Opens a file or folder, never a device or a pipe. The mode is that of a file that is made.
  HostDescriptor open(std::string_view name, int host_flags, unsigned mode) const;
  HostDescriptor open(const Place& place, int host_flags, unsigned mode) const;

  void change_to(std::string_view name);
  /// Throws EACCES if there are no folders.
  const std::string& current() const;

private:
  struct Root {
    std::string given; ///< absolute, without dots; links may be in it
    std::string path;  ///< without links
    HostDescriptor folder;
  };

  const Root* root_of(const std::string& path) const;
  bool looks_allowed(const std::string& path) const;
  Place place_at(const std::string& path) const;

  std::vector<Root> roots_;
  std::string current_;
};

} // namespace celltrace::cell_emu

// AllowedFolders opens files for programs, and only in folders of the host that programs may use.
#pragma once

#include "backends/cell_emu/simulator/ppe/spu_errno.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace celltrace::cell_emu {

/// A file descriptor of the host, closed on destruction.
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

/// Resolves names that programs pass, relative to a current folder, and follows symbolic links. Names that
/// lead out of the allowed folders fail with EACCES, whether or not the file exists. Links that are made
/// during the look-up are not followed. All functions throw CallFailed. Thread safety: none.
class AllowedFolders {
public:
  /// A name in a folder, for openat() and related calls. The name has no slash and may be ".".
  struct Place {
    HostDescriptor folder;
    std::string name;
    std::string path; ///< path without links, for messages and the current folder
  };
  enum class SymlinkPolicy { follow, keep };

  /// Makes the first folder the current folder. Without folders, all names fail. Throws InputError for paths
  /// that are no folders.
  explicit AllowedFolders(const std::vector<std::filesystem::path>& folders);

  /// Finds the place of a name, whose last part need not exist.
  Place locate(std::string_view name, SymlinkPolicy last = SymlinkPolicy::follow) const;

  /// Open a file or folder, but no device and no pipe. `mode` is for files that are created.
  HostDescriptor open(std::string_view name, int host_flags, unsigned mode) const;
  HostDescriptor open(const Place& place, int host_flags, unsigned mode) const;

  void change_to(std::string_view name);
  /// Returns the current folder. Throws CallFailed with EACCES if there are no folders.
  const std::string& current() const;

private:
  struct Root {
    std::string given; ///< absolute, without dots; may contain links
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

#include "backends/cell_emu/simulator/ppe/allowed_folders.hpp"

#include "celltrace/error.hpp"

#include <algorithm>
#include <cerrno>
#include <climits>
#include <cstdlib>
#include <memory>
#include <optional>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace celltrace::cell_emu {

namespace {

constexpr int kOpenFolder = O_RDONLY | O_DIRECTORY | O_CLOEXEC;

/// Returns the path without links. Returns nothing, and sets errno, if a part of the path does not exist or
/// may not be searched.
std::optional<std::string> without_links(const std::string& path) {
  const std::unique_ptr<char, decltype(&std::free)> real(::realpath(path.c_str(), nullptr), &std::free);
  if (!real) return std::nullopt;
  return std::string(real.get());
}

bool is_within(std::string_view path, std::string_view folder) {
  if (folder == "/") return path.starts_with('/');
  return path.starts_with(folder) && (path.size() == folder.size() || path[folder.size()] == '/');
}

std::string joined(std::string_view folder, std::string_view name) {
  std::string path(folder);
  if (!path.ends_with('/')) path += '/';
  return path += name;
}

/// Opens a folder below the folder `root`, part by part, and follows no link.
HostDescriptor open_below(const HostDescriptor& root, std::string_view path) {
  HostDescriptor folder(::openat(root.get(), ".", kOpenFolder));
  while (folder && !path.empty()) {
    const std::size_t slash = std::min(path.find('/'), path.size());
    const std::string part(path.substr(0, slash));
    path.remove_prefix(std::min(slash + 1, path.size()));
    if (!part.empty())
      folder = HostDescriptor(::openat(folder.get(), part.c_str(), kOpenFolder | O_NOFOLLOW));
  }
  if (!folder) fail_with_host_errno();
  return folder;
}

void check_kind(const struct stat& status) {
  if (!S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode)) throw CallFailed{SpuErrno::access};
}

} // namespace

HostDescriptor::~HostDescriptor() {
  if (fd_ >= 0) ::close(fd_);
}

AllowedFolders::AllowedFolders(const std::vector<std::filesystem::path>& folders) {
  for (const std::filesystem::path& folder : folders) {
    const std::string given = std::filesystem::absolute(folder).lexically_normal().string();
    const std::optional<std::string> path = without_links(given);
    HostDescriptor descriptor(path ? ::open(path->c_str(), kOpenFolder) : -1);
    if (!descriptor) throw InputError("\"" + folder.string() + "\" is no folder that programs can use");
    const bool slash = given.size() > 1 && given.ends_with('/');
    roots_.push_back({given.substr(0, given.size() - (slash ? 1 : 0)), *path, std::move(descriptor)});
  }
  if (!roots_.empty()) current_ = roots_.front().path;
}

const AllowedFolders::Root* AllowedFolders::root_of(const std::string& path) const {
  const auto root = std::ranges::find_if(roots_, [&](const Root& r) { return is_within(path, r.path); });
  return root != roots_.end() ? &*root : nullptr;
}

bool AllowedFolders::looks_allowed(const std::string& path) const {
  const std::string plain = std::filesystem::path(path).lexically_normal().string();
  return std::ranges::any_of(
      roots_, [&](const Root& root) { return is_within(plain, root.path) || is_within(plain, root.given); });
}

AllowedFolders::Place AllowedFolders::place_at(const std::string& path) const {
  const Root* root = root_of(path);
  if (root == nullptr) throw CallFailed{SpuErrno::access};
  if (path == root->path) return {open_below(root->folder, {}), ".", path};
  const std::size_t slash = path.rfind('/');
  const std::string_view below = std::string_view(path).substr(std::min(root->path.size(), slash));
  return {open_below(root->folder, below.substr(0, below.rfind('/'))), path.substr(slash + 1), path};
}

AllowedFolders::Place AllowedFolders::locate(std::string_view name, SymlinkPolicy last) const {
  if (name.empty()) throw CallFailed{SpuErrno::no_entry};
  if (name.size() >= PATH_MAX) throw CallFailed{SpuErrno::name_too_long};
  std::string path = name.starts_with('/') ? std::string(name) : joined(current(), name);
  if (!looks_allowed(path)) throw CallFailed{SpuErrno::access};

  const bool is_folder = path.ends_with('/');
  while (path.size() > 1 && path.ends_with('/'))
    path.pop_back();
  const std::size_t slash = path.rfind('/');
  const std::string part = path.substr(slash + 1);
  const bool dots = part == "." || part == "..";
  if (last == SymlinkPolicy::follow || is_folder || dots) {
    if (const auto whole = without_links(path)) return place_at(*whole);
    if (errno != ENOENT || dots) fail_with_host_errno();
  }
  const auto folder = without_links(slash == 0 ? "/" : path.substr(0, slash));
  if (!folder) fail_with_host_errno();
  return place_at(joined(*folder, part));
}

HostDescriptor AllowedFolders::open(std::string_view name, int host_flags, unsigned mode) const {
  return open(locate(name), host_flags, mode);
}

HostDescriptor AllowedFolders::open(const Place& place, int host_flags, unsigned mode) const {
  struct stat status;
  // Checked before opening, because opening a device may already have an effect.
  if (::fstatat(place.folder.get(), place.name.c_str(), &status, AT_SYMLINK_NOFOLLOW) == 0 &&
      !S_ISLNK(status.st_mode))
    check_kind(status);
  HostDescriptor file(::openat(place.folder.get(), place.name.c_str(),
                               host_flags | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_CLOEXEC, mode));
  if (!file || ::fstat(file.get(), &status) != 0) fail_with_host_errno();
  check_kind(status);
  return file;
}

void AllowedFolders::change_to(std::string_view name) {
  Place place = locate(name);
  const HostDescriptor folder(::openat(place.folder.get(), place.name.c_str(), kOpenFolder | O_NOFOLLOW));
  if (!folder) fail_with_host_errno();
  current_ = std::move(place.path);
}

const std::string& AllowedFolders::current() const {
  if (current_.empty()) throw CallFailed{SpuErrno::access};
  return current_;
}

} // namespace celltrace::cell_emu

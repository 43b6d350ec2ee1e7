#include "pov/sources.hpp"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <string>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "celltrace/error.hpp"
#include "memory/huge_pages.hpp"
#include "pov/diagnostics.hpp"

namespace celltrace::pov {

namespace fs = std::filesystem;

std::span<const char* const> installed_include_folders() {
  static constexpr const char* kFolders[] = {
      "/usr/share/povray-3.7/include", "/usr/local/share/povray-3.7/include", "/usr/share/povray/include"};
  return kFolders;
}

namespace {

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

bool same_but_for_case(const std::string& a, const std::string& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

/// Returns `folder/name` with each part matched without regard to case: the first match in alphabetical
/// order, so that the result does not depend on the file system.
std::optional<fs::path> find_without_case(const fs::path& folder, const fs::path& name) {
  fs::path found = folder.empty() ? fs::path(".") : folder;
  for (const fs::path& part : name) {
    if (part == "." || part == "..") {
      found /= part;
      continue;
    }
    std::optional<fs::path> match;
    std::error_code error;
    for (fs::directory_iterator entry(found, error), end; !error && entry != end; entry.increment(error)) {
      const fs::path file = entry->path().filename();
      if (same_but_for_case(file.string(), part.string()) && (!match || file < *match)) match = file;
    }
    if (!match) return std::nullopt;
    found /= *match;
  }
  if (!is_file(found)) return std::nullopt;
  return found;
}

bool is_below(const fs::path& file, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first == folder.end();
}

/// Returns whether a file lies in a folder or below it, with links resolved.
bool lies_in(const fs::path& canonical_file, const fs::path& folder) {
  std::error_code error;
  const fs::path canonical_folder = fs::canonical(folder.empty() ? fs::path(".") : folder, error);
  return !error && is_below(canonical_file, canonical_folder);
}

std::vector<fs::path> canonical_folders(const std::vector<fs::path>& folders) {
  std::vector<fs::path> result;
  for (const fs::path& folder : folders) {
    std::error_code error;
    const fs::path canonical = fs::canonical(folder, error);
    if (error || !fs::is_directory(canonical, error))
      throw InputError("'" + folder.string() + "' is no folder that scenes could be allowed to use");
    result.push_back(canonical);
  }
  return result;
}

std::string reason(int error) {
  return std::generic_category().message(error);
}

/// A file descriptor that closes itself.
struct Descriptor {
  int number;
  explicit Descriptor(int opened) : number(opened) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (number >= 0) ::close(number);
  }
};

constexpr std::size_t kWriteAtOnce = 1u << 16;
constexpr std::size_t kPadding = 2; // the scanner adds two NULs

} // namespace

fs::path portable_path(std::string_view name) {
  std::string path(name);
  std::replace(path.begin(), path.end(), '\\', '/');
  return path;
}

Sources::Sources(const ParseOptions& options)
    : library_paths_(options.library_paths), working_folder_(options.working_folder),
      readable_(canonical_folders(options.readable_folders)),
      writable_(canonical_folders(options.writable_folders)), permits_(options.permits) {
  if (working_folder_.empty() && !writable_.empty()) working_folder_ = writable_.front();
  readable_.insert(readable_.end(), writable_.begin(), writable_.end());
  for (const char* folder : installed_include_folders()) {
    std::error_code ignored;
    if (fs::is_directory(folder, ignored)) library_paths_.emplace_back(folder);
  }
}

void Sources::set_scene_folder(fs::path folder) {
  scene_folder_ = std::move(folder);
}

std::uint32_t Sources::number_of(const std::string& name) {
  const auto [entry, is_new] = numbers_.try_emplace(name, static_cast<std::uint32_t>(names_.size()));
  if (is_new) names_.push_back(name);
  return entry->second;
}

std::vector<fs::path> Sources::folders(const fs::path& naming_folder) const {
  std::vector<fs::path> folders;
  if (!working_folder_.empty()) folders.push_back(working_folder_);
  folders.insert(folders.end(), {naming_folder, scene_folder_});
  folders.insert(folders.end(), library_paths_.begin(), library_paths_.end());
  return folders;
}

std::string Sources::folders_searched(const fs::path& naming_folder) const {
  std::vector<std::string> named;
  for (const fs::path& folder : folders(naming_folder)) {
    const std::string name = folder.empty() ? "the current folder" : quoted_name(folder.string());
    if (std::find(named.begin(), named.end(), name) == named.end()) named.push_back(name);
  }
  std::string text;
  for (std::size_t i = 0; i < named.size(); ++i)
    text += (i == 0 ? "" : i + 1 == named.size() ? " and " : ", ") + named[i];
  return text;
}

std::optional<FoundFile> Sources::find_file(std::string_view name, const fs::path& naming_folder) const {
  if (name.find('\0') != name.npos) return std::nullopt;
  const fs::path wanted = portable_path(name);
  const std::vector<fs::path> folders = this->folders(naming_folder);
  const auto found = [&](const fs::path& path) {
    std::error_code error;
    const fs::path file = fs::canonical(path, error);
    const auto has_it = [&](const fs::path& folder) { return lies_in(file, folder); };
    // Packages put links to fonts into POV-Ray's own folder.
    const auto is_installed = [&](const char* folder) { return path.parent_path() == fs::path(folder); };
    const auto installed = installed_include_folders();
    const bool may_be_read =
        !error &&
        (has_it(scene_folder_) || std::any_of(installed.begin(), installed.end(), is_installed) || std::any_of(library_paths_.begin(), library_paths_.end(), has_it) ||
         std::any_of(readable_.begin(), readable_.end(), has_it) || permits(file, FileUse::read));
    return FoundFile{path, may_be_read};
  };
  const auto find = [&](const fs::path& file) -> std::optional<FoundFile> {
    for (const fs::path& folder : folders)
      if (is_file(folder / file)) return found(folder / file);
    if (wanted.is_absolute()) return std::nullopt;
    for (const fs::path& folder : folders)
      if (const auto path = find_without_case(folder, file)) return found(*path);
    return std::nullopt;
  };
  if (const auto file = find(wanted)) return file;
  // As in POV-Ray, the extension may be missing.
  return wanted.has_extension() ? std::nullopt : find(fs::path(wanted).replace_extension(".inc"));
}

fs::path Sources::writable_file(std::string_view name) const {
  if (writable_.empty() && !permits_)
    throw InputError("scenes write no files unless --allow-write DIR says in which folder they may");
  const fs::path wanted = portable_path(name);
  if (name.find('\0') != name.npos || !wanted.has_filename() || wanted.filename() == "." ||
      wanted.filename() == "..")
    throw InputError("this is no name of a file");
  std::error_code error;
  const fs::path named = wanted.is_absolute() ? wanted : working_folder_ / wanted;
  fs::path file = fs::canonical(named.has_parent_path() ? named.parent_path() : ".", error);
  if (error) throw InputError("its folder is not there: " + error.message());
  file /= wanted.filename();
  if (fs::is_symlink(fs::symlink_status(file, error))) {
    file = fs::canonical(file, error);
    if (error) throw InputError("it is a link that leads to no file");
  }
  if (std::none_of(writable_.begin(), writable_.end(),
                   [&](const fs::path& folder) { return is_below(file, folder); }) &&
      !permits(file, FileUse::write))
    throw InputError("it lies outside of the folders that " + std::string(permits_ ? "povray.conf or " : "") +
                     "--allow-write lets scenes write in");
  return file;
}

std::string make_text(std::size_t bytes) {
  std::string text;
  text.reserve(bytes + kPadding);
  use_huge_pages(text.data(), text.capacity());
  return text;
}

std::string read_text(const fs::path& path, std::uint64_t limit, const std::function<void()>& check) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) throw InputError("there is no such file");
  if (fs::is_directory(status)) throw InputError("this is a directory, not a file");
  if (!fs::is_regular_file(status)) throw InputError("this is not a regular file");
  const std::uint64_t size = fs::file_size(path, error);
  if (error) throw InputError("this file cannot be read: " + error.message());

  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.number < 0) throw InputError("this file cannot be opened: " + reason(errno));
  // The size is a hint: files of the system, such as pipes, have none, and others may grow while they are
  // read.
  std::string text = make_text(static_cast<std::size_t>(std::min(size, limit)) + 1);
  for (;;) {
    check();
    const std::size_t read = text.size();
    if (read > limit) throw InputError("this file is larger than " + std::to_string(limit) + " bytes");
    constexpr std::size_t kReadAtOnce = 1u << 20;
    const std::size_t room = text.capacity() - read;
    text.resize(read + (room > kPadding ? std::min(room - kPadding, kReadAtOnce) : kReadAtOnce));
    const ssize_t count = ::read(file.number, text.data() + read, text.size() - read);
    if (count < 0 && errno != EINTR) throw InputError("this file cannot be read: " + reason(errno));
    text.resize(read + (count > 0 ? static_cast<std::size_t>(count) : 0));
    if (count == 0) return text;
  }
}

TextWriter::TextWriter(const fs::path& path, bool append)
    : file_(::open(path.c_str(),
                   O_WRONLY | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK | (append ? O_APPEND : O_TRUNC),
                   0666)) {
  if (file_ < 0) throw InputError("it cannot be written: " + reason(errno));
  struct stat status {};
  if (::fstat(file_, &status) == 0 && S_ISREG(status.st_mode)) return;
  ::close(file_);
  throw InputError("it is not a regular file");
}

TextWriter::~TextWriter() {
  try {
    close();
  } catch (const InputError&) {
    // Errors are lost here; a caller that needs them calls close().
  }
}

void TextWriter::write(std::string_view text) {
  buffer_ += text;
  if (buffer_.size() >= kWriteAtOnce) flush();
}

void TextWriter::flush() {
  std::string_view rest = buffer_;
  while (!rest.empty()) {
    const ssize_t count = ::write(file_, rest.data(), rest.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      const int error = errno;
      buffer_.clear();
      throw InputError("it cannot be written: " + reason(error));
    }
    rest.remove_prefix(static_cast<std::size_t>(count));
  }
  buffer_.clear();
}

void TextWriter::close() {
  if (file_ < 0) return;
  const Descriptor closing(file_);
  try {
    flush();
  } catch (...) {
    file_ = -1;
    throw;
  }
  file_ = -1;
}

} // namespace celltrace::pov

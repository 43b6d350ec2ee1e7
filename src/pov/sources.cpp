#include "pov/sources.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>

#include "celltrace/error.hpp"

namespace celltrace::pov {

namespace fs = std::filesystem;

namespace {

const char* const kInstalledIncludes[] = {"/usr/share/povray-3.7/include",
                                          "/usr/local/share/povray-3.7/include", "/usr/share/povray/include"};

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

bool same_but_for_case(const std::string& a, const std::string& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

/// `folder/name`, each part matched without regard to case. The first match in alphabetical order, so that
/// the answer does not depend on the file system.
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

} // namespace

Sources::Sources(std::vector<fs::path> library_paths) : library_paths_(std::move(library_paths)) {
  for (const char* folder : kInstalledIncludes) {
    std::error_code ignored;
    if (fs::is_directory(folder, ignored)) library_paths_.emplace_back(folder);
  }
}

std::uint32_t Sources::number_of(const std::string& name) {
  const auto [entry, is_new] = numbers_.try_emplace(name, static_cast<std::uint32_t>(names_.size()));
  if (is_new) names_.push_back(name);
  return entry->second;
}

std::optional<fs::path> Sources::find_include(std::string_view name, const fs::path& including_folder) const {
  // Scenes written on Windows name their folders with backslashes.
  std::string portable(name);
  std::replace(portable.begin(), portable.end(), '\\', '/');
  const fs::path wanted(portable);

  std::vector<fs::path> folders = {including_folder, scene_folder_};
  folders.insert(folders.end(), library_paths_.begin(), library_paths_.end());
  for (const fs::path& folder : folders)
    if (is_file(folder / wanted)) return folder / wanted;
  if (wanted.is_absolute()) return std::nullopt;
  for (const fs::path& folder : folders)
    if (auto found = find_without_case(folder, wanted)) return found;
  return std::nullopt;
}

std::string read_text(const fs::path& path, std::uint64_t limit) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) throw InputError("there is no such file");
  if (fs::is_directory(status)) throw InputError("this is a directory, not a file");
  if (!fs::is_regular_file(status)) throw InputError("this is not a regular file");
  const std::uint64_t size = fs::file_size(path, error);
  if (error) throw InputError("this file cannot be read: " + error.message());
  if (size > limit) throw InputError("this file is larger than " + std::to_string(limit) + " bytes");

  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError("this file cannot be opened");
  std::string text;
  text.reserve(size + 2); // the scanner adds two NULs
  text.resize(size);
  file.read(text.data(), static_cast<std::streamsize>(size));
  text.resize(static_cast<std::size_t>(file.gcount()));
  return text;
}

} // namespace celltrace::pov

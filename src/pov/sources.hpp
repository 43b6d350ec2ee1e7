// The files a scene is read from: finding, reading and naming them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace celltrace::pov {

class Sources {
public:
  /// Include files are looked for in the folder of the including file, in the scene's, in `library_paths` and
  /// in POV-Ray's installed include folder, in this order; a name that differs in case only is taken last.
  explicit Sources(std::vector<std::filesystem::path> library_paths);

  /// The number of a name; the same name gives the same number.
  std::uint32_t number_of(const std::string& name);
  const std::string& name(std::uint32_t file) const { return names_[file]; }

  /// The scene's own folder, searched for every include.
  void set_scene_folder(std::filesystem::path folder) { scene_folder_ = std::move(folder); }

  std::optional<std::filesystem::path> find_include(std::string_view name,
                                                    const std::filesystem::path& including_folder) const;

private:
  std::vector<std::filesystem::path> library_paths_;
  std::filesystem::path scene_folder_;
  std::vector<std::string> names_;
  std::unordered_map<std::string, std::uint32_t> numbers_;
};

/// The text of a file, at most `limit` bytes. Throws InputError, without a position, if it is missing, is not
/// a regular file, is longer or cannot be read.
std::string read_text(const std::filesystem::path& path, std::uint64_t limit);

} // namespace celltrace::pov

// The files a scene is read from, and those that it writes: finding, reading and naming them, and where it
// may.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "celltrace/pov.hpp"

namespace celltrace::pov {

/// Returns where POV-Ray's include files may be installed.
std::span<const char* const> installed_include_folders();

/// A file that a scene has named.
struct FoundFile {
  std::filesystem::path path;
  bool may_be_read = false; ///< it lies, links followed, where the scene may read
};

class Sources {
public:
  /// Files are looked for in the working folder (by default the first writable one), in the folder of the
  /// file that names them, in the scene's, in the library paths and in POV-Ray's installed include folder, in
  /// this order; a name that differs in case only is taken last. Throws InputError if a folder to read or
  /// write in is none.
  explicit Sources(const ParseOptions& options);

  /// The number of a name; the same name gives the same number.
  std::uint32_t number_of(const std::string& name);
  const std::string& name(std::uint32_t file) const { return names_[file]; }

  /// The scene's own folder, searched for every file.
  void set_scene_folder(std::filesystem::path folder);

  std::optional<FoundFile> find_file(std::string_view name, const std::filesystem::path& naming_folder) const;
  /// Where find_file() looks, each folder once, for a message.
  std::string folders_searched(const std::filesystem::path& naming_folder) const;

  /// Where a scene writes the file that it calls `name`, no link. Throws InputError, without a position, if
  /// it may not.
  std::filesystem::path writable_file(std::string_view name) const;

private:
  bool permits(const std::filesystem::path& file, FileUse use) const {
    return permits_ && permits_(file, use);
  }
  std::vector<std::filesystem::path> folders(const std::filesystem::path& naming_folder) const;

  std::vector<std::filesystem::path> library_paths_;
  std::filesystem::path scene_folder_, working_folder_;    ///< the latter empty: none
  std::vector<std::filesystem::path> readable_, writable_; ///< canonical, apart from library and scene
  std::function<bool(const std::filesystem::path& file, FileUse use)> permits_;
  std::vector<std::string> names_;
  std::unordered_map<std::string, std::uint32_t> numbers_;
};

/// Scenes written on Windows name their folders with backslashes.
std::filesystem::path portable_path(std::string_view name);

/// What a text is read into: room for `bytes` bytes, and for what the scanner puts behind them.
std::string make_text(std::size_t bytes);

/// The text of a file, at most `limit` bytes. Calls `look` every now and then. Throws InputError, without a
/// position, if it is missing, is not a regular file, is longer or cannot be read to its end.
std::string read_text(const std::filesystem::path& path, std::uint64_t limit,
                      const std::function<void()>& look);

/// A text file being written. What is left of it when it is destroyed goes to the file, if it can.
class TextWriter {
public:
  /// The file is not followed if it is a link. Throws InputError, without a position, as the others do, if it
  /// cannot be written.
  TextWriter(const std::filesystem::path& path, bool append);
  TextWriter(const TextWriter&) = delete;
  TextWriter& operator=(const TextWriter&) = delete;
  ~TextWriter();

  void write(std::string_view text);
  void close();

private:
  void flush();

  int file_;
  std::string buffer_;
};

} // namespace celltrace::pov

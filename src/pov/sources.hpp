// The files that a scene reads and writes: finds, reads and names them, and restricts where they may be.
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
  bool may_be_read = false; ///< lies, links resolved, where the scene may read
};

class Sources {
public:
  /// Sets the folders in which files are looked for, in this order: the working folder (by default the first
  /// writable one), the folder of the file that names them, the scene's, the library paths, and POV-Ray's
  /// installed include folder; a name that differs in case only is taken last. Throws InputError if a folder
  /// to read or write in does not exist.
  explicit Sources(const ParseOptions& options);

  /// Returns the number of a name; equal names have equal numbers.
  std::uint32_t number_of(const std::string& name);
  const std::string& name(std::uint32_t file) const { return names_[file]; }

  /// Sets the scene's own folder, which is searched for every file.
  void set_scene_folder(std::filesystem::path folder);

  std::optional<FoundFile> find_file(std::string_view name, const std::filesystem::path& naming_folder) const;
  /// Returns the folders that find_file() searches, each once, for a message.
  std::string folders_searched(const std::filesystem::path& naming_folder) const;

  /// Returns the path for a file, no link, that a scene writes and calls `name`. Throws InputError, without a
  /// position, if the scene may not.
  std::filesystem::path writable_file(std::string_view name) const;

private:
  bool permits(const std::filesystem::path& file, FileUse use) const {
    return permits_ && permits_(file, use);
  }
  std::vector<std::filesystem::path> folders(const std::filesystem::path& naming_folder) const;

  std::vector<std::filesystem::path> library_paths_;
  std::filesystem::path scene_folder_, working_folder_; ///< an empty working folder counts as none
  std::vector<std::filesystem::path> readable_,
      writable_; ///< canonical; library paths and the scene's folder are not among them
  std::function<bool(const std::filesystem::path& file, FileUse use)> permits_;
  std::vector<std::string> names_;
  std::unordered_map<std::string, std::uint32_t> numbers_;
};

/// Returns a path with slashes: scenes written on Windows use backslashes.
std::filesystem::path portable_path(std::string_view name);

/// Returns a buffer for a text of `bytes` bytes, and for the padding that the scanner adds.
std::string make_text(std::size_t bytes);

/// Returns the text of a file of at most `limit` bytes. Calls `check` every now and then. Throws InputError,
/// without a position, if the file is missing, is no regular file, is longer, or cannot be read to its end.
std::string read_text(const std::filesystem::path& path, std::uint64_t limit,
                      const std::function<void()>& check);

/// A text file being written. The destructor writes the rest if it can.
class TextWriter {
public:
  /// Opens a file, but does not follow it if it is a link. Throws InputError, without a position, as the
  /// other functions do, if the file cannot be written.
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

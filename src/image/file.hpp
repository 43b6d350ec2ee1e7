// Files for the picture formats: C streams that close themselves and appear whole or not at all.
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <set>

namespace celltrace::image {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

/// Opens a regular file for reading. Throws InputError without the path ("cannot be opened: ...").
File open_for_reading(const std::filesystem::path& path);

/// Returns the target of a path after symbolic links, even if the target does not exist yet.
std::filesystem::path follow_links(std::filesystem::path path);

/// Returns the descriptor of this process that a path such as /dev/stdout or /dev/fd/3 names; -1 if the path
/// names none.
int descriptor_named(const std::filesystem::path& path);

/// Returns true if a path names an open descriptor, or something that exists and is neither a regular file
/// nor a folder: a pipe or a device, to which bytes are written directly.
bool is_stream(const std::filesystem::path& path);

/// Throws the InputError that an OutputFile for this path would throw. Nothing is written.
void check_output(const std::filesystem::path& path);

/// A file that appears under the name `path`, complete, on commit(); without commit() nothing changes there.
/// It is written under another name in the same folder and then renamed. An existing file keeps its mode, its
/// owner and its other names (hard links): if renaming would change these, or the folder cannot be written,
/// the bytes are copied into the existing file. Symbolic links are followed; streams are written to directly.
/// Not thread safe; several objects for the same path may exist, and the last commit() wins.
class OutputFile {
public:
  /// Throws InputError if the path cannot be written: a file without a permission to write is protected
  /// from root, too.
  explicit OutputFile(const std::filesystem::path& path);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile();

  std::FILE* get() const { return file_.get(); }
  /// Closes and renames or copies. Throws InputError if a write failed.
  void commit();

private:
  void take_name();

  std::filesystem::path target_;    ///< empty for a stream
  std::filesystem::path temporary_; ///< empty if a nameless file is copied
  File file_;
};

/// Removes the temporary files that killed processes have left of OutputFiles for these paths.
void remove_abandoned_parts(const std::set<std::filesystem::path>& paths);

} // namespace celltrace::image

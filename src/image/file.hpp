// Files as the picture formats use them: C streams that close themselves and appear whole or not at all.
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

/// A file that comes into being under another name in the folder of `path` and takes its place on commit();
/// without commit() it is removed. Links are followed; what is there but no regular file (a device, a pipe)
/// is written to directly. Not thread safe; several objects for the same path may exist, the last commit()
/// wins.
class OutputFile {
public:
  /// Throws InputError if nothing can be written there.
  explicit OutputFile(const std::filesystem::path& path);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile();

  std::FILE* get() const { return file_.get(); }
  /// Closes and renames. Throws InputError if a write failed.
  void commit();

private:
  std::filesystem::path target_;
  std::filesystem::path temporary_; // empty: the target is written to directly
  File file_;
};

/// Removes what processes that were killed have left of an OutputFile for one of these paths.
void remove_abandoned_parts(const std::set<std::filesystem::path>& paths);

} // namespace celltrace::image

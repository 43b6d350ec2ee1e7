// A page of HTML with many pictures.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace celltrace::cli {

struct SheetEntry {
  enum class State { done, partial, failed };
  State state = State::failed;
  std::string scene;           ///< path of the scene
  std::string picture;         ///< name of a file beside the page
  std::string text;            ///< the error
  bool is_unsupported = false; ///< the error is about features that --lenient leaves out
  double seconds = 0;
};

class ContactSheet {
public:
  void add(const SheetEntry& entry) { entries_.push_back(entry); }
  std::size_t count(SheetEntry::State state) const;
  std::size_t count_unsupported() const;
  /// Returns the page, in which names and errors are escaped.
  std::string page() const;
  /// Throws InputError if the file cannot be written.
  void write(const std::filesystem::path& path) const;

private:
  std::vector<SheetEntry> entries_;
};

} // namespace celltrace::cli

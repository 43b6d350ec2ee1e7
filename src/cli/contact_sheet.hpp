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
  std::string scene;           ///< its path
  std::string picture;         ///< file beside the page
  std::string text;            ///< the error
  bool is_unsupported = false; ///< it is about what --lenient leaves out
  double seconds = 0;
};

class ContactSheet {
public:
  void add(const SheetEntry& entry) { entries_.push_back(entry); }
  std::size_t count(SheetEntry::State state) const;
  std::size_t count_unsupported() const;
  /// Returns the page. Names and errors are text in it, whatever they are.
  std::string page() const;
  /// Throws InputError if the file cannot be written.
  void write(const std::filesystem::path& path) const;

private:
  std::vector<SheetEntry> entries_;
};

} // namespace celltrace::cli

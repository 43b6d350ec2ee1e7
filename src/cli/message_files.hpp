// Files that get messages, besides stderr, and kinds of messages that stderr does not get: POV-Ray's text
// streams.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace celltrace::cli {

/// The streams that POV-Ray sorts its messages into.
enum class MessageKind {
  debug, ///< the scene's own words, and whatever is none of the others
  error,
  render,     ///< progress
  statistics, ///< the summary in the end
  warning     ///< notes, too
};

/// Returns the kind that a line on stderr has. Lines that begin with blanks go on with the line before.
MessageKind kind_of_message(std::string_view line, MessageKind before);

struct MessageRequest {
  std::vector<std::pair<MessageKind, std::filesystem::path>> files;
  std::vector<std::filesystem::path> all_files; ///< for messages of every kind
  std::vector<MessageKind> hidden;              ///< not on stderr
  bool appends = false;                         ///< to files that are there

  bool is_empty() const { return files.empty() && all_files.empty() && hidden.empty(); }
};

/// Sorts what is written to std::cerr as long as it lives. One at a time.
class MessageFiles {
public:
  MessageFiles();
  ~MessageFiles();
  MessageFiles(const MessageFiles&) = delete;
  MessageFiles& operator=(const MessageFiles&) = delete;

  /// Begins to sort, unless nothing is asked for. Throws InputError, naming it, if a file cannot be written.
  void open(const MessageRequest& request);

private:
  class Sorter;
  std::unique_ptr<Sorter> sorter_;
};

} // namespace celltrace::cli

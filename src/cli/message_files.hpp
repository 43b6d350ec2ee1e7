// Copies messages to files, and hides kinds of messages from stderr: POV-Ray's text streams.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace celltrace::cli {

/// The text streams of POV-Ray.
enum class MessageKind {
  debug, ///< the scene's own messages, and all that belong to no other kind
  error,
  render,     ///< progress
  statistics, ///< the summary at the end
  warning     ///< warnings and notes
};

/// Returns the kind of a line on stderr. Lines that begin with blanks continue the line before.
MessageKind kind_of_message(std::string_view line, MessageKind before);

struct MessageRequest {
  std::vector<std::pair<MessageKind, std::filesystem::path>> files;
  std::vector<std::filesystem::path> all_files; ///< for messages of every kind
  std::vector<MessageKind> hidden;              ///< kinds that stderr does not get
  bool appends = false;                         ///< true: messages are appended to existing files

  bool is_empty() const { return files.empty() && all_files.empty() && hidden.empty(); }
};

/// Sorts the output to std::cerr while it lives. Only one may exist at a time.
class MessageFiles {
public:
  MessageFiles();
  ~MessageFiles();
  MessageFiles(const MessageFiles&) = delete;
  MessageFiles& operator=(const MessageFiles&) = delete;

  /// Starts sorting if the request asks for it. Throws InputError, naming the file, if a file cannot be
  /// written.
  void open(const MessageRequest& request);

private:
  class Sorter;
  std::unique_ptr<Sorter> sorter_;
};

} // namespace celltrace::cli

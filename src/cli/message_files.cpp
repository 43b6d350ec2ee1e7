#include "cli/message_files.hpp"

#include "celltrace/error.hpp"

#include <algorithm>
#include <fstream>
#include <iostream>
#include <optional>
#include <streambuf>

namespace celltrace::cli {

MessageKind kind_of_message(std::string_view line, MessageKind before) {
  struct Mark {
    std::string_view text;
    MessageKind kind;
  };
  static constexpr Mark kMarks[] = {
      {"error: ", MessageKind::error},          {"warning: ", MessageKind::warning},
      {"note: ", MessageKind::warning},         {"million rays/s", MessageKind::statistics},
      {"Trace Time:", MessageKind::statistics}, {"rows to go", MessageKind::render},
      {"==== [", MessageKind::render},          {"Rendering frame ", MessageKind::render},
      {"Rendered ", MessageKind::render},
  };
  if (!line.empty() && line[0] == ' ') return before;
  for (const Mark& mark : kMarks)
    if (line.find(mark.text) != line.npos) return mark.kind;
  return MessageKind::debug;
}

/// Writes lines to files and to the original stream of std::cerr.
class MessageFiles::Sorter : public std::streambuf {
public:
  explicit Sorter(const MessageRequest& request) : hidden_(request.hidden) {
    const auto mode = std::ios::binary | (request.appends ? std::ios::app : std::ios::trunc);
    for (const auto& path : request.all_files)
      add(std::nullopt, path, mode);
    for (const auto& [kind, path] : request.files)
      add(kind, path, mode);
    console_ = std::cerr.rdbuf(this);
  }
  Sorter(const Sorter&) = delete;
  Sorter& operator=(const Sorter&) = delete;
  ~Sorter() override {
    end_line();
    std::cerr.rdbuf(console_);
  }

private:
  static constexpr std::string_view kWipe = "\033[K"; ///< erases to the end of the terminal's line

  struct File {
    std::optional<MessageKind> kind; ///< none: all kinds
    std::ofstream stream;
  };

  void add(std::optional<MessageKind> kind, const std::filesystem::path& path, std::ios::openmode mode) {
    std::ofstream stream(path, mode);
    if (!stream) throw InputError(path.string() + ": cannot be written");
    files_.push_back({kind, std::move(stream)});
  }

  int_type overflow(int_type character) override {
    if (!traits_type::eq_int_type(character, traits_type::eof())) put(traits_type::to_char_type(character));
    return traits_type::not_eof(character);
  }

  std::streamsize xsputn(const char* text, std::streamsize size) override {
    std::for_each(text, text + size, [this](char c) { put(c); });
    return size;
  }

  /// Writes a progress line without an end, which begins by erasing its line.
  int sync() override {
    if (line_.compare(0, kWipe.size(), kWipe) == 0) {
      if (!is_hidden(MessageKind::render)) print(line_);
      line_.clear();
    }
    return console_->pubsync();
  }

  void print(std::string_view text) {
    console_->sputn(text.data(), static_cast<std::streamsize>(text.size()));
  }

  /// Adds a character. Lines that end with a carriage return are progress, which is overwritten, so that
  /// files do not get them.
  void put(char c) {
    line_ += c;
    if (c == '\n') return end_line();
    if (c != '\r') return;
    if (!is_hidden(MessageKind::render)) print(line_);
    line_.clear();
  }

  void end_line() {
    if (line_.empty()) return;
    kind_ = kind_of_message(line_, kind_);
    if (!is_hidden(kind_)) print(line_);
    const std::size_t wiped = line_.find(kWipe);
    const std::string_view text =
        std::string_view(line_).substr(wiped == line_.npos ? 0 : wiped + kWipe.size());
    for (File& file : files_)
      if (!file.kind || *file.kind == kind_) file.stream << text << std::flush;
    line_.clear();
  }

  bool is_hidden(MessageKind kind) const {
    return std::find(hidden_.begin(), hidden_.end(), kind) != hidden_.end();
  }

  std::vector<MessageKind> hidden_;
  std::vector<File> files_;
  std::string line_;
  MessageKind kind_ = MessageKind::debug;
  std::streambuf* console_ = nullptr;
};

MessageFiles::MessageFiles() = default;
MessageFiles::~MessageFiles() = default;

void MessageFiles::open(const MessageRequest& request) {
  if (!request.is_empty()) sorter_ = std::make_unique<Sorter>(request);
}

} // namespace celltrace::cli

#include "cli/pov_entries.hpp"

#include "celltrace/error.hpp"
#include "cli/blanks.hpp"

#include <cctype>

namespace celltrace::cli {

namespace {

bool is_quote(char c) {
  return c == '"' || c == '\'';
}

bool is_name_letter(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_';
}

bool has_pov_extension(std::string_view name) {
  return ends_with(name, ".pov") || ends_with(name, ".ini");
}

class Splitter {
public:
  Splitter(std::string_view text, bool in_file) : rest_(text), in_file_(in_file) {}

  std::vector<PovEntry> entries() {
    while (skip_blanks()) {
      const std::string_view before = rest_;
      PovEntry entry = next();
      entry.text = std::string(before.substr(0, before.size() - rest_.size()));
      while (!entry.text.empty() && is_blank(entry.text.back()))
        entry.text.pop_back();
      if (ends_the_line_ && skip_blanks()) entry.left_out = std::string(rest_);
      entries_.push_back(std::move(entry));
      if (ends_the_line_) break;
    }
    return std::move(entries_);
  }

private:
  /// Skips blanks. Returns false at the end, or at a comment.
  bool skip_blanks() {
    while (!rest_.empty() && is_blank(rest_[0]))
      rest_.remove_prefix(1);
    return !rest_.empty() && !is_comment(rest_[0]);
  }

  bool is_comment(char c) const { return in_file_ && (c == ';' || c == '#'); }

  PovEntry next() {
    if ((rest_[0] == '+' || rest_[0] == '-') && rest_.size() > 1 && is_name_letter(rest_[1])) return option();
    if (const std::size_t name = setting_name(rest_); name > 0) return setting(name);
    PovEntry entry{PovEntry::Kind::file};
    take_value(entry, true, true);
    return entry;
  }

  PovEntry option() {
    PovEntry entry{PovEntry::Kind::option};
    entry.plus = rest_[0] == '+';
    rest_.remove_prefix(1);
    entry.setting = find_switch(rest_);
    if (!entry.setting) {
      entry.value = words(false, false);
      return entry;
    }
    rest_.remove_prefix(entry.setting->letters.size());
    const Action action = entry.setting->action;
    take_value(entry, takes_blanks(action), action == Action::scene);
    return entry;
  }

  PovEntry setting(std::size_t name) {
    PovEntry entry{PovEntry::Kind::setting};
    entry.setting = find_setting(rest_.substr(0, name));
    rest_.remove_prefix(rest_.find('=') + 1);
    while (!rest_.empty() && is_blank(rest_[0]))
      rest_.remove_prefix(1);
    // Keeps the rest of the line together: a shell command contains words that look like switches.
    ends_the_line_ = in_file_ || (entry.setting && entry.setting->action == Action::never_run);
    take_value(entry, in_file_ || (entry.setting && takes_blanks(entry.setting->action)),
               entry.setting && entry.setting->action == Action::scene);
    return entry;
  }

  /// Returns the length of a setting's name at the front of a text; 0 if there is none.
  static std::size_t setting_name(std::string_view text) {
    std::size_t length = 0, equals = 0;
    while (length < text.size() && is_name_letter(text[length]))
      ++length;
    for (equals = length; equals < text.size() && is_blank(text[equals]);)
      ++equals;
    return equals < text.size() && text[equals] == '=' ? length : 0;
  }

  void take_value(PovEntry& entry, bool with_blanks, bool is_scene) {
    if (!rest_.empty() && is_quote(rest_[0])) {
      entry.in_quotes = true;
      entry.value = quoted();
    } else {
      entry.value = words(with_blanks, is_scene);
    }
  }

  /// Reads a quoted text. Without a closing quote it reaches to the end of the argument.
  std::string quoted() {
    const char quote = rest_[0];
    rest_.remove_prefix(1);
    const std::size_t end = rest_.find(quote);
    if (end == rest_.npos && in_file_) throw InputError("a quote is not closed");
    std::string text(rest_.substr(0, end));
    rest_.remove_prefix(std::min(end, rest_.size()));
    if (rest_.empty()) return text;
    rest_.remove_prefix(1);
    if (!in_file_ && !rest_.empty() && !is_blank(rest_[0]) && !begins_entry(rest_))
      throw InputError("'" + std::string(rest_) + "' stands right behind a quote");
    return text;
  }

  /// Reads a word or, with blanks, several.
  std::string words(bool with_blanks, bool is_scene) {
    std::size_t length = word_length(rest_);
    while (with_blanks) {
      std::size_t next = length;
      while (next < rest_.size() && is_blank(rest_[next]))
        ++next;
      const std::string_view more = rest_.substr(next);
      if (more.empty() || is_comment(more[0])) break;
      if (!ends_the_line_ && ends_before(more, rest_.substr(0, length), is_scene)) break;
      length = next + word_length(more);
    }
    std::string text(rest_.substr(0, length));
    rest_.remove_prefix(length);
    return text;
  }

  /// Returns the length up to a blank or a comment outside of closed quotes.
  std::size_t word_length(std::string_view text) const {
    std::size_t length = 0;
    for (; length < text.size() && !is_blank(text[length]) && !is_comment(text[length]); ++length)
      if (is_quote(text[length])) {
        const std::size_t end = text.find(text[length], length + 1);
        if (end != text.npos) length = end;
      }
    return length;
  }

  /// Returns whether the name `before` ends in front of the words `more`.
  static bool ends_before(std::string_view more, std::string_view before, bool is_scene) {
    if (begins_entry(more)) return true;
    if (is_scene) return has_pov_extension(before);
    return has_pov_extension(more.substr(0, more.find(' ')));
  }

  static bool begins_entry(std::string_view text) {
    if (is_quote(text[0])) return true;
    if (text[0] == '+' || text[0] == '-') return find_switch(text.substr(1)) != nullptr;
    return find_setting(text.substr(0, setting_name(text))) != nullptr;
  }

  std::string_view rest_;
  bool in_file_;
  bool ends_the_line_ = false; ///< a setting was read
  std::vector<PovEntry> entries_;
};

} // namespace

std::vector<PovEntry> split_argument(std::string_view argument) {
  return Splitter(argument, false).entries();
}

std::vector<PovEntry> split_ini_line(std::string_view line) {
  return Splitter(line, true).entries();
}

} // namespace celltrace::cli

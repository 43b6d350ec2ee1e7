#include "cli/ini_file.hpp"

#include "celltrace/error.hpp"
#include "cli/blanks.hpp"
#include "cli/pov_settings.hpp"
#include "cli/unreadable_file.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>

namespace celltrace::cli {

namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

/// Calls `take` with each line of a text and the line's number until it returns false.
template <class Take> void for_each_line(std::string_view text, Take take) {
  if (text.substr(0, kByteOrderMark.size()) == kByteOrderMark) text.remove_prefix(kByteOrderMark.size());
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    if (!take(IniLine{trimmed(text.substr(0, end)), number})) return;
    const std::size_t width = text.substr(end, 2) == "\r\n" ? 2 : 1;
    text.remove_prefix(std::min(end + width, text.size()));
  }
}

} // namespace

std::string read_ini_text(const std::string& name) {
  constexpr std::streamsize kMostBytes = 1 << 20;
  std::ifstream file(name, std::ios::binary);
  if (!file) throw unreadable(name);
  std::string text(kMostBytes + 1, '\0');
  file.read(text.data(), kMostBytes + 1);
  if (file.bad() || (file.gcount() == 0 && !file.eof())) throw unreadable(name);
  if (file.gcount() > kMostBytes) throw InputError(name + ": is longer than a megabyte");
  text.resize(static_cast<std::size_t>(file.gcount()));
  return text;
}

IniLines parse_ini(std::string_view text, std::string_view section) {
  IniLines result;
  result.has_section = section.empty();
  bool wanted = true;
  for_each_line(text, [&](const IniLine& line) {
    if (!line.text.empty() && line.text[0] == '[') {
      const std::string_view label = trimmed(line.text.substr(1, line.text.find(']') - 1));
      wanted = !section.empty() && same_word(label, trimmed(section));
      result.has_section = result.has_section || wanted;
    } else if (wanted && !line.text.empty()) {
      result.lines.push_back(line);
    }
    return true;
  });
  return result;
}

bool looks_like_ini(std::string_view text) {
  bool answer = false;
  for_each_line(text, [&](const IniLine& line) {
    const std::string_view rest = line.text;
    const auto is_letter = [&](std::size_t at) {
      return at < rest.size() && std::isalpha(static_cast<unsigned char>(rest[at])) != 0;
    };
    // A line that begins with # and a letter is a directive of the scene language, not a comment.
    if (rest.empty() || rest[0] == ';' || (rest[0] == '#' && !is_letter(1))) return true;
    const std::string_view name = trimmed(rest.substr(0, rest.find('=')));
    answer = rest[0] == '[' || ((rest[0] == '+' || rest[0] == '-') && is_letter(1)) ||
             (name.size() < rest.size() && find_setting(name) != nullptr);
    return false;
  });
  return answer;
}

} // namespace celltrace::cli

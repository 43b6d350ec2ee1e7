#include "cli/ini_file.hpp"

#include "celltrace/error.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>

namespace celltrace::cli {

namespace {

bool is_blank(char c) {
  return std::isspace(static_cast<unsigned char>(c)) != 0;
}

bool same_name(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

/// One line of a file.
class Line {
public:
  Line(std::string_view text, std::string place) : rest_(text), place_(std::move(place)) {}

  /// False: nothing but a comment is left.
  bool at_entry() {
    skip_blanks();
    return !rest_.empty() && rest_[0] != ';' && rest_[0] != '#';
  }
  char first() const { return rest_[0]; }

  /// What is in brackets.
  std::string section() {
    const std::size_t end = rest_.find(']');
    if (end == std::string_view::npos) throw InputError(place_ + ": a section's name has to end with ]");
    return std::string(rest_.substr(1, end - 1));
  }

  std::string entry() {
    std::string text;
    while (!rest_.empty() && (std::isalpha(static_cast<unsigned char>(rest_[0])) || rest_[0] == '_'))
      text += take();
    const std::string_view behind_name = rest_;
    skip_blanks();
    if (!text.empty() && !rest_.empty() && rest_[0] == '=') {
      text += take();
      skip_blanks();
      return text + word();
    }
    rest_ = behind_name;
    return text + word();
  }

private:
  void skip_blanks() {
    while (!rest_.empty() && is_blank(rest_[0]))
      rest_.remove_prefix(1);
  }

  char take() {
    const char c = rest_[0];
    rest_.remove_prefix(1);
    return c;
  }
  /// Up to a blank or a comment. Quotes hold together what is in them.
  std::string word() {
    std::string text;
    while (!rest_.empty() && !is_blank(rest_[0]) && rest_[0] != ';') {
      const char c = take();
      if (c != '"' && c != '\'') {
        text += c;
        continue;
      }
      const std::size_t end = rest_.find(c);
      if (end == std::string_view::npos) throw InputError(place_ + ": a quote is not closed");
      text += rest_.substr(0, end);
      rest_.remove_prefix(end + 1);
    }
    return text;
  }

  std::string_view rest_;
  std::string place_;
};

} // namespace

std::string read_ini_text(const std::string& name) {
  constexpr std::streamsize kMostBytes = 1 << 20;
  std::ifstream file(name, std::ios::binary);
  if (!file) throw InputError(name + ": cannot be read");
  std::string text(kMostBytes + 1, '\0');
  file.read(text.data(), kMostBytes + 1);
  if (file.bad() || (file.gcount() == 0 && !file.eof())) throw InputError(name + ": cannot be read");
  if (file.gcount() > kMostBytes) throw InputError(name + ": is longer than a megabyte");
  text.resize(static_cast<std::size_t>(file.gcount()));
  return text;
}

std::vector<IniEntry> parse_ini(std::string_view text, std::string_view section, const std::string& name) {
  std::vector<IniEntry> entries;
  bool wanted = true, found = section.empty();
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    Line line(text.substr(0, end), name + ":" + std::to_string(number));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.at_entry() && line.first() == '[') {
      const std::string label = line.section();
      wanted = !section.empty() && same_name(label, section);
      found = found || wanted;
      continue;
    }
    while (wanted && line.at_entry())
      entries.push_back({line.entry(), number});
  }
  if (!found) throw InputError(name + ": has no section [" + std::string(section) + "]");
  return entries;
}

} // namespace celltrace::cli

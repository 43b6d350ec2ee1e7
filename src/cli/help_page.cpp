#include "cli/help_page.hpp"

#include <algorithm>
#include <sstream>

namespace celltrace::cli {

namespace {

constexpr std::size_t kPageWidth = 80, kColumn = 26;

/// Appends words, broken into lines that begin at a column; the first line continues the page's last one.
void append_wrapped(std::string& page, const std::string& text, std::size_t column) {
  std::size_t at = page.size() - (page.rfind('\n') + 1);
  std::istringstream words(text);
  bool begins_line = true;
  for (std::string word; words >> word; begins_line = false) {
    if (!begins_line && at + 1 + word.size() > kPageWidth) {
      page += '\n' + std::string(column, ' ');
      at = column;
      begins_line = true;
    }
    if (!begins_line) page += ' ', ++at;
    page += word;
    at += word.size();
  }
  page += '\n';
}

/// Appends a name and its value; a list of words may take several lines.
void append_name(std::string& page, const std::string& name) {
  constexpr std::size_t kDeeper = 6;
  page += "  ";
  std::size_t at = 2;
  for (std::size_t begin = 0; begin < name.size();) {
    const std::size_t bar = name.find('|', begin);
    const std::string part = name.substr(begin, bar == name.npos ? bar : bar + 1 - begin);
    if (at > kDeeper && at + part.size() > kPageWidth) {
      page += '\n' + std::string(kDeeper, ' ');
      at = kDeeper;
    }
    page += part;
    at += part.size();
    begin += part.size();
  }
}

/// Appends a row of two columns.
void append_row(std::string& page, const std::string& name, const std::string& text) {
  append_name(page, name);
  if (2 + name.size() + 2 > kColumn)
    page += '\n' + std::string(kColumn, ' ');
  else
    page += std::string(kColumn - 2 - name.size(), ' ');
  append_wrapped(page, text, kColumn);
}

std::string name_of(const DescribedOption& option) {
  std::string name;
  for (const std::string& each : option.names)
    name += (name.empty() ? "" : ", ") + each;
  if (!option.value.empty()) name += (name.empty() ? "" : " ") + option.value;
  return name;
}

std::string text_of(const DescribedOption& option) {
  std::string more = option.limits;
  if (!option.default_value.empty())
    more += (more.empty() ? "" : "; ") + ("default: " + option.default_value);
  return more.empty() ? option.description : option.description + " (" + more + ')';
}

void append_options(std::string& page, const DescribedGroup& group, bool positional) {
  const auto is_wanted = [&](const DescribedOption& option) { return option.positional() == positional; };
  if (std::none_of(group.options.begin(), group.options.end(), is_wanted)) return;
  page += '\n' + (positional ? "Arguments" : group.title.empty() ? "Options" : group.title) + ":\n";
  for (const DescribedOption& option : group.options)
    if (is_wanted(option)) append_row(page, name_of(option), text_of(option));
}

/// Appends text without joining its lines.
void append_lines(std::string& page, const std::string& text) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    append_wrapped(page, line, 0);
}

} // namespace

std::string help_page(const DescribedCommand& command, const std::vector<DescribedCommand>& commands) {
  std::string page;
  append_lines(page, command.description);
  page += "\nUsage: celltrace" + (command.name.empty() ? "" : ' ' + command.name);
  for (const DescribedGroup& group : command.groups)
    for (const DescribedOption& option : group.options)
      if (option.positional()) page += ' ' + (option.required ? option.value : '[' + option.value + ']');
  page += commands.empty() ? " [options]\n"
                           : " COMMAND [options]\n       celltrace SCENE.pov [options of render]\n";
  for (const DescribedGroup& group : command.groups)
    append_options(page, group, true);
  for (const DescribedGroup& group : command.groups)
    append_options(page, group, false);
  if (!commands.empty()) {
    page += "\nCommands, each with a --help of its own:\n";
    for (const DescribedCommand& each : commands)
      append_row(page, each.name, each.description);
  }
  if (!command.footer.empty()) {
    page += '\n';
    append_lines(page, command.footer);
  }
  return page;
}

} // namespace celltrace::cli

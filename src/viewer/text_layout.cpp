#include "viewer/text_layout.hpp"

#include <algorithm>
#include <cstddef>
#include <sstream>

namespace celltrace::viewer {

namespace {

/// Returns the number of letters of a text in UTF-8.
std::size_t letters(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

/// Returns the number of bytes of the first `count` letters.
std::size_t bytes_of(const std::string& text, std::size_t count) {
  std::size_t at = 0;
  for (; at < text.size(); ++at)
    if ((static_cast<unsigned char>(text[at]) & 0xC0) != 0x80 && count-- == 0) break;
  return at;
}

void wrap_line(const std::string& text, std::size_t columns, std::size_t indent,
               std::vector<std::string>& lines) {
  const std::size_t first = lines.size();
  // Blanks at the beginning of a line, as in a list of places, are kept.
  std::string line(
      std::min(text.find_first_not_of(' ') == text.npos ? 0 : text.find_first_not_of(' '), columns / 2), ' ');
  bool is_empty = true;
  const auto end_line = [&] {
    lines.push_back(line);
    line.assign(std::min(indent, columns / 2), ' ');
    is_empty = true;
  };
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (!is_empty && letters(line) + 1 + letters(word) > columns) end_line();
    if (!is_empty) line += ' ';
    while (letters(line) + letters(word) > columns) {
      const std::size_t bytes = bytes_of(word, columns - letters(line));
      line += word.substr(0, bytes);
      word.erase(0, bytes);
      end_line();
    }
    line += word;
    is_empty = is_empty && word.empty();
  }
  if (!is_empty || lines.size() == first) lines.push_back(line);
}

constexpr int kGap = 3;        ///< letters between two columns
constexpr int kNarrowest = 24; ///< width of a second column

} // namespace

std::vector<std::string> wrapped(const std::string& text, int columns, int indent) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
    wrap_line(line, static_cast<std::size_t>(std::max(columns, 4)), static_cast<std::size_t>(indent), lines);
  return lines;
}

std::vector<std::vector<std::string>> pages_of(const std::vector<std::pair<std::string, std::string>>& table,
                                               int columns, int rows) {
  std::size_t first = 0;
  for (const auto& row : table)
    first = std::max(first, letters(row.first));
  const int second = columns - static_cast<int>(first) - kGap;
  std::vector<std::vector<std::string>> groups; // lines of a group stay on one page
  for (const auto& [what, about] : table) {
    if (second < kNarrowest) {
      groups.push_back(wrapped(what + ": " + about, columns, 2));
      continue;
    }
    groups.emplace_back();
    for (const std::string& line : wrapped(about, second)) {
      const std::string& left = groups.back().empty() ? what : std::string();
      groups.back().push_back(left + std::string(first + kGap - letters(left), ' ') + line);
    }
  }
  std::size_t all = 0;
  for (const auto& group : groups)
    all += group.size();
  const auto most = static_cast<std::size_t>(std::max(rows, 2));
  if (all <= most) {
    std::vector<std::string> page;
    for (const auto& group : groups)
      page.insert(page.end(), group.begin(), group.end());
    return {page};
  }
  std::vector<std::vector<std::string>> pages(1);
  for (const auto& group : groups) {
    if (!pages.back().empty() && pages.back().size() + group.size() > most - 1) pages.emplace_back();
    for (const std::string& line : group) { // a group may have more lines than a page
      if (pages.back().size() == most - 1) pages.emplace_back();
      pages.back().push_back(line);
    }
  }
  for (std::size_t i = 0; i < pages.size(); ++i)
    pages[i].push_back("H: page " + std::to_string(i + 1) + " of " + std::to_string(pages.size()));
  return pages;
}

} // namespace celltrace::viewer

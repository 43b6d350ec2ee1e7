// Lays out text for a window, in letters of one width.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace celltrace::viewer {

/// Breaks a text between words, and inside of words that are longer than a line, into lines of at most
/// `columns` letters. Continued lines begin with `indent` blanks.
std::vector<std::string> wrapped(const std::string& text, int columns, int indent = 0);

/// Lays out rows of a thing and its description: in two columns if there is room, the second one wrapped, and
/// in a narrow window one below the other. A page has at most `rows` lines; if there are several, the
/// last line of each has its number.
std::vector<std::vector<std::string>> pages_of(const std::vector<std::pair<std::string, std::string>>& table,
                                               int columns, int rows);

} // namespace celltrace::viewer

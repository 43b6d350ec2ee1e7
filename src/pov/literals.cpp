#include "pov/literals.hpp"

#include <algorithm>
#include <charconv>
#include <limits>
#include <string_view>

#include "pov/names.hpp"

namespace celltrace::pov {

namespace {

/// The longest entry that the scanner accepts without an error.
constexpr std::ptrdiff_t kLongestEntry = 4096;

/// The length in bytes of the shortest vector with its comma, "<0,0>,".
constexpr std::ptrdiff_t kShortestVector = 6;

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

bool starts_number(const char* at) {
  return is_digit(at[*at == '-' || *at == '+' ? 1 : 0]);
}
bool starts_literal(const char* at) {
  return *at == '<' || starts_number(at);
}

const char* skip_gap(const char* at) {
  while (*at == ' ' || *at == '\t')
    ++at;
  return at;
}

/// Skips blanks, line ends and comments up to the end of a line.
const char* skip_blanks(const char* at) {
  for (;;) {
    while (*at == ' ' || *at == '\n' || *at == '\r' || *at == '\t')
      ++at;
    if (at[0] != '/' || at[1] != '/') return at;
    while (*at != '\n' && *at != '\r' && *at != '\0')
      ++at;
  }
}

/// Reads a number; null if there is none, or none that a double can hold.
const char* read_number(const char* at, const char* end, double& value) {
  const bool plus = *at == '+';
  if (plus) ++at;
  const char digit = at[!plus && *at == '-' ? 1 : 0];
  if (!is_digit(digit) && digit != '.') return nullptr;
  const auto [behind, error] = std::from_chars(at, end, value);
  return error == std::errc() ? behind : nullptr;
}

const char* read_vector(const char* at, const char* end, Vec3& vector) {
  for (int i = 0; i < 3; ++i) {
    at = read_number(skip_gap(at + 1), end, vector[i]);
    if (!at) return nullptr;
    at = skip_gap(at);
    if (*at == '>') return i == 0 ? nullptr : at + 1;
    if (*at != ',') return nullptr;
  }
  return nullptr;
}

/// Reads an entry and returns its end; null if it is no literal.
const char* read_entry(const char* at, const char* end, ListEntry& entry) {
  const char* behind = nullptr;
  if (*at == '<') {
    behind = read_vector(at, end, entry.v);
  } else if (starts_number(at)) {
    behind = read_number(at, end, entry.v.x);
    entry.v = Vec3(entry.v.x);
    entry.is_float = true;
  }
  return behind && behind - at <= kLongestEntry ? behind : nullptr;
}

bool is_in_word(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || is_digit(c) || c == '_';
}

/// Returns whether a value in front of this is complete, whatever follows. A name that is not reserved may be
/// that of a macro, which may continue the value with an operator.
bool ends_value(const char* at, const Names& names) {
  if (*at == ',' || *at == '}') return true;
  const char* end = at;
  while (is_in_word(*end))
    ++end;
  return names.is_reserved(std::string_view(at, static_cast<std::size_t>(end - at)));
}

/// Returns how long a list will be: the count at its head, as far as the rest of the text can hold that many
/// entries.
std::size_t expected(double count, const char* text, const char* end, std::size_t most) {
  const auto room = static_cast<std::size_t>((end - text) / kShortestVector + 2);
  const std::size_t limit = std::min(room, most);
  if (!(count >= 0)) return 1;
  return count < static_cast<double>(limit) ? static_cast<std::size_t>(count) + 1 : limit;
}

} // namespace

ListEntry::ListEntry(const Quantity& quantity) : v(quantity.vec3()), is_float(quantity.is_float()) {
  if (!quantity.is_finite()) v.x = std::numeric_limits<double>::infinity();
}

bool read_argument(const char* text, const char* end, bool is_first, const Names& names, Literal& literal) {
  const char* at = skip_blanks(text);
  if (!is_first) {
    if (*at != ',') return false;
    at = skip_blanks(at + 1);
  }
  ListEntry entry;
  literal.begin = at;
  literal.end = read_entry(at, end, entry);
  if (!literal.end || !ends_value(skip_blanks(literal.end), names)) return false;
  literal.value = entry.is_float ? Quantity(entry.v.x) : Quantity::vector(entry.v);
  return true;
}

const char* take_literals(const char* text, const char* end, std::vector<ListEntry>& list, std::size_t most) {
  const bool is_front = list.empty();
  const char* taken = text;
  while (list.size() < most) {
    ListEntry entry;
    const char* at = read_entry(skip_blanks(taken), end, entry);
    if (!at) break;
    at = skip_blanks(at);
    if (*at == ',')
      at = skip_blanks(at + 1);
    else if (*at != '<')
      break;
    if (!starts_literal(at)) break;
    if (is_front && list.size() == 1) list.reserve(expected(list.front().v.x, taken, end, most));
    list.push_back(entry);
    taken = at;
  }
  return taken;
}

} // namespace celltrace::pov

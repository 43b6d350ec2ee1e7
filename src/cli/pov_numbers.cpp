#include "cli/pov_numbers.hpp"

#include "cli/blanks.hpp"

#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>

namespace celltrace::cli {

namespace {

bool is_digit(std::string_view text, std::size_t at) {
  return at < text.size() && std::isdigit(static_cast<unsigned char>(text[at])) != 0;
}

std::size_t sign_length(std::string_view text) {
  return !text.empty() && (text[0] == '+' || text[0] == '-') ? 1 : 0;
}

NumberPrefix number_prefix(std::string_view text, std::size_t length) {
  const std::string digits(text.substr(0, length)); // strtod() needs a NUL at the end
  return {std::strtod(digits.c_str(), nullptr), trimmed(text.substr(length))};
}

} // namespace

std::optional<NumberPrefix> read_whole(std::string_view text) {
  text = trimmed(text);
  std::size_t length = sign_length(text);
  if (!is_digit(text, length)) return std::nullopt;
  while (is_digit(text, length))
    ++length;
  return number_prefix(text, length);
}

std::optional<NumberPrefix> read_real(std::string_view text) {
  text = trimmed(text);
  const std::size_t sign = sign_length(text);
  const bool has_dot = sign < text.size() && text[sign] == '.';
  if (!is_digit(text, sign + (has_dot ? 1 : 0))) return std::nullopt;
  const std::string copy(text);
  char* end = nullptr;
  std::strtod(copy.c_str(), &end);
  return number_prefix(text, static_cast<std::size_t>(end - copy.c_str()));
}

std::string number_text(double value) {
  char text[32];
  const bool is_whole = std::fabs(value) < 1e15 && value == std::floor(value);
  const auto end = is_whole
                       ? std::to_chars(std::begin(text), std::end(text), static_cast<long long>(value)).ptr
                       : std::to_chars(std::begin(text), std::end(text), value).ptr;
  return {text, end};
}

} // namespace celltrace::cli

#include "pov/scanner.hpp"

#include <algorithm>
#include <charconv>
#include <limits>
#include <stdexcept>

namespace celltrace::pov {

namespace {

constexpr std::size_t kLongestWord = 255;
constexpr std::size_t kLongestString = 1u << 20;
constexpr std::size_t kLongestNumber = 4096;

/// Returns the value of a number beyond the range of double: zero or infinity.
double out_of_range(std::string_view text) {
  long double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc()) return static_cast<double>(value);
  return text.find('-', 1) != text.npos ? 0 : std::numeric_limits<double>::infinity();
}

/// Removes an exponent without digits, which counts as 0.
void remove_bare_exponent(std::string_view& text) {
  if (text.empty() || (text.front() != 'e' && text.front() != 'E')) return;
  text.remove_prefix(1);
  if (!text.empty() && (text.front() == '+' || text.front() == '-')) text.remove_prefix(1);
}

/// Reads the number at the front of `text`, which the lexer has found well formed, and removes it.
double take_number(std::string_view& text) {
  if (text.front() == '+') text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc::result_out_of_range) value = out_of_range({text.data(), end});
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  remove_bare_exponent(text);
  return value;
}

} // namespace

void Scanner::start_lexeme(std::size_t length) {
  where_.line = line_;
  where_.column = static_cast<std::uint32_t>(offset_ - line_start_ + 1);
  offset_ += length;
}

void Scanner::count_lines(std::string_view lexeme) {
  const std::size_t begin = offset_ - lexeme.size();
  if (lexeme.find('\r') == lexeme.npos) {
    line_ += static_cast<std::uint32_t>(std::count(lexeme.begin(), lexeme.end(), '\n'));
    if (const std::size_t last = lexeme.rfind('\n'); last != lexeme.npos) line_start_ = begin + last + 1;
    return;
  }
  for (std::size_t i = 0; i < lexeme.size(); ++i) {
    const bool carriage_return = lexeme[i] == '\r' && (i + 1 == lexeme.size() || lexeme[i + 1] != '\n');
    if (lexeme[i] != '\n' && !carriage_return) continue;
    ++line_;
    line_start_ = begin + i + 1;
  }
}

bool Scanner::take_literals(std::vector<ListEntry>& list, std::size_t most) {
  const std::size_t count = list.size();
  move_flex();
  pass_to(pov::take_literals(text_.data() + offset_, text_.data() + text_.size(), list, most));
  move_flex();
  return list.size() > count;
}

bool Scanner::take_arguments(std::vector<ShapeArgument>& arguments, std::size_t most) {
  const std::size_t count = arguments.size();
  move_flex();
  Literal literal;
  while (arguments.size() < most && read_argument(text_.data() + offset_, text_.data() + text_.size(),
                                                  arguments.empty(), names_, literal)) {
    pass_to(literal.begin);
    start_lexeme(static_cast<std::size_t>(literal.end - literal.begin));
    arguments.push_back({literal.value, where_});
  }
  move_flex();
  return arguments.size() > count;
}

void Scanner::pass_to(const char* place) {
  const std::string_view passed(text_.data() + offset_,
                                static_cast<std::size_t>(place - text_.data()) - offset_);
  offset_ += passed.size();
  count_lines(passed);
}

void Scanner::open_comment() {
  if (comment_depth_++ == 0) comment_start_ = where_;
}

void Scanner::fail(const Location& where, const std::string& what) const {
  fail_(where, what);
  throw std::logic_error("a scanner's fail returned");
}

void Scanner::unterminated_comment() {
  fail(comment_start_, "this comment is never closed");
}

void Scanner::second_point() {
  fail(where_, "this number has more than one decimal point");
}

void Scanner::unterminated_string() {
  fail(where_, "this string is never closed");
}

Token Scanner::punctuation(unsigned symbol) const {
  Token token;
  token.kind = Token::Kind::punctuation;
  token.symbol = static_cast<std::uint16_t>(symbol);
  token.where = where_;
  return token;
}

Token Scanner::bad_character(unsigned char character) const {
  Token token = punctuation(character);
  token.kind = Token::Kind::bad_character;
  return token;
}

Token Scanner::number(std::string_view lexeme) const {
  if (lexeme.size() > kLongestNumber) fail(where_, "this number is too long");
  Token token;
  token.kind = Token::Kind::number;
  token.where = where_;
  token.number[0] = take_number(lexeme);
  return token;
}

Token Scanner::vector(std::string_view lexeme, unsigned count) const {
  if (lexeme.size() > kLongestNumber) fail(where_, "this vector is too long");
  Token token;
  token.kind = Token::Kind::vector;
  token.where = where_;
  token.symbol = static_cast<std::uint16_t>(count);
  for (unsigned i = 0; i < count; ++i) {
    lexeme.remove_prefix(lexeme.find_first_not_of("<, \t"));
    token.number[i] = take_number(lexeme);
  }
  return token;
}

Token Scanner::named(Token::Kind kind, std::string_view text) {
  if (kind == Token::Kind::string) {
    if (text.size() > kLongestString) fail(where_, "this string is too long");
    count_lines(text);
    text = text.substr(1, text.size() - 2);
  } else {
    if (kind != Token::Kind::word) text.remove_prefix(text.find_first_not_of("#. \t"));
    if (text.size() > kLongestWord) fail(where_, "this name is too long");
  }
  Token token;
  token.kind = kind;
  token.where = where_;
  token.name = names_.intern(text);
  return token;
}

Token Scanner::end() const {
  Token token;
  token.where = where_;
  token.where.line = line_;
  token.where.column = static_cast<std::uint32_t>(offset_ - line_start_ + 1);
  return token;
}

} // namespace celltrace::pov

// Cuts the text of one file into tokens. Reentrant: one scanner per file being read.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "pov/literals.hpp"
#include "pov/names.hpp"
#include "pov/token.hpp"

namespace celltrace::pov {

class Scanner {
public:
  /// Reports an error in the text; must throw.
  using Fail = std::function<void(const Location&, const std::string&)>;

  Scanner(std::string text, std::uint32_t file, Names& names, Fail fail);
  Scanner(const Scanner&) = delete;
  Scanner& operator=(const Scanner&) = delete;
  ~Scanner();

  /// Returns the next token; at the end, Token::Kind::end each time. Comments may nest; line ends are CR, LF
  /// or CR LF.
  Token next();

  /// Returns how many bytes of the text have been read.
  std::size_t offset() const { return offset_; }
  std::size_t size() const { return text_.size() - kPadding; }

  /// Reads literals at the current position, see pov::take_literals(). Returns false if there were none.
  bool take_literals(std::vector<ListEntry>& list, std::size_t most);

  /// Reads a shape's arguments at the current position as long as they are literals and fewer than `most`,
  /// see pov::read_argument(). Returns false if there were none.
  bool take_arguments(std::vector<ShapeArgument>& arguments, std::size_t most);

  // Functions that the generated code calls.
  void start_lexeme(std::size_t length);
  void start_line() { line_start_ = offset_, ++line_; }
  /// Counts the line ends inside a lexeme that may span lines.
  void count_lines(std::string_view lexeme);
  void open_comment();
  /// Returns true if this closed the outermost comment.
  bool close_comment() { return --comment_depth_ == 0; }
  [[noreturn]] void unterminated_comment();
  [[noreturn]] void unterminated_string();
  [[noreturn]] void second_point();
  Token punctuation(unsigned symbol) const;
  Token bad_character(unsigned char character) const;
  Token number(std::string_view lexeme) const;
  /// Returns a vector of 3 or 4 numbers.
  Token vector(std::string_view lexeme, unsigned count) const;
  Token named(Token::Kind kind, std::string_view text);
  Token end() const;

private:
  static constexpr std::size_t kPadding = 2; // NULs that flex needs behind a text that it scans in place

  /// Makes flex continue at offset_, and restores the character behind its last lexeme, which it had
  /// replaced.
  void move_flex();
  /// Continues at a place in the text.
  void pass_to(const char* place);
  [[noreturn]] void fail(const Location& where, const std::string& what) const;

  std::string text_; // includes the padding
  Names& names_;
  Fail fail_;
  void* flex_ = nullptr;
  std::size_t offset_ = 0;
  std::size_t line_start_ = 0;
  std::uint32_t line_ = 1;
  Location where_;
  Location comment_start_;
  int comment_depth_ = 0;
};

} // namespace celltrace::pov

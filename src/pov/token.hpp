// A word of the scene text before it is looked up: the scanner produces tokens; macros and loops replay them.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "pov/location.hpp"

namespace celltrace::pov {

/// The number of an interned text: see Names.
using NameId = std::uint32_t;
constexpr NameId kNoName = ~NameId{0};

struct Token {
  enum class Kind : std::uint8_t {
    end,           ///< end of the file, macro or loop body being read
    word,          ///< name
    directive,     ///< name, without the #
    string,        ///< name: the text between the quotes, escapes untouched
    component,     ///< name, without the dot in front
    number,        ///< number[0]
    vector,        ///< number[0..2] or [0..3], a literal <1, 2, 3>; symbol is the count
    punctuation,   ///< symbol
    bad_character, ///< symbol: not part of the language
  };
  Kind kind = Kind::end;
  std::uint16_t symbol = 0; ///< the character; two-character operators have the numbers below
  NameId name = 0;
  Location where;
  double number[4] = {0, 0, 0, 0};

  static constexpr std::uint16_t kLessEqual = 256;
  static constexpr std::uint16_t kGreaterEqual = 257;
  static constexpr std::uint16_t kNotEqual = 258;

  bool is(char punctuation_character) const {
    return kind == Kind::punctuation && symbol == static_cast<unsigned char>(punctuation_character);
  }
};

/// A part of a recorded sequence of tokens.
struct TokenRange {
  std::shared_ptr<const std::vector<Token>> tokens;
  std::size_t begin = 0;
  std::size_t end = 0;
};

} // namespace celltrace::pov

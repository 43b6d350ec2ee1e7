// Common parts of printf and scanf: reading a format's text, and lengths of integers.
#pragma once

#include "backends/cell_emu/simulator/ppe/call_arguments.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace celltrace::cell_emu {

/// The length of an integer argument, by its length modifier; `normal` and `word` have 32 bits.
enum class Length { normal, byte, half, two_words, word };

/// A format that is read character by character. It is a copy, because conversions may overwrite the original
/// in local store.
class FormatText {
public:
  explicit FormatText(std::string_view text) : text_(text) {}

  bool at_end() const { return at_ == text_.size(); }
  std::size_t place() const { return at_; }
  /// Returns the next character; the text must not be at its end.
  char peek() const { return text_[at_]; }
  char take() { return text_[at_++]; }
  bool skip(char character) {
    if (at_end() || peek() != character) return false;
    ++at_;
    return true;
  }
  /// Skips `sign` if it is the next character and is followed by another character than `end`. Returns
  /// whether it did.
  bool skips_to_another(char sign, char end) {
    return at_ + 1 < text_.size() && text_[at_ + 1] != end && skip(sign);
  }
  /// Returns the text that has been read since `start`.
  std::string_view since(std::size_t start) const {
    return std::string_view(text_).substr(start, at_ - start);
  }
  /// Takes the text up to `character`, or to the end, and returns it.
  std::string_view take_until(char character) {
    const std::size_t start = at_;
    at_ = std::min(text_.find(character, at_), text_.size());
    return since(start);
  }

  std::uint64_t read_number() {
    std::uint64_t number = 0;
    for (; !at_end() && peek() >= '0' && peek() <= '9'; ++at_)
      number = std::min<std::uint64_t>(number * 10 + static_cast<unsigned>(peek() - '0'), 1 << 30);
    return number;
  }
  Length read_length() {
    if (skip('h')) return skip('h') ? Length::byte : Length::half;
    if (skip('l')) return skip('l') ? Length::two_words : Length::word;
    if (skip('j') || skip('q') || skip('L')) return Length::two_words;
    return skip('z') || skip('t') ? Length::word : Length::normal;
  }

private:
  const std::string text_;
  std::size_t at_ = 0;
};

/// Stores the low bits of `value`, as many as an integer of `length` has.
inline void store_integer(const LocalStoreView& local_store, std::uint32_t address, Length length,
                          std::uint64_t value) {
  switch (length) {
  case Length::byte:
    return local_store.store(address, static_cast<std::uint8_t>(value));
  case Length::half:
    return local_store.store(address, static_cast<std::uint16_t>(value));
  case Length::two_words:
    return local_store.store(address, value);
  case Length::normal:
  case Length::word:
    return local_store.store(address, static_cast<std::uint32_t>(value));
  }
}

} // namespace celltrace::cell_emu

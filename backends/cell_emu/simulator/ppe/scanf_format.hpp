// scan_formatted(): the conversions of the scanf family, with results in local store.
#pragma once

#include "backends/cell_emu/simulator/ppe/call_arguments.hpp"

#include <cstddef>
#include <string>
#include <string_view>

namespace celltrace::cell_emu {

/// A source of characters.
class CharacterSource {
public:
  virtual ~CharacterSource() = default;
  /// Returns the next character, 0..255, or -1 at the end.
  virtual int get() = 0;
  /// Takes back the last character that get() returned; at most one in a row.
  virtual void unget(int character) = 0;
};

class StringSource final : public CharacterSource {
public:
  explicit StringSource(std::string_view text) : text_(text) {}
  int get() override { return at_ < text_.size() ? static_cast<unsigned char>(text_[at_++]) : -1; }
  void unget(int) override { --at_; }

private:
  std::string text_; // a copy, because conversions may overwrite the original
  std::size_t at_ = 0;
};

/// Reads as C99's vscanf() does with 32-bit int, long and pointers, in the "C" locale. Returns the number of
/// stored results, or -1 if the input ended before the first conversion. Throws CallFailed: EFAULT for places
/// outside local store; EINVAL for conversions that C99 does not have.
int scan_formatted(CharacterSource& source, std::string_view format, const LocalStoreView& local_store,
                   VariableArguments arguments);

} // namespace celltrace::cell_emu

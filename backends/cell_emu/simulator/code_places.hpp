// CodePlaces finds the source place of an address in a program, for profiles and messages: function, file and
// line, and the calls that were inlined there.
#pragma once

#include "backends/cell_emu/simulator/inlined_calls.hpp"
#include "backends/cell_emu/simulator/line_table.hpp"
#include "backends/cell_emu/simulator/spu_symbols.hpp"

#include <cstdint>

namespace celltrace::cell_emu {

/// A source place. Its strings live as long as the CodePlaces that returned it.
struct CodePlace {
  const char* function = nullptr; ///< null: unknown
  std::uint32_t offset = 0;       ///< bytes from the function's start
  const char* file = nullptr;     ///< null: unknown
  std::uint32_t line = 0;         ///< from 1; 0: unknown
};

/// Symbols, lines and inlined calls of one program. Thread safety: all members are const.
class CodePlaces {
public:
  explicit CodePlaces(const SpuElf& elf) : symbols_(elf), lines_(elf), calls_(elf) {}

  /// Returns the place of an address, by two binary searches.
  CodePlace at(std::uint32_t lsa) const {
    CodePlace place;
    if (const FunctionSymbol* function = symbols_.function_at(lsa)) {
      place.function = function->name;
      place.offset = lsa - function->lsa;
    }
    const SourceLine line = lines_.at(lsa);
    place.file = line.file;
    place.line = line.line;
    return place;
  }

  const SpuSymbols& symbols() const { return symbols_; }
  const LineTable& lines() const { return lines_; }
  const InlinedCalls& inlined_calls() const { return calls_; }

private:
  SpuSymbols symbols_;
  LineTable lines_;
  InlinedCalls calls_;
};

} // namespace celltrace::cell_emu

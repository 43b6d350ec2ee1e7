// SpuSymbols: the names of functions and data in a program's symbol table.
#pragma once

#include "backends/cell_emu/simulator/spu_elf.hpp"

#include <cstdint>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace celltrace::cell_emu {

/// A function, as its symbol describes it.
struct FunctionSymbol {
  const char* name = nullptr; ///< as in the file (C++ names are mangled); lives as long as the SpuSymbols
  std::uint32_t lsa = 0;
  std::uint32_t bytes = 0; ///< size; if the symbol has none, up to the next function or the end of the code
};

/// The symbols of a program's .symtab; empty if the program was stripped or the table is malformed. Thread
/// safety: all members are const.
class SpuSymbols {
public:
  explicit SpuSymbols(const SpuElf& elf);

  /// Returns the last function that starts at or before the address, in the same segment; null if there is
  /// none. An address in padding between functions lies behind the returned function's last byte. If
  /// functions in overlays share an address, only one of them is known.
  const FunctionSymbol* function_at(std::uint32_t lsa) const;

  /// Returns the value of a defined symbol of any kind, such as `_end`, `__stack` or `_start`. If several
  /// symbols have the name, a global symbol is preferred.
  std::optional<std::uint32_t> value_of(std::string_view name) const;

  /// Returns all functions by ascending address; no two have the same address.
  const std::vector<FunctionSymbol>& functions() const { return functions_; }

private:
  struct Candidate;
  struct Range {
    std::uint32_t first = 0, last = 0; ///< the last byte is included
  };

  std::vector<Candidate> read(const ElfSection& table, std::span<const std::uint8_t> names);
  void keep_functions(std::vector<Candidate> candidates);
  void find_code(const SpuElf& elf);
  const Range* code_around(std::uint32_t lsa) const;

  SpuElf elf_;              // keeps the names alive
  std::vector<Range> code_; // executable memory, by ascending address, disjoint
  std::vector<FunctionSymbol> functions_;
  std::unordered_map<std::string_view, std::uint32_t> values_;
};

} // namespace celltrace::cell_emu

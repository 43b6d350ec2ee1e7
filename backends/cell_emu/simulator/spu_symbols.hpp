// The names that a program's symbol table has for its functions and data.
#pragma once

#include "backends/cell_emu/simulator/spu_elf.hpp"

#include <cstdint>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace celltrace::cell_emu {

/// A function, as its symbol says.
struct FunctionSymbol {
  const char* name = nullptr; ///< as in the file (C++ names are mangled); lives as long as the SpuSymbols
  std::uint32_t lsa = 0;
  std::uint32_t bytes = 0; ///< up to the next function or the end of the code where the file does not say
};

/// Made from a program's .symtab; empty for a program that is stripped of it or whose table makes no sense.
/// Thread safety: all members are const.
class SpuSymbols {
public:
  explicit SpuSymbols(const SpuElf& elf);

  /// The function that starts at the address or is the last one to start before it in the same segment, or
  /// null. Between functions, in what the linker fills up, the address may lie behind the function's last
  /// byte. Of functions in overlays that share an address, one is known.
  const FunctionSymbol* function_at(std::uint32_t lsa) const;

  /// The value of a symbol of any kind that is defined, such as `_end`, `__stack` or `_start`; of several
  /// that have the name, a global one.
  std::optional<std::uint32_t> value_of(std::string_view name) const;

  /// By rising address, no two with the same.
  const std::vector<FunctionSymbol>& functions() const { return functions_; }

private:
  struct Candidate;
  struct Range {
    std::uint32_t first = 0, last = 0; ///< the last byte, too
  };

  std::vector<Candidate> read(const ElfSection& table, std::span<const std::uint8_t> names);
  void keep_functions(std::vector<Candidate> candidates);
  void find_code(const SpuElf& elf);
  const Range* code_around(std::uint32_t lsa) const;

  SpuElf elf_;              // for the names
  std::vector<Range> code_; // executable memory, by rising address, disjoint
  std::vector<FunctionSymbol> functions_;
  std::unordered_map<std::string_view, std::uint32_t> values_;
};

} // namespace celltrace::cell_emu

#include "backends/cell_emu/simulator/spu_symbols.hpp"

#include "backends/cell_emu/simulator/big_endian.hpp"

#include <algorithm>
#include <tuple>

namespace celltrace::cell_emu {

namespace {

constexpr std::uint32_t kSymbolTable = 2; // type of the section
constexpr std::size_t kSymbolBytes = 16;
constexpr std::size_t kName = 0, kValue = 4, kSize = 8, kInfo = 12, kSection = 14;
constexpr unsigned kNoType = 0, kFunction = 2, kFile = 4;
constexpr unsigned kLocal = 0, kGlobal = 1;
constexpr std::uint16_t kUndefined = 0, kAbsolute = 0xFFF1;

} // namespace

struct SpuSymbols::Candidate {
  FunctionSymbol symbol;
  bool typed = false; ///< true: marked as a function; false: a label in code
  bool global = false;
};

SpuSymbols::SpuSymbols(const SpuElf& elf) : elf_(elf) {
  find_code(elf);
  const auto& sections = elf.sections();
  const auto table = std::ranges::find(sections, kSymbolTable, &ElfSection::type);
  if (table == sections.end() || table->link >= sections.size()) return;
  keep_functions(read(*table, sections[table->link].content));
}

void SpuSymbols::find_code(const SpuElf& elf) {
  for (const ElfSegment& segment : elf.segments())
    if (segment.executable) code_.push_back({segment.lsa, segment.lsa + segment.bytes - 1});
  std::ranges::sort(code_, {}, &Range::first);
  std::vector<Range> merged;
  for (const Range& range : code_) {
    if (!merged.empty() && range.first <= merged.back().last)
      merged.back().last = std::max(merged.back().last, range.last);
    else
      merged.push_back(range);
  }
  code_ = std::move(merged);
}

const SpuSymbols::Range* SpuSymbols::code_around(std::uint32_t lsa) const {
  const auto behind = std::ranges::upper_bound(code_, lsa, {}, &Range::first);
  if (behind == code_.begin()) return nullptr;
  const Range& range = *std::prev(behind);
  return lsa <= range.last ? &range : nullptr;
}

std::vector<SpuSymbols::Candidate> SpuSymbols::read(const ElfSection& table,
                                                    std::span<const std::uint8_t> names) {
  std::vector<Candidate> functions;
  for (std::size_t at = kSymbolBytes; at + kSymbolBytes <= table.content.size(); at += kSymbolBytes) {
    const std::uint8_t* entry = table.content.data() + at;
    const std::string_view name = string_at(names, load_big_endian<std::uint32_t>(entry + kName));
    const auto value = load_big_endian<std::uint32_t>(entry + kValue);
    const auto section = load_big_endian<std::uint16_t>(entry + kSection);
    const unsigned type = entry[kInfo] & 15, binding = entry[kInfo] >> 4;
    if (name.empty() || section == kUndefined || type == kFile) continue;

    if (binding == kLocal)
      values_.try_emplace(name, value);
    else
      values_[name] = value;
    // Local labels are left out: they are places inside of functions written in assembly.
    const bool label = type == kNoType && binding == kGlobal && section != kAbsolute;
    if ((type == kFunction || label) && code_around(value) != nullptr)
      functions.push_back({{name.data(), value, load_big_endian<std::uint32_t>(entry + kSize)},
                           type == kFunction,
                           binding == kGlobal});
  }
  return functions;
}

void SpuSymbols::keep_functions(std::vector<Candidate> candidates) {
  // If several symbols have one address, the most informative comes first and is kept.
  const auto order = [](const Candidate& c) {
    return std::make_tuple(c.symbol.lsa, !c.typed, !c.global, c.symbol.bytes == 0);
  };
  std::ranges::stable_sort(candidates, {}, order);
  std::uint32_t sized_end = 0; // largest end of the functions so far whose size is known
  for (const Candidate& candidate : candidates) {
    const FunctionSymbol& symbol = candidate.symbol;
    if (!functions_.empty() && functions_.back().lsa == symbol.lsa) continue;
    if (!candidate.typed && symbol.lsa < sized_end) continue; // a second entry of a function
    functions_.push_back(symbol);
    const Range* code = code_around(symbol.lsa);
    if (symbol.bytes > code->last + 1 - symbol.lsa) functions_.back().bytes = code->last + 1 - symbol.lsa;
    sized_end = std::max(sized_end, symbol.lsa + functions_.back().bytes);
  }
  for (std::size_t i = 0; i < functions_.size(); ++i) {
    FunctionSymbol& function = functions_[i];
    if (function.bytes != 0) continue;
    std::uint32_t end = code_around(function.lsa)->last + 1;
    if (i + 1 < functions_.size()) end = std::min(end, functions_[i + 1].lsa);
    function.bytes = end - function.lsa;
  }
}

const FunctionSymbol* SpuSymbols::function_at(std::uint32_t lsa) const {
  const auto behind = std::ranges::upper_bound(functions_, lsa, {}, &FunctionSymbol::lsa);
  if (behind == functions_.begin()) return nullptr;
  const FunctionSymbol& function = *std::prev(behind);
  const Range* code = code_around(lsa);
  return code != nullptr && function.lsa >= code->first ? &function : nullptr;
}

std::optional<std::uint32_t> SpuSymbols::value_of(std::string_view name) const {
  const auto found = values_.find(name);
  if (found == values_.end()) return std::nullopt;
  return found->second;
}

} // namespace celltrace::cell_emu

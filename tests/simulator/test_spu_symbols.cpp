// Functions and data by name and address.
#include "backends/cell_emu/simulator/code_places.hpp"
#include "backends/cell_emu/simulator/spu_symbols.hpp"
#include "simulator/elf_image.hpp"

#include <catch2/catch.hpp>

using namespace celltrace::test;
using celltrace::cell_emu::CodePlace;
using celltrace::cell_emu::CodePlaces;
using celltrace::cell_emu::FunctionSymbol;
using celltrace::cell_emu::SpuElf;
using celltrace::cell_emu::SpuSymbols;

namespace {

constexpr unsigned kLabel = 0, kObject = 1, kFunction = 2, kFile = 4;
constexpr unsigned kLocal = 0, kGlobal = 16, kWeak = 32;

/// A symbol table and its strings.
class Symbols {
public:
  void add(const std::string& name, std::uint32_t value, std::uint32_t size, unsigned info,
           std::uint16_t section = 1) {
    const std::size_t at = table_.size();
    table_.resize(at + 16);
    put<std::uint32_t>(table_, at, static_cast<std::uint32_t>(names_.size()));
    put<std::uint32_t>(table_, at + 4, value);
    put<std::uint32_t>(table_, at + 8, size);
    table_[at + 12] = static_cast<std::uint8_t>(info);
    put<std::uint16_t>(table_, at + 14, section);
    names_.insert(names_.end(), name.begin(), name.end());
    names_.push_back(0);
  }
  /// Of a program with code from 0x80 to 0x180.
  SpuElf elf() const {
    ElfImage image;
    image.add_segment(0x80, Bytes(0x100), 0x100, 1 | 4);
    image.add_segment(0x200, Bytes(0x100), 0x100, 2 | 4);
    const std::uint32_t strings = image.add_section(".strtab", 3, names_);
    image.add_section(".symtab", 2, table_, strings);
    return SpuElf(image.build());
  }
  SpuSymbols read() const { return SpuSymbols(elf()); }

private:
  Bytes table_ = Bytes(16), names_ = Bytes(1);
};

std::string name_at(const SpuSymbols& symbols, std::uint32_t lsa) {
  const FunctionSymbol* function = symbols.function_at(lsa);
  return function != nullptr ? function->name : "none";
}

} // namespace

TEST_CASE("an address belongs to the function at or before it") {
  Symbols table;
  table.add("second", 0x100, 0x20, kFunction | kGlobal);
  table.add("first", 0xA0, 0x30, kFunction | kLocal);
  const SpuSymbols symbols = table.read();
  REQUIRE(symbols.functions().size() == 2);
  CHECK(name_at(symbols, 0x9C) == "none");
  CHECK(name_at(symbols, 0xA0) == "first");
  CHECK(name_at(symbols, 0xFC) == "first");
  CHECK(name_at(symbols, 0x100) == "second");
  CHECK(name_at(symbols, 0x17C) == "second");
  CHECK(name_at(symbols, 0x180) == "none"); // behind the code
  CHECK(name_at(symbols, 0x200) == "none");
  CHECK(name_at(symbols, 0xFFFFFFFF) == "none");
  CHECK(symbols.function_at(0x110)->lsa == 0x100);
  CHECK(symbols.function_at(0x110)->bytes == 0x20);
}

TEST_CASE("a place in a program is a function and the bytes from its start") {
  Symbols table;
  table.add("whole", 0xA0, 0xE0, kFunction | kGlobal);
  const CodePlaces places(table.elf());
  CHECK(places.at(0xA0).offset == 0);
  const CodePlace place = places.at(0x114);
  CHECK(std::string(place.function) == "whole");
  CHECK(place.offset == 0x74);
  CHECK(place.file == nullptr);
  CHECK(places.at(0x9C).function == nullptr);
}

TEST_CASE("functions of unknown size reach to the next one") {
  Symbols table;
  table.add("_start", 0x80, 0, kFunction | kGlobal);
  table.add("main", 0xC0, 0x10, kFunction | kGlobal);
  table.add("last", 0xE0, 0, kFunction | kGlobal);
  table.add("endless", 0x140, 0xFFFFFFFF, kFunction | kGlobal);
  const SpuSymbols symbols = table.read();
  CHECK(symbols.function_at(0x80)->bytes == 0x40);
  CHECK(symbols.function_at(0xE0)->bytes == 0x60);
  CHECK(symbols.function_at(0x140)->bytes == 0x40);
}

TEST_CASE("of several symbols the most telling one names a function") {
  Symbols table;
  table.add("crt0.S", 0, 0, kFile | kLocal, 0xFFF1);
  table.add("label", 0x80, 0, kLabel | kGlobal);
  table.add("local", 0x80, 0x20, kFunction | kLocal);
  table.add("weak", 0x80, 0x20, kFunction | kWeak);
  table.add("global", 0x80, 0x20, kFunction | kGlobal);
  table.add("entry", 0x90, 0, kLabel | kGlobal);    // inside a function
  table.add("assembly", 0xC0, 0, kLabel | kGlobal); // outside
  table.add("loop", 0xD0, 0, kLabel | kLocal);
  table.add("__stack", 0xE0, 0, kLabel | kGlobal, 0xFFF1);
  table.add("undefined", 0xF0, 0, kFunction | kGlobal, 0);
  table.add("elsewhere", 0x210, 0x10, kFunction | kGlobal);
  const SpuSymbols symbols = table.read();
  REQUIRE(symbols.functions().size() == 2);
  CHECK(name_at(symbols, 0x9C) == "global");
  CHECK(name_at(symbols, 0xF8) == "assembly");
}

TEST_CASE("values are found by name, global ones first") {
  Symbols table;
  table.add("_end", 0x7FF0, 0, kLabel | kGlobal, 0xFFF1);
  table.add("counter", 0x210, 4, kObject | kLocal);
  table.add("counter", 0x220, 4, kObject | kGlobal);
  table.add("counter", 0x230, 4, kObject | kLocal);
  table.add("missing", 0, 0, kObject | kGlobal, 0);
  const SpuSymbols symbols = table.read();
  CHECK(symbols.value_of("_end") == 0x7FF0);
  CHECK(symbols.value_of("counter") == 0x220);
  CHECK_FALSE(symbols.value_of("missing"));
  CHECK_FALSE(symbols.value_of(""));
}

TEST_CASE("a stripped program has no symbols") {
  const SpuSymbols symbols{SpuElf(small_program().build())};
  CHECK(symbols.functions().empty());
  CHECK(symbols.function_at(0x80) == nullptr);
  CHECK_FALSE(symbols.value_of("_end"));
}

// Source lines of instructions.
#include "backends/cell_emu/simulator/code_places.hpp"
#include "simulator/elf_image.hpp"

#include <catch2/catch.hpp>

#include <random>

using namespace celltrace::test;
using celltrace::cell_emu::CodePlace;
using celltrace::cell_emu::CodePlaces;
using celltrace::cell_emu::LineTable;
using celltrace::cell_emu::SourceLine;
using celltrace::cell_emu::SpuElf;

namespace {

void append(Bytes& to, const Bytes& from) {
  for (const std::uint8_t byte : from)
    to.push_back(byte);
}

Bytes word(std::uint32_t value) {
  Bytes bytes(4);
  put<std::uint32_t>(bytes, 0, value);
  return bytes;
}

/// A unit with the files "work/first.c" and "/there/second.h", opcode base 10, line base -3, line range 12.
Bytes unit(std::uint16_t version, const Bytes& program) {
  Bytes header{4};
  if (version >= 4) header.push_back(1);
  append(header, {1, static_cast<std::uint8_t>(-3), 12, 10, 0, 1, 1, 1, 1, 0, 0, 0, 1});
  append(header, {'w', 'o', 'r', 'k', 0, 0});
  append(header, {'f', 'i', 'r', 's', 't', '.', 'c', 0, 1, 0, 0});
  for (const char c : std::string("/there/second.h"))
    header.push_back(static_cast<std::uint8_t>(c));
  append(header, {0, 1, 0, 0, 0});

  Bytes body(2);
  put<std::uint16_t>(body, 0, version);
  append(body, word(static_cast<std::uint32_t>(header.size())));
  append(body, header);
  append(body, program);
  Bytes all = word(static_cast<std::uint32_t>(body.size()));
  append(all, body);
  return all;
}

Bytes set_address(std::uint32_t lsa) {
  Bytes program{0, 5, 2};
  append(program, word(lsa));
  return program;
}

/// From `lsa`: first.c:1 for 8 bytes, first.c:11 for 4, second.h:7 for 64.
Bytes small_sequence(std::uint32_t lsa) {
  Bytes program = set_address(lsa);
  append(program, {1});                                     // copy
  append(program, {2, 2, 3, 10, 1});                        // two instructions and ten lines further, copy
  append(program, {4, 2, 10 + 1 * 12 + 3 - 3, 3, 0x7F, 1}); // second.h, special: one on, -3; line -1, copy
  append(program, {2, 16, 0, 1, 1});                        // sixteen instructions, the end
  return program;
}

std::string text(const SourceLine& line) {
  if (line.file == nullptr) return "none";
  std::string text = line.file;
  text += ':';
  text += std::to_string(line.line);
  return text;
}

} // namespace

TEST_CASE("line programs of all versions are executed") {
  const auto version = GENERATE(std::uint16_t{2}, std::uint16_t{3}, std::uint16_t{4});
  const LineTable lines(unit(version, small_sequence(0x100)));
  CHECK(text(lines.at(0xFC)) == "none");
  CHECK(text(lines.at(0x100)) == "work/first.c:1");
  CHECK(text(lines.at(0x107)) == "work/first.c:1");
  CHECK(text(lines.at(0x108)) == "work/first.c:11");
  CHECK(text(lines.at(0x10C)) == "/there/second.h:7");
  CHECK(text(lines.at(0x14B)) == "/there/second.h:7");
  CHECK(text(lines.at(0x14C)) == "none");
  CHECK(text(lines.at(0xFFFFFFFF)) == "none");
}

TEST_CASE("all units count, in any order of addresses") {
  Bytes section = unit(4, small_sequence(0x200));
  append(section, unit(2, small_sequence(0x100)));
  append(section, unit(3, small_sequence(0x14C)));
  const LineTable lines(section);
  CHECK(text(lines.at(0x148)) == "/there/second.h:7");
  CHECK(text(lines.at(0x14C)) == "work/first.c:1");
  CHECK(text(lines.at(0x208)) == "work/first.c:11");
}

TEST_CASE("functions that the linker threw away do not cover others") {
  Bytes section = unit(2, small_sequence(0));
  append(section, unit(2, small_sequence(0x20)));
  const LineTable lines(section);
  CHECK(text(lines.at(0)) == "none");
  CHECK(text(lines.at(0x28)) == "work/first.c:11");
  CHECK(text(LineTable(unit(2, small_sequence(0))).at(8)) == "work/first.c:11");
}

TEST_CASE("units that make no sense have no lines, the others have") {
  Bytes section = unit(5, small_sequence(0x300));
  append(section, unit(2, {0, 200}));                // an operation over the end
  append(section, unit(2, small_sequence(0x3FFFC))); // out of local store
  append(section, unit(2, {1, 1, 1}));               // without an end
  append(section, unit(2, small_sequence(0x100)));
  append(section, {0xFF, 0xFF, 0xFF, 0xFF}); // 64-bit DWARF
  const LineTable lines(section);
  CHECK(text(lines.at(0x300)) == "none");
  CHECK(text(lines.at(0x3FFFC)) == "none");
  CHECK(text(lines.at(0x100)) == "work/first.c:1");
  CHECK(LineTable(std::span<const std::uint8_t>()).empty());
}

TEST_CASE("damaged line programs never do harm") {
  std::mt19937 random(45);
  Bytes sound = unit(2, small_sequence(0x100));
  append(sound, unit(4, small_sequence(0x200)));
  for (int i = 0; i < 20000; ++i) {
    Bytes section = sound;
    for (unsigned n = 1 + random() % 4; n > 0; --n)
      section[random() % section.size()] = static_cast<std::uint8_t>(random());
    const LineTable lines(section);
    for (std::uint32_t lsa = 0xF0; lsa < 0x260; lsa += 8)
      if (const SourceLine line = lines.at(lsa); line.file != nullptr) REQUIRE(line.line > 0);
  }
}

#ifdef CELLTRACE_SIMULATOR_PROGRAMS
TEST_CASE("places in a compiled program have function, file and line") {
  const CodePlaces places{SpuElf(read_file(CELLTRACE_SIMULATOR_PROGRAMS "/lines.elf"))};
  const auto& functions = places.symbols().functions();
  const auto sum =
      std::ranges::find_if(functions, [](const auto& f) { return f.name == std::string("sum"); });
  REQUIRE(sum != functions.end());

  const CodePlace start = places.at(sum->lsa);
  CHECK(start.function == std::string("sum"));
  CHECK(start.offset == 0);
  REQUIRE(start.file != nullptr);
  CHECK_THAT(start.file, Catch::EndsWith("lines.c"));
  CHECK(start.line >= 6);
  CHECK(start.line <= 9);

  bool loop = false;
  for (std::uint32_t lsa = sum->lsa; lsa < sum->lsa + sum->bytes; lsa += 4) {
    CHECK(places.at(lsa).function == std::string("sum"));
    CHECK(places.at(lsa).line >= 6);
    CHECK(places.at(lsa).line <= 11);
    loop |= places.at(lsa).line == 9;
  }
  CHECK(loop);
  CHECK(places.symbols().value_of("_start") ==
        SpuElf(read_file(CELLTRACE_SIMULATOR_PROGRAMS "/lines.elf")).entry());
  CHECK(places.symbols().value_of("__stack") == 0x3FFF0);
  CHECK(places.symbols().value_of("table") > 0u);
}
#endif

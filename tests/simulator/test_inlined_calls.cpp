// Calls that the compiler inlined.
#include "backends/cell_emu/simulator/inlined_calls.hpp"
#include "backends/cell_emu/simulator/simulated_program.hpp"
#include "celltrace/simulator.hpp"
#include "simulator/elf_image.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <random>

using namespace celltrace;
using namespace celltrace::test;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;
using cell_emu::InlinedCall;
using cell_emu::InlinedCalls;

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

Bytes text(const std::string& characters) {
  Bytes bytes(characters.begin(), characters.end());
  bytes.push_back(0);
  return bytes;
}

/// The sections of a program, as bytes.
struct Dwarf {
  Bytes info, abbrev, ranges, line, strings;

  InlinedCalls::Sections sections() const { return {info, abbrev, ranges, line, strings}; }
  std::size_t bytes() const {
    return info.size() + abbrev.size() + ranges.size() + line.size() + strings.size();
  }
  std::uint8_t& byte(std::size_t at) {
    for (Bytes* section : {&info, &abbrev, &ranges, &line}) {
      if (at < section->size()) return (*section)[at];
      at -= section->size();
    }
    return strings[at];
  }
};

constexpr std::uint8_t kUnit = 1, kFunction = 2, kNamed = 3, kBody = 4, kBodyOfRanges = 5, kBlock = 6,
                       kMember = 7;

/// One kind of entry: its attributes, each with its form.
Bytes kind(std::uint8_t code, std::uint8_t tag, bool has_children, const Bytes& attributes) {
  Bytes bytes{code, tag, has_children};
  append(bytes, attributes);
  append(bytes, {0, 0});
  return bytes;
}

/// The entries that the units below consist of.
Bytes abbreviations() {
  Bytes all = kind(kUnit, 0x11, true, {0x11, 0x01, 0x10, 0x06});                  // base, files
  append(all, kind(kFunction, 0x2E, true, {0x03, 0x08, 0x11, 0x01, 0x12, 0x01})); // name, code
  append(all, kind(kNamed, 0x2E, false, {0x3F, 0x19, 0x03, 0x0E, 0x20, 0x0B}));   // name
  append(all, kind(kBody, 0x1D, true, {0x31, 0x13, 0x11, 0x01, 0x12, 0x06, 0x58, 0x0B, 0x59, 0x05}));
  append(all, kind(kBodyOfRanges, 0x1D, true, {0x31, 0x10, 0x55, 0x06, 0x58, 0x0F, 0x59, 0x16}));
  append(all, kind(kBlock, 0x0B, true, {0x02, 0x0A}));
  append(all, kind(kMember, 0x2E, false, {0x47, 0x13, 0x20, 0x0C})); // of a declaration
  append(all, {0});
  return all;
}

Bytes line_header() {
  Bytes tables{'w', 'o', 'r', 'k', 0, 0};
  append(tables, {'f', 'i', 'r', 's', 't', '.', 'c', 0, 1, 0, 0});
  append(tables, {'/', 's', '.', 'h', 0, 0, 0, 0, 0});
  Bytes header{4, 1, 0xFD, 12, 10, 0, 1, 1, 1, 1, 0, 0, 0, 1};
  append(header, tables);
  Bytes unit{0, 2};
  append(unit, word(static_cast<std::uint32_t>(header.size())));
  append(unit, header);
  Bytes all = word(static_cast<std::uint32_t>(unit.size()));
  append(all, unit);
  return all;
}

/// `outer` is 0x1000 to 0x1100. In it, `half` is inlined from work/first.c:300 at 0x1010 to 0x1040, and in
/// that, in a block, the member `third` from /s.h:7 at 0x1018 to 0x1020 and 0x1030 to 0x1034. A second unit
/// has the same at 0x3000, a third one at 0, which the linker has thrown away.
Dwarf small_program(std::uint16_t version) {
  Dwarf dwarf;
  dwarf.abbrev = abbreviations();
  dwarf.line = line_header();
  dwarf.strings = text("half<(Kind)7>");
  const auto third = static_cast<std::uint32_t>(dwarf.strings.size());
  append(dwarf.strings, text("third"));
  for (const std::uint32_t base : {0x1000u, 0x3000u, 0u}) {
    const auto ranges = static_cast<std::uint32_t>(dwarf.ranges.size());
    for (const std::uint32_t offset : {0x18u, 0x20u})
      append(dwarf.ranges, word(offset));
    append(dwarf.ranges, word(0xFFFFFFFF)); // another base
    append(dwarf.ranges, word(base + 0x20));
    for (const std::uint32_t offset : {0x10u, 0x14u, 0u, 0u})
      append(dwarf.ranges, word(offset));

    const auto start = static_cast<std::uint32_t>(dwarf.info.size());
    Bytes unit(4);
    append(unit, {0, static_cast<std::uint8_t>(version), 0, 0, 0, 0, 4});
    append(unit, {kUnit});
    append(unit, word(base));
    append(unit, word(0));
    const auto half_at = static_cast<std::uint32_t>(unit.size());
    append(unit, {kNamed, 0, 0, 0, 0, 1});
    const auto declared_at = static_cast<std::uint32_t>(unit.size());
    append(unit, {kNamed});
    append(unit, word(third));
    append(unit, {1});
    const auto third_at = static_cast<std::uint32_t>(unit.size());
    append(unit, {kMember});
    append(unit, word(declared_at));
    append(unit, {1});
    append(unit, {kFunction});
    append(unit, text("outer"));
    append(unit, word(base));
    append(unit, word(base + 0x100));
    append(unit, {kBody});
    append(unit, word(half_at));
    append(unit, word(base + 0x10));
    append(unit, word(0x30));
    append(unit, {1, 1, 300 - 256});
    append(unit, {kBlock, 2, 0xAA, 0xBB});
    append(unit, {kBodyOfRanges});
    append(unit, word(start + third_at));
    append(unit, word(ranges));
    append(unit, {2, 0x0B, 7});
    append(unit, {0, 0, 0, 0, 0});
    put<std::uint32_t>(unit, 0, static_cast<std::uint32_t>(unit.size() - 4));
    append(dwarf.info, unit);
  }
  return dwarf;
}

std::string chain(const InlinedCalls& calls, std::uint32_t lsa) {
  std::string chain;
  for (const InlinedCall& call : calls.at(lsa)) {
    if (!chain.empty()) chain += ", ";
    chain += call.callee;
    chain += " from ";
    chain += call.file == nullptr ? "nowhere" : call.file;
    chain += ':';
    chain += std::to_string(call.line);
  }
  return chain;
}

const char* const kHalf = "half<(Kind)7> from work/first.c:300";
const char* const kThird = "third from /s.h:7, half<(Kind)7> from work/first.c:300";

} // namespace

TEST_CASE("every instruction has the calls that it is in the bodies of") {
  const auto version = GENERATE(std::uint16_t{2}, std::uint16_t{3}, std::uint16_t{4});
  const Dwarf dwarf = small_program(version);
  const InlinedCalls calls(dwarf.sections());
  for (const std::uint32_t base : {0x1000u, 0x3000u}) {
    CAPTURE(base);
    CHECK(chain(calls, base - 4) == "");
    CHECK(chain(calls, base) == "");
    CHECK(chain(calls, base + 0xC) == "");
    CHECK(chain(calls, base + 0x10) == kHalf);
    CHECK(chain(calls, base + 0x18) == kThird);
    CHECK(chain(calls, base + 0x1F) == kThird);
    CHECK(chain(calls, base + 0x20) == kHalf);
    CHECK(chain(calls, base + 0x30) == kThird);
    CHECK(chain(calls, base + 0x34) == kHalf);
    CHECK(chain(calls, base + 0x40) == "");
    CHECK(chain(calls, base + 0x100) == "");
  }
  CHECK(chain(calls, 0x18) == "");
  CHECK(chain(calls, 0xFFFFFFFF) == "");
}

TEST_CASE("units that make no sense have no calls, the others have") {
  const Dwarf sound = small_program(4);
  const std::size_t unit_bytes = sound.info.size() / 3;
  const auto spoilt = [&](std::size_t at, std::uint8_t value) {
    Dwarf dwarf = sound;
    dwarf.info[at] = value;
    const InlinedCalls calls(dwarf.sections());
    CHECK(chain(calls, 0x3018) == kThird);
    return chain(calls, 0x1018);
  };
  CHECK(spoilt(5, 5) == "");    // a later version
  CHECK(spoilt(10, 8) == "");   // addresses of 64 bits
  CHECK(spoilt(6, 0x7F) == ""); // abbreviations that are not there
  CHECK(spoilt(11, 99) == "");  // an entry of no kind
  CHECK(spoilt(16, 0x7F) == "third from nowhere:0, half<(Kind)7> from nowhere:0"); // no files

  Dwarf cut = sound;
  cut.info.resize(2 * unit_bytes - 1);
  const InlinedCalls first(cut.sections());
  CHECK(chain(first, 0x1018) == kThird);
  CHECK(chain(first, 0x3018) == "");
  Dwarf no_ranges = sound;
  no_ranges.ranges.clear();
  CHECK(chain(InlinedCalls(no_ranges.sections()), 0x1018) == kHalf);
  Dwarf no_names = sound;
  no_names.strings.clear();
  CHECK(chain(InlinedCalls(no_names.sections()), 0x1010) == " from work/first.c:300");
  CHECK(InlinedCalls(InlinedCalls::Sections()).empty());
}

TEST_CASE("lists of ranges and tables that are used over and over cost nothing") {
  // A function of 100,000 bodies, each with the same 10,000 ranges.
  Dwarf dwarf;
  dwarf.abbrev = kind(kFunction, 0x2E, true, {0x11, 0x01, 0x12, 0x01});
  append(dwarf.abbrev, kind(kBody, 0x1D, false, {0x55, 0x06}));
  append(dwarf.abbrev, {0});
  Bytes unit(4);
  append(unit, {0, 4, 0, 0, 0, 0, 4, kFunction});
  append(unit, word(0x1000));
  append(unit, word(0x20000));
  for (int body = 0; body < 100000; ++body)
    append(unit, {kBody, 0, 0, 0, 0});
  put<std::uint32_t>(unit, 0, static_cast<std::uint32_t>(unit.size() - 4));
  dwarf.info = unit;
  for (std::uint32_t range = 0; range < 10000; ++range) {
    append(dwarf.ranges, word(0x1000 + 4 * range));
    append(dwarf.ranges, word(0x1004 + 4 * range));
  }
  append(dwarf.ranges, Bytes(8));
  CHECK(InlinedCalls(dwarf.sections()).at(0x2000).size() == 1);

  // 10,000 units, each with abbreviations that start a byte behind those of the one before.
  Dwarf shifted;
  shifted.abbrev.assign(100000, 0x81);
  for (std::uint32_t number = 0; number < 10000; ++number) {
    append(shifted.info, word(8));
    append(shifted.info, {0, 4});
    append(shifted.info, word(number));
    append(shifted.info, {4, 1});
  }
  CHECK(InlinedCalls(shifted.sections()).empty());

  // Bodies in bodies.
  Dwarf deep;
  deep.abbrev = kind(kFunction, 0x2E, true, {0x11, 0x01, 0x12, 0x01});
  append(deep.abbrev, kind(kBody, 0x1D, true, {0x11, 0x01, 0x12, 0x01}));
  append(deep.abbrev, {0});
  Bytes nest(4);
  append(nest, {0, 4, 0, 0, 0, 0, 4, kFunction});
  append(nest, word(0x1000));
  append(nest, word(0x2000));
  for (int body = 0; body < 100000; ++body) {
    append(nest, {kBody});
    append(nest, word(0x1000));
    append(nest, word(0x2000));
  }
  put<std::uint32_t>(nest, 0, static_cast<std::uint32_t>(nest.size() - 4));
  deep.info = nest;
  CHECK(InlinedCalls(deep.sections()).at(0x1800).size() == 64);
}

TEST_CASE("damaged debugging information never does harm") {
  std::mt19937 random(45);
  const Dwarf sound = small_program(4);
  for (int i = 0; i < 20000; ++i) {
    Dwarf dwarf = sound;
    for (unsigned n = 1 + random() % 4; n > 0; --n)
      dwarf.byte(random() % dwarf.bytes()) =
          random() % 4 == 0 ? std::uint8_t{0xFF} : static_cast<std::uint8_t>(random());
    const InlinedCalls calls(dwarf.sections());
    for (std::uint32_t lsa = 0; lsa < 0x3100; lsa += 16)
      for (const InlinedCall& call : calls.at(lsa))
        REQUIRE((call.file == nullptr) == (call.line == 0));
  }
}

#ifdef CELLTRACE_SIMULATOR_PROGRAMS
TEST_CASE("a diagnostic of machine code names the line outside the compiler's headers, and its callers") {
  const Bytes elf = read_file(CELLTRACE_SIMULATOR_PROGRAMS "/inlined.elf");
  const SimulatedRun run = simulate(simulated(1), elf);
  const Diagnostic* const found = run.find(Rule::transfer_size);
  REQUIRE(found != nullptr);
  CHECK_THAT(found->site.file, Catch::EndsWith("inlined.c"));
  CHECK(found->site.line == 7);
  CHECK_THAT(
      found->site.function,
      StartsWith("fetch, inlined from inlined.c:11 in fetch_odd, inlined from inlined.c:15 in main+0x"));
  CHECK_THAT(found->text, Contains("at inlined.c:7 in fetch, inlined from inlined.c:11 in fetch_odd, "));
}

TEST_CASE("damaged debugging information of a compiled program never does harm") {
  const cell_emu::SpuElf elf(read_file(CELLTRACE_SIMULATOR_PROGRAMS "/inlined.elf"));
  Dwarf sound;
  const auto content = [&](const char* name) {
    const auto bytes = elf.section(name)->content;
    return Bytes(bytes.begin(), bytes.end());
  };
  sound = {content(".debug_info"), content(".debug_abbrev"), content(".debug_ranges"), content(".debug_line"),
           content(".debug_str")};
  REQUIRE_FALSE(InlinedCalls(sound.sections()).empty());
  std::mt19937 random(46);
  for (int i = 0; i < 5000; ++i) {
    Dwarf dwarf = sound;
    for (unsigned n = 1 + random() % 8; n > 0; --n)
      dwarf.byte(random() % dwarf.bytes()) = static_cast<std::uint8_t>(random());
    const InlinedCalls calls(dwarf.sections());
    for (std::uint32_t lsa = 0; lsa < 0x1000; lsa += 16)
      CHECK(calls.at(lsa).size() <= 64);
  }
}
#endif

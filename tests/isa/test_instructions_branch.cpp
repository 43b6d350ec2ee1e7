// Branches, and the hints that change nothing.
#include "isa/instruction_rows.hpp"

#include "isa/machines.hpp"

#include <memory>

#include <catch2/catch.hpp>

namespace celltrace::test {

namespace {

constexpr Effect kEnabled{Effect::interrupts, 0, 1}, kDisabled{Effect::interrupts, 0, 0};
constexpr const char* kLink = "00001004 00000000 00000000 00000000";

// The instruction is at 0x1000 unless a row says otherwise; immediates count words.
const Row kRows[] = {
    {.op = "br", .immediate = 4, .next = 0x1010},
    {.op = "br", .immediate = -0x400, .next = 0},
    {.op = "br", .immediate = -0x401, .next = 0x3FFFC},
    {.op = "br", .immediate = 0x7FFF, .pc = 0x3FFFC, .next = 0x1FFF8},
    {.op = "bra", .immediate = 0x800, .next = 0x2000},
    {.op = "bra", .immediate = -1, .next = 0x3FFFC},
    {.op = "brsl", .immediate = 4, .gives = kLink, .next = 0x1010},
    {.op = "brsl", .immediate = 2, .pc = 0x3FFFC, .gives = "00", .next = 4},
    {.op = "brasl", .immediate = 0x800, .gives = kLink, .next = 0x2000},

    // Whole words or the right halves of them, of the preferred slot only.
    {.op = "brz", .rt = "00000000 00000001", .immediate = 4, .next = 0x1010},
    {.op = "brz", .rt = "80000000 00000000", .immediate = 4},
    {.op = "brnz", .rt = "80000000 00000000", .immediate = 4, .next = 0x1010},
    {.op = "brnz", .rt = "00000000 00000001", .immediate = 4},
    {.op = "brhz", .rt = "ffff0000 00000001", .immediate = -4, .next = 0xFF0},
    {.op = "brhz", .rt = "00008000 00000000", .immediate = -4},
    {.op = "brhnz", .rt = "00008000 00000000", .immediate = -4, .next = 0xFF0},
    {.op = "brhnz", .rt = "ffff0000 00000001", .immediate = -4},

    {.op = "bi", .ra = "00002003 00000000", .next = 0x2000},
    {.op = "bi", .ra = "ffffffff", .next = 0x3FFFC},
    {.op = "bi", .ra = "00002000", .feature = kDisableInterrupts, .next = 0x2000, .effects = {kDisabled}},
    {.op = "bi", .ra = "00002000", .feature = kEnableInterrupts, .next = 0x2000, .effects = {kEnabled}},
    {.op = "bisl", .ra = "00002003", .gives = kLink, .next = 0x2000},
    {.op = "bisl", .ra = "00002000", .pc = 0x3FFFC, .gives = "00", .next = 0x2000},
    {.op = "bisl",
     .ra = "00002000",
     .feature = kEnableInterrupts,
     .gives = kLink,
     .next = 0x2000,
     .effects = {kEnabled}},
    {.op = "iret", .answers = {.srr0 = 0x2468}, .next = 0x2468},
    {.op = "iret", .answers = {.srr0 = 0x42003}, .next = 0x2000},
    {.op = "iret",
     .feature = kEnableInterrupts,
     .answers = {.srr0 = 0x2468},
     .next = 0x2468,
     .effects = {kEnabled}},
    // The link is set whether there is an event or not.
    {.op = "bisled", .ra = "00002003", .answers = {.event = true}, .gives = kLink, .next = 0x2000},
    {.op = "bisled", .ra = "00002003", .gives = kLink},
    {.op = "bisled",
     .ra = "00002000",
     .feature = kDisableInterrupts,
     .answers = {.event = true},
     .gives = kLink,
     .next = 0x2000,
     .effects = {kDisabled}},
    {.op = "bisled", .ra = "00002000", .feature = kDisableInterrupts, .gives = kLink},

    {.op = "biz", .ra = "00002003", .rt = "00000000 00000001", .next = 0x2000},
    {.op = "biz", .ra = "00002000", .rt = "80000000 00000000"},
    {.op = "binz", .ra = "00002003", .rt = "80000000 00000000", .next = 0x2000},
    {.op = "binz", .ra = "00002000", .rt = "00000000 00000001"},
    {.op = "bihz", .ra = "00002003", .rt = "ffff0000 00000001", .next = 0x2000},
    {.op = "bihz", .ra = "00002000", .rt = "00008000 00000000"},
    {.op = "bihnz", .ra = "00002003", .rt = "00008000 00000000", .next = 0x2000},
    {.op = "bihnz", .ra = "00002000", .rt = "ffff0000 00000001"},
    // Only a branch that is taken changes what interrupts may do.
    {.op = "biz",
     .ra = "00002000",
     .rt = "00000000",
     .feature = kEnableInterrupts,
     .next = 0x2000,
     .effects = {kEnabled}},
    {.op = "biz", .ra = "00002000", .rt = "00000001", .feature = kEnableInterrupts},
    {.op = "bihnz", .ra = "00002000", .rt = "00000000", .feature = kDisableInterrupts},

    {.op = "hbr", .ra = "00002000"},
    {.op = "hbra", .immediate = 0x1234},
    {.op = "hbrr", .immediate = 0x1234},
};

} // namespace

std::span<const Row> branch_rows() {
  return kRows;
}

TEST_CASE("branches do as the ISA says") {
  check(kRows);
}

TEST_CASE("a branch goes where its register pointed before the link was set") {
  constexpr std::uint32_t kBislSame = 0x35200204;   // bisl $4,$4
  constexpr std::uint32_t kBisledSame = 0x35600204; // bisled $4,$4
  const auto interpreter = std::make_unique<InterpreterMachine>();
  const auto reference = std::make_unique<ReferenceMachine>();
  for (Machine* machine : {static_cast<Machine*>(interpreter.get()), static_cast<Machine*>(reference.get())})
    for (const std::uint32_t word : {kBislSame, kBisledSame}) {
      INFO(machine->name() << ": " << isa::disassemble(word, 0x1000));
      machine->answers().event = true;
      machine->set_gpr(4, Register::of_preferred(0x2000));
      machine->execute(0x1000, word);
      CHECK(machine->next() == 0x2000);
      CHECK(machine->gpr(4) == Register::of_preferred(0x1004));
    }
}

} // namespace celltrace::test

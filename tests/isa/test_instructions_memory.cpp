// Loads and stores.
#include "isa/instruction_rows.hpp"

#include "isa/machines.hpp"

#include <memory>

#include <catch2/catch.hpp>

namespace celltrace::test {

namespace {

constexpr const char* kHeld = "00112233 44556677 8899aabb ccddeeff";

// The quadword that counts is at 0x2000 unless a row says otherwise.
const Row kRows[] = {
    // The low four bits of an address do not count, nor do those beyond the local store.
    {.op = "lqd", .ra = "00001ff5 00000000", .immediate = 1, .holds = kHeld, .gives = kHeld},
    {.op = "lqd", .ra = "00004000", .immediate = -512, .holds = kHeld, .gives = kHeld},
    {.op = "lqd", .ra = "00000010", .immediate = 511, .holds = kHeld, .gives = kHeld},
    {.op = "lqd", .ra = "fffffff0", .immediate = 1, .at = 0, .holds = kHeld, .gives = kHeld},
    {.op = "lqd", .ra = "7fc42000", .immediate = 0, .holds = kHeld, .gives = kHeld},
    {.op = "lqx", .ra = "00001000 00000000", .rb = "00001008 00000000", .holds = kHeld, .gives = kHeld},
    {.op = "lqx", .ra = "00003000", .rb = "fffff000", .holds = kHeld, .gives = kHeld},
    // The low four bits carry before they are dropped.
    {.op = "lqx", .ra = "00001ff8", .rb = "00000008", .holds = kHeld, .gives = kHeld},
    {.op = "lqa", .immediate = 0x800, .holds = kHeld, .gives = kHeld},
    {.op = "lqa", .immediate = 0x803, .holds = kHeld, .gives = kHeld},
    {.op = "lqa", .immediate = -4, .at = 0x3FFF0, .holds = kHeld, .gives = kHeld},
    {.op = "lqr", .immediate = 0x400, .holds = kHeld, .gives = kHeld},
    // From the instruction itself, not from the one after it.
    {.op = "lqr", .immediate = 0x401, .pc = 0x1008, .holds = kHeld, .gives = kHeld, .next = 0x100C},
    {.op = "lqr", .immediate = -0x400, .pc = 0x3004, .holds = kHeld, .gives = kHeld, .next = 0x3008},
    {.op = "lqr", .immediate = 1, .pc = 0x3FFFC, .at = 0, .holds = kHeld, .gives = kHeld, .next = 0},

    {.op = "stqd", .ra = "00001ff5 00000000", .rt = kHeld, .immediate = 1, .stores = kHeld},
    {.op = "stqd", .ra = "00004000", .rt = kHeld, .immediate = -512, .stores = kHeld},
    {.op = "stqd", .ra = "fffffff0", .rt = kHeld, .immediate = 1, .at = 0, .stores = kHeld},
    {.op = "stqx", .ra = "00001000 00000000", .rb = "00001008 00000000", .rt = kHeld, .stores = kHeld},
    {.op = "stqx", .ra = "00001ff8", .rb = "00000008", .rt = kHeld, .stores = kHeld},
    {.op = "stqx", .ra = "80000000", .rb = "8003ffff", .rt = kHeld, .at = 0x3FFF0, .stores = kHeld},
    {.op = "stqa", .rt = kHeld, .immediate = 0x803, .stores = kHeld},
    {.op = "stqa", .rt = kHeld, .immediate = -4, .at = 0x3FFF0, .stores = kHeld},
    {.op = "stqr", .rt = kHeld, .immediate = 0x400, .stores = kHeld},
    {.op = "stqr", .rt = kHeld, .immediate = 0x401, .pc = 0x1008, .stores = kHeld, .next = 0x100C},
    {.op = "stqr", .rt = kHeld, .immediate = 1, .pc = 0x3FFFC, .at = 0, .stores = kHeld, .next = 0},
};

constexpr std::uint32_t kLqd = 0x34000203;  // lqd $3,0($4)
constexpr std::uint32_t kStqd = 0x24000203; // stqd $3,0($4)

} // namespace

std::span<const Row> memory_rows() {
  return kRows;
}

TEST_CASE("loads and stores do as the ISA says") {
  check(kRows);
}

TEST_CASE("accesses to watched quadwords are announced") {
  const auto machine = std::make_unique<InterpreterMachine>();
  const Register value = register_of(kHeld);
  machine->set_gpr(3, value);
  machine->set_gpr(4, Register::of_preferred(0x2008));

  SECTION("stores, with what they store, before they do") {
    machine->watch(0x2000, isa::State::kWatchStores);
    machine->execute(0, kStqd);
    CHECK(machine->world.stored == 0x2000u);
    CHECK(machine->world.stored_value == value);
    CHECK(machine->local_store()[0x2001] == 0x11);
    machine->execute(0, kLqd);
    CHECK_FALSE(machine->world.loaded.has_value());
  }
  SECTION("loads") {
    machine->watch(0x2000, isa::State::kWatchLoads);
    machine->execute(0, kLqd);
    CHECK(machine->world.loaded == 0x2000u);
    machine->execute(0, kStqd);
    CHECK_FALSE(machine->world.stored.has_value());
  }
  SECTION("not their neighbours") {
    machine->watch(0x1FF0, isa::State::kWatchStores | isa::State::kWatchLoads);
    machine->watch(0x2010, isa::State::kWatchStores | isa::State::kWatchLoads);
    machine->execute(0, kLqd);
    machine->execute(0, kStqd);
    CHECK_FALSE(machine->world.loaded.has_value());
    CHECK_FALSE(machine->world.stored.has_value());
  }
}

} // namespace celltrace::test

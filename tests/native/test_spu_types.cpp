#include "lane_sum.hpp"

#include "backends/native/spu_types.hpp"
#include "celltrace/spe/machine.hpp"

#include <catch2/catch.hpp>

#include <numeric>

namespace celltrace {
SpeProgram lane_sum_program();
} // namespace celltrace

using namespace celltrace;

namespace {

void check_lane_sum(Machine& machine) {
  alignas(128) test::LaneSumBlock block{};
  std::iota(std::begin(block.a), std::end(block.a), 0.0f);
  machine.start(0, lane_sum_program(), to_ea(&block));
  machine.wait(0);
  CHECK(block.sum == 136.0f);
}

} // namespace

TEST_CASE("every SPU type that the CPU supports runs a program compiled for it") {
  unsigned entered = 0;
  for (const native::SpuType& type : native::spu_types()) {
    CAPTURE(type.key);
    MachineConfig config;
    config.spes = 1;
    config.simd = type.simd;
    if (!type.supported()) {
      CHECK_THROWS_AS(make_machine(config), InputError);
      continue;
    }
    const auto machine = make_machine(config);
    check_lane_sum(*machine);
    CHECK(machine->spu_key() == type.key);
    ++entered;
  }
  CHECK(entered > 0);
}

TEST_CASE("auto takes the widest SPU type that both CPU and program have") {
  const auto usable = native::usable_spu_types(SimdLevel::automatic);
  MachineConfig config;
  config.spes = 1;
  const auto machine = make_machine(config);
  CHECK(machine->spu_key() == usable.front()->key);
  check_lane_sum(*machine);
  CHECK(machine->spu_key() == usable.front()->key);

  SpeProgram narrow("narrow");
  narrow.add(usable.back()->key, [](void*, ea_t) {});
  machine->start(0, narrow, 0);
  machine->wait(0);
  CHECK(machine->spu_key() == usable.back()->key);
}

TEST_CASE("a program's machine code is an executable of the SPU's") {
  const SpeProgram program = lane_sum_program();
  CHECK(program.image("cell_emu").empty());
#ifdef HAS_SPU_COMPILER
  const auto elf = program.image("cell_sim");
  REQUIRE(elf.size() > 52);
  const auto half = [&](std::size_t at) { return elf[at] << 8 | elf[at + 1]; };
  CHECK((elf[0] == 0x7F && elf[1] == 'E' && elf[2] == 'L' && elf[3] == 'F'));
  CHECK(elf[4] == 1);    // 32 bits
  CHECK(elf[5] == 2);    // most significant byte first
  CHECK(half(16) == 2);  // executable
  CHECK(half(18) == 23); // SPU
#else
  CHECK(program.image("cell_sim").empty());
#endif
}

TEST_CASE("a program without an entry for the machine is refused") {
  const auto machine = make_machine(MachineConfig{});
  CHECK_THROWS_AS(machine->start(0, SpeProgram("nothing"), 0), SpeError);
  CHECK_FALSE(machine->running(0));
}

TEST_CASE("machines are made within limits") {
  MachineConfig config;
  config.backend = static_cast<Backend>(7);
  CHECK_THROWS_WITH(make_machine(config), Catch::Contains("unknown backend 7"));
  config = MachineConfig{};
  config.spes = 257;
  CHECK_THROWS_AS(make_machine(config), InputError);
  // No build has both.
  std::string refused;
  for (const SimdLevel level : {SimdLevel::sse2, SimdLevel::neon64}) {
    config = MachineConfig{};
    config.simd = level;
    try {
      make_machine(config);
    } catch (const InputError& error) {
      refused = error.what();
    }
  }
  CHECK_THAT(refused, Catch::StartsWith("this build has no SIMD \"") && Catch::Contains("but auto"));
}

TEST_CASE("backends and SIMD levels have names") {
  for (const Backend backend : kBackends)
    CHECK(backend_named(name_of(backend)) == backend);
  for (const SimdLevel level : kSimdLevels)
    CHECK(simd_level_named(name_of(level)) == level);
  CHECK_THROWS_WITH(backend_named("cray"), "unknown backend \"cray\"; there are native, cell_emu, cell_sim");
  CHECK_THROWS_WITH(simd_level_named("mmx"), Catch::StartsWith("unknown SIMD \"mmx\"; there are auto, sse2"));
  CHECK(name_of(static_cast<Backend>(7)) == std::string("unknown"));
}

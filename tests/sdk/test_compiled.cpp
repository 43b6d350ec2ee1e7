// The same source by the host's compiler and by the SPU's, whose machine code the simulator runs.
#include "celltrace/simulator.hpp"
#include "celltrace/spe/spu_intrinsics.hpp"
#include "sdk/every_intrinsic.h"
#include "sdk/simulated_instruction.hpp"

#include <catch2/catch.hpp>

#include <algorithm>

int every_intrinsic(qword* results, const qword* operands);

namespace celltrace::test {
namespace {

#ifdef CELLTRACE_EVERY_INTRINSIC_ELF
/// What the program gets and puts.
struct alignas(16) Set {
  std::uint8_t operands[4][16];
  std::uint8_t results[EVERY_INTRINSIC_RESULTS][16];
};

TEST_CASE("intrinsics give what the SPU's compiler makes of them") {
  const auto& sets = operand_sets();
  std::vector<Set> memory(sets.size() + 1);
  for (std::size_t i = 0; i < sets.size(); ++i) {
    const qword operands[] = {sets[i].a, sets[i].b, sets[i].c, si_il(1)};
    for (unsigned k = 0; k < 4; ++k)
      operands[k].quadword().store(memory[i].operands[k]);
  }
  MachineConfig config = simulated(1);
  config.emulation.objects = {memory_object(memory, "operands and results")};
  config.emulation.cycle_limit = 100'000'000;
  const Bytes elf = read_file(CELLTRACE_EVERY_INTRINSIC_ELF);
  const SimulatedRun run = simulate(config, elf, to_ea(memory.data()));
  INFO(run.report());
  REQUIRE(run.ok());
  REQUIRE(run.exit_codes[0] == 0);

  std::vector<unsigned> differing(EVERY_INTRINSIC_RESULTS);
  int count = 0;
  for (std::size_t i = 0; i < sets.size(); ++i) {
    qword results[EVERY_INTRINSIC_RESULTS];
    const qword operands[] = {sets[i].a, sets[i].b, sets[i].c};
    count = every_intrinsic(results, operands);
    for (int k = 0; k < count; ++k) {
      const qword expected(sdk::Quadword::load(memory[i].results[k]));
      if (results[k].quadword() == expected.quadword()) continue;
      if (++differing[static_cast<std::size_t>(k)] == 1)
        UNSCOPED_INFO("result " << k << " of " << text_of(operands[0]) << " | " << text_of(operands[1])
                                << " | " << text_of(operands[2]) << " is " << text_of(results[k])
                                << " and not " << text_of(expected));
    }
  }
  CHECK(std::count(differing.begin(), differing.end(), 0u) == EVERY_INTRINSIC_RESULTS);
  CHECK(count > 200);
}
#else
TEST_CASE("intrinsics give what the SPU's compiler makes of them") {
  WARN("skipped: set CELLTRACE_SPU_GXX to spu-elf-g++");
  qword results[EVERY_INTRINSIC_RESULTS];
  const qword operands[3] = {};
  CHECK(every_intrinsic(results, operands) > 200);
}
#endif

} // namespace
} // namespace celltrace::test

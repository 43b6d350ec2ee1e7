// Tests of an SPE program on a PC: saxpy.c, unchanged but for its static data, on the emulated Cell.
#include "saxpy.h"

#include <celltrace/emulator.hpp>
#include <celltrace/spe/spu_mfcio.hpp>

#define CATCH_CONFIG_MAIN
#include <catch2/catch.hpp>

#include <array>
#include <string>

using namespace celltrace;

// The main() of saxpy.c, compiled three times: see CMakeLists.txt.
int saxpy_single(unsigned long long speid, unsigned long long argp, unsigned long long envp);
int saxpy_double(unsigned long long speid, unsigned long long argp, unsigned long long envp);
int saxpy_without_wait(unsigned long long speid, unsigned long long argp, unsigned long long envp);

namespace {

constexpr unsigned kSpes = 2;
constexpr unsigned kBlocks = 8; // of every SPE
constexpr unsigned kElements = kSpes * kBlocks * SAXPY_BLOCK;

/// 64 KB of x and as much of y, in equal parts for every SPE.
struct Problem {
  alignas(128) std::array<float, kElements> x;
  alignas(128) std::array<float, kElements> y;
  alignas(128) std::array<unsigned, 32> finished{};
  std::array<saxpy_control, kSpes> control{};

  Problem() {
    for (unsigned i = 0; i < kElements; ++i) {
      x[i] = static_cast<float>(i % 100);
      y[i] = 1;
    }
    for (unsigned spe = 0; spe < kSpes; ++spe) {
      const unsigned first = spe * kBlocks * SAXPY_BLOCK;
      control[spe] = {to_ea(&x[first]), to_ea(&y[first]), to_ea(finished.data()), kBlocks, 2};
    }
  }

  EmulatedRun run(const MachineConfig& config,
                  int (*program)(unsigned long long, unsigned long long, unsigned long long)) {
    return emulate(config, [&](EmulatedSpu& spu) { spe_main(program)(spu, to_ea(&control[spu.id()])); });
  }

  bool solved() const {
    for (unsigned i = 0; i < kElements; ++i)
      if (y[i] != 1 + 2 * static_cast<float>(i % 100)) return false;
    return finished[0] == kSpes;
  }
};

} // namespace

TEST_CASE("every program computes a * x + y and breaks no rule") {
  const auto program = GENERATE(saxpy_single, saxpy_double);
  Problem problem;
  const EmulatedRun run = problem.run(lockstep(kSpes), program);
  INFO(run.report());
  CHECK(run.ok());
  CHECK(problem.solved());
}

TEST_CASE("a missing wait is found, with the line of the command that was not waited for") {
  Problem problem;
  // Also where the data happen to come in time, and the result is right.
  MachineConfig config = lockstep(kSpes);
  config.emulation.transfers = TransferTime::at_issue;
  const EmulatedRun run = problem.run(config, saxpy_without_wait);
  CHECK_FALSE(run.ok());
  const Diagnostic* const race = run.find(Rule::local_store_race);
  REQUIRE(race != nullptr);
  CHECK(std::string(race->site.file).find("saxpy.c") != std::string::npos);
  CHECK(std::string(race->other_site.file).find("saxpy.c") != std::string::npos);
}

TEST_CASE("with two buffers the transfers hide behind the computation") {
  Problem one, two;
  const EmulatedRun single_buffered = one.run(lockstep(kSpes), saxpy_single);
  const EmulatedRun double_buffered = two.run(lockstep(kSpes), saxpy_double);
  const double speedup =
      static_cast<double>(single_buffered.cycles) / static_cast<double>(double_buffered.cycles);
  INFO(single_buffered.cycles << " cycles with one buffer, " << double_buffered.cycles << " with two");
  CHECK(speedup > 1.3);
  CHECK(double_buffered.spes[0].cycles.channel_stall_cycle <
        single_buffered.spes[0].cycles.channel_stall_cycle);
}

TEST_CASE("what is moved is x and y in and y out, and local store is used sparingly") {
  Problem problem;
  const EmulatedRun run = problem.run(lockstep(kSpes), saxpy_double);
  constexpr unsigned kBytes = kBlocks * SAXPY_BLOCK * sizeof(float);
  for (const SpeStatistics& spe : run.spes) {
    CHECK(spe.dma_bytes_read >= 2 * kBytes + sizeof(saxpy_control));
    CHECK(spe.dma_bytes_written >= kBytes);
    CHECK(spe.local_store_peak < 40 * 1024);
  }
}

TEST_CASE("whatever the order of the SPEs and the time of the transfers, the result is the same") {
  for (unsigned seed = 0; seed < 50; ++seed) {
    Problem problem;
    const EmulatedRun run = problem.run(exploring_with_faults(kSpes, seed), saxpy_double);
    INFO("seed " << seed << "\n" << run.report());
    REQUIRE(run.ok());
    REQUIRE(problem.solved());
  }
}

// Cycles of computation: what the SIMD facade and compute() count, and what the pipeline model makes of it.
#include "celltrace/spe/counting_simd.hpp"
#include "backends/cell_emu/pipeline.hpp"
#include "celltrace/spe/simd_host.hpp"

#include <catch2/catch.hpp>

#include <thread>

namespace celltrace::cell_emu {
namespace {

using S = CountingSimd<HostSimd<BaselineArch>>;

/// What `work` counts.
template <class Work> OperationCounts counted(Work work) {
  take_operation_counts();
  work();
  return take_operation_counts();
}

/// A machine whose latencies all are `latency`, which exposes all there is, and whose branches cost nothing
/// but themselves.
TimingParameters uniform(std::uint32_t latency) {
  TimingParameters timing;
  timing.simple_fixed = timing.shift = timing.byte_operation = latency;
  timing.float_operation = timing.float_conversion = latency;
  timing.load_store = timing.shuffle = timing.branch = latency;
  timing.exposed_latency = 1;
  timing.paired_issue = 1;
  timing.hints = timing.late_hint = timing.no_ops = timing.late_fetch = 0;
  return timing;
}

TEST_CASE("operations of the SIMD facade count the instructions of a real SPU") {
  const S::F a(3.0f);
  const S::F b(2.0f);
  CHECK(counted([&] { (void)(a + b); }).packet.fp6 == 1);
  CHECK(counted([&] { (void)(a < b); }).packet.fx2 == 1);
  CHECK(counted([&] { (void)S::max(a, b); }).packet.fx2 == 2);
  CHECK(counted([&] { (void)S::to_int(a); }).packet.fp7 == 1);
  CHECK(counted([&] { (void)S::shift_left<3>(S::bits_of(a)); }).packet.fx3 == 1);

  // Estimate, interpolation, a Newton-Raphson step, and the correction by the remainder.
  const OperationCounts quotient = counted([&] { (void)(a / b); });
  CHECK(quotient.packet.shuf == 1);
  CHECK(quotient.packet.fp7 == 1);
  CHECK(quotient.packet.fp6 == 5);
  CHECK(quotient.packet.fx2 == 0);

  const S::M mask = a < b;
  const OperationCounts gathered = counted([&] { (void)mask.bits(); });
  CHECK(gathered.packet.fx2 == 1);
  CHECK(gathered.chain.br == 1); // orx
  CHECK(gathered.scalar.br == 0);
}

TEST_CASE("a load counts and gives the same lanes as one that nobody counts") {
  alignas(64) float lanes[kSimdLanes];
  for (std::uint32_t i = 0; i < kSimdLanes; ++i)
    lanes[i] = static_cast<float>(i) - 7.5f;
  alignas(64) float counting[kSimdLanes];
  alignas(64) float silent[kSimdLanes];
  const OperationCounts counts = counted([&] { (S::F::load(lanes) / S::F(3.0f)).store(counting); });
  using Silent = HostSimd<BaselineArch>;
  (Silent::F::load(lanes) / Silent::F(3.0f)).store(silent);
  for (std::uint32_t i = 0; i < kSimdLanes; ++i)
    CHECK(counting[i] == silent[i]);
  CHECK(counts.packet.ls == 2);
  CHECK(counts.chain.shuf == 1); // the splat
}

TEST_CASE("declared work divides into scalar accesses and moves of quadwords") {
  const OperationCounts counts = counted([] { count(ScalarWork{5, 2, 30, 4, 3, 6, 70, 36}); });
  CHECK(counts.scalar.fx2 == 5);
  CHECK(counts.scalar.fx3 == 6);
  CHECK(counts.scalar.fp6 == 2);
  CHECK(counts.scalar.ls == 30);
  CHECK(counts.scalar.shuf == 4);
  CHECK(counts.scalar.br == 3);
  CHECK(counts.waits == 70);
  CHECK(counts.misses == 36);
  CHECK(counts.moves == 26);

  const OperationCounts shuffles = counted([] { count(ScalarWork{0, 0, 1, 4, 0}); });
  CHECK(shuffles.scalar.ls == 1);
  CHECK(shuffles.moves == 0);
}

TEST_CASE("counts are a host thread's own and start again when they are taken") {
  take_operation_counts();
  count(ScalarWork{1, 0, 0, 0, 0});
  std::uint64_t elsewhere = 1;
  std::thread([&] { elsewhere = take_operation_counts().scalar.fx2; }).join();
  CHECK(elsewhere == 0);
  CHECK(take_operation_counts().scalar.fx2 == 1);
  CHECK(take_operation_counts().scalar.fx2 == 0);
}

TEST_CASE("instructions of both pipes pair up, the rest issues alone") {
  OperationCounts counts;
  counts.scalar.fx2 = 10;
  counts.scalar.ls = 4;
  const SpuCycles all = cycles_of(counts, uniform(1));
  CHECK(all.dual_cycle == 4);
  CHECK(all.single_cycle == 6);
  CHECK(all.total_cycle == 10);
  CHECK(all.instructions() == 14);
  CHECK(all.fx2 == 10);
  CHECK(all.ls == 4);

  TimingParameters half = uniform(1);
  half.paired_issue = 0.5;
  const SpuCycles some = cycles_of(counts, half);
  CHECK(some.dual_cycle == 2);
  CHECK(some.single_cycle == 10);
  CHECK(some.total_cycle == 12);
}

TEST_CASE("an operation on a packet issues for four cycles, which hide as much of its latency") {
  OperationCounts counts;
  counts.packet.fp6 = 3;
  const SpuCycles cycles = cycles_of(counts, uniform(6));
  CHECK(cycles.fp6 == 12);
  CHECK(cycles.single_cycle == 12);
  CHECK(cycles.stall_due_to_dependency == 6);
  CHECK(cycles.total_cycle == 18);
  CHECK(cycles_of(counts, uniform(3)).stall_due_to_dependency == 0);

  OperationCounts chain;
  chain.chain.fp6 = 12;
  CHECK(cycles_of(chain, uniform(6)).stall_due_to_dependency == 60);

  OperationCounts scalar;
  scalar.scalar.fp6 = 12;
  scalar.waits = 7;
  CHECK(cycles_of(scalar, uniform(6)).stall_due_to_dependency == 7);
}

TEST_CASE("the latency of each unit is its own") {
  const auto stall = [](std::uint64_t UnitCounts::*unit) {
    TimingParameters timing;
    timing.exposed_latency = 1;
    OperationCounts counts;
    counts.chain.*unit = 1;
    return cycles_of(counts, timing).stall_due_to_dependency;
  };
  CHECK(stall(&UnitCounts::fx2) == 1);
  CHECK(stall(&UnitCounts::fx3) == 3);
  CHECK(stall(&UnitCounts::fxb) == 3);
  CHECK(stall(&UnitCounts::fp6) == 5);
  CHECK(stall(&UnitCounts::fp7) == 6);
  CHECK(stall(&UnitCounts::ls) == 5);
  CHECK(stall(&UnitCounts::shuf) == 3);
  CHECK(stall(&UnitCounts::br) == 3);
}

TEST_CASE("branches come with hints and no-ops, and lose what they say") {
  OperationCounts counts;
  counts.scalar.br = 10;
  counts.misses = 55;
  TimingParameters timing = uniform(1);
  timing.hints = 1.5;
  timing.late_hint = 0.5;
  timing.no_ops = 0.2;
  timing.branch_miss = 18;
  const SpuCycles cycles = cycles_of(counts, timing);
  CHECK(cycles.br == 10);
  CHECK(cycles.hbr == 15);
  CHECK(cycles.single_cycle == 25);
  CHECK(cycles.nop_cycle == 2);
  CHECK(cycles.stall_due_to_hint_target == 5);
  CHECK(cycles.branch_taken_miss == 3);
  CHECK(cycles.stall_due_to_branch_miss == 55);
  CHECK(cycles.total_cycle == 87);
}

TEST_CASE("instructions come late where quadwords are moved about") {
  OperationCounts counts;
  counts.moves = 100;
  TimingParameters timing = uniform(1);
  timing.late_fetch = 0.1;
  CHECK(cycles_of(counts, timing).stall_due_to_prefetch_miss == 10);
  CHECK(cycles_of(counts, timing).total_cycle == 10);
}

TEST_CASE("parts of cycles round to nearest, and nothing costs nothing") {
  CHECK(detail::part_of(0, 0.6) == 0);
  CHECK(detail::part_of(1, 0.6) == 1);
  CHECK(detail::part_of(1, 0.4) == 0);
  CHECK(detail::part_of(5, 0.5) == 3);
  CHECK(detail::part_of(1'000'000'000'000, 1.0) == 1'000'000'000'000);
  CHECK(cycles_of(OperationCounts(), TimingParameters::cell()).total_cycle == 0);
}

TEST_CASE("a quotient of packets on a Cell") {
  const S::F a(3.0f);
  const S::F b(2.0f);
  TimingParameters timing;
  timing.exposed_latency = 0.5;
  timing.paired_issue = 0.5;
  const SpuCycles cycles = cycles_of(counted([&] { (void)(a / b); }), timing);
  CHECK(cycles.instructions() == 28); // seven for each quadword
  CHECK(cycles.dual_cycle == 2);      // the four estimates with half of them
  CHECK(cycles.single_cycle == 24);
  CHECK(cycles.stall_due_to_dependency == 7); // half of 5 * 2 + 3
  CHECK(cycles.total_cycle == 33);
}

} // namespace
} // namespace celltrace::cell_emu

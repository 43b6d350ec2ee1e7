// What a packet of 16 rays against one object takes, by kind of object, backend and width of SIMD.
#include "bench/intersection_loop.hpp"
#include "celltrace/error.hpp"
#include "celltrace/spe/machine.hpp"
#include "celltrace/spe/program.hpp"

#include <benchmark/benchmark.h>

#include <memory>
#include <string>

namespace celltrace {

SpeProgram intersection_loop_program();

namespace {

using namespace kernel;
using bench::IntersectionTask;

constexpr std::uint32_t kPackets = 100'000;

/// Rays along z, about half of which meet the object.
IntersectionTask make_task(ObjectKind kind) {
  IntersectionTask task{};
  for (std::uint32_t lane = 0; lane < kSimdLanes; ++lane) {
    task.rays.origin.x.lane[lane] = 0.1f + 0.25f * static_cast<float>(lane % 4);
    task.rays.origin.y.lane[lane] = 0.1f + 0.25f * static_cast<float>(lane / 4);
    task.rays.origin.z.lane[lane] = -5;
    task.rays.direction.z.lane[lane] = 1;
    task.rays.start_object.lane[lane] = 0xFFFFFFFFu;
  }
  task.object.kind_and_flags = static_cast<std::uint32_t>(kind);
  const float sphere[12] = {0, 0, 0, 0.9f}, triangle[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0},
              ellipsoid[12] = {1.1f, 0, 0, 0, 0, 1.1f, 0, 0, 0, 0, 2, 0};
  const float* const from = kind == ObjectKind::sphere      ? sphere
                            : kind == ObjectKind::ellipsoid ? ellipsoid
                                                            : triangle;
  std::copy(from, from + 12, task.object.geometry);
  task.count = kPackets;
  return task;
}

void intersect(benchmark::State& state, ObjectKind kind, Backend backend, SimdLevel simd) {
  MachineConfig config;
  config.backend = backend;
  config.spes = 1;
  config.simd = simd;
  std::unique_ptr<Machine> machine;
  try {
    machine = make_machine(config);
  } catch (const InputError& error) {
    state.SkipWithError(error.what()); // this computer has no such SIMD
    return;
  }
  const SpeProgram program = intersection_loop_program();
  std::uint64_t rays = 0;
  for (auto _ : state) {
    IntersectionTask task = make_task(kind);
    machine->start(0, program, reinterpret_cast<std::uintptr_t>(&task));
    machine->wait(0);
    benchmark::DoNotOptimize(task.hits);
    rays += std::uint64_t{kPackets} * kSimdLanes;
  }
  state.counters["rays"] = benchmark::Counter(static_cast<double>(rays), benchmark::Counter::kIsRate);
}

#define CELLTRACE_INTERSECT(kind)                                                                            \
  BENCHMARK_CAPTURE(intersect, kind##_sse2, ObjectKind::kind, Backend::native, SimdLevel::sse2)              \
      ->UseRealTime();                                                                                       \
  BENCHMARK_CAPTURE(intersect, kind##_avx2, ObjectKind::kind, Backend::native, SimdLevel::avx2)              \
      ->UseRealTime();                                                                                       \
  BENCHMARK_CAPTURE(intersect, kind##_avx512, ObjectKind::kind, Backend::native, SimdLevel::avx512)          \
      ->UseRealTime();                                                                                       \
  BENCHMARK_CAPTURE(intersect, kind##_cell_emu, ObjectKind::kind, Backend::cell_emu, SimdLevel::automatic)   \
      ->UseRealTime()

CELLTRACE_INTERSECT(sphere);
CELLTRACE_INTERSECT(ellipsoid);
CELLTRACE_INTERSECT(triangle);

} // namespace

} // namespace celltrace

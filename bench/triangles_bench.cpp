// The tests of triangles beside each other: the processor time that each takes for the triangles of a leaf,
// by width of SIMD.
#include "bench/triangle_loop.hpp"
#include "celltrace/error.hpp"
#include "celltrace/spe/machine.hpp"
#include "celltrace/spe/program.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <string>

namespace celltrace {

SpeProgram triangle_loop_program();

namespace {

using namespace kernel;
using bench::TriangleTask;
using bench::TriangleTest;

void set(VectorLanes& lanes, std::uint32_t lane, const float (&v)[3]) {
  lanes.x.lane[lane] = v[0];
  lanes.y.lane[lane] = v[1];
  lanes.z.lane[lane] = v[2];
}

/// Rays of a bundle of 4x4 packets from the eye at (0, 0, -5), which cover a square of side 1 in the plane
/// z = 0. Shadow rays start on that square, toward a light there.
void make_rays(TriangleTask& task, bool shadows) {
  const float eye[3] = {0, 0, -5};
  std::copy(eye, eye + 3, task.eye);
  std::copy(eye, eye + 3, task.origins.light);
  std::fill(task.origins.base, task.origins.base + 3, 0.0f);
  task.origins.span = 1.5f;
  for (std::uint32_t packet = 0; packet < kSimdLanes; ++packet)
    for (std::uint32_t lane = 0; lane < kSimdLanes; ++lane) {
      const float x = static_cast<float>(packet % 4 * 4 + lane % 4) / 15 - 0.5f;
      const float y = static_cast<float>(packet / 4 * 4 + lane / 4) / 15 - 0.5f;
      const float length = std::sqrt(x * x + y * y + 25), sign = shadows ? -1.0f : 1.0f;
      const float direction[3] = {sign * x / length, sign * y / length, sign * 5 / length};
      const float origin[3] = {shadows ? x : eye[0], shadows ? y : eye[1], shadows ? 0 : eye[2]};
      RayPacket& rays = task.packets[packet];
      set(rays.origin, lane, origin);
      set(rays.direction, lane, direction);
      rays.start_object.lane[lane] = kNoOffset;
      set(task.origins.origin[packet], lane, origin); // the base is 0
      task.origins.low[packet].lane[lane] = kShadowEpsilon / length;
      task.origins.high[packet].lane[lane] = 1 - kShadowEpsilon / length;
      task.light[packet].lane[lane] = length;
      task.hits[packet].distance.lane[lane] = kMaxHitDistance;
      task.hits[packet].object.lane[lane] = kNoOffset;
    }
}

/// Triangles between the eye and that square, each of which a few of the rays hit.
void make_leaf(TriangleTask& task) {
  std::mt19937 random(7);
  const auto around = [&](float middle, float by) {
    return middle + by * (static_cast<float>(random() % 2001) / 1000 - 1);
  };
  for (std::uint32_t i = 0; i < task.triangle_count; ++i) {
    ObjectRecord& triangle = task.leaf[i];
    triangle.kind_and_flags = static_cast<std::uint32_t>(ObjectKind::triangle);
    const float x = around(0, 0.4f), y = around(0, 0.4f), z = around(-1, 0.5f);
    for (int corner = 0; corner < 3; ++corner) {
      triangle.geometry[3 * corner] = around(x, 0.2f);
      triangle.geometry[3 * corner + 1] = around(y, 0.2f);
      triangle.geometry[3 * corner + 2] = around(z, 0.2f);
    }
  }
}

std::unique_ptr<TriangleTask> make_task(TriangleTest test, std::uint32_t packets, std::uint32_t rays,
                                        std::uint32_t triangles) {
  auto task = std::make_unique<TriangleTask>();
  task->triangle_count = triangles;
  task->packet_count = packets;
  task->lanes = (2u << (rays - 1)) - 1;
  task->test = test;
  make_rays(*task, test == TriangleTest::shadow_single || test == TriangleTest::shadow_volumes);
  make_leaf(*task);
  return task;
}

/// The rays of task.lanes that hit something.
std::uint32_t hits_of(const TriangleTask& task) {
  std::uint32_t count = 0;
  for (std::uint32_t packet = 0; packet < task.packet_count; ++packet)
    for (std::uint32_t lane = 0; lane < kSimdLanes; ++lane) {
      const bool hit =
          task.hits[packet].object.lane[lane] != kNoOffset || (task.occluded[packet] >> lane & 1) != 0;
      count += hit && (task.lanes >> lane & 1) != 0;
    }
  return count;
}

/// `reference` must find as many hits.
void test(benchmark::State& state, TriangleTest test, TriangleTest reference, std::uint32_t packets,
          std::uint32_t rays, std::uint32_t triangles, SimdLevel simd) {
  MachineConfig config;
  config.backend = Backend::native;
  config.spes = 1;
  config.simd = simd;
  std::unique_ptr<Machine> machine;
  try {
    machine = make_machine(config);
  } catch (const InputError& error) {
    state.SkipWithError(error.what()); // this computer has no such SIMD
    return;
  }
  const SpeProgram program = triangle_loop_program();
  const auto run = [&](TriangleTask& task, std::uint32_t rounds) {
    task.rounds = rounds;
    machine->start(0, program, reinterpret_cast<std::uintptr_t>(&task));
    machine->wait(0);
  };
  const auto task = make_task(test, packets, rays, triangles),
             expected = make_task(reference, packets, rays, triangles);
  run(*task, 1);
  run(*expected, 1);
  if (hits_of(*task) != hits_of(*expected)) {
    state.SkipWithError("the tests find different hits");
    return;
  }
  constexpr std::uint32_t kRounds = 10'000;
  for (auto _ : state)
    run(*task, kRounds);
  state.counters["seconds_a_leaf"] = benchmark::Counter(
      kRounds, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.counters["hits"] = hits_of(*task);
}

void add(const std::string& name, TriangleTest kind, TriangleTest reference, std::uint32_t packets,
         std::uint32_t rays, std::uint32_t triangles) {
  for (const SimdLevel simd : {SimdLevel::sse2, SimdLevel::avx2, SimdLevel::avx512})
    benchmark::RegisterBenchmark(
        (name + "/triangles:" + std::to_string(triangles) + "/" + name_of(simd)).c_str(),
        [=](benchmark::State& state) { test(state, kind, reference, packets, rays, triangles, simd); })
        ->MeasureProcessCPUTime();
}

const int registered = [] {
  using enum TriangleTest;
  for (const std::uint32_t triangles : {2u, 4u, 8u, 16u}) {
    add("primary_rays/single", single, single, 16, 16, triangles);
    add("primary_rays/pinhole", pinhole, single, 16, 16, triangles);
    add("shadow_rays/single", shadow_single, shadow_single, 16, 16, triangles);
    add("shadow_rays/shadow_volumes", shadow_volumes, shadow_single, 16, 16, triangles);
    add("few_rays/by_triangle", single, single, 1, 16, triangles);
    for (const std::uint32_t rays : {1u, 2u, 4u, 8u})
      add("few_rays/by_ray/rays:" + std::to_string(rays), by_ray, single, 1, rays, triangles);
  }
  return 0;
}();

} // namespace

} // namespace celltrace

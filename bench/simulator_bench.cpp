// How fast cell_sim executes machine code: instructions of SPUs in a second of one host thread, no-ops
// included.
#include "celltrace/render.hpp"
#include "celltrace/spe/machine.hpp"
#include "celltrace/spe/shared_records.hpp"
#include "tests/cache/script.hpp"
#include "tests/cache/script_fields.hpp"

#include <benchmark/benchmark.h>

#include <cstdint>
#include <memory>
#include <random>

namespace celltrace {

SpeProgram cache_reads_program();

} // namespace celltrace

namespace {

using namespace celltrace;
using namespace celltrace::test;

std::uint64_t instructions(const SpuCycles& cycles) {
  return cycles.instructions() + cycles.nop;
}

/// Mirrors over a plane.
Scene small_scene() {
  Scene scene;
  scene.camera.location = {0, 2, -5};
  scene.lights.push_back({{10, 20, -10}});
  Material mirror;
  mirror.pigment.rgb = {0.6, 0.7, 0.8};
  mirror.finish.reflection_min = mirror.finish.reflection_max = {0.3, 0.3, 0.3};
  const Index material = scene.add(mirror);
  for (int i = 0; i < 25; ++i) {
    Object object;
    object.shape = Sphere{{i % 5 - 2.0, 0, i / 5 - 2.0}, 0.4};
    object.material = material;
    object.interior = scene.add(Interior{});
    scene.objects.push_back(object);
  }
  return scene;
}

/// Frames of the tracer.
void tracer(benchmark::State& state) {
  try {
    RenderOptions options;
    options.width = 64;
    options.height = 48;
    options.backend = Backend::cell_sim;
    options.spes = static_cast<unsigned>(state.range(0));
    options.emulation.schedule = Schedule::lockstep;
    Renderer renderer(options);
    const Scene scene = small_scene();
    renderer.render(scene);
    std::uint64_t executed = 0;
    for (auto _ : state)
      for (const RenderStatistics::Spe& spe : renderer.render(scene.camera).statistics.spes)
        executed += instructions(spe.cycles);
    state.SetItemsProcessed(static_cast<std::int64_t>(executed));
  } catch (const Error& error) {
    state.SkipWithError(error.what());
  }
}
BENCHMARK(tracer)->Arg(1)->Arg(8)->Unit(benchmark::kMillisecond);

/// Reads through a software cache, near each other with jumps in between.
void cache_reads(benchmark::State& state) {
  try {
    MachineConfig config;
    config.backend = Backend::cell_sim;
    config.spes = 1;
    config.emulation.schedule = Schedule::lockstep;
    const std::unique_ptr<Machine> machine = make_machine(config);
    const std::endian order = machine->byte_order();

    const Memory memory(2000);
    CacheScript script(memory, order);
    std::mt19937 random(1);
    std::uint32_t offset = 0;
    for (int i = 0; i < 20'000; ++i)
      script.read(offset = wander(offset, memory.bytes(), random));
    SharedRecords<std::uint32_t> words(memory.bytes() / 4, order);
    for (std::uint32_t i = 0; i < words.size(); ++i)
      words[i] = memory.word(4 * i);
    words.publish();
    SharedRecords<CacheEntry> entries(0, order);
    entries.assign(script.entries());
    SharedRecords<CacheReport> report(1, order);
    SharedRecords<CacheTask> task(1, order);
    task[0] = task_of(CacheFlavour::plain, CacheConfig{}, words.ea(), entries, report.ea());
    task.publish();

    const SpeProgram program = cache_reads_program();
    const std::uint64_t before = instructions(machine->statistics(0).cycles);
    for (auto _ : state) {
      machine->start(0, program, task.ea());
      machine->wait(0);
    }
    state.SetItemsProcessed(static_cast<std::int64_t>(instructions(machine->statistics(0).cycles) - before));
    report.fetch();
    if (report[0].wrong != 0 || report[0].played != entries.size()) state.SkipWithError("wrong values");
  } catch (const Error& error) {
    state.SkipWithError(error.what());
  }
}
BENCHMARK(cache_reads)->Unit(benchmark::kMillisecond);

} // namespace

// How fast frames are rendered: a field of mirroring spheres, by backend and number of SPEs.
#include "celltrace/render.hpp"

#include <benchmark/benchmark.h>

namespace {

celltrace::Scene sphere_field(int side) {
  celltrace::Scene scene;
  scene.camera.location = {0, 3, -1.2 * side};
  scene.lights.push_back({{10, 20, -10}});
  celltrace::Material mirror;
  mirror.pigment.rgb = {0.6, 0.7, 0.8};
  mirror.finish.specular = 0.5;
  mirror.finish.reflection_min = mirror.finish.reflection_max = {0.3, 0.3, 0.3};
  const celltrace::Index material = scene.add(mirror);
  for (int z = 0; z < side; ++z)
    for (int x = 0; x < side; ++x) {
      celltrace::Object object;
      object.shape = celltrace::Sphere{{x - 0.5 * side, 0, z - 0.5 * side}, 0.4};
      object.material = material;
      object.interior = scene.add(celltrace::Interior{});
      scene.objects.push_back(object);
    }
  return scene;
}

void render(benchmark::State& state, celltrace::Backend backend) {
  const celltrace::Scene scene = sphere_field(20);
  celltrace::RenderOptions options;
  options.width = 320;
  options.height = 240;
  options.backend = backend;
  options.spes = static_cast<unsigned>(state.range(0));
  celltrace::Renderer renderer(options);
  std::uint64_t rays = 0;
  for (auto _ : state)
    rays += renderer.render(scene).statistics.total_rays();
  state.counters["rays"] = benchmark::Counter(static_cast<double>(rays), benchmark::Counter::kIsRate);
}
BENCHMARK_CAPTURE(render, native, celltrace::Backend::native)
    ->Arg(1)
    ->Arg(2)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(render, cell_emu, celltrace::Backend::cell_emu)
    ->Arg(1)
    ->Arg(8)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

/// Primary rays through the accelerator and nothing else: no lights, no mirrors.
void traverse(benchmark::State& state, celltrace::Accelerator accelerator) {
  celltrace::Scene scene = sphere_field(static_cast<int>(state.range(0)));
  scene.lights.clear();
  scene.max_trace_level = 1;
  celltrace::RenderOptions options;
  options.width = options.height = 512;
  options.spes = 1;
  options.accelerator = accelerator;
  celltrace::Renderer renderer(options);
  renderer.render(scene);
  std::uint64_t rays = 0;
  for (auto _ : state)
    rays += renderer.render(scene.camera).statistics.total_rays();
  state.counters["rays"] = benchmark::Counter(static_cast<double>(rays), benchmark::Counter::kIsRate);
}
BENCHMARK_CAPTURE(traverse, bvh, celltrace::Accelerator::bvh)
    ->Arg(10)
    ->Arg(100)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(traverse, grid, celltrace::Accelerator::grid)
    ->Arg(10)
    ->Arg(100)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

} // namespace

// What emulation costs: the same small frame on one SPE of the native machine and of the emulated one under
// either schedule. See docs/benchmarks.md.
//
//   bench_backends [--benchmark_...] [scene.pov ...]
#include "bench/scene_arguments.hpp"
#include "celltrace/pov.hpp"
#include "celltrace/render.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace {

constexpr int kWidth = 320;
constexpr int kHeight = 240;
constexpr int kRounds = 9;

enum Subject { native, free_running, lockstep };
constexpr std::size_t kSubjects = 3;

celltrace::Renderer renderer_of(Subject subject) {
  celltrace::RenderOptions options;
  options.width = kWidth;
  options.height = kHeight;
  options.spes = 1;
  options.backend = subject == native ? celltrace::Backend::native : celltrace::Backend::cell_emu;
  options.emulation.schedule =
      subject == lockstep ? celltrace::Schedule::lockstep : celltrace::Schedule::free;
  return celltrace::Renderer(options);
}

/// What the SPE works for a frame.
double seconds_of_frame(celltrace::Renderer& renderer, const celltrace::Scene& scene) {
  const celltrace::RenderStatistics statistics = renderer.render(scene).statistics;
  return statistics.prepare_seconds + statistics.render_seconds;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// An iteration renders one frame on each machine, so that whatever else the computer does reaches all three.
/// Each comes first in every third, because a frame also depends on what ran before it.
void backends(benchmark::State& state, const std::filesystem::path& path) {
  try {
    celltrace::ParseOptions size;
    size.width = kWidth;
    size.height = kHeight;
    const celltrace::Scene scene = celltrace::parse_file(path, size);
    std::array renderers = {renderer_of(native), renderer_of(free_running), renderer_of(lockstep)};
    // The first frame of each also pays for its memory.
    for (celltrace::Renderer& renderer : renderers)
      seconds_of_frame(renderer, scene);

    std::array order = {native, free_running, lockstep};
    std::array<std::vector<double>, kSubjects> seconds;
    for (auto _ : state) {
      double round = 0;
      for (const Subject subject : order) {
        seconds[subject].push_back(seconds_of_frame(renderers[subject], scene));
        round += seconds[subject].back();
      }
      state.SetIterationTime(round);
      std::rotate(order.begin(), order.begin() + 1, order.end());
    }
    const double on_native = median(seconds[native]);
    const double on_free = median(seconds[free_running]);
    const double on_lockstep = median(seconds[lockstep]);
    state.counters["native_ms"] = 1e3 * on_native;
    state.counters["free_ms"] = 1e3 * on_free;
    state.counters["lockstep_ms"] = 1e3 * on_lockstep;
    state.counters["free/native"] = on_free / on_native;
    state.counters["lockstep/free"] = on_lockstep / on_free;
  } catch (const std::exception& error) {
    state.SkipWithError(error.what());
  }
}

void add(const std::filesystem::path& scene) {
  benchmark::RegisterBenchmark(("backends/" + scene.stem().string()).c_str(), backends, scene)
      ->Iterations(kRounds)
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
}

} // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  for (const std::filesystem::path& scene : scene_arguments(argc, argv, SCENES))
    add(scene);
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}

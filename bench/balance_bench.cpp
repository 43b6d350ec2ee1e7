// Load balancing: sweeps on system graphs against the theory, and frames of the tracer in virtual time under
// every way to share them. See docs/balancing.md.
//
//   bench_balance [--benchmark_...] [scene.pov ...]
#include "bench/scene_arguments.hpp"
#include "celltrace/balance.hpp"
#include "celltrace/pov.hpp"
#include "celltrace/render.hpp"

#include <benchmark/benchmark.h>

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace celltrace;

// --- sweeps ---

struct GraphCase {
  std::string name;
  SystemGraph graph;
  double optimum;
  double theory; ///< convergence factor with the optimum
};

std::vector<GraphCase> graph_cases() {
  const std::vector<std::uint32_t> sides{4, 8};
  std::vector<GraphCase> cases;
  for (const std::uint32_t nodes : {8u, 16u}) {
    const double on_chain = optimal_chain_parameter(nodes);
    const double on_ring = optimal_ring_parameter(nodes);
    cases.push_back({"chain " + std::to_string(nodes), chain_graph(nodes), on_chain,
                     chain_convergence_factor(nodes, on_chain)});
    cases.push_back({"ring " + std::to_string(nodes), ring_graph(nodes), on_ring,
                     ring_convergence_factor(nodes, on_ring)});
  }
  const double on_mesh = optimal_mesh_parameter(sides);
  const double on_torus = optimal_torus_parameter(sides);
  cases.push_back({"mesh 4x8", mesh_graph(sides), on_mesh, mesh_convergence_factor(sides, on_mesh)});
  cases.push_back({"torus 4x8", torus_graph(sides), on_torus, torus_convergence_factor(sides, on_torus)});
  cases.push_back({"hypercube 4", hypercube_graph(4), 0.5, 0});
  return cases;
}

void sweeps(benchmark::State& state, const GraphCase& each) {
  std::vector<double> heap(each.graph.nodes);
  heap[0] = 1;
  std::vector<double> loads = heap;
  for (auto _ : state) {
    gde_sweep(each.graph, loads, each.optimum);
    benchmark::DoNotOptimize(loads.data());
  }
  constexpr double kTolerance = 0.01;
  const auto sweeps_with = [&](double lambda) {
    return sweeps_to_balance(each.graph, heap, lambda, kTolerance).value_or(0);
  };
  state.counters["lambda"] = each.optimum;
  state.counters["factor"] = convergence_factor(each.graph, each.optimum);
  state.counters["theory"] = each.theory;
  state.counters["sweeps"] = sweeps_with(each.optimum);
  state.counters["sweeps_half"] = sweeps_with(0.5);
  state.counters["diffusion"] =
      steps_to_balance(each.graph, heap, diffusion_parameter(each.graph), kTolerance).value_or(0);
}

// --- frames ---

constexpr int kWidth = 512;
constexpr int kHeight = 384;
constexpr int kFrames = 4;

const std::map<std::string, Balance> kBalances = {{"gde", Balance::gde},
                                                  {"diffusion", Balance::diffusion},
                                                  {"static", Balance::fixed},
                                                  {"scatter", Balance::scatter},
                                                  {"tiles", Balance::tiles}};

Scene scene_of(const std::filesystem::path& path) {
  ParseOptions size;
  size.width = kWidth;
  size.height = kHeight;
  return parse_file(path, size);
}

/// The first and the last of some frames.
std::pair<RenderStatistics, RenderStatistics> frames_of(const Scene& scene, Balance balance, unsigned spes) {
  RenderOptions options;
  options.width = kWidth;
  options.height = kHeight;
  options.backend = Backend::cell_emu;
  options.spes = spes;
  options.balance = balance;
  options.emulation.schedule = Schedule::lockstep;
  Renderer renderer(options);
  const RenderStatistics first = renderer.render(scene).statistics;
  RenderStatistics last;
  for (int frame = 1; frame < kFrames; ++frame)
    last = renderer.render(scene.camera).statistics;
  return {first, last};
}

double cycles(const RenderStatistics& frame) {
  return static_cast<double>(frame.render_cycles);
}

/// The time is virtual, so that one iteration says all.
void frames(benchmark::State& state, const std::filesystem::path& path, Balance balance, unsigned spes) {
  try {
    const Scene scene = scene_of(path);
    const auto alone = frames_of(scene, Balance::fixed, 1);
    const auto together = frames_of(scene, balance, spes);
    for (auto _ : state)
      state.SetIterationTime(cycles(together.second) / TimingParameters().clock_hz);
    state.counters["imbalance_1"] = together.first.imbalance;
    state.counters["imbalance"] = together.second.imbalance;
    state.counters["speedup_1"] = cycles(alone.first) / cycles(together.first);
    state.counters["speedup"] = cycles(alone.second) / cycles(together.second);
  } catch (const std::exception& error) {
    state.SkipWithError(error.what());
  }
}

void add(const std::filesystem::path& scene) {
  for (const unsigned spes : {8u, 16u})
    for (const auto& [name, balance] : kBalances)
      benchmark::RegisterBenchmark(
          ("frames/" + scene.stem().string() + "/" + std::to_string(spes) + "/" + name).c_str(), frames,
          scene, balance, spes)
          ->Iterations(1)
          ->UseManualTime()
          ->Unit(benchmark::kMillisecond);
}

} // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  for (const GraphCase& each : graph_cases())
    benchmark::RegisterBenchmark(("sweeps/" + each.name).c_str(), sweeps, each);
  for (const std::filesystem::path& scene : scene_arguments(argc, argv, SCENES))
    add(scene);
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}

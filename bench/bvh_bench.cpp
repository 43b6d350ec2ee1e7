// What the scene image and the BVH take in one thread, and what rays have of the BVH:
// expected visits of nodes and tests of objects of a ray that hits the root (the surface area heuristic).
#include "compare/generated.hpp"
#include "kernel/built_bvh.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <random>
#include <vector>

using namespace celltrace;
using namespace celltrace::kernel;

namespace {

using Objects = std::vector<ObjectRecord>;

Objects objects_of(const compare::Model& model) {
  Objects objects;
  for (const auto& triangle : model.triangles) {
    ObjectRecord object{};
    object.kind_and_flags = static_cast<std::uint32_t>(ObjectKind::triangle);
    for (int corner = 0; corner < 3; ++corner)
      for (int axis = 0; axis < 3; ++axis)
        object.geometry[3 * corner + axis] = model.vertices[triangle[static_cast<std::size_t>(corner)]][axis];
    objects.push_back(object);
  }
  return objects;
}

Objects hills(std::size_t triangles) {
  return objects_of(compare::hills(triangles));
}
/// Neighbours are anywhere in the list.
Objects shuffled_hills(std::size_t triangles) {
  Objects objects = hills(triangles);
  std::shuffle(objects.begin(), objects.end(), std::mt19937(1));
  return objects;
}
Objects random_triangles(std::size_t triangles) {
  return objects_of(compare::random_triangles(triangles));
}
/// All but one in one cell of the grid over all.
Objects crowd(std::size_t triangles) {
  Objects objects = hills(triangles);
  for (float& coordinate : objects.front().geometry)
    coordinate *= 1e5f;
  return objects;
}

double area(const NodeRecord& node, int slot) {
  double extent[3];
  for (int axis = 0; axis < 3; ++axis)
    extent[axis] = double{node.bounds[2 * axis + 1][slot]} - node.bounds[2 * axis][slot];
  return extent[0] * (extent[1] + extent[2]) + extent[1] * extent[2];
}

struct Expected {
  double visits = 1, tests = 0;
};
Expected expected(const test::BuiltBvh& bvh) {
  Expected sum;
  double whole = 0;
  for (int slot = 0; slot < 4; ++slot)
    whole += area(bvh.root(), slot);
  std::vector<const NodeRecord*> open = {&bvh.root()};
  while (!open.empty()) {
    const NodeRecord& node = *open.back();
    open.pop_back();
    for (int slot = 0; slot < 4; ++slot) {
      const double hit = area(node, slot) / whole;
      if (node.leaf[slot] != 0) {
        sum.tests += hit * kernel::leaf_word::count(node.leaf[slot]);
      } else {
        sum.visits += hit;
        open.push_back(&bvh.node(node.child[slot]));
      }
    }
  }
  return sum;
}

void build(benchmark::State& state, Objects (*make)(std::size_t)) {
  const Objects objects = make(static_cast<std::size_t>(state.range(0)));
  test::BuiltBvh bvh(objects);
  for (auto _ : state)
    benchmark::DoNotOptimize(bvh.build());
  const Expected cost = expected(bvh);
  const auto count = static_cast<double>(objects.size());
  state.counters["triangles"] =
      benchmark::Counter(count * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
  state.counters["visits"] = cost.visits;
  state.counters["tests"] = cost.tests;
  state.counters["bytes/triangle"] = 128.0 * bvh.frame().bvh.node_count / count + 4;
}

/// Records in the order of the image, from frame to frame.
void image(benchmark::State& state, compare::Model (*make)(std::size_t)) {
  const compare::Model model = make(static_cast<std::size_t>(state.range(0)));
  Mesh mesh;
  mesh.vertices = model.vertices;
  for (const auto& [a, b, c] : model.triangles)
    mesh.triangles.push_back({{a, b, c}});
  Scene scene;
  scene.add(Material{});
  scene.add(Interior{});
  scene.objects.push_back({std::make_shared<const Mesh>(std::move(mesh)), {}});
  SceneImage result;
  AlignedBlock work;
  for (auto _ : state)
    result.assign(scene, work, 1);
  state.counters["triangles"] =
      benchmark::Counter(static_cast<double>(state.range(0)) * static_cast<double>(state.iterations()),
                         benchmark::Counter::kIsRate);
}

#define CELLTRACE_SIZES                                                                                      \
  ->Arg(70'000)->Arg(400'000)->Arg(1'000'000)->Arg(10'000'000)->Unit(benchmark::kMillisecond)
BENCHMARK_CAPTURE(build, hills, hills) CELLTRACE_SIZES;
BENCHMARK_CAPTURE(build, shuffled, shuffled_hills) CELLTRACE_SIZES;
BENCHMARK_CAPTURE(build, random, random_triangles) CELLTRACE_SIZES;
BENCHMARK_CAPTURE(build, crowd, crowd) CELLTRACE_SIZES;
BENCHMARK_CAPTURE(image, hills, compare::hills) CELLTRACE_SIZES;
BENCHMARK_CAPTURE(image, random, compare::random_triangles) CELLTRACE_SIZES;

} // namespace

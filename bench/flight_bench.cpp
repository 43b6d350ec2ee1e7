// A flight on an emulated Cell: the camera goes round the middle of what it looks at, and every frame starts
// from the caches and the strips of the one before. What later frames cost beside the first one.
//
//   bench_flight SCENE.pov [FRAMES] [WIDTH] [DEGREES] [SPES]
//
// 120 frames, 320 pixels a row and 60 degrees over all frames unless said otherwise; 8 SPEs in lockstep.
#include "celltrace/error.hpp"
#include "celltrace/pov.hpp"
#include "celltrace/session.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

using namespace celltrace;

namespace {

std::uint64_t misses(const RenderStatistics& s) {
  return s.list_cache.misses + s.object_cache.misses + s.material_cache.misses + s.light_cache.misses;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Turned round the vertical through `centre`.
Camera turned(const Camera& camera, const Vec3& centre, double degrees) {
  Camera result = camera;
  const Transform turn = Transform::rotate({0, degrees, 0});
  result.location = centre + turn.point(camera.location - centre);
  result.direction = turn.point(camera.direction);
  result.right = turn.point(camera.right);
  result.up = turn.point(camera.up);
  return result;
}

int fly(int argc, char** argv) {
  const auto number = [&](int i, int otherwise) { return argc > i ? std::atoi(argv[i]) : otherwise; };
  Scene scene = parse_file(argv[1]);
  const int frames = number(2, 120), degrees = number(4, 60);
  RenderOptions options;
  options.backend = Backend::cell_emu;
  options.spes = static_cast<unsigned>(number(5, 8));
  options.emulation.schedule = Schedule::lockstep;
  options.width = number(3, 320);
  options.height = options.width * 3 / 4;
  const Camera start = scene.camera;
  Session session(std::move(scene), options);
  const RenderStatistics first = session.render().statistics;
  const Vec3 centre = (first.bounds[0] + first.bounds[1]) * 0.5;
  std::vector<double> imbalances, shares, preparations;
  std::uint64_t lists = 0, objects = 0, materials = 0, lights = 0;
  for (int frame = 1; frame < frames; ++frame) {
    session.set_camera(turned(start, centre, double(degrees) * frame / frames));
    const RenderStatistics s = session.render().statistics;
    imbalances.push_back(s.imbalance);
    shares.push_back(double(misses(s)) / double(misses(first)));
    preparations.push_back(double(s.prepare_cycles) / double(s.prepare_cycles + s.render_cycles));
    lists += s.list_cache.misses;
    objects += s.object_cache.misses;
    materials += s.material_cache.misses;
    lights += s.light_cache.misses;
  }
  const auto later = static_cast<unsigned long long>(frames - 1);
  std::printf("%s: imbalance %.3f, misses %.3f of the first frame's %llu, prepare %.4f (medians)\n", argv[1],
              median(imbalances), median(shares), static_cast<unsigned long long>(misses(first)),
              median(preparations));
  std::printf("  misses a frame, first and mean of later: lists %llu %llu, objects %llu %llu, materials %llu "
              "%llu, lights %llu %llu\n",
              static_cast<unsigned long long>(first.list_cache.misses), lists / later,
              static_cast<unsigned long long>(first.object_cache.misses), objects / later,
              static_cast<unsigned long long>(first.material_cache.misses), materials / later,
              static_cast<unsigned long long>(first.light_cache.misses), lights / later);
  return 0;
}

} // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "bench_flight SCENE.pov [FRAMES] [WIDTH] [DEGREES] [SPES]\n");
    return 2;
  }
  try {
    return fly(argc, argv);
  } catch (const Error& error) {
    std::fprintf(stderr, "bench_flight: %s\n", error.what());
    return 1;
  }
}

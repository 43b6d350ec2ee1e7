// The tracer's own traces: recorded while it renders on cell_emu, replayed, and held against full caches.
#include "celltrace/cache/replay.hpp"
#include "celltrace/pov.hpp"
#include "celltrace/render.hpp"
#include "render/scenes.hpp"

#include <catch2/catch.hpp>

#include <filesystem>
#include <map>
#include <sstream>

using namespace celltrace;
using namespace celltrace::test;

namespace {

/// The scenes of tests/scenes, and one that is far larger than a cache.
std::vector<std::pair<std::string, Scene>> all_scenes() {
  std::vector<std::pair<std::string, Scene>> all;
  for (const char* name : {"finishes", "glass", "mesh", "orthographic"})
    all.emplace_back(name, parse_file(std::filesystem::path(SCENES) / (std::string(name) + ".pov"), {}));
  Scene large = scene_named("meshes");
  large.objects.push_back(mesh_object(ball_mesh(40), 0, 0));
  all.emplace_back("large mesh", large);
  return all;
}

RenderOptions options_for(const CacheConfig& cache, Accelerator accelerator, SpeRecorder& recorder) {
  RenderOptions options;
  options.width = 64;
  options.height = 48;
  options.backend = Backend::cell_emu;
  options.spes = 3;
  options.cache = cache;
  options.accelerator = accelerator;
  options.emulation.schedule = Schedule::lockstep;
  options.emulation.recorder = &recorder;
  return options;
}

struct Recording {
  std::string file;
  RenderStatistics statistics;
};

Recording record(const Scene& scene, const CacheConfig& cache, Accelerator accelerator) {
  std::ostringstream file;
  CacheTraceWriter writer(file);
  const RenderStatistics statistics = render(scene, options_for(cache, accelerator, writer)).statistics;
  writer.finish();
  return {file.str(), statistics};
}

std::vector<CacheTrace> read(const std::string& file) {
  std::istringstream stream(file);
  return read_cache_traces(stream);
}

template <class ReplayOne> ReplayResult sum(const std::vector<CacheTrace>& traces, ReplayOne replay_one) {
  ReplayResult result;
  for (const CacheTrace& trace : traces)
    result = result + replay_one(trace);
  return result;
}

void check_as_recorded(const std::vector<CacheTrace>& traces, const RenderStatistics& statistics) {
  const ReplayResult replayed =
      sum(traces, [](const CacheTrace& trace) { return replay(trace, trace.config); });
  const RenderStatistics::Cache expected[] = {statistics.list_cache, statistics.object_cache,
                                              statistics.material_cache, statistics.light_cache};
  for (std::size_t kind = 0; kind < std::size(expected); ++kind) {
    CAPTURE(kind);
    CHECK(replayed.kinds[kind].hits == expected[kind].hits);
    CHECK(replayed.kinds[kind].misses == expected[kind].misses);
  }
  CHECK(replayed.total().misses > 0);
}

} // namespace

TEST_CASE("a replay has exactly the hits and misses of the frame that was recorded") {
  const auto accelerator = GENERATE(Accelerator::grid, Accelerator::bvh);
  const auto cache = GENERATE(
      CacheConfig::of(4, 128, CacheReplacement::fifo), CacheConfig::of(4, 4, CacheReplacement::random),
      CacheConfig::of(2, 8, CacheReplacement::lru), CacheConfig::of(1, 16, CacheReplacement::random),
      CacheConfig::of(8, 4, CacheReplacement::fifo), CacheConfig::of(32, 1, CacheReplacement::lru),
      CacheConfig::off());
  for (const auto& [name, scene] : all_scenes()) {
    CAPTURE(name, accelerator, cache.ways, cache.sets, cache.replacement, cache.enabled);
    const Recording recording = record(scene, cache, accelerator);
    const std::vector<CacheTrace> traces = read(recording.file);
    REQUIRE(traces.size() == 3);
    check_as_recorded(traces, recording.statistics);
  }
}

TEST_CASE("in lockstep the same run records the same file") {
  const Scene scene = scene_named("glass and mirrors");
  const Recording first = record(scene, CacheConfig{}, Accelerator::bvh);
  CHECK(record(scene, CacheConfig{}, Accelerator::bvh).file == first.file);
}

TEST_CASE("recording changes neither picture nor virtual time") {
  const Scene scene = scene_named("glass and mirrors");
  std::ostringstream file;
  CacheTraceWriter writer(file);
  RenderOptions options = options_for(CacheConfig{}, Accelerator::bvh, writer);
  const RenderResult recorded = render(scene, options);
  options.emulation.recorder = nullptr;
  const RenderResult plain = render(scene, options);
  CHECK(plain.image == recorded.image);
  CHECK(plain.statistics.render_cycles == recorded.statistics.render_cycles);
}

TEST_CASE("the last of several frames can be replayed, from warm caches and after a change of the scene") {
  std::ostringstream file;
  CacheTraceWriter writer(file);
  Scene scene = scene_named("meshes");
  RenderStatistics statistics;
  {
    Renderer renderer(options_for(CacheConfig::of(2, 8, CacheReplacement::random), Accelerator::bvh, writer));
    renderer.render(scene);
    scene.camera = camera_at({0.5, 0.7, -4.5}, {0.1, 0.2, 0});
    renderer.render(scene.camera);
    renderer.render(scene_named("glass and mirrors"));
    statistics = renderer.render(camera_at({0.2, 0.9, -4}, {0, 0, 0})).statistics;
  }
  writer.finish();
  // Of each SPE, the cache that it had last.
  std::map<unsigned, CacheTrace> last;
  for (CacheTrace& trace : read(file.str()))
    last[trace.spe] = std::move(trace);
  REQUIRE(last.size() == 3);
  check_as_recorded({last[0], last[1], last[2]}, statistics);
}

TEST_CASE("the default cache is within two points of a full one that replaces what was used least recently") {
  const auto accelerator = GENERATE(Accelerator::grid, Accelerator::bvh);
  for (const auto& [name, scene] : all_scenes()) {
    CAPTURE(name, accelerator);
    const CacheConfig usual;
    REQUIRE(usual.ways == 4);
    const std::vector<CacheTrace> traces = read(record(scene, usual, accelerator).file);
    const CacheConfig full = CacheConfig::of(usual.lines(), 1, CacheReplacement::lru);
    const double rate = sum(traces, [&](const CacheTrace& trace) { return replay(trace, usual); }).hit_rate();
    const double full_rate =
        sum(traces, [&](const CacheTrace& trace) { return replay(trace, full); }).hit_rate();
    const double best =
        sum(traces, [&](const CacheTrace& trace) { return optimal(trace, usual.lines()); }).hit_rate();
    CHECK(rate >= full_rate - 0.02);
    CHECK(full_rate <= best);
    CHECK(rate <= best);
  }
}

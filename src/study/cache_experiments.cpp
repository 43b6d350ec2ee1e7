// The benefit of the software cache, and the effect of its shape.
#include "celltrace/cache/replay.hpp"
#include "study/experiment.hpp"

#include <algorithm>
#include <sstream>

namespace celltrace::study {

namespace {

/// Returns the share of the SPEs' time in which they stall at channels, in percent.
double waiting(const RenderStatistics& statistics) {
  double stalled = 0, total = 0;
  for (const RenderStatistics::Spe& spe : statistics.spes) {
    stalled += static_cast<double>(spe.cycles.channel_stall_cycle);
    total += static_cast<double>(spe.cycles.total_cycle);
  }
  return 100 * stalled / total;
}

} // namespace

Table study_cache_cost(Laboratory& laboratory) {
  Table table{"cache",
              "With the software cache and without it",
              "The cache made rendering 13.5 times as fast.",
              "",
              {{"scene"},
               {"accelerator"},
               {"off, Mcycles", 2},
               {"4x128, Mcycles", 2},
               {"off / 4x128", 2},
               {"reads"},
               {"hit rate, %", 2},
               {"waiting without, %", 1},
               {"waiting with, %", 1}},
              {},
              {Chart::Kind::bars,
               "scene",
               "times as fast with the cache",
               false,
               false,
               {},
               {{"bvh", {}}, {"grid", {}}}}};
  const std::vector<std::pair<std::string, Accelerator>> accelerators = {{"bvh", Accelerator::bvh},
                                                                         {"grid", Accelerator::grid}};
  std::vector<Job> jobs;
  for (const StudyScene& scene : laboratory.scenes)
    for (const auto& [word, accelerator] : accelerators)
      for (const bool enabled : {false, true}) {
        // The rays of a packet stay together over long distances only if there are enough of them, in a quick
        // study, too.
        const int width = scene.name != "cage" ? 256 : laboratory.quick ? 1280 : 640;
        Job job{&scene.scene, laboratory.options(width, 8), 2};
        job.options.accelerator = accelerator;
        job.options.cache.enabled = enabled;
        jobs.push_back(job);
      }
  const std::vector<Outcome> outcomes = laboratory.runner.run(jobs);
  std::vector<ClaimValue> values;
  for (std::size_t i = 0; i < jobs.size(); i += 2) {
    const std::string& name = laboratory.scenes[i / 4].name;
    const auto& [word, accelerator] = accelerators[i / 2 % 2];
    demand_same_picture(name, {&outcomes[i], &outcomes[i + 1]});
    const RenderStatistics &off = outcomes[i].last(), &on = outcomes[i + 1].last();
    const RenderStatistics::Cache reads = all_reads(on);
    const double ratio = megacycles(off.render_cycles) / megacycles(on.render_cycles);
    table.rows.push_back({name, word, megacycles(off.render_cycles), megacycles(on.render_cycles), ratio,
                          static_cast<double>(reads.hits + reads.misses), 100 * reads.hit_rate(),
                          waiting(off), waiting(on)});
    values.push_back({name + " on a " + word,
                      laboratory.command_options(jobs[i].options) + " --accelerator " + word +
                          " --cache off | --cache 4x128, second frame",
                      ratio});
    if (accelerator == Accelerator::bvh) table.chart.labels.push_back(name);
    table.chart.series[i / 2 % 2].points.emplace_back(double(i / 4), ratio);
  }
  const Claim claim = make_claim(values, Holds::somewhere, 13.5, false, 13.5);
  laboratory.claims["cached_over_uncached"] = claim;
  table.here =
      "Up to " + number(claim.value, 2) + " times as fast (" + claim.scene +
      "). Less than 13.5: " + (claim.missed.size() == values.size() ? "all" : listed(claim.missed)) +
      ". A read without the cache costs some 670 cycles. On a grid each ray reads the voxels on its way for "
      "itself, with little between two reads where they are empty; a test or shading takes 300 cycles and "
      "more, and on a BVH the rays of a packet share their reads.";
  return table;
}

Table study_cache_shapes(Laboratory& laboratory) {
  Table table{"shapes",
              "Shapes and policies of the cache",
              "A 4-way set-associative cache with random replacement was chosen; a fully associative one "
              "would search "
              "too long.",
              "",
              {{"scene"},
               {"lines"},
               {"ways"},
               {"policy"},
               {"hit rate, %", 3},
               {"optimal, %", 3},
               {"points below full LRU", 3}},
              {},
              {Chart::Kind::lines, "ways of 512 lines", "misses, % of reads", true, false, {}, {}}};
  const std::vector<std::string> names =
      laboratory.quick ? std::vector<std::string>{"molecule", "terrain"}
                       : std::vector<std::string>{"molecule", "flake", "terrain", "mountains"};
  const std::vector<std::uint32_t> sizes = {128, 512};
  struct Shape {
    std::uint32_t lines, ways;
    CacheReplacement policy;
  };
  std::vector<Shape> shapes;
  for (const std::uint32_t lines : sizes)
    for (const std::uint32_t ways : {1u, 2u, 4u, 8u, lines})
      for (const CacheReplacement policy :
           {CacheReplacement::random, CacheReplacement::fifo, CacheReplacement::lru})
        if (ways != 1 || policy == CacheReplacement::fifo) shapes.push_back({lines, ways, policy});
  struct Result {
    std::vector<double> rates, optimal;
  };
  std::vector<Result> results(names.size());
  laboratory.runner.each(names.size(), [&](std::size_t i) {
    std::stringstream file;
    CacheTraceWriter writer(file);
    RenderOptions options = laboratory.options(256, 2);
    options.backend = Backend::cell_emu;
    options.emulation.schedule = Schedule::lockstep;
    options.emulation.recorder = &writer;
    render(laboratory.scene(names[i]).scene, options);
    writer.finish();
    const std::vector<CacheTrace> traces = read_cache_traces(file);
    const auto rate = [&](auto replay_one) {
      ReplayResult sum;
      for (const CacheTrace& trace : traces)
        sum = sum + replay_one(without_prefetches(trace));
      return 100 * sum.hit_rate();
    };
    for (const std::uint32_t lines : sizes)
      results[i].optimal.push_back(rate([&](const CacheTrace& trace) { return optimal(trace, lines); }));
    for (const Shape& shape : shapes) {
      const CacheConfig config = CacheConfig::of(shape.ways, shape.lines / shape.ways, shape.policy);
      results[i].rates.push_back(rate([&](const CacheTrace& trace) { return replay(trace, config); }));
    }
  });
  const char* const policies[] = {"random", "FIFO", "LRU"};
  double farthest = 0, from_optimal = 0;
  for (std::size_t i = 0; i < names.size(); ++i)
    for (std::size_t s = 0; s < shapes.size(); ++s) {
      const Shape& shape = shapes[s];
      const auto full = std::find_if(shapes.begin(), shapes.end(), [&](const Shape& each) {
        return each.lines == shape.lines && each.ways == shape.lines && each.policy == CacheReplacement::lru;
      });
      const double full_lru = results[i].rates[static_cast<std::size_t>(full - shapes.begin())];
      const double best = results[i].optimal[shape.lines == sizes[0] ? 0 : 1];
      const double rate = results[i].rates[s];
      table.rows.push_back({names[i], double(shape.lines),
                            shape.ways == shape.lines ? Value("full") : Value(double(shape.ways)),
                            policies[static_cast<unsigned>(shape.policy)], rate, best, full_lru - rate});
      if (shape.lines == 512 && shape.ways == 4 && shape.policy == CacheConfig().replacement) {
        farthest = std::max(farthest, full_lru - rate);
        from_optimal = std::max(from_optimal, best - rate);
      }
      if (shape.lines != 512) continue;
      const std::string curve = names[i] + ", " + policies[static_cast<unsigned>(shape.policy)];
      if (shape.ways == 1) continue;
      auto series = std::find_if(table.chart.series.begin(), table.chart.series.end(),
                                 [&](const Chart::Series& each) { return each.name == curve; });
      if (series == table.chart.series.end()) series = table.chart.series.insert(series, {curve, {}});
      series->points.emplace_back(shape.ways, 100 - rate);
    }
  table.here = "The 4-way cache of 512 lines that is built in is at most " +
               number(std::max(farthest, 0.0), 2) +
               " points behind a fully associative one with LRU, and at most " + number(from_optimal, 2) +
               " points behind the optimal replacement (Belady). Traces of two SPEs of cell_emu, replayed "
               "without prefetches.";
  return table;
}

} // namespace celltrace::study

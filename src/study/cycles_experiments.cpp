// The time of an SPE by its use, and the extra cost of the first frame.
#include "study/experiment.hpp"

#include <algorithm>

namespace celltrace::study {

Table study_warmth(Laboratory& laboratory) {
  Table table{"warmth",
              "The first frame and those that follow",
              "Data stay in the cache from frame to frame; the thesis gives no figures.",
              "",
              {{"scene"},
               {"frame 1, Mcycles", 2},
               {"frame 2, Mcycles", 2},
               {"frame 3, Mcycles", 2},
               {"1 / 3", 3},
               {"misses in frame 1"},
               {"misses in frame 3"}},
              {},
              {Chart::Kind::bars, "scene", "Mcycles", false, true, {}, {{"frame 1", {}}, {"frame 3", {}}}}};
  std::vector<Job> jobs;
  for (const StudyScene& scene : laboratory.scenes)
    jobs.push_back({&scene.scene, laboratory.options(256, 8), 3});
  const std::vector<Outcome> outcomes = laboratory.runner.run(jobs);
  double most = 0;
  std::string where;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    const std::string& name = laboratory.scenes[i].name;
    const auto frame = [&](std::size_t n) -> const RenderStatistics& { return outcomes[i].frames[n]; };
    const auto misses = [&](std::size_t n) { return static_cast<double>(all_reads(frame(n)).misses); };
    const double ratio = megacycles(frame(0).render_cycles) / megacycles(frame(2).render_cycles);
    if (ratio > most) {
      most = ratio;
      where = name;
    }
    table.rows.push_back({name, megacycles(frame(0).render_cycles), megacycles(frame(1).render_cycles),
                          megacycles(frame(2).render_cycles), ratio, misses(0), misses(2)});
    table.chart.labels.push_back(name);
    table.chart.series[0].points.emplace_back(double(i), megacycles(frame(0).render_cycles));
    table.chart.series[1].points.emplace_back(double(i), megacycles(frame(2).render_cycles));
  }
  table.here = "The first frame takes up to " + number(most, 2) + " times as long as the third (" + where +
               "): empty caches, and strips that do not fit the scene yet.";
  return table;
}

Table study_cycles(Laboratory& laboratory) {
  Table table{
      "cycles",
      "Where the cycles of an SPE go",
      "The thesis names memory latency as the main cost of its predecessor.",
      "",
      {{"scene"},
       {"one instruction, %", 1},
       {"two instructions, %", 1},
       {"dependency, %", 1},
       {"branch miss, %", 1},
       {"waiting, %", 1},
       {"instructions a cycle", 2},
       {"cycles a ray", 0}},
      {},
      {Chart::Kind::bars,
       "scene",
       "% of the cycles",
       false,
       false,
       {},
       {{"one instruction", {}}, {"two", {}}, {"dependency", {}}, {"branch miss", {}}, {"waiting", {}}}}};
  std::vector<Job> jobs;
  for (const StudyScene& scene : laboratory.scenes)
    jobs.push_back({&scene.scene, laboratory.options(256, 8), 2});
  const std::vector<Outcome> outcomes = laboratory.runner.run(jobs);
  double most = 0;
  std::string where;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    const std::string& name = laboratory.scenes[i].name;
    const RenderStatistics& statistics = outcomes[i].last();
    SpuCycles all;
    for (const RenderStatistics::Spe& spe : statistics.spes)
      all += spe.cycles;
    const auto total = static_cast<double>(all.total_cycle);
    const double parts[5] = {double(all.single_cycle), double(all.dual_cycle),
                             double(all.stall_due_to_dependency), double(all.stall_due_to_branch_miss),
                             double(all.channel_stall_cycle)};
    std::vector<Value> row = {name};
    for (std::size_t part = 0; part < 5; ++part) {
      row.emplace_back(100 * parts[part] / total);
      table.chart.series[part].points.emplace_back(double(i), 100 * parts[part] / total);
    }
    if (parts[4] / total > most) {
      most = parts[4] / total;
      where = name;
    }
    row.emplace_back(static_cast<double>(all.instructions()) / total);
    row.emplace_back(total / static_cast<double>(statistics.total_rays()));
    table.rows.push_back(row);
    table.chart.labels.push_back(name);
  }
  table.here = "SPEs wait at channels for at most " + number(100 * most, 1) + " % of their time (" + where +
               "); the rest is instructions, and the results that they wait for.";
  return table;
}

} // namespace celltrace::study

// Compares the cycles of counted operations with those of machine code.
#include "study/experiment.hpp"

#include <algorithm>
#include <cmath>

namespace celltrace::study {

namespace {

/// The study's ways to render whose work on the SPUs differs most.
struct Setting {
  const char* name;
  int width; ///< width if the study is not quick
  unsigned spes;
  Accelerator accelerator;
  bool cached;
};
constexpr Setting kSettings[] = {
    {"bvh", 256, 8, Accelerator::bvh, true},
    {"BVH, 1 SPE", 256, 1, Accelerator::bvh, true},
    {"BVH, no cache", 128, 8, Accelerator::bvh, false},
    {"grid", 256, 8, Accelerator::grid, true},
    {"grid, no cache", 128, 8, Accelerator::grid, false},
};

} // namespace

Table study_calibration(Laboratory& laboratory) {
  Table table{"calibration",
              "Counted operations and machine code",
              "It has nothing to compare with.",
              "",
              {{"scene"},
               {"accelerator"},
               {"pixels"},
               {"cell_emu, Mcycles", 2},
               {"cell_sim, Mcycles", 2},
               {"cell_emu / cell_sim", 3}},
              {},
              {Chart::Kind::bars, "scene", "cell_emu / cell_sim", false, false, {}, {}}};
  if (!has_machine_code()) {
    table.here = "Skipped: this build has no machine code for cell_sim.";
    return table;
  }
  std::vector<Job> jobs;
  for (const Setting& setting : kSettings) {
    table.chart.series.push_back({setting.name, {}});
    for (const StudyScene& scene : laboratory.scenes) {
      Job job{&scene.scene, laboratory.options(setting.width, setting.spes), 2};
      job.options.accelerator = setting.accelerator;
      job.options.cache.enabled = setting.cached;
      jobs.push_back(job);
    }
  }
  const std::vector<Outcome> counted = laboratory.runner.run(jobs, Backend::cell_emu);
  const std::vector<Outcome> executed = laboratory.runner.run(jobs, Backend::cell_sim);
  double sum = 0, farthest = 1;
  std::string where;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    const std::size_t setting = i / laboratory.scenes.size(), scene = i % laboratory.scenes.size();
    const std::string& name = laboratory.scenes[scene].name;
    const RenderOptions& options = jobs[i].options;
    const double emulated = megacycles(counted[i].last().render_cycles),
                 simulated = megacycles(executed[i].last().render_cycles), ratio = emulated / simulated;
    sum += ratio;
    if (std::abs(ratio - 1) > std::abs(farthest - 1) || where.empty()) {
      farthest = ratio;
      where = name + ", " + kSettings[setting].name;
    }
    table.rows.push_back({name, kSettings[setting].name,
                          std::to_string(options.width) + "x" + std::to_string(options.height), emulated,
                          simulated, ratio});
    if (setting == 0) table.chart.labels.push_back(name);
    table.chart.series[setting].points.emplace_back(double(scene), ratio);
  }
  table.here = "Cycles of counted operations are " + number(sum / double(jobs.size()), 3) +
               " times those of machine code in the mean; the farthest off is " + number(farthest, 3) + " (" +
               where + "). Second frames.";
  return table;
}

} // namespace celltrace::study

// Ways in which SPEs share the work of a ray: pipelines, joined and split, offload, and rays that stay put.
#include "study/experiment.hpp"

#include <algorithm>

namespace celltrace::study {

Table study_reprocessing(Laboratory& laboratory) {
  Table table{
      "reprocessing",
      "Rays that a split pipeline searches again",
      "Of 64x64, 256x256 and 2400x2400 rays, 64.7, 51 and 86.4 % of those that hit something went back to "
      "traversal, because the hit lay beyond the voxel (table 2.1).",
      "",
      {{"scene"},
       {"pixels"},
       {"rays"},
       {"rays with hit"},
       {"reprocessed"},
       {"percentage", 1},
       {"times sent back", 0}},
      {},
      {Chart::Kind::lines, "pixels a side", "reprocessed rays, % of hits", true, false, {}, {}}};
  const std::vector<int> sides =
      laboratory.quick ? std::vector<int>{32, 64, 128} : std::vector<int>{64, 128, 256, 512};
  std::vector<Job> jobs;
  std::vector<std::string> names = {"few", "molecule", "terrain"};
  for (const std::string& name : names)
    for (const int side : sides) {
      Job job{&laboratory.scene(name).scene, {}, 1};
      job.options.width = job.options.height = side;
      job.options.spes = 8;
      job.options.model = Model::pipeline_split;
      jobs.push_back(job);
    }
  const std::vector<Outcome> outcomes = laboratory.runner.run(jobs);
  double least = 100, most = 0;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    const RenderStatistics& statistics = outcomes[i].last();
    const RenderStatistics::Stages& stages = statistics.stages;
    const std::string& name = names[i / sides.size()];
    const double percentage = stages.primary_hits == 0
                                  ? 0
                                  : 100.0 * static_cast<double>(stages.primary_reprocessed) /
                                        static_cast<double>(stages.primary_hits);
    least = std::min(least, percentage);
    most = std::max(most, percentage);
    const double side = jobs[i].options.width;
    table.rows.push_back(
        {name, std::to_string(jobs[i].options.width) + "x" + std::to_string(jobs[i].options.height),
         static_cast<double>(statistics.primary_rays), static_cast<double>(stages.primary_hits),
         static_cast<double>(stages.primary_reprocessed), percentage, static_cast<double>(stages.returns)});
    if (i % sides.size() == 0) table.chart.series.push_back({name, {}});
    table.chart.series.back().points.emplace_back(side, percentage);
  }
  table.here =
      "Between " + number(least, 1) + " and " + number(most, 1) +
      " % of the primary rays that hit something are searched more than once; it is the scene that decides, "
      "not the resolution: rays cross more voxels than one before they hit.";
  return table;
}

Table study_models(Laboratory& laboratory) {
  Table table{
      "models",
      "Programming models",
      "Joining the two halves of the split pipeline took 77.36 s to 52.73 s (1.47); the shared-memory "
      "model was 3 times as fast as the pipeline.",
      "",
      {{"scene"},
       {"split, Mcycles", 2},
       {"joined", 2},
       {"offload", 2},
       {"shared on a grid", 2},
       {"shared", 2},
       {"split / joined", 2},
       {"joined / shared on a grid", 2},
       {"joined / shared", 2},
       {"native, ms", 1}},
      {},
      {Chart::Kind::bars,
       "scene",
       "times the cycles of the shared model",
       false,
       true,
       {},
       {{"split", {}}, {"joined", {}}, {"offload", {}}, {"shared on a grid", {}}}}};
  struct Variant {
    Model model;
    Accelerator accelerator;
  };
  // Pipelines and offload are the models of earlier work, which used the grid.
  const std::vector<Variant> variants = {{Model::pipeline_split, Accelerator::grid},
                                         {Model::pipeline, Accelerator::grid},
                                         {Model::offload, Accelerator::grid},
                                         {Model::shared, Accelerator::grid},
                                         {Model::shared, Accelerator::automatic}};
  const std::vector<std::string> names =
      laboratory.quick ? std::vector<std::string>{"few", "molecule", "corner", "terrain"}
                       : std::vector<std::string>{"few", "molecule", "corner", "flake", "terrain"};
  std::vector<Job> jobs;
  for (const std::string& name : names)
    for (const Variant& variant : variants) {
      Job job{&laboratory.scene(name).scene, laboratory.options(320, 8), 2};
      job.options.model = variant.model;
      job.options.accelerator = variant.accelerator;
      jobs.push_back(job);
    }
  const std::vector<Outcome> outcomes = laboratory.runner.run(jobs);
  std::vector<ClaimValue> joined_over_split, shared_over_pipeline;
  double most_on_grid = 0;
  for (std::size_t i = 0; i < names.size(); ++i) {
    std::vector<const Outcome*> same;
    std::vector<double> cycles;
    for (std::size_t variant = 0; variant < variants.size(); ++variant) {
      same.push_back(&outcomes[i * variants.size() + variant]);
      cycles.push_back(megacycles(same.back()->last().render_cycles));
    }
    demand_same_picture(names[i], same);
    const RenderOptions& options = jobs[i * variants.size() + 4].options;
    table.rows.push_back({names[i], cycles[0], cycles[1], cycles[2], cycles[3], cycles[4],
                          cycles[0] / cycles[1], cycles[1] / cycles[3], cycles[1] / cycles[4],
                          1e3 * native_seconds(laboratory.scene(names[i]).scene, options, 3)});
    const std::string size = laboratory.command_options(options) + ", second frame, ";
    joined_over_split.push_back(
        {names[i], size + "--model pipeline-split | --model pipeline", cycles[0] / cycles[1]});
    shared_over_pipeline.push_back({names[i],
                                    size + "--model pipeline (on a grid) | --model shared (on a BVH); " +
                                        number(cycles[1] / cycles[3], 2) +
                                        " with --accelerator grid for both",
                                    cycles[1] / cycles[4]});
    most_on_grid = std::max(most_on_grid, cycles[1] / cycles[3]);
    table.chart.labels.push_back(names[i]);
    for (std::size_t variant = 0; variant < 4; ++variant)
      table.chart.series[variant].points.emplace_back(double(i), cycles[variant] / cycles[4]);
  }
  const Claim joined = make_claim(joined_over_split, Holds::somewhere, 1.3, false, 77.36 / 52.73);
  const Claim shared = make_claim(shared_over_pipeline, Holds::somewhere, 3, false, 3);
  laboratory.claims["joined_over_split"] = joined;
  laboratory.claims["shared_over_pipeline"] = shared;
  table.here =
      "The joined pipeline is up to " + number(joined.value, 2) + " times as fast as the split one (" +
      joined.scene + "; less than 1.3: " + listed(joined.missed) +
      "). The shared model, with the BVH that it takes by itself, is up to " + number(shared.value, 2) +
      " times as fast as the joined pipeline on its grid (" + shared.scene +
      "; less than 3: " + listed(shared.missed) +
      "). Everything else equal, grid, cache and packets of 16 rays, it is at most " +
      number(most_on_grid, 2) + " times as fast: what made the predecessor slow was memory, not its stages.";
  return table;
}

} // namespace celltrace::study

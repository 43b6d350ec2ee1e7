// Measures how evenly the SPEs share a frame, and how much faster more SPEs are.
#include "study/experiment.hpp"

#include <algorithm>

namespace celltrace::study {

namespace {

/// POV-Ray's own picture size: 19,200 pixels for each of 16 SPEs. A quick study has the same, because the
/// claims are about it.
constexpr int kPictureWidth = 640;
constexpr int kPictureHeight = 480;

RenderOptions sized(unsigned spes) {
  RenderOptions options;
  options.width = kPictureWidth;
  options.height = kPictureHeight;
  options.spes = spes;
  return options;
}

} // namespace

Table study_balance(Laboratory& laboratory) {
  Table table{"balance",
              "Ways to share the work of a frame",
              "Generalized dimension exchange of strips made rendering twice as fast as static strips.",
              "",
              {{"scene"},
               {"balance"},
               {"SPEs"},
               {"Mcycles", 2},
               {"imbalance, %", 1},
               {"hit rate of the cache, %", 2}},
              {},
              {Chart::Kind::lines, "SPEs", "imbalance, % (corner)", true, false, {}, {}}};
  const std::vector<std::pair<std::string, Balance>> ways = {{"static", Balance::fixed},
                                                             {"scatter", Balance::scatter},
                                                             {"tiles", Balance::tiles},
                                                             {"diffusion", Balance::diffusion},
                                                             {"gde", Balance::gde}};
  const std::vector<std::string> names = laboratory.quick
                                             ? std::vector<std::string>{"corner", "terrain"}
                                             : std::vector<std::string>{"few", "corner", "flake", "terrain"};
  const std::vector<unsigned> counts =
      laboratory.quick ? std::vector<unsigned>{2, 8, 16} : std::vector<unsigned>{1, 2, 4, 8, 12, 16};
  std::vector<Job> jobs;
  for (const std::string& name : names)
    for (const auto& [word, balance] : ways)
      for (const unsigned spes : counts) {
        Job job{&laboratory.scene(name).scene, laboratory.quick ? laboratory.options(384, spes) : sized(spes),
                3};
        job.options.balance = balance;
        jobs.push_back(job);
      }
  const std::vector<Outcome> outcomes = laboratory.runner.run(jobs);
  std::vector<ClaimValue> over_static;
  std::size_t i = 0;
  for (const std::string& name : names) {
    std::vector<const Outcome*> same;
    double fixed = 0;
    for (const auto& [word, balance] : ways) {
      if (name == "corner") table.chart.series.push_back({word, {}});
      for (const unsigned spes : counts) {
        const Outcome& outcome = outcomes[i];
        const RenderStatistics& statistics = outcome.last();
        same.push_back(&outcome);
        table.rows.push_back({name, word, double(spes), megacycles(statistics.render_cycles),
                              100 * statistics.imbalance, 100 * statistics.object_cache.hit_rate()});
        if (name == "corner") table.chart.series.back().points.emplace_back(spes, 100 * statistics.imbalance);
        if (spes == 8 && balance == Balance::fixed) fixed = megacycles(statistics.render_cycles);
        if (spes == 8 && balance == Balance::gde)
          over_static.push_back(
              {name, laboratory.command_options(jobs[i].options) + " --balance static | gde, third frame",
               fixed / megacycles(statistics.render_cycles)});
        ++i;
      }
    }
    demand_same_picture(name, same);
  }
  const Claim claim = make_claim(over_static, Holds::somewhere, 2, false, 2);
  laboratory.claims["gde_over_static"] = claim;
  table.here =
      "With 8 SPEs, exchanged strips are " + number(claim.value, 2) + " times as fast as static ones on '" +
      claim.scene + "'. Less than 2: " + listed(claim.missed) +
      ". Scattered packets balance by chance and read the scene everywhere; strips keep what they have read.";
  return table;
}

Table study_imbalance(Laboratory& laboratory) {
  Table table{
      "imbalance",
      "What generalized dimension exchange leaves",
      "An exchange parameter of 1 / (1 + sin(pi / n)) balances a chain in the fewest sweeps; strips are kept "
      "from frame to frame.",
      "",
      {{"scene"},
       {"SPEs"},
       {"frame 1, %", 2},
       {"frame 2, %", 2},
       {"frame 3, %", 2},
       {"frame 4, %", 2},
       {"exchanges in frame 2"}},
      {},
      {Chart::Kind::bars,
       "scene",
       "greatest imbalance from frame 2 on, %",
       false,
       false,
       {},
       {{"8 SPEs", {}}, {"16 SPEs", {}}}}};
  constexpr int kFrames = 4;
  const std::vector<unsigned> counts = {8, 16};
  std::vector<Job> jobs;
  for (const StudyScene& scene : laboratory.scenes)
    for (const unsigned spes : counts)
      jobs.push_back({&scene.scene, sized(spes), kFrames});
  const std::vector<Outcome> outcomes = laboratory.runner.run(jobs);
  std::vector<ClaimValue> worst[2];
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    const StudyScene& scene = laboratory.scenes[i / 2];
    std::vector<Value> row = {scene.name, double(counts[i % 2])};
    double greatest = 0;
    for (int frame = 0; frame < kFrames; ++frame) {
      const double imbalance = outcomes[i].frames[static_cast<std::size_t>(frame)].imbalance;
      row.emplace_back(100 * imbalance);
      if (frame > 0) greatest = std::max(greatest, imbalance);
    }
    row.emplace_back(static_cast<double>(outcomes[i].frames[1].balance_exchanges));
    table.rows.push_back(row);
    worst[i % 2].push_back(
        {scene.name, laboratory.command_options(jobs[i].options) + ", second to fourth frame", greatest});
    if (i % 2 == 0) table.chart.labels.push_back(scene.name);
    table.chart.series[i % 2].points.emplace_back(double(i / 2), 100 * greatest);
  }
  const Claim eight = make_claim(worst[0], Holds::everywhere, 0.03, true, 0);
  const Claim sixteen = make_claim(worst[1], Holds::everywhere, 0.03, true, 0);
  laboratory.claims["imbalance_8"] = eight;
  laboratory.claims["imbalance_16"] = sixteen;
  table.here = "From the second frame on, the busiest of 8 SPEs has at most " + number(100 * eight.value, 2) +
               " % more to do than the mean (" + eight.scene + "), of 16 at most " +
               number(100 * sixteen.value, 2) + " % (" + sixteen.scene +
               "). Above 3 %: " + listed(eight.missed) + " with 8, " + listed(sixteen.missed) +
               " with 16. 38,400 and 19,200 pixels an SPE.";
  return table;
}

Table study_speedup(Laboratory& laboratory) {
  Table table{"speedup",
              "More SPEs",
              "The thesis gives no figures; its SPEs share nothing but the scene, so that it expects speed "
              "to grow with "
              "their number.",
              "",
              {{"scene"}, {"1 SPE, Mcycles", 2}, {"2", 2}, {"4", 2}, {"8", 2}, {"16", 2}},
              {},
              {Chart::Kind::lines, "SPEs", "times as fast as one", true, true, {}, {}}};
  const std::vector<unsigned> counts = {1, 2, 4, 8, 16};
  std::vector<Job> jobs;
  for (const StudyScene& scene : laboratory.scenes)
    for (const unsigned spes : counts)
      jobs.push_back({&scene.scene, sized(spes), 3});
  const std::vector<Outcome> outcomes = laboratory.runner.run(jobs);
  std::vector<ClaimValue> of_8, of_16;
  for (std::size_t i = 0; i < laboratory.scenes.size(); ++i) {
    const std::string& name = laboratory.scenes[i].name;
    const auto cycles = [&](std::size_t n) {
      return megacycles(outcomes[i * counts.size() + n].last().render_cycles);
    };
    std::vector<Value> row = {name, cycles(0)};
    table.chart.series.push_back({name, {}});
    std::vector<const Outcome*> same;
    for (std::size_t n = 0; n < counts.size(); ++n) {
      same.push_back(&outcomes[i * counts.size() + n]);
      if (n > 0) row.emplace_back(cycles(0) / cycles(n));
      table.chart.series.back().points.emplace_back(counts[n], cycles(0) / cycles(n));
    }
    demand_same_picture(name, same);
    table.rows.push_back(row);
    of_8.push_back({name, laboratory.command_options(sized(8)) + " against --spes 1, third frame",
                    cycles(0) / cycles(3)});
    of_16.push_back({name, laboratory.command_options(sized(16)) + " against --spes 1, third frame",
                     cycles(0) / cycles(4)});
  }
  const Claim eight = make_claim(of_8, Holds::everywhere, 7.5, false, 0);
  const Claim sixteen = make_claim(of_16, Holds::everywhere, 14, false, 0);
  laboratory.claims["speedup_8"] = eight;
  laboratory.claims["speedup_16"] = sixteen;
  table.here = "At least " + number(eight.value, 2) + " times as fast with 8 SPEs (" + eight.scene +
               ") and " + number(sixteen.value, 2) + " times with 16 (" + sixteen.scene +
               "). Less than 7.5: " + listed(eight.missed) + "; less than 14: " + listed(sixteen.missed) +
               ".";
  return table;
}

} // namespace celltrace::study

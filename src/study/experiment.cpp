#include "study/experiment.hpp"

#include "celltrace/error.hpp"

#include <algorithm>
#include <cstdio>

namespace celltrace::study {

const StudyScene& Laboratory::scene(const std::string& name) const {
  const auto found =
      std::find_if(scenes.begin(), scenes.end(), [&](const StudyScene& scene) { return scene.name == name; });
  if (found == scenes.end()) throw Error("the study has no scene '" + name + "'");
  return *found;
}

RenderOptions Laboratory::options(int full, unsigned spes) const {
  RenderOptions options;
  options.width = quick ? full / 2 : full;
  options.height = options.width * 3 / 4;
  options.spes = spes;
  return options;
}

std::string Laboratory::command_options(const RenderOptions& options) const {
  return "-W " + std::to_string(options.width) + " -H " + std::to_string(options.height) + " --backend " +
         std::string(name_of(runner.backend())) + " --schedule lockstep --spes " +
         std::to_string(options.spes);
}

Claim make_claim(const std::vector<ClaimValue>& values, Holds holds, double bar, bool at_most,
                 double thesis) {
  Claim claim;
  claim.bar = bar;
  claim.at_most = at_most;
  claim.thesis = thesis;
  const bool want_greatest = (holds == Holds::somewhere) != at_most;
  const auto less = [](const ClaimValue& a, const ClaimValue& b) { return a.value < b.value; };
  const auto chosen = want_greatest ? std::max_element(values.begin(), values.end(), less)
                                    : std::min_element(values.begin(), values.end(), less);
  if (chosen == values.end()) return claim;
  claim.value = chosen->value;
  claim.scene = chosen->scene;
  claim.parameters = chosen->parameters;
  for (const ClaimValue& each : values)
    if (at_most ? each.value > bar : each.value < bar) claim.missed.push_back(each.scene);
  return claim;
}

RenderStatistics::Cache all_reads(const RenderStatistics& statistics) {
  RenderStatistics::Cache all;
  for (const RenderStatistics::Cache* cache : {&statistics.list_cache, &statistics.object_cache,
                                               &statistics.material_cache, &statistics.light_cache}) {
    all.hits += cache->hits;
    all.misses += cache->misses;
  }
  return all;
}

void demand_same_picture(const std::string& scene, const std::vector<const Outcome*>& outcomes) {
  for (const Outcome* outcome : outcomes)
    if (outcome->picture != outcomes.front()->picture)
      throw Error("the study's pictures of '" + scene + "' differ: there is a fault in the renderer");
}

double megacycles(std::uint64_t cycles) {
  return static_cast<double>(cycles) / 1e6;
}

std::string number(double value, int decimals) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}

std::string listed(const std::vector<std::string>& names) {
  if (names.empty()) return "none";
  std::string text = names.front();
  for (std::size_t i = 1; i < names.size(); ++i)
    text += (i + 1 == names.size() ? " and " : ", ") + names[i];
  return text;
}

} // namespace celltrace::study

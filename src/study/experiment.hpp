// Common parts of the experiments of a study.
#pragma once

#include "study/runs.hpp"
#include "study/scenes.hpp"
#include "study/study.hpp"

#include <map>
#include <string>
#include <vector>

namespace celltrace::study {

/// The scenes and the machine that an experiment works with, and the place for its claims.
struct Laboratory {
  const std::vector<StudyScene>& scenes;
  const Runner& runner;
  bool quick;
  std::map<std::string, Claim>& claims;

  const StudyScene& scene(const std::string& name) const;
  /// Returns options for pictures of the study's size: `full` pixels wide, or half of that if it is to be
  /// quick, and three quarters as high.
  RenderOptions options(int full, unsigned spes) const;
  /// Returns the options of `celltrace render` for frames in lockstep of this size on as many SPEs.
  std::string command_options(const RenderOptions& options) const;
};

// The experiments: each makes one table.
Table study_reprocessing(Laboratory& laboratory);
Table study_models(Laboratory& laboratory);
Table study_cache_cost(Laboratory& laboratory);
Table study_cache_shapes(Laboratory& laboratory);
Table study_simd(Laboratory& laboratory);
Table study_balance(Laboratory& laboratory);
Table study_imbalance(Laboratory& laboratory);
Table study_speedup(Laboratory& laboratory);
Table study_warmth(Laboratory& laboratory);
Table study_cycles(Laboratory& laboratory);
Table study_calibration(Laboratory& laboratory);

/// A value of one of several scenes: the best one (or, if it has to hold everywhere, the worst) becomes the
/// claim.
struct ClaimValue {
  std::string scene, parameters;
  double value;
};
enum class Holds { somewhere, everywhere };
Claim make_claim(const std::vector<ClaimValue>& values, Holds holds, double bar, bool at_most, double thesis);

/// Throws Error if outcomes of one scene show different pictures.
void demand_same_picture(const std::string& scene, const std::vector<const Outcome*>& outcomes);

/// Returns the reads of all kinds of data.
RenderStatistics::Cache all_reads(const RenderStatistics& statistics);

double megacycles(std::uint64_t cycles);
/// Returns 1.234 as "1.23".
std::string number(double value, int decimals);
/// Returns "a, b and c"; "none" for none.
std::string listed(const std::vector<std::string>& names);

} // namespace celltrace::study

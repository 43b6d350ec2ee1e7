#include "study/study.hpp"

#include "celltrace/error.hpp"
#include "study/experiment.hpp"

#include <algorithm>

namespace celltrace::study {

namespace {

struct Experiment {
  const char* id;
  Table (*make)(Laboratory&);
};

constexpr Experiment kExperiments[] = {
    {"reprocessing", study_reprocessing},
    {"models", study_models},
    {"cache", study_cache_cost},
    {"shapes", study_cache_shapes},
    {"simd", study_simd},
    {"balance", study_balance},
    {"imbalance", study_imbalance},
    {"speedup", study_speedup},
    {"warmth", study_warmth},
    {"cycles", study_cycles},
    {"calibration", study_calibration},
};

} // namespace

std::vector<std::string> table_ids() {
  std::vector<std::string> ids;
  for (const Experiment& experiment : kExperiments)
    ids.emplace_back(experiment.id);
  return ids;
}

Study run_study(const StudyOptions& options,
                const std::function<void(const std::string& table, int jobs)>& progress) {
  const std::vector<std::string> ids = table_ids();
  if (!options.only.empty() && std::find(ids.begin(), ids.end(), options.only) == ids.end())
    throw InputError("the study has no table '" + options.only + "', only " + listed(ids));
  if (options.backend != Backend::cell_emu && options.backend != Backend::cell_sim)
    throw InputError("a study is of 'cell_emu' or 'cell_sim', not of '" +
                     std::string(name_of(options.backend)) + "'");
  if (options.backend == Backend::cell_sim && !has_machine_code())
    throw InputError("this build has no machine code for cell_sim: it was made without spu-elf-g++");
  const std::vector<StudyScene> scenes = make_scenes();
  Study study;
  study.quick = options.quick;
  study.backend = options.backend;
  std::string current;
  int jobs = 0;
  const Runner runner(options.backend, options.threads, [&] {
    if (progress) progress(current, ++jobs);
  });
  Laboratory laboratory{scenes, runner, options.quick, study.claims};
  for (const Experiment& experiment : kExperiments) {
    if (!options.only.empty() && options.only != experiment.id) continue;
    current = experiment.id;
    study.tables.push_back(experiment.make(laboratory));
  }
  return study;
}

} // namespace celltrace::study

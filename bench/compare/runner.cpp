#include "runner.hpp"

namespace celltrace::compare {

std::vector<Samples> alternate(const std::vector<Subject>& subjects, int rounds, const std::string& unit) {
  std::vector<Samples> samples;
  for (const Subject& subject : subjects)
    samples.push_back({subject.name, unit, {}});
  for (int round = 0; round < rounds; ++round)
    for (std::size_t turn = 0; turn < subjects.size(); ++turn) {
      const std::size_t who = (static_cast<std::size_t>(round) + turn) % subjects.size();
      samples[who].values.push_back(subjects[who].run());
    }
  return samples;
}

Samples ratio(const Samples& ours, const Samples& theirs, Values values) {
  Samples result = {"times as fast", "x", {}};
  for (std::size_t i = 0; i < ours.values.size(); ++i)
    result.values.push_back(values == Values::speeds ? ours.values[i] / theirs.values[i]
                                                     : theirs.values[i] / ours.values[i]);
  return result;
}

} // namespace celltrace::compare

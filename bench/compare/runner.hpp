// Measurements in turn.
#pragma once

#include "report.hpp"

#include <functional>
#include <string>
#include <vector>

namespace celltrace::compare {

/// Somebody who takes a turn in each round. `run` returns a value.
struct Subject {
  std::string name;
  std::function<double()> run;
};

/// Lets all subjects run in turn, each coming first as often as the others; a vector of samples for each.
std::vector<Samples> alternate(const std::vector<Subject>& subjects, int rounds, const std::string& unit);

/// Round by round, how many times as fast the first of two was; `values` are speeds, or else times.
enum class Values { speeds, times };
Samples ratio(const Samples& ours, const Samples& theirs, Values values);

} // namespace celltrace::compare

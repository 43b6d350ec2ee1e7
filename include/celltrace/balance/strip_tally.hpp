// The PPE's part in balancing the work of a frame (strip.hpp): hands out strips and detects when a frame is
// complete.
#pragma once

#include "celltrace/balance/strip.hpp"

#include <cstdint>
#include <numeric>
#include <optional>
#include <vector>

namespace celltrace {

/// Returns strips of the given numbers of units, one after the other from unit 0.
inline std::vector<UnitRange> consecutive_strips(const std::vector<std::uint32_t>& counts) {
  std::vector<UnitRange> strips;
  strips.reserve(counts.size());
  std::uint32_t first = 0;
  for (const std::uint32_t count : counts) {
    strips.push_back({first, count});
    first += count;
  }
  return strips;
}

/// Divides `units` units into `nodes` (at least 1) strips that differ by at most one unit.
inline std::vector<UnitRange> even_strips(std::uint32_t units, std::uint32_t nodes) {
  std::vector<std::uint32_t> counts(nodes, units / nodes);
  for (std::uint32_t node = 0; node < units % nodes; ++node)
    ++counts[node];
  return consecutive_strips(counts);
}

/// Counts the idle reports of one frame. Not thread safe.
class StripTally {
public:
  /// Starts the tally of a frame of `units` units, done by `nodes` nodes.
  StripTally(std::uint32_t nodes, std::uint32_t units) : units_(units), reports_(nodes) {}

  std::uint32_t units() const { return units_; }
  /// Notes that node `node` is idle and has completed `completed` units in this frame; a newer report
  /// replaces an older one.
  void report(std::uint32_t node, std::uint32_t completed) { reports_.at(node) = completed; }
  /// Returns the number of units that are known to be completed.
  std::uint32_t completed() const {
    return std::accumulate(reports_.begin(), reports_.end(), std::uint32_t{0},
                           [](std::uint32_t sum, const auto& report) { return sum + report.value_or(0); });
  }
  /// Returns true if every node has reported and all units are completed.
  bool frame_complete() const {
    for (const auto& report : reports_) {
      if (!report) return false;
    }
    return completed() == units_;
  }
  /// Returns strips for the next frame, in which each node gets as many units as it completed in this frame,
  /// because frames resemble each other. Precondition: frame_complete().
  std::vector<UnitRange> next_strips() const {
    std::vector<std::uint32_t> counts;
    for (const auto& report : reports_)
      counts.push_back(report.value_or(0));
    return consecutive_strips(counts);
  }

private:
  std::uint32_t units_;
  std::vector<std::optional<std::uint32_t>> reports_;
};

} // namespace celltrace

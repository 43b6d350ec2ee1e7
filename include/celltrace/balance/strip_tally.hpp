// The PPE's part in balancing the rows of a frame (strip.hpp): it hands out strips and knows when a frame is
// complete.
#pragma once

#include "celltrace/balance/strip.hpp"

#include <cstdint>
#include <numeric>
#include <optional>
#include <vector>

namespace celltrace {

/// Strips of the given numbers of rows, one after the other from row 0.
inline std::vector<RowRange> consecutive_strips(const std::vector<std::uint32_t>& counts) {
  std::vector<RowRange> strips;
  strips.reserve(counts.size());
  std::uint32_t first = 0;
  for (const std::uint32_t count : counts) {
    strips.push_back({first, count});
    first += count;
  }
  return strips;
}

/// `rows` rows in `nodes` (at least 1) strips that differ by at most one row.
inline std::vector<RowRange> even_strips(std::uint32_t rows, std::uint32_t nodes) {
  std::vector<std::uint32_t> counts(nodes, rows / nodes);
  for (std::uint32_t node = 0; node < rows % nodes; ++node)
    ++counts[node];
  return consecutive_strips(counts);
}

/// Counts the idle reports of one frame. Not thread safe.
class StripTally {
public:
  /// `rows`: of the whole frame.
  StripTally(std::uint32_t nodes, std::uint32_t rows) : rows_(rows), reports_(nodes) {}

  /// Node `node` is idle and has completed `completed` rows in this frame. Its newest report counts.
  void report(std::uint32_t node, std::uint32_t completed) { reports_.at(node) = completed; }
  /// Rows that are known to be completed.
  std::uint32_t completed() const {
    return std::accumulate(reports_.begin(), reports_.end(), std::uint32_t{0},
                           [](std::uint32_t sum, const auto& report) { return sum + report.value_or(0); });
  }
  /// Every node has been idle and all rows are completed.
  bool frame_complete() const {
    for (const auto& report : reports_) {
      if (!report) return false;
    }
    return completed() == rows_;
  }
  /// The strips for the next frame, which is likely to resemble this one: as many rows for each node as it
  /// managed. Precondition: frame_complete().
  std::vector<RowRange> next_strips() const {
    std::vector<std::uint32_t> counts;
    for (const auto& report : reports_)
      counts.push_back(report.value_or(0));
    return consecutive_strips(counts);
  }

private:
  std::uint32_t rows_;
  std::vector<std::optional<std::uint32_t>> reports_;
};

} // namespace celltrace

// Cuts a sequence of work into units and strips by the measured cost of its parts. Host side; pure
// functions.
#pragma once

#include "celltrace/balance/dimension_exchange.hpp"
#include "celltrace/balance/strip.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace celltrace {

/// Consecutive items, and their cost together.
struct CostRun {
  std::uint32_t items;
  double cost;
};

/// Cuts the items of all `measured` runs into about `wanted` (at least 1) new runs of about equal cost and of
/// at most `longest` (at least 1) items. Returns at most wanted + items / longest + 1 runs. All items of a
/// measured run count as equally expensive.
inline std::vector<CostRun> equal_cost_runs(std::span<const CostRun> measured, std::uint32_t wanted,
                                            std::uint32_t longest) {
  const double total = std::accumulate(measured.begin(), measured.end(), 0.0,
                                       [](double sum, const CostRun& run) { return sum + run.cost; });
  const double share = total / wanted;
  std::vector<CostRun> runs;
  CostRun open{0, 0};
  for (const CostRun& run : measured) {
    const double each = run.cost / std::max(run.items, 1u);
    for (std::uint32_t left = run.items; left != 0;) {
      const double until_full = each > 0 ? std::ceil((share - open.cost) / each) : longest;
      const auto room = static_cast<std::uint32_t>(std::clamp(until_full, 1.0, double{1.0 * longest}));
      const std::uint32_t taken = std::min({left, room, longest - open.items});
      open.items += taken;
      open.cost += taken * each;
      left -= taken;
      if (open.items < longest && open.cost < share) continue;
      runs.push_back(open);
      open = {0, 0};
    }
  }
  if (open.items != 0) runs.push_back(open);
  return runs;
}

/// Cuts all units, which have `costs`, into consecutive strips. Each strip ends where the sum of all costs up
/// to its end is nearest to the sum of the loads up to the strip. `loads` has one load per strip; their sum
/// is the sum of all costs.
inline std::vector<UnitRange> strips_of_loads(std::span<const double> costs, std::span<const double> loads) {
  std::vector<UnitRange> strips;
  const auto units = static_cast<std::uint32_t>(costs.size());
  std::uint32_t first = 0;
  double before = 0; // cost of the units before `end`
  double wanted = 0;
  for (std::size_t node = 0; node < loads.size(); ++node) {
    wanted += loads[node];
    std::uint32_t end = first;
    while (end < units && (node + 1 == loads.size() || before + costs[end] / 2 < wanted))
      before += costs[end++];
    strips.push_back({first, end - first});
    first = end;
  }
  return strips;
}

/// Cuts all units into strips of about equal cost. `nodes` is at least 1.
inline std::vector<UnitRange> strips_of_equal_cost(std::span<const double> costs, std::uint32_t nodes) {
  const double total = std::accumulate(costs.begin(), costs.end(), 0.0);
  return strips_of_loads(costs, std::vector<double>(nodes, total / nodes));
}

/// Returns the strips after a step of first-order diffusion along the chain: each strip passes the share
/// `alpha` of the difference in cost to each cheaper neighbour. Throws as diffusion_step() does.
inline std::vector<UnitRange> diffused_strips(std::span<const double> costs,
                                              std::span<const UnitRange> strips, double alpha) {
  std::vector<double> loads;
  for (const UnitRange strip : strips) {
    const auto of_strip = costs.subspan(strip.first, strip.count);
    loads.push_back(std::accumulate(of_strip.begin(), of_strip.end(), 0.0));
  }
  diffusion_step(chain_graph(static_cast<std::uint32_t>(strips.size())), loads, alpha);
  return strips_of_loads(costs, loads);
}

} // namespace celltrace

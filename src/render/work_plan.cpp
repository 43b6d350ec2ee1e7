#include "render/work_plan.hpp"

#include "celltrace/balance.hpp"

#include <algorithm>
#include <numeric>
#include <random>
#include <utility>

namespace celltrace {

using namespace kernel;

namespace {

/// The number of units per strip: a unit should be a small part of an SPE's work, as strips may differ by
/// one.
constexpr std::uint32_t kUnitsPerStrip = 512;
/// Limit on a unit's length where bundles have been cheap, as a multiple of the mean length: the next picture
/// may differ.
constexpr std::uint32_t kLongestUnit = 8;
/// The number of pieces per strip in the first frame, for which no costs are known: pieces from all over the
/// picture leave less to exchange.
constexpr std::uint32_t kPiecesPerStrip = 16;
/// The edge of the tiles that are dealt at random, in bundles.
constexpr std::uint32_t kTileEdge = 4;
constexpr std::uint32_t kTileSeed = 1;

constexpr std::uint32_t divided(std::uint32_t count, std::uint32_t by) {
  return (count + by - 1) / by;
}

} // namespace

WorkPlan::WorkPlan(Balance balance, std::uint32_t columns, std::uint32_t rows, std::uint32_t spes,
                   std::endian spe_order, std::uint32_t first_row)
    : balance_(balance), columns_(columns), rows_(rows), first_row_(first_row), spes_(spes),
      unit_records_(0, spe_order), strip_records_(0, spe_order), cost_records_(0, spe_order) {
  // Limit on wanted units; cuts by cost may make an eighth more, plus one.
  constexpr std::uint32_t kMostUnits = strip_word::kMaxUnits / 9 * 8 - 8;
  wanted_units_ = std::min({kMostUnits, kUnitsPerStrip * spes, columns * rows});
  if (balance == Balance::scatter)
    deal_bundles();
  else if (balance == Balance::tiles)
    deal_tiles();
  else if (balance == Balance::gde)
    deal_pieces();
  else
    cut_evenly();
  write();
}

void WorkPlan::place(FrameBlock& frame) const {
  frame.units = unit_records_.ea();
  frame.strips = strip_records_.ea();
  frame.costs = cost_records_.ea();
  frame.unit_count = units();
  frame.bundle_columns = columns_;
}

void WorkPlan::learn() {
  cost_records_.fetch();
  if (balance_ == Balance::gde)
    cut_by_cost();
  else if (balance_ == Balance::diffusion)
    strips_ = diffused_strips(costs(), strips_, diffusion_parameter(chain_graph(spes_)));
  else
    return;
  write();
}

void WorkPlan::cut_by_cost() {
  const std::uint32_t longest = kLongestUnit * divided(columns_ * rows_, wanted_units_);
  std::vector<std::uint32_t> lengths;
  std::vector<double> expected;
  for (const CostRun& run : equal_cost_runs(measured_runs(), wanted_units_, longest)) {
    lengths.push_back(run.items);
    expected.push_back(run.cost);
  }
  cut(lengths);
  strips_ = strips_of_equal_cost(expected, spes_);
  begin_with_costly(expected);
}

void WorkPlan::begin_with_costly(const std::vector<double>& expected) {
  const double mean = std::accumulate(expected.begin(), expected.end(), 0.0) / units();
  const std::vector<UnitRecord> in_order = units_;
  std::vector<std::size_t> order(expected.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (const UnitRange strip : strips_) {
    const auto begin = order.begin() + strip.first;
    std::stable_partition(begin, begin + strip.count,
                          [&](std::size_t unit) { return expected[unit] > mean; });
  }
  std::transform(order.begin(), order.end(), units_.begin(),
                 [&](std::size_t unit) { return in_order[unit]; });
}

void WorkPlan::cut(const std::vector<std::uint32_t>& lengths) {
  units_.clear();
  std::uint32_t first = 0;
  for (const std::uint32_t length : lengths) {
    add_unit(first % columns_, first / columns_, length);
    first += length;
  }
}

void WorkPlan::cut_evenly() {
  std::vector<std::uint32_t> lengths;
  for (const UnitRange& run : even_strips(columns_ * rows_, wanted_units_))
    lengths.push_back(run.count);
  cut(lengths);
  strips_ = even_strips(units(), spes_);
}

void WorkPlan::deal_pieces() {
  cut_evenly();
  const std::vector<UnitRecord> in_order = std::exchange(units_, {});
  const std::vector<UnitRange> pieces =
      even_strips(static_cast<std::uint32_t>(in_order.size()), kPiecesPerStrip * spes_);
  std::vector<std::uint32_t> counts;
  for (std::uint32_t spe = 0; spe < spes_; ++spe) {
    const std::uint32_t before = units();
    for (std::uint32_t round = 0; round < kPiecesPerStrip; ++round) {
      // Rounds alternate in direction, so that no SPE always gets the lowest piece.
      const UnitRange piece = pieces[round * spes_ + (round % 2 == 0 ? spe : spes_ - 1 - spe)];
      units_.insert(units_.end(), in_order.begin() + piece.first,
                    in_order.begin() + piece.first + piece.count);
    }
    counts.push_back(units() - before);
  }
  strips_ = consecutive_strips(counts);
}

void WorkPlan::deal_bundles() {
  const std::uint32_t bundles = columns_ * rows_;
  std::vector<std::uint32_t> counts;
  for (std::uint32_t spe = 0; spe < spes_; ++spe) {
    for (std::uint32_t bundle = spe; bundle < bundles; bundle += spes_)
      add_unit(bundle % columns_, bundle / columns_, 1);
    counts.push_back(bundles / spes_ + (spe < bundles % spes_ ? 1 : 0));
  }
  strips_ = consecutive_strips(counts);
}

void WorkPlan::deal_tiles() {
  const std::uint32_t across = divided(columns_, kTileEdge);
  std::vector<std::uint32_t> tiles(across * divided(rows_, kTileEdge));
  std::iota(tiles.begin(), tiles.end(), 0u);
  std::mt19937 random(kTileSeed);
  for (std::size_t left = tiles.size(); left > 1; --left)
    std::swap(tiles[left - 1], tiles[random() % left]);
  std::vector<std::uint32_t> counts;
  for (std::uint32_t spe = 0; spe < spes_; ++spe) {
    const std::uint32_t before = units();
    for (std::size_t i = spe; i < tiles.size(); i += spes_) {
      const std::uint32_t column = tiles[i] % across * kTileEdge;
      const std::uint32_t row = tiles[i] / across * kTileEdge;
      for (std::uint32_t y = row; y < std::min(row + kTileEdge, rows_); ++y)
        add_unit(column, y, std::min(kTileEdge, columns_ - column));
    }
    counts.push_back(units() - before);
  }
  strips_ = consecutive_strips(counts);
}

void WorkPlan::add_unit(std::uint32_t column, std::uint32_t row, std::uint32_t bundles) {
  units_.push_back(
      {static_cast<std::uint16_t>(column), static_cast<std::uint16_t>(first_row_ + row), bundles});
}

void WorkPlan::write() {
  std::vector<StripRecord> strips;
  for (const UnitRange strip : strips_)
    strips.push_back({strip.first, strip.first + strip.count, {0, 0}});
  unit_records_.assign(units_);
  strip_records_.assign(strips);
  cost_records_.assign(std::vector<std::uint32_t>(units_.size()));
}

std::vector<CostRun> WorkPlan::measured_runs() const {
  const std::vector<double> cost = costs();
  std::vector<std::size_t> order(cost.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto place = [&](std::size_t unit) { return units_[unit].row * columns_ + units_[unit].column; };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return place(a) < place(b); });
  std::vector<CostRun> runs;
  for (const std::size_t unit : order)
    runs.push_back({units_[unit].bundles, cost[unit]});
  return runs;
}

std::vector<double> WorkPlan::measured_costs() {
  cost_records_.fetch();
  return costs();
}

std::vector<double> WorkPlan::costs() const {
  // A unit that took less than a tick still had a cost.
  const auto ticks = cost_records_.all();
  std::vector<double> costs(ticks.size());
  std::transform(ticks.begin(), ticks.end(), costs.begin(), [](std::uint32_t each) { return each + 1.0; });
  return costs;
}

} // namespace celltrace

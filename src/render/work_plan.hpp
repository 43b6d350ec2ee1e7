// Divides the bundles of a frame into units of work, and assigns each unit to the SPE that starts with it.
#pragma once

#include "celltrace/balance/partition.hpp"
#include "celltrace/render.hpp"
#include "celltrace/spe/shared_records.hpp"
#include "render/frame_fields.hpp"

#include <bit>
#include <vector>

namespace celltrace {

/// The plan of the next frame, in the memory from which the SPEs read it. Learns from the frame before if the
/// balancing method does.
class WorkPlan {
public:
  /// Plans `columns` x `rows` bundles of a picture (at least one), from row `first_row` on, for `spes` SPEs,
  /// whose SPUs have this byte order.
  WorkPlan(Balance balance, std::uint32_t columns, std::uint32_t rows, std::uint32_t spes,
           std::endian spe_order = std::endian::native, std::uint32_t first_row = 0);

  /// Writes the places of the plan's tables, and the width of the picture, to the frame block. Call it before
  /// every frame: plans may move.
  void place(kernel::FrameBlock& frame) const;
  std::uint32_t units() const { return static_cast<std::uint32_t>(units_.size()); }
  const kernel::UnitRecord& unit(std::uint32_t index) const { return units_[index]; }
  /// Returns for each unit the ticks that it took in the last frame, plus 1, since no unit is free.
  std::vector<double> measured_costs();
  /// Plans the next frame by the measured costs of the units in the frame that is complete.
  void learn();

private:
  void cut_evenly();
  void cut_by_cost();
  /// Moves the units of each strip that cost more than the mean to its beginning: at the end of a frame they
  /// would keep one SPE busy while the others are idle. The rest stays in the picture's order, in which
  /// neighbours share cache lines.
  void begin_with_costly(const std::vector<double>& expected);
  /// Cuts the bundles into units of these lengths, row by row.
  void cut(const std::vector<std::uint32_t>& lengths);
  void deal_pieces();
  void deal_bundles();
  void deal_tiles();
  /// Adds a unit; `row` is relative to the plan's first row.
  void add_unit(std::uint32_t column, std::uint32_t row, std::uint32_t bundles);
  void write();
  /// Returns the costs by unit, as the SPEs have written them.
  std::vector<double> costs() const;
  /// Returns the measured costs in the order of the picture.
  std::vector<CostRun> measured_runs() const;

  Balance balance_;
  std::uint32_t columns_, rows_, first_row_, spes_;
  std::uint32_t wanted_units_; ///< number of units to make; below the maximum, since cuts may make more
  std::vector<kernel::UnitRecord> units_;
  std::vector<UnitRange> strips_;
  // The tables that the SPEs read and write.
  SharedRecords<kernel::UnitRecord> unit_records_;
  SharedRecords<kernel::StripRecord> strip_records_;
  SharedRecords<std::uint32_t> cost_records_;
};

} // namespace celltrace

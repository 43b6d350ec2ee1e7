// How the bundles of a frame are cut into units of work, and which SPE starts with which of them.
#pragma once

#include "celltrace/balance/partition.hpp"
#include "celltrace/render.hpp"
#include "celltrace/spe/shared_records.hpp"
#include "render/frame_fields.hpp"

#include <bit>
#include <vector>

namespace celltrace {

/// The plan of the next frame, in the memory that the SPEs read it from. Learns from the frame before where
/// the way of balancing does.
class WorkPlan {
public:
  /// For `columns` x `rows` bundles of a picture (at least one), of which the first row is `first_row`, and
  /// for so many SPEs, whose SPUs have this byte order.
  WorkPlan(Balance balance, std::uint32_t columns, std::uint32_t rows, std::uint32_t spes,
           std::endian spe_order = std::endian::native, std::uint32_t first_row = 0);

  /// Writes where everything lies, and how wide the picture is. Call it before every frame: plans may move.
  void place(kernel::FrameBlock& frame) const;
  std::uint32_t units() const { return static_cast<std::uint32_t>(units_.size()); }
  const kernel::UnitRecord& unit(std::uint32_t index) const { return units_[index]; }
  /// By unit, the ticks that it took in the frame before; 1 more, because nothing is for nothing.
  std::vector<double> measured_costs();
  /// Plans the next frame by what the units of the one that is complete have cost.
  void learn();

private:
  void cut_evenly();
  void cut_by_cost();
  /// Moves the units of each strip that cost more than the mean to its beginning: at the end of a frame they
  /// would keep one SPE busy while the others have run dry. The rest stays in the picture's order, in which
  /// neighbours find in the cache what they share.
  void begin_with_costly(const std::vector<double>& expected);
  /// Row by row, as long as `lengths` says.
  void cut(const std::vector<std::uint32_t>& lengths);
  void deal_pieces();
  void deal_bundles();
  void deal_tiles();
  /// `row` is counted from the plan's first one on.
  void add_unit(std::uint32_t column, std::uint32_t row, std::uint32_t bundles);
  void write();
  /// By unit, as the SPEs wrote them.
  std::vector<double> costs() const;
  /// In the order of the picture.
  std::vector<CostRun> measured_runs() const;

  Balance balance_;
  std::uint32_t columns_, rows_, first_row_, spes_;
  std::uint32_t wanted_units_; ///< fewer than there may be at most, for cuts that do not come out even
  std::vector<kernel::UnitRecord> units_;
  std::vector<UnitRange> strips_;
  // What the SPEs read and write.
  SharedRecords<kernel::UnitRecord> unit_records_;
  SharedRecords<kernel::StripRecord> strip_records_;
  SharedRecords<std::uint32_t> cost_records_;
};

} // namespace celltrace

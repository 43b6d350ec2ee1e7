// The plans by which the SPEs process the rows of a frame.
#pragma once

#include "celltrace/render.hpp"
#include "celltrace/spe/machine.hpp"
#include "records/frame.hpp"
#include "render/picture_memory.hpp"
#include "render/work_plan.hpp"

#include <cstdint>
#include <memory>

namespace celltrace {

/// The plans of a picture. They are kept, with their measured costs, as long as the rows stay the same.
class FramePlan {
public:
  /// Refers to all arguments, which must outlive this object; each call uses the current `options`.
  FramePlan(const RenderOptions& options, const Machine& machine, const kernel::FrameBlock& frame,
            PictureMemory& picture)
      : options_(options), machine_(machine), frame_(frame), picture_(picture) {}

  /// Makes plans for these rows, and makes the picture's memory begin with them. Points of the grid that are
  /// in memory from earlier rows are not traced again.
  void plan(const RowRange& rows);
  /// Makes the next call build all plans anew, because pictures will have another size or kind.
  void forget() { planned_ = {0, 0}; }

  /// Records that all points of the grid in these rows are in memory, until forget_points().
  void keep_points(const RowRange& rows) { traced_ = grid_rows_of(rows); }
  void forget_points() { traced_ = {0, 0}; }
  /// Returns how many lines of the grid, in pixels, the plan leaves out because earlier rows have traced
  /// them.
  std::uint32_t kept_lines() const;

  WorkPlan& grid() { return *grid_plan_; }
  /// Returns the plan of the blocks of pixels that are sampled, if the options ask for antialiasing.
  WorkPlan& samples() { return *sample_plan_; }

private:
  /// Rows of bundles of the grid: [begin, end).
  struct BundleRows {
    std::uint32_t begin = 0, end = 0;
    bool operator==(const BundleRows&) const = default;
    std::uint32_t count() const { return end - begin; }
  };

  /// Returns the rows of bundles that the picture's rows need.
  BundleRows grid_rows_of(const RowRange& rows) const;
  std::uint32_t line_of(std::uint32_t bundle_row) const;

  const RenderOptions& options_;
  const Machine& machine_;
  const kernel::FrameBlock& frame_;
  PictureMemory& picture_;
  RowRange planned_ = {0, 0};
  BundleRows planned_grid_;
  BundleRows traced_; ///< rows of the grid whose points are in memory
  std::unique_ptr<WorkPlan> grid_plan_, sample_plan_;
};

} // namespace celltrace

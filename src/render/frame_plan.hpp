// The plans by which the SPEs work off the rows of a frame.
#pragma once

#include "celltrace/render.hpp"
#include "celltrace/spe/machine.hpp"
#include "records/frame.hpp"
#include "render/picture_memory.hpp"
#include "render/work_plan.hpp"

#include <cstdint>
#include <memory>

namespace celltrace {

/// Plans that have learned stay as long as the rows do.
class FramePlan {
public:
  /// All of them stay as long as this lives; what is planned is as `options` are at the time of each call.
  FramePlan(const RenderOptions& options, const Machine& machine, const kernel::FrameBlock& frame,
            PictureMemory& picture)
      : options_(options), machine_(machine), frame_(frame), picture_(picture) {}

  /// Makes plans for these rows, and the picture's memory begin with them. Points of the grid that rows
  /// before have left there are not traced again.
  void plan(const RowRange& rows);
  /// Has all plans made anew: pictures are of another size or kind.
  void forget() { planned_ = {0, 0}; }

  /// The grid's points of all these rows are there, until forget_points().
  void keep_points(const RowRange& rows) { traced_ = grid_rows_of(rows); }
  void forget_points() { traced_ = {0, 0}; }
  /// Lines of the grid that the plan leaves out: pixels, which came with the rows before.
  std::uint32_t kept_lines() const;

  WorkPlan& grid() { return *grid_plan_; }
  /// The plan of blocks of pixels that are sampled, if the options ask for antialiasing.
  WorkPlan& samples() { return *sample_plan_; }

private:
  /// Bundles of the grid, by row: [begin, end).
  struct BundleRows {
    std::uint32_t begin = 0, end = 0;
    bool operator==(const BundleRows&) const = default;
    std::uint32_t count() const { return end - begin; }
  };

  /// All that the picture's rows need.
  BundleRows grid_rows_of(const RowRange& rows) const;
  /// Returns the first line of a row of bundles.
  std::uint32_t line_of(std::uint32_t bundle_row) const;

  const RenderOptions& options_;
  const Machine& machine_;
  const kernel::FrameBlock& frame_;
  PictureMemory& picture_;
  RowRange planned_ = {0, 0};
  BundleRows planned_grid_;
  BundleRows traced_; ///< of the grid, whose points are there
  std::unique_ptr<WorkPlan> grid_plan_, sample_plan_;
};

} // namespace celltrace

#include "render/frame_plan.hpp"

#include "kernel/strategy.hpp"
#include "render/picture_options.hpp"

namespace celltrace {

using namespace kernel;

FramePlan::BundleRows FramePlan::grid_rows_of(const RowRange& rows) const {
  const std::uint32_t height = bundle_edge(machine_.direct_memory()) * kPacketEdge;
  // The block of a pixel includes the points below and to the right of it.
  const std::uint32_t lines = static_cast<std::uint32_t>(rows.bottom) + (options_.antialiasing ? 1 : 0);
  return {static_cast<std::uint32_t>(rows.top) / height, (lines + height - 1) / height};
}

std::uint32_t FramePlan::line_of(std::uint32_t bundle_row) const {
  return bundle_row * bundle_edge(machine_.direct_memory()) * kPacketEdge;
}

void FramePlan::plan(const RowRange& rows) {
  BundleRows grid = grid_rows_of(rows);
  // If these rows follow earlier rows, the points on the border between them are in memory.
  const bool goes_on = traced_.begin <= grid.begin && grid.begin < traced_.end && traced_.end < grid.end;
  if (goes_on) grid.begin = traced_.end;
  picture_.begin_at(rows, goes_on ? line_of(grid.begin) : 0);
  if (planned_ == rows && planned_grid_ == grid) return;
  const unsigned spes = machine_.spe_count();
  // Computes the columns: the frame block has those of the last plan that was used, which may be a plan of
  // samples.
  const std::uint32_t edge = bundle_edge(machine_.direct_memory());
  grid_plan_ = std::make_unique<WorkPlan>(options_.balance, (frame_.packet_columns + edge - 1) / edge,
                                          grid.count(), spes, machine_.byte_order(), grid.begin);
  if (options_.antialiasing) {
    const auto blocks = [](int pixels) {
      return (static_cast<std::uint32_t>(pixels) + kSampledEdge - 1) / kSampledEdge;
    };
    const PictureRegion region = region_of(options_);
    const std::uint32_t first = static_cast<std::uint32_t>(rows.top) / kSampledEdge;
    sample_plan_ =
        std::make_unique<WorkPlan>(options_.balance, blocks(region.right - region.left),
                                   blocks(rows.bottom) - first, spes, machine_.byte_order(), first);
  }
  planned_ = rows;
  planned_grid_ = grid;
}

std::uint32_t FramePlan::kept_lines() const {
  if (planned_grid_.begin == grid_rows_of(planned_).begin) return 0;
  return line_of(planned_grid_.begin);
}

} // namespace celltrace

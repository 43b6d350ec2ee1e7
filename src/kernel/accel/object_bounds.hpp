// Bounds of objects, and the voxels of the grid that they touch. Kernel dialect.
#pragma once

#include "kernel/primitives/list.hpp"
#include "kernel/scalar_work.hpp"
#include "records/accelerator.hpp"
#include "records/object.hpp"

namespace celltrace::kernel {

/// Returns true if the object's ExtraRecord has bounds instead of a triangle's surface coordinates.
constexpr bool has_own_bounds(uint32_t flags) {
  constexpr uint32_t kMapped = object_flag::by_surface | static_cast<uint32_t>(ObjectKind::triangle);
  return (flags & object_flag::csg) != 0 &&
         (flags & (object_flag::by_surface | object_flag::kind_mask)) != kMapped;
}

/// Returns the axis-aligned bounding box of an object. `extra` is its ExtraRecord, if it has one.
inline Aabb bounding_box(const ObjectRecord& object, const ExtraRecord& extra = {}) {
  const float* limits = extra.bounds;
  Aabb box = {{limits[0], limits[1], limits[2]}, {limits[3], limits[4], limits[5]}};
  if (has_own_bounds(object.kind_and_flags)) return box;
  Primitives::dispatch(object.kind_and_flags & object_flag::kind_mask,
                       [&](auto shape) { box = decltype(shape)::bounds(object, extra); });
  return box;
}

/// Returns true if the object may touch a box; for some shapes also if the box is only near.
inline bool overlaps(const ObjectRecord& object, const Aabb& box, const ExtraRecord& extra = {}) {
  bool result = false;
  if ((object.kind_and_flags & object_flag::csg) != 0 || is_instance(object.kind_and_flags))
    return true; // any box within its bounds
  Primitives::dispatch(object.kind_and_flags & object_flag::kind_mask,
                       [&](auto shape) { result = decltype(shape)::overlaps(object, extra, box); });
  return result;
}

/// Returns the kind whose charges are used: shapes without charges of their own are charged as ellipsoids, to
/// which they are most similar.
inline uint32_t charged_kind(uint32_t kind) {
  constexpr auto kLast = static_cast<uint32_t>(ObjectKind::ellipsoid);
  return kind < kLast ? kind : kLast;
}

/// Calls `visit(cell)` for each voxel that the object touches. Voxels are extended by more than the rounding
/// errors of rays and points.
template <class Spu, class Visit>
void for_each_voxel(Spu& spu, const GridRecord& grid, const ObjectRecord& object, const ExtraRecord& extra,
                    Visit visit) {
  const uint32_t kind = charged_kind(object.kind_and_flags & object_flag::kind_mask);
  spu.compute(scalar_work::kBounds[kind]);
  const Aabb bounds = bounding_box(object, extra);
  int32_t low[3];
  int32_t high[3];
  float margin[3];
  for (int i = 0; i < 3; ++i) {
    margin[i] = 1e-3f * grid.cell_size[i];
    const float last = static_cast<float>(grid.cells[i] - 1);
    const float from = (bounds.min[i] - margin[i] - grid.min[i]) * grid.inverse_cell_size[i];
    const float to = (bounds.max[i] + margin[i] - grid.min[i]) * grid.inverse_cell_size[i];
    low[i] = static_cast<int32_t>(smaller(larger(from, 0.0f), last));
    high[i] = static_cast<int32_t>(smaller(larger(to, 0.0f), last));
  }
  const bool single = low[0] == high[0] && low[1] == high[1] && low[2] == high[2];
  uint32_t slice =
      static_cast<uint32_t>(low[2]) * grid.row_of_cells + static_cast<uint32_t>(low[1]) * grid.cells[0];
  for (int32_t z = low[2]; z <= high[2]; ++z, slice += grid.row_of_cells) {
    uint32_t row = slice;
    for (int32_t y = low[1]; y <= high[1]; ++y, row += grid.cells[0]) {
      for (int32_t x = low[0]; x <= high[0]; ++x) {
        if (!single) {
          spu.compute(scalar_work::kOverlap[kind]);
          const int32_t at[3] = {x, y, z};
          Aabb voxel;
          for (int i = 0; i < 3; ++i) {
            voxel.min[i] = grid.min[i] + static_cast<float>(at[i]) * grid.cell_size[i] - margin[i];
            voxel.max[i] = voxel.min[i] + grid.cell_size[i] + 2.0f * margin[i];
          }
          if (!overlaps(object, voxel, extra)) continue;
        }
        visit(row + static_cast<uint32_t>(x));
      }
    }
  }
}

} // namespace celltrace::kernel

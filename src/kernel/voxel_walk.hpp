// The way of one ray through the uniform grid (Amanatides and Woo, A Fast Voxel Traversal Algorithm, 1987).
// How to walk, not what to do in a voxel. Kernel dialect.
#pragma once

#include "kernel/records.hpp"

#include <stdint.h>

namespace celltrace::kernel {

/// Larger than any distance along a ray.
constexpr float kFarAway = 1e30f;

/// Visits the voxels that a ray from `origin` along `direction` passes, in order: `visit(cell, enter, leave)`
/// with the voxel's index and the ray's distances there returns true to stop. The first voxel is entered at
/// -kFarAway and the last one left at kFarAway, so that rounding at the grid's border loses nothing.
template <class Visit>
void walk_voxels(const GridRecord& grid, const float (&origin)[3], const float (&direction)[3], Visit visit) {
  float inverse[3];
  float enter = 0.0f;
  float leave = kFarAway;
  bool parallel[3];
  for (int axis = 0; axis < 3; ++axis) {
    parallel[axis] = direction[axis] < 1e-12f && direction[axis] > -1e-12f;
    if (parallel[axis]) {
      if (origin[axis] < grid.min[axis] || origin[axis] > grid.max[axis]) return;
      inverse[axis] = 0.0f;
      continue;
    }
    inverse[axis] = 1.0f / direction[axis];
    const float a = (grid.min[axis] - origin[axis]) * inverse[axis];
    const float b = (grid.max[axis] - origin[axis]) * inverse[axis];
    const float low = a < b ? a : b;
    const float high = a < b ? b : a;
    enter = low > enter ? low : enter;
    leave = high < leave ? high : leave;
  }
  if (enter > leave) return;

  const uint32_t strides[3] = {1, grid.cells[0], grid.row_of_cells};
  uint32_t cell = 0;
  int32_t position[3];
  int32_t step[3];
  float next[3]; // distance at which the ray leaves the voxel on this axis
  for (int axis = 0; axis < 3; ++axis) {
    const float offset = origin[axis] + direction[axis] * enter - grid.min[axis];
    // Clamped as a number, so that whatever it is converts.
    const float last = static_cast<float>(grid.cells[axis] - 1);
    const float at = offset * grid.inverse_cell_size[axis];
    position[axis] = static_cast<int32_t>(at > 0.0f ? (at < last ? at : last) : 0.0f);
    cell += static_cast<uint32_t>(position[axis]) * strides[axis];
    step[axis] = direction[axis] < 0.0f ? -1 : 1;
  }
  const auto border = [&](int axis) {
    // From the voxel's number, not by adding up steps: no drift over hundreds of voxels.
    const int32_t far_side = position[axis] + (step[axis] > 0 ? 1 : 0);
    return (grid.min[axis] + static_cast<float>(far_side) * grid.cell_size[axis] - origin[axis]) *
           inverse[axis];
  };
  for (int axis = 0; axis < 3; ++axis)
    next[axis] = parallel[axis] ? kFarAway : border(axis);

  float entered = -kFarAway;
  for (;;) {
    const int axis = next[0] < next[1] ? (next[0] < next[2] ? 0 : 2) : (next[1] < next[2] ? 1 : 2);
    const int32_t moved = position[axis] + step[axis];
    const bool inside = moved >= 0 && moved < static_cast<int32_t>(grid.cells[axis]) && next[axis] < kFarAway;
    if (visit(cell, entered, inside ? next[axis] : kFarAway) || !inside) return;
    entered = next[axis];
    position[axis] = moved;
    cell += static_cast<uint32_t>(step[axis]) * strides[axis];
    next[axis] = border(axis);
  }
}

} // namespace celltrace::kernel

// The way of one ray through the uniform grid (Amanatides and Woo, A Fast Voxel Traversal Algorithm, 1987).
// How to walk, not what to do in a voxel. Kernel dialect.
#pragma once

#include "kernel/records.hpp"

#include <stdint.h>

namespace celltrace::kernel {

/// Larger than any distance along a ray.
constexpr float kFarAway = 1e30f;

/// A ray on its way. The first voxel is entered at -kFarAway and the last one left at kFarAway, so that
/// rounding at the grid's border loses nothing.
class VoxelWalk {
public:
  /// Where a walk is: enough to go on with it elsewhere.
  struct Place {
    uint32_t position; ///< the voxel's coordinates, kPositionBits each
    float leave;
  };
  static constexpr uint32_t kPositionBits = 10;

  VoxelWalk(const GridRecord& grid, const float (&origin)[3], const float (&direction)[3])
      : grid_(grid), origin_(origin) {
    for (int axis = 0; axis < 3; ++axis) {
      parallel_[axis] = direction[axis] < 1e-12f && direction[axis] > -1e-12f;
      inverse_[axis] = parallel_[axis] ? 0.0f : 1.0f / direction[axis];
      step_[axis] = direction[axis] < 0.0f ? -1 : 1;
    }
    strides_[0] = 1;
    strides_[1] = grid.cells[0];
    strides_[2] = grid.row_of_cells;
  }

  /// Enters the grid; false if the ray misses it.
  bool start(const float (&direction)[3]) {
    float enter = 0.0f;
    float leave = kFarAway;
    for (int axis = 0; axis < 3; ++axis) {
      if (parallel_[axis]) {
        if (origin_[axis] < grid_.min[axis] || origin_[axis] > grid_.max[axis]) return false;
        continue;
      }
      const float a = (grid_.min[axis] - origin_[axis]) * inverse_[axis];
      const float b = (grid_.max[axis] - origin_[axis]) * inverse_[axis];
      const float low = a < b ? a : b;
      const float high = a < b ? b : a;
      enter = low > enter ? low : enter;
      leave = high < leave ? high : leave;
    }
    if (enter > leave) return false;
    for (int axis = 0; axis < 3; ++axis) {
      const float offset = origin_[axis] + direction[axis] * enter - grid_.min[axis];
      // Clamped as a number, so that whatever it is converts.
      const float last = static_cast<float>(grid_.cells[axis] - 1);
      const float at = offset * grid_.inverse_cell_size[axis];
      position_[axis] = static_cast<int32_t>(at > 0.0f ? (at < last ? at : last) : 0.0f);
    }
    be_in_voxel(-kFarAway);
    return true;
  }
  /// Stands where another walk of the same ray stood, and steps on; false as step().
  bool resume(const Place& place) {
    for (uint32_t axis = 0; axis < 3; ++axis)
      position_[axis] = static_cast<int32_t>(place.position >> (axis * kPositionBits) & kPositionMask);
    be_in_voxel(0.0f);
    leave_ = place.leave;
    return step();
  }

  /// The voxel's index, and the ray's distances there.
  uint32_t cell() const { return cell_; }
  float enter() const { return enter_; }
  float leave() const { return leave_; }
  Place place() const {
    uint32_t packed = 0;
    for (uint32_t axis = 0; axis < 3; ++axis)
      packed |= static_cast<uint32_t>(position_[axis]) << (axis * kPositionBits);
    return {packed, leave_};
  }

  /// To the next voxel; false if there is none.
  bool step() {
    if (leave_ >= kFarAway) return false;
    enter_ = leave_;
    position_[axis_] += step_[axis_];
    cell_ += static_cast<uint32_t>(step_[axis_]) * strides_[axis_];
    next_[axis_] = border(axis_);
    choose_axis();
    return true;
  }

private:
  static constexpr uint32_t kPositionMask = (1u << kPositionBits) - 1;

  void be_in_voxel(float enter) {
    cell_ = 0;
    for (int axis = 0; axis < 3; ++axis) {
      cell_ += static_cast<uint32_t>(position_[axis]) * strides_[axis];
      next_[axis] = parallel_[axis] ? kFarAway : border(axis);
    }
    enter_ = enter;
    choose_axis();
  }
  /// The axis on which the ray leaves the voxel, and where.
  void choose_axis() {
    axis_ = next_[0] < next_[1] ? (next_[0] < next_[2] ? 0 : 2) : (next_[1] < next_[2] ? 1 : 2);
    const int32_t moved = position_[axis_] + step_[axis_];
    const bool inside =
        moved >= 0 && moved < static_cast<int32_t>(grid_.cells[axis_]) && next_[axis_] < kFarAway;
    leave_ = inside ? next_[axis_] : kFarAway;
  }
  /// The distance at which the ray leaves the voxel on an axis: from the voxel's number, not by adding up
  /// steps, so that it does not drift over hundreds of voxels.
  float border(int axis) const {
    const int32_t far_side = position_[axis] + (step_[axis] > 0 ? 1 : 0);
    return (grid_.min[axis] + static_cast<float>(far_side) * grid_.cell_size[axis] - origin_[axis]) *
           inverse_[axis];
  }

  const GridRecord& grid_;
  const float (&origin_)[3];
  float inverse_[3];
  bool parallel_[3];
  int32_t step_[3];
  uint32_t strides_[3];
  uint32_t cell_ = 0;
  int32_t position_[3];
  float next_[3];
  float enter_ = 0.0f;
  float leave_ = 0.0f;
  int axis_ = 0;
};

/// Visits the voxels that a ray from `origin` along `direction` passes, in order: `visit(cell, enter, leave)`
/// returns true to stop.
template <class Visit>
void walk_voxels(const GridRecord& grid, const float (&origin)[3], const float (&direction)[3], Visit visit) {
  VoxelWalk walk(grid, origin, direction);
  if (!walk.start(direction)) return;
  while (!visit(walk.cell(), walk.enter(), walk.leave()) && walk.step()) {
  }
}

} // namespace celltrace::kernel

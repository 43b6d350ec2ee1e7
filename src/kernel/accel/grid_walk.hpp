// Steps of a packet's rays through the uniform grid by a 3D DDA (Amanatides and Woo, A Fast Voxel Traversal
// Algorithm for Ray Tracing, 1987). Each lane is in a voxel of its own, and all lanes step at once. The
// caller decides what to do in a voxel. Kernel dialect.
#pragma once

#include "kernel/packet.hpp"
#include "records/accelerator.hpp"

#include <stdint.h>

namespace celltrace::kernel {

/// Distance that is larger than any along a ray.
constexpr float kFarAway = 1e30f;

/// The voxels that the rays of a packet are in. A ray enters a voxel at the distance at which it leaves the
/// previous one. The first voxel is entered at -kFarAway and the last one left at kFarAway, so that rounding
/// hides no hit at the border of the grid.
template <class S> class VoxelWalk {
public:
  using F = typename S::F;
  using I = typename S::I;
  using M = typename S::M;

  /// Starts `lanes` where their rays enter the grid.
  VoxelWalk(const GridRecord& grid, const RayPacket& rays, uint32_t lanes) {
    const V3<S> origin = rays.origin.template load<S>();
    const V3<S> direction = rays.direction.template load<S>();
    const GridSpan span = cross_slabs(grid, origin, direction);
    lanes_ = lanes & ((!span.outside) & (span.enter <= span.leave)).bits();
    if (lanes_ == 0) return;
    const V3<S> at = origin + direction * span.enter;
    set_voxels(grid, direction, {voxel_at(grid, 0, at.x), voxel_at(grid, 1, at.y), voxel_at(grid, 2, at.z)});
  }
  /// Continues `lanes` at the place() of another walk of the same rays.
  VoxelWalk(const GridRecord& grid, const RayPacket& rays, uint32_t lanes, const I& place) : lanes_(lanes) {
    const V3<S> direction = rays.direction.template load<S>();
    cross_slabs(grid, rays.origin.template load<S>(), direction);
    const I mask = I::splat((1 << kPlaceBits) - 1);
    set_voxels(grid, direction,
               {S::to_float(place & mask), S::to_float(S::template shift_right<kPlaceBits>(place) & mask),
                S::to_float(S::template shift_right<2 * kPlaceBits>(place) & mask)});
  }

  /// Returns the rays that are in the grid; the results of other lanes are undefined.
  uint32_t lanes() const { return lanes_; }
  /// Return the indices of the voxels, and the distances at which the rays leave them.
  const I& cell() const { return cell_; }
  const F& leave() const { return leave_; }

  /// Returns the coordinates of the voxels, 10 bits each, from which another walk can continue.
  I place(const GridRecord& grid) const {
    return x_.voxel(grid.cells[0]) | S::template shift_left<kPlaceBits>(y_.voxel(grid.cells[1])) |
           S::template shift_left<2 * kPlaceBits>(z_.voxel(grid.cells[2]));
  }

  /// Steps `lanes` to their next voxels and drops all other lanes. Each ray must have a next voxel. A ray
  /// leaves its last voxel at kFarAway, beyond any hit and any light.
  void step(uint32_t lanes) {
    lanes_ = lanes;
    cell_ = cell_ + of_axis(x_.stride, y_.stride, z_.stride);
    const F one(1.0f), zero(0.0f);
    x_.steps = x_.steps - S::select(x_before_y_ & xy_before_z_, one, zero);
    y_.steps = y_.steps - S::select((!x_before_y_) & xy_before_z_, one, zero);
    z_.steps = z_.steps - S::select(xy_before_z_, zero, one);
    choose_axis(x_.border(), y_.border(), z_.border());
  }

private:
  static constexpr int kPlaceBits = 10;

  struct Axis {
    F steps;   ///< voxels between the current one and the grid's border
    F last;    ///< distance to the grid's border
    F spacing; ///< distance between planes of voxels
    I stride;  ///< difference of index between a voxel and the next

    /// Returns the distance at which the voxel is left. The distance is computed from the voxel's number, as
    /// a sum of steps would drift over hundreds of voxels.
    F border() const { return last - steps * spacing; }
    I voxel(uint32_t cells) const {
      const F forward = F(static_cast<float>(cells - 1)) - steps;
      return S::to_int(S::select(stride < I::splat(0), steps, forward));
    }
  };

  /// The segments of the rays in the grid, from `enter` to `leave`. Rays that are `outside` have no segment.
  struct GridSpan {
    F enter, leave;
    M outside;
  };
  GridSpan cross_slabs(const GridRecord& grid, const V3<S>& origin, const V3<S>& direction) {
    GridSpan span = {F(0.0f), F(kFarAway), M::none()};
    cross_slab(grid, 0, origin.x, direction.x, x_, span);
    cross_slab(grid, 1, origin.y, direction.y, y_, span);
    cross_slab(grid, 2, origin.z, direction.z, z_, span);
    return span;
  }
  static void cross_slab(const GridRecord& grid, int axis, const F& origin, const F& direction, Axis& a,
                         GridSpan& span) {
    const F low(grid.min[axis]), high(grid.max[axis]);
    const M parallel = S::abs(direction) < F(1e-12f);
    const F inverse = F(1.0f) / S::select(parallel, F(1.0f), direction);
    const F to_low = (low - origin) * inverse;
    const F to_high = (high - origin) * inverse;
    span.enter = S::select(parallel, span.enter, S::max(span.enter, S::min(to_low, to_high)));
    span.leave = S::select(parallel, span.leave, S::min(span.leave, S::max(to_low, to_high)));
    span.outside = span.outside | (parallel & ((origin < low) | (origin > high)));
    // The grid's border is computed as the borders of its voxels are, so that both agree.
    const M backward = direction < F(0.0f);
    const F far_border(grid.min[axis] + static_cast<float>(grid.cells[axis]) * grid.cell_size[axis]);
    a.last = S::select(parallel, F(kFarAway), (S::select(backward, low, far_border) - origin) * inverse);
    a.spacing = S::select(parallel, F(0.0f), S::abs(inverse) * F(grid.cell_size[axis]));
  }
  /// Returns the number of the voxel that contains a scene coordinate.
  static F voxel_at(const GridRecord& grid, int axis, const F& at) {
    // The number is clamped before the conversion, which is undefined for large numbers.
    const F last(static_cast<float>(grid.cells[axis] - 1));
    const F voxels = (at - F(grid.min[axis])) * F(grid.inverse_cell_size[axis]);
    return S::to_float(S::to_int(S::max(S::min(voxels, last), F(0.0f))));
  }
  void set_voxels(const GridRecord& grid, const V3<S>& direction, const V3<S>& voxel) {
    // Indices of voxels are exact in single precision: there are at most 2^24.
    F cell = set_axis(grid, 0, 1, voxel.x, direction.x, x_);
    cell = cell + set_axis(grid, 1, grid.cells[0], voxel.y, direction.y, y_);
    cell = cell + set_axis(grid, 2, grid.row_of_cells, voxel.z, direction.z, z_);
    cell_ = S::to_int(cell);
    choose_axis(x_.border(), y_.border(), z_.border());
  }
  /// Initialises one axis. Returns the coordinate's part of the voxel's index.
  static F set_axis(const GridRecord& grid, int axis, uint32_t stride, const F& voxel, const F& direction,
                    Axis& a) {
    const M backward = direction < F(0.0f);
    a.steps = S::select(backward, voxel, F(static_cast<float>(grid.cells[axis] - 1)) - voxel);
    const auto step = static_cast<int32_t>(stride);
    a.stride = S::select(backward, I::splat(-step), I::splat(step));
    return voxel * F(static_cast<float>(stride));
  }

  /// Finds the axis on which each ray leaves its voxel, and the distance.
  void choose_axis(const F& x, const F& y, const F& z) {
    x_before_y_ = x < y;
    const F nearer = S::select(x_before_y_, x, y);
    xy_before_z_ = nearer < z;
    const M more = of_axis(x_.steps, y_.steps, z_.steps) > F(0.0f);
    leave_ = S::select(more, S::select(xy_before_z_, nearer, z), F(kFarAway));
  }
  /// Returns the value for the axis on which each ray leaves its voxel.
  template <class Lanes> Lanes of_axis(const Lanes& x, const Lanes& y, const Lanes& z) const {
    return S::select(xy_before_z_, S::select(x_before_y_, x, y), z);
  }

  Axis x_, y_, z_;
  I cell_;
  F leave_;
  M x_before_y_, xy_before_z_; ///< order of the distances to the voxel's planes
  uint32_t lanes_;
};

} // namespace celltrace::kernel

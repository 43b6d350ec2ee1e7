// The ways of a packet's rays through the uniform grid (Amanatides and Woo, A Fast Voxel Traversal Algorithm,
// 1987), all of them at a time: each lane is in a voxel of its own, and they step together. How to walk, not
// what to do in a voxel. Kernel dialect.
#pragma once

#include "kernel/packet.hpp"

#include <stdint.h>

namespace celltrace::kernel {

/// Larger than any distance along a ray.
constexpr float kFarAway = 1e30f;

/// A packet on its way. A voxel is entered where the one before was left, the first one at -kFarAway, and the
/// last one is left at kFarAway, so that rounding at the grid's border loses nothing.
template <class S> class VoxelWalk {
public:
  using F = typename S::F;
  using I = typename S::I;
  using M = typename S::M;

  /// Enters the grid with `lanes`.
  VoxelWalk(const GridRecord& grid, const RayPacket& rays, uint32_t lanes) {
    const V3<S> origin = rays.origin.template load<S>();
    const V3<S> direction = rays.direction.template load<S>();
    const Way way = cross_slabs(grid, origin, direction);
    lanes_ = lanes & ((!way.outside) & (way.enter <= way.leave)).bits();
    if (lanes_ == 0) return;
    const V3<S> at = origin + direction * way.enter;
    be_in_voxels(grid, direction,
                 {voxel_at(grid, 0, at.x), voxel_at(grid, 1, at.y), voxel_at(grid, 2, at.z)});
  }
  /// Stands with `lanes` where another walk of the same rays stood, by its place().
  VoxelWalk(const GridRecord& grid, const RayPacket& rays, uint32_t lanes, const I& place) : lanes_(lanes) {
    const V3<S> direction = rays.direction.template load<S>();
    cross_slabs(grid, rays.origin.template load<S>(), direction);
    const I mask = I::splat((1 << kPlaceBits) - 1);
    be_in_voxels(grid, direction,
                 {S::to_float(place & mask), S::to_float(S::template shift_right<kPlaceBits>(place) & mask),
                  S::to_float(S::template shift_right<2 * kPlaceBits>(place) & mask)});
  }

  /// The rays that are in the grid; what follows is meaningless for all others.
  uint32_t lanes() const { return lanes_; }
  /// The voxels' indices, and the distances at which the rays leave them.
  const I& cell() const { return cell_; }
  const F& leave() const { return leave_; }

  /// The coordinates of the voxels: enough to go on with the walk elsewhere.
  I place(const GridRecord& grid) const {
    return x_.voxel(grid.cells[0]) | S::template shift_left<kPlaceBits>(y_.voxel(grid.cells[1])) |
           S::template shift_left<2 * kPlaceBits>(z_.voxel(grid.cells[2]));
  }

  /// Takes `lanes` to their next voxels and leaves the others behind. There has to be a next one: the last
  /// one is not left before kFarAway, farther than anyone looks.
  void step(uint32_t lanes) {
    lanes_ = lanes;
    cell_ = cell_ + of_axis(x_.stride, y_.stride, z_.stride);
    const F one(1.0f), zero(0.0f);
    x_.steps = x_.steps - S::select(first_before_second_ & two_before_third_, one, zero);
    y_.steps = y_.steps - S::select((!first_before_second_) & two_before_third_, one, zero);
    z_.steps = z_.steps - S::select(two_before_third_, zero, one);
    choose_axis(x_.border(), y_.border(), z_.border());
  }

private:
  static constexpr int kPlaceBits = 10;

  struct Axis {
    F steps;  ///< how many voxels are left to the grid's border
    F last;   ///< the distance of that border
    F apart;  ///< how far borders of voxels are apart
    I stride; ///< from a voxel's index to the next one's

    /// The distance of the voxel's own border: from the voxel's number, not by adding up steps, so that it
    /// does not drift over hundreds of voxels.
    F border() const { return last - steps * apart; }
    I voxel(uint32_t cells) const {
      const F forth = F(static_cast<float>(cells - 1)) - steps;
      return S::to_int(S::select(stride < I::splat(0), steps, forth));
    }
  };

  /// What of the rays lies in the grid: from `enter` to `leave`, but for those that are outside.
  struct Way {
    F enter, leave;
    M outside;
  };
  Way cross_slabs(const GridRecord& grid, const V3<S>& origin, const V3<S>& direction) {
    Way way = {F(0.0f), F(kFarAway), M::none()};
    cross_slab(grid, 0, origin.x, direction.x, x_, way);
    cross_slab(grid, 1, origin.y, direction.y, y_, way);
    cross_slab(grid, 2, origin.z, direction.z, z_, way);
    return way;
  }
  static void cross_slab(const GridRecord& grid, int axis, const F& origin, const F& direction, Axis& a,
                         Way& way) {
    const F low(grid.min[axis]), high(grid.max[axis]);
    const M parallel = S::abs(direction) < F(1e-12f);
    const F inverse = F(1.0f) / S::select(parallel, F(1.0f), direction);
    const F to_low = (low - origin) * inverse;
    const F to_high = (high - origin) * inverse;
    way.enter = S::select(parallel, way.enter, S::max(way.enter, S::min(to_low, to_high)));
    way.leave = S::select(parallel, way.leave, S::min(way.leave, S::max(to_low, to_high)));
    way.outside = way.outside | (parallel & ((origin < low) | (origin > high)));
    // The grid's borders as those of voxels are.
    const M back = direction < F(0.0f);
    const F far_border(grid.min[axis] + static_cast<float>(grid.cells[axis]) * grid.cell_size[axis]);
    a.last = S::select(parallel, F(kFarAway), (S::select(back, low, far_border) - origin) * inverse);
    a.apart = S::select(parallel, F(0.0f), S::abs(inverse) * F(grid.cell_size[axis]));
  }
  /// The coordinate of the voxel that is at a coordinate.
  static F voxel_at(const GridRecord& grid, int axis, const F& at) {
    // Clamped as a number, so that whatever it is converts.
    const F last(static_cast<float>(grid.cells[axis] - 1));
    const F voxels = (at - F(grid.min[axis])) * F(grid.inverse_cell_size[axis]);
    return S::to_float(S::to_int(S::max(S::min(voxels, last), F(0.0f))));
  }
  void be_in_voxels(const GridRecord& grid, const V3<S>& direction, const V3<S>& voxel) {
    // Numbers of voxels are exact as floats: there are no more than 2^24.
    F cell = stand(grid, 0, 1, voxel.x, direction.x, x_);
    cell = cell + stand(grid, 1, grid.cells[0], voxel.y, direction.y, y_);
    cell = cell + stand(grid, 2, grid.row_of_cells, voxel.z, direction.z, z_);
    cell_ = S::to_int(cell);
    choose_axis(x_.border(), y_.border(), z_.border());
  }
  /// Returns what the coordinate adds to the voxel's index.
  static F stand(const GridRecord& grid, int axis, uint32_t stride, const F& voxel, const F& direction,
                 Axis& a) {
    const M back = direction < F(0.0f);
    a.steps = S::select(back, voxel, F(static_cast<float>(grid.cells[axis] - 1)) - voxel);
    const auto step = static_cast<int32_t>(stride);
    a.stride = S::select(back, I::splat(-step), I::splat(step));
    return voxel * F(static_cast<float>(stride));
  }

  /// The axes on which the rays leave their voxels, and where.
  void choose_axis(const F& x, const F& y, const F& z) {
    first_before_second_ = x < y;
    const F nearer = S::select(first_before_second_, x, y);
    two_before_third_ = nearer < z;
    const M more = of_axis(x_.steps, y_.steps, z_.steps) > F(0.0f);
    leave_ = S::select(more, S::select(two_before_third_, nearer, z), F(kFarAway));
  }
  /// That of the axis on which each ray leaves its voxel.
  template <class Lanes> Lanes of_axis(const Lanes& x, const Lanes& y, const Lanes& z) const {
    return S::select(two_before_third_, S::select(first_before_second_, x, y), z);
  }

  Axis x_, y_, z_;
  I cell_;
  F leave_;
  M first_before_second_, two_before_third_; ///< of the three axes' borders
  uint32_t lanes_;
};

} // namespace celltrace::kernel

// Packets through the uniform grid. Kernel dialect.
//
// The rays of a packet walk the grid side by side, each through voxels of its own. An object met by one of
// them is tested against the whole packet, and a mailbox per packet (Amanatides and Woo) keeps the others
// from testing it again. Each lane keeps the nearest of all tested hits and stops once that lies in the voxel
// it is in.
#pragma once

#include "kernel/accel/object_tests.hpp"
#include "kernel/accel/grid_walk.hpp"

namespace celltrace::kernel {

template <class Spu> class GridTraversal {
public:
  using S = typename Spu::simd;
  using F = typename S::F;
  using I = typename S::I;

  GridTraversal(ObjectTests<Spu>& objects, const GridRecord& grid)
      : objects_(objects), scene_(objects.scene()), grid_(grid) {}

  // Not inlined: what a walk has on the stack is not there in what callers do apart from it.

  /// As Traversal's, into hits that hold none yet.
  [[gnu::noinline]] void find_closest(const RayPacket& rays, uint32_t lanes, HitPacket& hits) {
    objects_.hit_filter().begin_packet();
    walk(rays, lanes, [&](const VoxelWalk<S>& at, uint32_t listing) {
      for_each_cell(at.cell(), listing, [&](uint32_t cell, uint32_t) { find_closest_in(cell, rays, hits); });
      return (F::load(hits.distance.lane) > at.leave()).bits();
    });
  }

  /// As Traversal's; returns the lanes to which some light comes.
  [[gnu::noinline]] uint32_t transmittance(const RayPacket& rays, uint32_t lanes, const FloatLanes& distance,
                                       VectorLanes& light) {
    objects_.hit_filter().begin_packet();
    uint32_t lit = lanes;
    FloatLanes enter, leave;
    F(-kFarAway).store(leave.lane);
    walk(rays, lanes, [&](const VoxelWalk<S>& at, uint32_t listing) {
      enter = leave;
      at.leave().store(leave.lane);
      for_each_cell(at.cell(), listing, [&](uint32_t cell, uint32_t there) {
        transmittance_in(cell, there, enter, leave, rays, distance, light, lit);
      });
      return (F::load(distance.lane) > at.leave()).bits() & lit;
    });
    return lit;
  }

  // --- one voxel, for whoever does not walk; objects_.mailbox() says what it has seen of the packet ---

  void find_closest_in(uint32_t cell, const RayPacket& rays, HitPacket& hits) {
    for_each_object(cell, [&](uint32_t self) {
      if (objects_.hit_filter().first_test(self)) objects_.test_closest(rays, self, hits);
      return false;
    });
  }
  /// For the rays of `lanes`, which are in the voxel from `enter` to `leave`. Takes the lanes that are shut
  /// off from the light out of `lit`.
  void transmittance_in(uint32_t cell, uint32_t lanes, const FloatLanes& enter, const FloatLanes& leave,
                    const RayPacket& rays, const FloatLanes& distance, VectorLanes& light, uint32_t& lit) {
    if ((lanes & lit) == 0) return;
    for_each_object(cell, [&](uint32_t self) {
      lit &= ~objects_.occluded(rays, self, lanes & lit, distance, light, {&enter, &leave});
      return (lanes & lit) == 0;
    });
  }

private:
  /// Calls `visit(walk, lanes in voxels that list objects)` after every step. It returns the lanes that go
  /// on, which may not be those that are in their last voxel.
  template <class Visit> void walk(const RayPacket& rays, uint32_t lanes, Visit visit) {
    scene_.spu().compute(scalar_work::kVoxelWalk);
    uint64_t voxels = 0;
    VoxelWalk<S> walk(grid_, rays, lanes);
    if (walk.lanes() == 0) return;
    for (;;) {
      scene_.spu().compute(scalar_work::kPacketStep);
      voxels += static_cast<uint32_t>(__builtin_popcount(walk.lanes()));
      const uint32_t empty = (scene_.listed_in(grid_, walk.cell(), walk.lanes()) == I::splat(0)).bits();
      const uint32_t onward = walk.lanes() & visit(walk, walk.lanes() & ~empty);
      if (onward == 0) break;
      walk.step(onward);
    }
    objects_.counters().visits += voxels;
  }

  /// Splits `lanes` by the voxel that they are in.
  template <class Visit> void for_each_cell(const I& cells, uint32_t lanes, Visit visit) {
    if (lanes == 0) return;
    WordLanes each;
    cells.store(reinterpret_cast<int32_t*>(each.lane));
    while (lanes != 0) {
      scene_.spu().compute(scalar_work::kVoxelOfPacket);
      const uint32_t cell = each.lane[__builtin_ctz(lanes)];
      const uint32_t there = lanes & (cells == I::splat(static_cast<int32_t>(cell))).bits();
      lanes &= ~there;
      visit(cell, there);
    }
  }

  /// Calls `visit(object offset)` for the objects of a voxel until it returns true.
  template <class Visit> void for_each_object(uint32_t cell, Visit visit) {
    const CellRecord list = scene_.cell(grid_, cell);
    scene_.for_each_listed(list.list, list.count, visit);
  }

  ObjectTests<Spu>& objects_;
  SceneAccess<Spu>& scene_;
  const GridRecord& grid_;
};

} // namespace celltrace::kernel

// Traversal of the uniform grid with packets. Kernel dialect.
//
// All rays of a packet step at once, each through voxels of its own. An object in a voxel of one ray is
// tested against the whole packet. The hit filter keeps rays that come to the object later from testing it
// again. A ray stops when its closest hit lies within its current voxel.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/accel/grid_walk.hpp"
#include "kernel/accel/object_tests.hpp"

namespace celltrace::kernel {

template <class Spu> class GridTraversal {
public:
  using S = typename Spu::simd;
  using F = typename S::F;
  using I = typename S::I;

  GridTraversal(ObjectTests<Spu>& objects, const GridRecord& grid)
      : objects_(objects), scene_(objects.scene()), grid_(grid) {}

  // The functions are not inlined: the stack frame of a traversal would otherwise always be part of the
  // caller's.

  /// Finds closest hits as Traversal::find_closest() does; `hits` have been reset.
  CELLTRACE_ONE_COPY void find_closest(const RayPacket& rays, uint32_t lanes, HitPacket& hits) {
    objects_.hit_filter().begin_packet();
    walk(rays, lanes, [&](const VoxelWalk<S>& at, uint32_t listing) {
      for_each_cell(at.cell(), listing, [&](uint32_t cell, uint32_t) { find_closest_in(cell, rays, hits); });
      return (F::load(hits.distance.lane) > at.leave()).bits();
    });
  }

  /// Multiplies `light` as Traversal::transmittance() does. Returns the lanes that are not occluded.
  CELLTRACE_ONE_COPY uint32_t transmittance(const RayPacket& rays, uint32_t lanes, const FloatLanes& distance,
                                            VectorLanes& light) {
    objects_.hit_filter().begin_packet();
    uint32_t lit = lanes;
    FloatLanes enter, leave;
    F(-kFarAway).store(leave.lane);
    walk(rays, lanes, [&](const VoxelWalk<S>& at, uint32_t listing) {
      enter = leave;
      at.leave().store(leave.lane);
      for_each_cell(at.cell(), listing, [&](uint32_t cell, uint32_t inside) {
        transmittance_in(cell, inside, enter, leave, rays, distance, light, lit);
      });
      return (F::load(distance.lane) > at.leave()).bits() & lit;
    });
    return lit;
  }

  // --- one voxel, for callers that step through the grid; the hit filter has to know the packet ---

  /// Tests the objects of a voxel for closest hits.
  void find_closest_in(uint32_t cell, const RayPacket& rays, HitPacket& hits) {
    for_each_object(cell, [&](uint32_t self) {
      if (objects_.hit_filter().first_test(self)) objects_.test_closest(rays, self, hits);
      return false;
    });
  }
  /// Tests the objects of a voxel against the shadow rays in `lanes`, which are in the voxel from `enter` to
  /// `leave`. Removes occluded lanes from `lit`.
  void transmittance_in(uint32_t cell, uint32_t lanes, const FloatLanes& enter, const FloatLanes& leave,
                        const RayPacket& rays, const FloatLanes& distance, VectorLanes& light,
                        uint32_t& lit) {
    if ((lanes & lit) == 0) return;
    for_each_object(cell, [&](uint32_t self) {
      lit &= ~objects_.occluded(rays, self, lanes & lit, distance, light, {&enter, &leave});
      return (lanes & lit) == 0;
    });
  }

private:
  /// Steps through the grid and calls `visit(walk, lanes whose voxels are not empty)` in all voxels. `visit`
  /// returns the lanes that continue; rays in their last voxel must not be among them.
  template <class Visit> void walk(const RayPacket& rays, uint32_t lanes, Visit visit) {
    scene_.spu().compute(scalar_work::kVoxelWalk);
    uint64_t voxels = 0;
    VoxelWalk<S> walk(grid_, rays, lanes);
    if (walk.lanes() == 0) return;
    for (;;) {
      scene_.spu().compute(scalar_work::kPacketStep);
      voxels += static_cast<uint32_t>(__builtin_popcount(walk.lanes()));
      const uint32_t empty = (scene_.listed_in(grid_, walk.cell(), walk.lanes()) == I::splat(0)).bits();
      const uint32_t continuing = walk.lanes() & visit(walk, walk.lanes() & ~empty);
      if (continuing == 0) break;
      walk.step(continuing);
    }
    objects_.counters().visits += voxels;
  }

  /// Calls `visit(cell, lanes in it)` for each voxel that some of `lanes` are in.
  template <class Visit> void for_each_cell(const I& cells, uint32_t lanes, Visit visit) {
    if (lanes == 0) return;
    WordLanes each;
    store_words<S>(each, cells);
    while (lanes != 0) {
      scene_.spu().compute(scalar_work::kVoxelOfPacket);
      const uint32_t cell = each.lane[__builtin_ctz(lanes)];
      const uint32_t inside = lanes & (cells == I::splat(static_cast<int32_t>(cell))).bits();
      lanes &= ~inside;
      visit(cell, inside);
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

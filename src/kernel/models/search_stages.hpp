// What an SPE does with a search: all of it; or, in the split pipeline, one of its halves. Kernel dialect.
//
// Split, one SPE walks every ray to the next voxel that has objects, another one tests these and sends the
// rays back that hit nothing there: neither knows what the other does.
#pragma once

#include "kernel/models/model_work.hpp"
#include "kernel/models/search_record.hpp"
#include "kernel/models/stage_block.hpp"
#include "kernel/traversal.hpp"

namespace celltrace::kernel::models {

/// Walks and tests, by any accelerator.
template <class Spu> class WholeSearch {
public:
  using S = typename Spu::simd;

  WholeSearch(SceneAccess<Spu>& scene, const FrameBlock& frame) : traversal_(scene, frame) {}

  void run(SearchRecord& search) {
    if (static_cast<SearchKind>(search.kind) == SearchKind::closest)
      traversal_.find_closest(search.rays, search.lanes, search.hits);
    else
      traversal_.attenuate(search.rays, search.lanes, search.light.distance, search.light.colour);
  }

  const TraversalCounters& counters() const { return traversal_.counters(); }

private:
  Traversal<Spu> traversal_;
};

/// Primary rays that hit something, and that were ever sent back.
inline void count_primary(const SearchRecord& search, StageReport& report) {
  if (search.primary == 0) return;
  uint32_t hits = 0;
  for_each_lane(search.lanes, [&](uint32_t lane) {
    hits |= static_cast<uint32_t>(search.hits.object.lane[lane] != kNoOffset) << lane;
  });
  const auto count = [](uint32_t lanes) { return static_cast<uint32_t>(__builtin_popcount(lanes)); };
  report.primary_hits += count(hits);
  report.primary_returned += count(search.returned);
  report.primary_hits_returned += count(search.returned & hits);
}

/// How far a ray has to be looked at: to its closest hit yet, or to the light.
inline float limit_of(const SearchRecord& search, uint32_t lane) {
  return static_cast<SearchKind>(search.kind) == SearchKind::closest ? search.hits.distance.lane[lane]
                                                                     : search.light.distance.lane[lane];
}

/// Takes the pending rays to their next voxels.
template <class Spu> class GridWalk {
public:
  using S = typename Spu::simd;

  GridWalk(SceneAccess<Spu>& scene, const FrameBlock& frame) : scene_(scene), grid_(frame.grid) {}

  /// Rays that leave the grid are no longer pending.
  void run(SearchRecord& search) {
    const bool begins = search.walked == 0;
    if (begins) begin(search);
    uint32_t in_voxels = 0;
    for_each_lane(search.pending, [&](uint32_t lane) {
      if (go_on(search, lane, begins)) in_voxels |= 1u << lane;
    });
    search.pending = in_voxels;
  }

  uint64_t voxels() const { return voxels_; }

private:
  static void begin(SearchRecord& search) {
    search.walked = 1;
    search.pending = search.lanes;
    search.lit = search.lanes;
    search.returned = 0;
    if (static_cast<SearchKind>(search.kind) != SearchKind::closest) return;
    typename S::F(kMaxHitDistance).store(search.hits.distance.lane);
    S::I::splat(-1).store(reinterpret_cast<int32_t*>(search.hits.object.lane));
  }

  /// True if the ray is in a voxel that has objects.
  bool go_on(SearchRecord& search, uint32_t lane, bool begins) {
    const RayPacket& rays = search.rays;
    const float origin[3] = {rays.origin.x.lane[lane], rays.origin.y.lane[lane], rays.origin.z.lane[lane]};
    const float direction[3] = {rays.direction.x.lane[lane], rays.direction.y.lane[lane],
                                rays.direction.z.lane[lane]};
    scene_.spu().compute(scalar_work::kWalk);
    VoxelWalk walk(grid_, origin, direction);
    bool inside =
        begins ? walk.start(direction) : walk.resume({search.place.lane[lane], search.leave.lane[lane]});
    for (; inside; inside = walk.step()) {
      ++voxels_;
      scene_.spu().compute(scalar_work::kVoxel);
      if (scene_.cell(grid_, walk.cell()).count != 0) {
        hand_over(walk, lane, search);
        return true;
      }
      if (limit_of(search, lane) <= walk.leave()) return false;
    }
    return false;
  }
  void hand_over(const VoxelWalk& walk, uint32_t lane, SearchRecord& search) {
    scene_.spu().compute(model_work::kHandOver);
    search.cell.lane[lane] = walk.cell();
    search.place.lane[lane] = walk.place().position;
    search.enter.lane[lane] = walk.enter();
    search.leave.lane[lane] = walk.leave();
  }

  SceneAccess<Spu>& scene_;
  const GridRecord& grid_;
  uint64_t voxels_ = 0;
};

/// Tests the pending rays against the objects of the voxels that they are in.
template <class Spu> class VoxelTests {
public:
  using S = typename Spu::simd;
  using F = typename S::F;

  VoxelTests(SceneAccess<Spu>& scene, const FrameBlock& frame)
      : objects_(scene), grid_(objects_, frame.grid) {}

  /// Rays that need to go no farther are no longer pending.
  void run(SearchRecord& search) {
    objects_.mailbox().begin_packet();
    if (static_cast<SearchKind>(search.kind) == SearchKind::closest)
      find_closest(search);
    else
      attenuate(search);
    uint32_t back = 0;
    for_each_lane(search.pending, [&](uint32_t lane) {
      back |= static_cast<uint32_t>(limit_of(search, lane) > search.leave.lane[lane]) << lane;
    });
    search.pending = back;
    search.returned |= back;
    returns_ += static_cast<uint32_t>(__builtin_popcount(back));
  }

  uint64_t returns() const { return returns_; }
  const TraversalCounters& counters() const { return objects_.counters(); }

private:
  void find_closest(SearchRecord& search) {
    for_each_value(search.cell, search.pending,
                   [&](uint32_t cell, uint32_t) { grid_.find_closest_in(cell, search.rays, search.hits); });
  }
  void attenuate(SearchRecord& search) {
    for_each_value(search.cell, search.pending, [&](uint32_t cell, uint32_t lanes) {
      grid_.attenuate_in(cell, lanes, search.enter, search.leave, search.rays, search.light.distance,
                         search.light.colour, search.lit);
    });
    search.pending &= search.lit;
    const V3<S> dark = {F(0.0f), F(0.0f), F(0.0f)};
    VectorLanes& colour = search.light.colour;
    colour.template store<S>(select<S>(S::M::from_bits(search.lit), colour.template load<S>(), dark));
  }

  ObjectTests<Spu> objects_;
  GridTraversal<Spu> grid_;
  uint64_t returns_ = 0;
};

} // namespace celltrace::kernel::models

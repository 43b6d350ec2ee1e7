// The part of a search that an SPE performs: all of it or, in the split pipeline, one half. Kernel dialect.
//
// In the split pipeline one SPE walks every ray to the next voxel with objects. Another SPE tests these
// objects and sends back the rays that hit none of them. Neither depends on how the other one works.
#pragma once

#include "kernel/accel/traversal.hpp"
#include "kernel/models/model_work.hpp"
#include "kernel/models/search_record.hpp"
#include "kernel/models/stage_block.hpp"

#include <type_traits>

namespace celltrace::kernel::models {

/// A complete search, with any accelerator.
template <class Spu> class WholeSearch {
public:
  using S = typename Spu::simd;

  WholeSearch(SceneAccess<Spu>& scene, const FrameBlock& frame) : traversal_(scene, frame) {}

  void run(SearchRecord& search) {
    if (static_cast<SearchKind>(search.kind) == SearchKind::closest)
      traversal_.find_closest(search.rays, search.lanes, search.hits, search.reflected);
    else
      traversal_.transmittance(search.rays, search.lanes, search.light.distance, search.light.colour);
  }

  const TraversalCounters& counters() const { return traversal_.counters(); }

private:
  Traversal<Spu> traversal_;
};

/// Counts primary rays that hit something, and primary rays that were sent back at least once.
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

/// Returns the distance up to which a ray is searched: to its closest hit so far, or to the light.
inline float limit_of(const SearchRecord& search, uint32_t lane) {
  return static_cast<SearchKind>(search.kind) == SearchKind::closest ? search.hits.distance.lane[lane]
                                                                     : search.light.distance.lane[lane];
}

/// The walking half: advances the pending rays to their next voxels that list objects.
template <class Spu> class GridWalk {
public:
  using S = typename Spu::simd;
  using F = typename S::F;
  using I = typename S::I;

  GridWalk(SceneAccess<Spu>& scene, const FrameBlock& frame) : scene_(scene), grid_(frame.grid) {}

  /// Walks the pending rays; rays that leave the grid are no longer pending. Calls `on_begin(search)` before
  /// the first step of the search.
  template <class OnBegin> void run(SearchRecord& search, OnBegin on_begin) {
    const bool begins = search.walked == 0;
    if (begins) {
      begin(search);
      on_begin(search);
    }
    VoxelWalk<S> walk = set_out(search, begins);
    F enter(-kFarAway);
    const auto step = [&](uint32_t lanes) {
      enter = walk.leave();
      walk.step(lanes);
    };
    if (!begins) step(walk.lanes()); // the objects in the current voxel have been tested
    uint32_t in_voxels = 0;
    while (walk.lanes() != 0) {
      scene_.spu().compute(scalar_work::kPacketStep);
      voxels_ += static_cast<uint32_t>(__builtin_popcount(walk.lanes()));
      const uint32_t empty = (scene_.listed_in(grid_, walk.cell(), walk.lanes()) == I::splat(0)).bits();
      const uint32_t listing = walk.lanes() & ~empty;
      if (listing != 0) hand_over(walk, enter, listing, search);
      in_voxels |= listing;
      step(walk.lanes() & empty & (limits_of(search) > walk.leave()).bits());
    }
    search.pending = in_voxels;
  }

  uint64_t voxels() const { return voxels_; }

private:
  static F limits_of(const SearchRecord& search) {
    return F::load(static_cast<SearchKind>(search.kind) == SearchKind::closest ? search.hits.distance.lane
                                                                               : search.light.distance.lane);
  }
  static void begin(SearchRecord& search) {
    search.walked = 1;
    search.pending = search.lanes;
    search.lit = search.lanes;
    search.returned = 0;
    if (static_cast<SearchKind>(search.kind) != SearchKind::closest) return;
    typename S::F(kMaxHitDistance).store(search.hits.distance.lane);
    store_words<S>(search.hits.object, S::I::splat(-1));
  }

  VoxelWalk<S> set_out(const SearchRecord& search, bool begins) {
    scene_.spu().compute(scalar_work::kVoxelWalk);
    if (begins) return {grid_, search.rays, search.pending};
    return {grid_, search.rays, search.pending, load_words<S>(search.place)};
  }
  /// Stores the positions of the rays in `lanes`.
  void hand_over(const VoxelWalk<S>& walk, const F& enter, uint32_t lanes, SearchRecord& search) {
    scene_.spu().compute(model_work::kHandOver);
    const auto here = S::M::from_bits(lanes);
    const auto keep = [&](const auto& now, auto* lane) {
      using Lanes = std::decay_t<decltype(now)>;
      S::select(here, now, Lanes::load(lane)).store(lane);
    };
    keep(walk.cell(), reinterpret_cast<int32_t*>(search.cell.lane));
    keep(walk.place(grid_), reinterpret_cast<int32_t*>(search.place.lane));
    keep(enter, search.enter.lane);
    keep(walk.leave(), search.leave.lane);
  }

  SceneAccess<Spu>& scene_;
  const GridRecord& grid_;
  uint64_t voxels_ = 0;
};

/// The testing half: tests the pending rays against the objects of the voxels that they are in.
template <class Spu> class VoxelTests {
public:
  using S = typename Spu::simd;
  using F = typename S::F;

  VoxelTests(SceneAccess<Spu>& scene, const FrameBlock& frame)
      : frame_(frame), objects_(scene), grid_(objects_, frame.grid) {}

  /// Tests the objects that are in no voxel, before the walk begins.
  void test_unbounded(SearchRecord& search) {
    if (frame_.unbounded_count == 0) return;
    objects_.set_reflected(search.reflected);
    if (static_cast<SearchKind>(search.kind) == SearchKind::closest) {
      RayQuery query = {&search.rays, &search.hits, nullptr, nullptr, search.lanes};
      return objects_.test_unbounded(frame_, query);
    }
    RayQuery query = {&search.rays, nullptr, &search.light.distance, &search.light.colour, search.lit};
    objects_.test_unbounded(frame_, query);
    search.lit = query.lanes;
    search.pending &= search.lit;
    darken(search);
  }

  /// Tests the pending rays; rays that are complete are no longer pending.
  void run(SearchRecord& search) {
    objects_.hit_filter().begin_packet();
    objects_.set_reflected(search.reflected);
    if (static_cast<SearchKind>(search.kind) == SearchKind::closest)
      find_closest(search);
    else
      transmittance(search);
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
    for_each_value<S>(search.cell, search.pending, [&](uint32_t cell, uint32_t) {
      grid_.find_closest_in(cell, search.rays, search.hits);
    });
  }
  void transmittance(SearchRecord& search) {
    for_each_value<S>(search.cell, search.pending, [&](uint32_t cell, uint32_t lanes) {
      grid_.transmittance_in(cell, lanes, search.enter, search.leave, search.rays, search.light.distance,
                             search.light.colour, search.lit);
    });
    search.pending &= search.lit;
    darken(search);
  }
  /// Sets the light of occluded lanes to 0.
  static void darken(SearchRecord& search) {
    const V3<S> dark = {F(0.0f), F(0.0f), F(0.0f)};
    VectorLanes& colour = search.light.colour;
    colour.template store<S>(select<S>(S::M::from_bits(search.lit), colour.template load<S>(), dark));
  }

  const FrameBlock& frame_;
  ObjectTests<Spu> objects_;
  GridTraversal<Spu> grid_;
  uint64_t returns_ = 0;
};

} // namespace celltrace::kernel::models

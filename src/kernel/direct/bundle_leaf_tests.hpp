// Tests of a bundle's packets against the objects of leaves in direct memory: the triangles of several leaves
// are tested together. Kernel dialect.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/direct/leaf_triangles.hpp"
#include "kernel/direct/pinhole_triangles.hpp"
#include "kernel/direct/shadow_volumes.hpp"
#include "kernel/direct/triangle_culling.hpp"

namespace celltrace::kernel {

/// Tests of leaves. The objects of consecutive leaves of triangles are deferred, so that they fill the SIMD
/// lanes. For each triangle test() culls packets, one in each lane, and tests the remaining packets, one ray
/// in each lane.
template <class Spu> class BundleLeafTests {
public:
  using S = typename Spu::simd;
  using F = typename S::F;
  using M = typename S::M;
  using Tests = ObjectTests<Spu>;

  /// Makes the tests for a bundle with a `view`. If `view` is null, no function may be called.
  BundleLeafTests(Tests& tests, const BundleView<S>* view)
      : tests_(tests), view_(view), triangles_(tests.scene().image()) {}

  /// Returns true if objects have been deferred to test().
  bool has_deferred() const { return triangles_.count() != 0; }
  /// Returns true if there is room to defer all objects of another leaf.
  bool has_room_for(const NodeRef& leaf) const { return triangles_.has_room_for(leaf); }

  /// Defers the objects of a leaf that `packets` have hit. If the first object is no triangle, or there is
  /// not enough room, objects that are not deferred are tested now. Returns packets whose results may have
  /// changed.
  uint32_t add(RayQuery* queries, uint32_t packets, const NodeRef& leaf) {
    uint32_t all[kMost]; // filled and copied as a vector
    for (uint32_t& of_one : all)
      of_one = packets;
    __builtin_memcpy(packets_of_ + triangles_.count(), all, sizeof all);
    if (triangles_.has_room_for(leaf) && triangles_.add(leaf, wanted())) return 0;
    uint32_t changed = 0;
    collect_triangles(tests_.scene(), leaf, wanted(), triangles_, [&](uint32_t self) {
      changed = packets;
      test_object(queries, packets, self);
    });
    return changed;
  }

  /// Tests the deferred objects, at least one. Returns the packets whose results may have changed.
  uint32_t test(RayQuery* queries) {
    triangles_.fill();
    const uint32_t unfit = triangles_.all() & ~triangles_.lanes_with(wanted());
    const uint32_t others = unfit == 0 ? 0 : test_others(queries, unfit);
    const TriangleSides<S> sides = triangles_.sides();
    const BundleView<S>& view = *view_;
    const TriangleCulling<S> culling(sides, view);
    // Packets are culled for all triangles before the first test: no triangle waits for the tests of another.
    Pairs pairs;
    const uint32_t count = triangles_.count();
    uint32_t changed = 0;
    for (uint32_t first = 0; first < count; first += kTrianglesPerWord) {
      uint64_t& word = pairs.word[first / kTrianglesPerWord];
      word = 0;
      for (uint32_t i = first; i < count && i < first + kTrianglesPerWord; ++i) {
        const uint32_t packets = packets_of_[i] & culling.seen_by(i, view);
        changed |= packets;
        word |= static_cast<uint64_t>(packets) << (i % kTrianglesPerWord * kSimdLanes);
      }
    }
    if (changed != 0) {
      if (are_shadows())
        test_shadows(queries, sides, *view.shadows, pairs);
      else
        keep_closest(queries, sides, view, pairs);
    }
    triangles_.clear();
    return changed | others;
  }

private:
  bool are_shadows() const { return view_->shadows != nullptr; }
  ObjectFlags wanted() const { return wanted_triangles(are_shadows()); }

  void test_object(RayQuery* queries, uint32_t packets, uint32_t self) {
    if (are_shadows())
      tests_.test_occlusion_of_all(queries, packets, self);
    else
      tests_.test_closest_of_all(queries, packets, self);
  }
  /// Tests the deferred objects that are not triangles or are translucent; test() then skips them. Returns
  /// their packets.
  CELLTRACE_ONE_COPY uint32_t test_others(RayQuery* queries, uint32_t others) {
    uint32_t packets = 0;
    for_each_lane(others, [&](uint32_t i) {
      packets |= packets_of_[i];
      test_object(queries, packets_of_[i], triangles_.offset(i));
      packets_of_[i] = 0;
    });
    return packets;
  }

  static constexpr uint32_t kMost = LeafTriangles<S>::kMost;
  static_assert(kBundlePackets<Spu> <= kSimdLanes, "packets of a bundle are lanes");

  /// Pairs of a triangle and a packet that may hit it, as bits. A word holds the packets of four triangles: a
  /// loop for each triangle would end in a mispredicted branch more often.
  static constexpr uint32_t kTrianglesPerWord = 64 / kSimdLanes;
  struct Pairs {
    uint64_t word[kMost / kTrianglesPerWord];
  };
  template <class Visit> [[gnu::always_inline]] void for_each_pair(const Pairs& pairs, Visit visit) {
    uint32_t tests = 0;
    for (uint32_t first = 0; first < triangles_.count(); first += kTrianglesPerWord) {
      uint64_t left = pairs.word[first / kTrianglesPerWord];
      tests += static_cast<uint32_t>(__builtin_popcountll(left));
      for (; left != 0; left &= left - 1) {
        const auto next = static_cast<uint32_t>(__builtin_ctzll(left));
        visit(first + next / kSimdLanes, next % kSimdLanes);
      }
    }
    tests_.counters().tests[static_cast<uint32_t>(ObjectKind::triangle)] += tests;
  }

  [[gnu::always_inline]] void keep_closest(const RayQuery* queries, const TriangleSides<S>& sides,
                                           const BundleView<S>& view, const Pairs& pairs) {
    const PinholeTriangles<S> triangles(sides, view.origin);
    for_each_pair(pairs, [&](uint32_t i, uint32_t packet) {
      const RayQuery& query = queries[packet];
      const V3<S> direction = query.rays->direction.template load<S>();
      kernel::keep_closest<S>(triangles.crossed(i, direction), triangles_.offset(i), *query.hits);
    });
  }

  [[gnu::always_inline]] void test_shadows(RayQuery* queries, const TriangleSides<S>& sides,
                                           const ShadowOrigins& origins, const Pairs& pairs) {
    const ShadowVolumes<S> volumes(sides, origins);
    for_each_pair(pairs, [&](uint32_t i, uint32_t packet) {
      RayQuery& query = queries[packet];
      const M occluded = volumes.crossed(i, origins, packet);
      query.lanes &= ~(occluded & !lanes_that_start_on<S>(*query.rays, triangles_.offset(i))).bits();
    });
  }

  Tests& tests_;
  const BundleView<S>* view_;
  LeafTriangles<S> triangles_;
  uint32_t packets_of_[2 * kMost]; ///< index: triangle; the packets that hit its leaf
};

} // namespace celltrace::kernel

// What packets of a bundle do with the objects of leaves where memory is direct: the triangles of several
// leaves are looked at together. Kernel dialect.
#pragma once

#include "kernel/direct/leaf_triangles.hpp"
#include "kernel/direct/pluecker_triangles.hpp"
#include "kernel/direct/edge_function_triangles.hpp"

namespace celltrace::kernel {

template <class Spu> class BundleLeafTests {
public:
  using S = typename Spu::simd;
  using F = typename S::F;
  using M = typename S::M;
  using Tests = ObjectTests<Spu>;

  explicit BundleLeafTests(Tests& tests) : tests_(tests) {}

  /// Whether there are triangles that wait for test().
  bool has_deferred() const { return triangles_.count() != 0; }
  /// Whether all objects of one more leaf can wait with them.
  bool has_room_for(const NodeRef& leaf) const {
    return triangles_.count() + leaf_word::count(leaf.leaf) <= kMost;
  }

  /// The objects of a leaf that packets have met: triangles wait, as many as there is room for, others are
  /// tested. Returns the packets that may have been changed.
  uint32_t add(RayQuery* queries, uint32_t packets, const NodeRef& leaf) {
    const bool shadows = is_for_light(queries, packets);
    const uint32_t before = triangles_.count();
    uint32_t changed = 0;
    collect_triangles(tests_.scene(), leaf, shadows, triangles_, [&](uint32_t self) {
      changed = packets;
      if (shadows)
        tests_.test_occlusion_of_all(queries, packets, self);
      else
        tests_.test_closest_of_all(queries, packets, self);
    });
    for (uint32_t i = before; i < triangles_.count(); ++i)
      packets_of_[i] = packets;
    return changed;
  }

  /// Tests all that wait; there are some. Returns the packets that may have been changed.
  uint32_t test(RayQuery* queries, const BundleView<S>& view) {
    const TriangleSides<S> sides = triangles_.sides();
    const EdgeFunctionTriangles<S> viewed(sides, view);
    // First all of these, so that none waits for the tests of the one before.
    Pairs pairs;
    const uint32_t count = triangles_.count();
    uint32_t changed = 0;
    for (uint32_t first = 0; first < count; first += kInWord) {
      uint64_t& word = pairs.word[first / kInWord];
      word = 0;
      for (uint32_t i = first; i < count && i < first + kInWord; ++i) {
        const uint32_t packets = packets_of_[i] & viewed.seen_by(i, view);
        changed |= packets;
        word |= static_cast<uint64_t>(packets) << (i % kInWord * kSimdLanes);
      }
    }
    if (changed != 0) {
      if (is_for_light(queries, changed))
        shadow(queries, sides, *view.moments, pairs);
      else
        keep_closest(queries, viewed, view, pairs);
    }
    triangles_.clear();
    return changed;
  }

private:
  static constexpr uint32_t kMost = LeafTriangles<S>::kMost;
  static_assert(kBundlePackets<Spu> <= kSimdLanes, "packets of a bundle are lanes");

  /// Triangles and the packets that may see them. A word holds those of four triangles: few loops end in a
  /// way that a processor cannot foresee.
  static constexpr uint32_t kInWord = 64 / kSimdLanes;
  struct Pairs {
    uint64_t word[kMost / kInWord];
  };
  template <class Visit> [[gnu::always_inline]] void for_each_pair(const Pairs& pairs, Visit visit) {
    uint32_t tests = 0;
    for (uint32_t first = 0; first < triangles_.count(); first += kInWord) {
      uint64_t left = pairs.word[first / kInWord];
      tests += static_cast<uint32_t>(__builtin_popcountll(left));
      for (; left != 0; left &= left - 1) {
        const auto next = static_cast<uint32_t>(__builtin_ctzll(left));
        visit(first + next / kSimdLanes, next % kSimdLanes);
      }
    }
    tests_.counters().tests[static_cast<uint32_t>(ObjectKind::triangle)] += tests;
  }

  static bool is_for_light(const RayQuery* queries, uint32_t packets) {
    return queries[__builtin_ctz(packets)].hits == nullptr;
  }

  [[gnu::always_inline]] void keep_closest(const RayQuery* queries, const EdgeFunctionTriangles<S>& viewed,
                                           const BundleView<S>& view, const Pairs& pairs) {
    for_each_pair(pairs, [&](uint32_t i, uint32_t packet) {
      const RayQuery& query = queries[packet];
      const V3<S> direction = view.mapped(query.rays->direction);
      Tests::keep_closest(viewed.crossed(i, direction), triangles_.offset(i), *query.hits);
    });
  }

  [[gnu::always_inline]] void shadow(RayQuery* queries, const TriangleSides<S>& sides,
                                     const BundleMoments& moments, const Pairs& pairs) {
    const PlueckerTriangles<S> by_moment(sides, moments);
    for_each_pair(pairs, [&](uint32_t i, uint32_t packet) {
      RayQuery& query = queries[packet];
      const F low(Tests::kShadowTolerance);
      const F high = F::load(query.distance->lane) - low;
      const M between = by_moment.crossed_between(i, *query.rays, moments.of[packet], moments, low, high);
      query.lanes &= ~(between & !lanes_that_start_on<S>(*query.rays, triangles_.offset(i))).bits();
    });
  }

  Tests& tests_;
  LeafTriangles<S> triangles_;
  uint32_t packets_of_[kMost]; ///< packets that have met the leaf of a triangle
};

} // namespace celltrace::kernel

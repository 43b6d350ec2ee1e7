// What packets of a bundle do with the objects of leaves where memory is direct: the triangles of several
// leaves are looked at together. Kernel dialect.
#pragma once

#include "kernel/leaf_triangles.hpp"
#include "kernel/moment_triangles.hpp"
#include "kernel/viewed_triangles.hpp"

namespace celltrace::kernel {

template <class Spu> class BundleLeafTests {
public:
  using S = typename Spu::simd;
  using F = typename S::F;
  using M = typename S::M;
  using Tests = ObjectTests<Spu>;

  explicit BundleLeafTests(Tests& tests) : tests_(tests) {}

  /// Whether there are triangles that wait for test().
  bool is_waiting() const { return triangles_.count() != 0; }
  /// Whether all objects of one more leaf can wait with them.
  bool has_room_for(const Branch& leaf) const {
    return triangles_.count() + leaf_word::count(leaf.leaf) <= kMost;
  }

  /// The objects of a leaf that packets have met: triangles wait, as many as there is room for, others are
  /// tested. Returns the packets that may have been changed.
  uint32_t add(Search* searches, uint32_t packets, const Branch& leaf) {
    const bool shadows = is_for_light(searches, packets);
    const uint32_t before = triangles_.count();
    uint32_t changed = 0;
    collect_triangles(tests_.scene(), leaf, shadows, triangles_, [&](uint32_t self) {
      changed = packets;
      if (shadows)
        tests_.shadow_all(searches, packets, self);
      else
        tests_.test_closest_of_all(searches, packets, self);
    });
    for (uint32_t i = before; i < triangles_.count(); ++i)
      met_by_[i] = packets;
    return changed;
  }

  /// Tests all that wait; there are some. Returns the packets that may have been changed.
  uint32_t test(Search* searches, const BundleView<S>& view) {
    const TriangleSides<S> sides = triangles_.sides();
    const ViewedTriangles<S> viewed(sides, view);
    // First all of these, so that none waits for the tests of the one before.
    Pairs pairs;
    const uint32_t count = triangles_.count();
    uint32_t changed = 0;
    for (uint32_t first = 0; first < count; first += kInWord) {
      uint64_t& word = pairs.word[first / kInWord];
      word = 0;
      for (uint32_t i = first; i < count && i < first + kInWord; ++i) {
        const uint32_t packets = met_by_[i] & viewed.seen_by(i, view);
        changed |= packets;
        word |= static_cast<uint64_t>(packets) << (i % kInWord * kSimdLanes);
      }
    }
    if (changed != 0) {
      if (is_for_light(searches, changed))
        shadow(searches, sides, *view.moments, pairs);
      else
        keep_closest(searches, viewed, view, pairs);
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

  static bool is_for_light(const Search* searches, uint32_t packets) {
    return searches[__builtin_ctz(packets)].hits == nullptr;
  }

  [[gnu::always_inline]] void keep_closest(const Search* searches, const ViewedTriangles<S>& viewed,
                                           const BundleView<S>& view, const Pairs& pairs) {
    for_each_pair(pairs, [&](uint32_t i, uint32_t packet) {
      const Search& search = searches[packet];
      const V3<S> direction = view.mapped(search.rays->direction);
      Tests::keep_closest(viewed.crossed(i, direction), triangles_.offset(i), *search.hits);
    });
  }

  [[gnu::always_inline]] void shadow(Search* searches, const TriangleSides<S>& sides,
                                     const BundleMoments& moments, const Pairs& pairs) {
    const MomentTriangles<S> by_moment(sides, moments);
    for_each_pair(pairs, [&](uint32_t i, uint32_t packet) {
      Search& search = searches[packet];
      const F low(Tests::kShadowTolerance);
      const F high = F::load(search.distance->lane) - low;
      const M between = by_moment.crossed_between(i, *search.rays, moments.of[packet], moments, low, high);
      search.lanes &= ~(between & !lanes_that_start_on<S>(*search.rays, triangles_.offset(i))).bits();
    });
  }

  Tests& tests_;
  LeafTriangles<S> triangles_;
  uint32_t met_by_[kMost]; ///< packets that have met the leaf of a triangle
};

} // namespace celltrace::kernel

// What rays do with the objects of a leaf where memory is direct: many triangles are tested at a time. Kernel
// dialect.
#pragma once

#include "kernel/leaf_triangles.hpp"
#include "kernel/moment_triangles.hpp"
#include "kernel/object_tests.hpp"
#include "kernel/viewed_triangles.hpp"

namespace celltrace::kernel {

template <class Spu> class LeafTests {
public:
  using S = typename Spu::simd;
  using F = typename S::F;
  using I = typename S::I;
  using M = typename S::M;
  using Tests = ObjectTests<Spu>;

  /// Each of some rays is tested against all triangles of a leaf at once, if there are no more rays than
  /// these and no fewer triangles. Found by measurement.
  static constexpr int kMostRays = 4;
  static constexpr uint32_t kLeastTriangles = 4;

  explicit LeafTests(Tests& tests) : tests_(tests) {}

  /// The objects of a leaf that packets of a bundle have met. Returns the packets that may have been changed.
  uint32_t test(Search* searches, uint32_t packets, const Branch& leaf, const BundleView<S>& view) {
    const bool shadows = searches[__builtin_ctz(packets)].hits == nullptr;
    uint32_t changed = 0;
    LeafTriangles<S> triangles;
    collect(leaf, shadows, triangles, [&](uint32_t self) {
      changed = packets;
      test_one(searches, packets, self, shadows);
    });
    const uint32_t count = triangles.count();
    if (count == 0) return changed;
    const TriangleSides<S> sides = triangles.sides();
    const ViewedTriangles<S> viewed(sides, view);
    // First all of these, so that none waits for the tests of the one before.
    uint32_t seen_by[LeafTriangles<S>::kMost];
    for (uint32_t i = 0; i < count; ++i)
      seen_by[i] = packets & viewed.seen_by(i, view);
    uint32_t tests = 0;
    for (uint32_t i = 0; i < count; ++i) {
      changed |= seen_by[i];
      tests += static_cast<uint32_t>(__builtin_popcount(seen_by[i]));
    }
    count_tests(tests);
    // Plain loops: what does not change in them stays in registers.
    if (!shadows) {
      for (uint32_t i = 0; i < count; ++i)
        for (uint32_t left = seen_by[i]; left != 0; left &= left - 1) {
          const Search& search = searches[__builtin_ctz(left)];
          const V3<S> direction = view.mapped(search.rays->direction);
          Tests::keep_closest(viewed.crossed(i, direction), triangles.offset(i), *search.hits);
        }
    } else if (changed != 0) {
      const BundleMoments& moments = *view.moments;
      const MomentTriangles<S> by_moment(sides, moments);
      for (uint32_t i = 0; i < count; ++i)
        for (uint32_t left = seen_by[i]; left != 0; left &= left - 1) {
          const auto packet = static_cast<uint32_t>(__builtin_ctz(left));
          Search& search = searches[packet];
          const F low(Tests::kShadowTolerance);
          const F high = F::load(search.distance->lane) - low;
          const M between =
              by_moment.crossed_between(i, *search.rays, moments.of[packet], moments, low, high);
          search.lanes &= ~(between & !lanes_that_start_on<S>(*search.rays, triangles.offset(i))).bits();
        }
    }
    return changed;
  }

  /// Those of some rays of a packet.
  void test(Search& search, uint32_t rays, const Branch& leaf) {
    const bool shadows = search.hits == nullptr;
    LeafTriangles<S> triangles;
    collect(leaf, shadows, triangles, [&](uint32_t self) {
      if (!shadows) {
        if (tests_.mailbox().first_visit(self)) tests_.test_closest(*search.rays, self, *search.hits);
      } else if ((search.lanes & rays) != 0) {
        search.lanes &= ~tests_.shadowed(*search.rays, self, rays, *search.distance, *search.light);
      }
    });
    if (triangles.count() == 0) return;
    const TriangleSides<S> sides = triangles.sides();
    for (uint32_t left = rays & search.lanes; left != 0; left &= left - 1) {
      const auto lane = static_cast<uint32_t>(__builtin_ctz(left));
      const Crossings<S> crossings = crossed(*search.rays, lane, sides, triangles);
      if (shadows)
        shadow(crossings, triangles.all(), lane, search);
      else
        keep_closest(crossings, triangles, lane, *search.hits);
    }
    count_tests(triangles.count());
  }

private:
  /// Triangles that can be tested together; what else is in the leaf is for `visit`.
  template <class Visit>
  [[gnu::always_inline]] void collect(const Branch& leaf, bool shadows, LeafTriangles<S>& triangles,
                                      Visit visit) {
    tests_.scene().for_each_object(leaf, [&](uint32_t self) {
      const ObjectRecord& object = *tests_.scene().object(self);
      const uint32_t flags = object.kind_and_flags;
      const bool fits = shadows
                            ? Tests::is_opaque_triangle(flags)
                            : static_cast<ObjectKind>(flags & object_flag::kind_mask) == ObjectKind::triangle;
      if (fits && triangles.count() < LeafTriangles<S>::kMost)
        triangles.add(self, object);
      else
        visit(self);
      return false;
    });
  }

  void test_one(Search* searches, uint32_t packets, uint32_t self, bool shadows) {
    if (shadows)
      tests_.shadow_all(searches, packets, self);
    else
      tests_.test_closest_of_all(searches, packets, self);
  }

  // --- one ray, and a triangle in each lane ---

  static Crossings<S> crossed(const RayPacket& rays, uint32_t lane, const TriangleSides<S>& sides,
                              const LeafTriangles<S>& triangles) {
    const auto of_ray = [&](const VectorLanes& v) {
      return V3<S>{F(v.x.lane[lane]), F(v.y.lane[lane]), F(v.z.lane[lane])};
    };
    const I start = I::splat(static_cast<int32_t>(rays.start_object.lane[lane]));
    const M starts_here = I::load(reinterpret_cast<const int32_t*>(triangles.offsets().lane)) == start;
    return SeenTriangle<S>(of_ray(rays.origin), sides).crossed(of_ray(rays.direction), starts_here);
  }

  static void shadow(const Crossings<S>& c, uint32_t triangles, uint32_t lane, Search& search) {
    const F low(Tests::kShadowTolerance);
    const M between = c.near_hit & (c.near > low) & (c.near < F(search.distance->lane[lane]) - low);
    if ((between.bits() & triangles) != 0) search.lanes &= ~(1u << lane);
  }

  /// As ObjectTests does.
  static void keep_closest(const Crossings<S>& c, const LeafTriangles<S>& triangles, uint32_t lane,
                           HitPacket& hits) {
    const M valid = c.near_hit & (c.near > F(kMinHitDistance)) & (c.near <= F(hits.distance.lane[lane]));
    const uint32_t hit = valid.bits() & triangles.all();
    if (hit == 0) return;
    FloatLanes near, u, v;
    c.near.store(near.lane);
    c.u.store(u.lane);
    c.v.store(v.lane);
    for_each_lane(hit, [&](uint32_t i) {
      const float nearest = hits.distance.lane[lane];
      const auto present = static_cast<int32_t>(hits.object.lane[lane]);
      const auto candidate = static_cast<int32_t>(triangles.offset(i));
      if (!(near.lane[i] < nearest || (near.lane[i] == nearest && candidate < present))) return;
      hits.distance.lane[lane] = near.lane[i];
      hits.u.lane[lane] = u.lane[i];
      hits.v.lane[lane] = v.lane[i];
      hits.object.lane[lane] = triangles.offset(i);
    });
  }

  void count_tests(uint32_t triangles) {
    tests_.counters().tests[static_cast<uint32_t>(ObjectKind::triangle)] += triangles;
  }

  Tests& tests_;
};

} // namespace celltrace::kernel

// Tests a few rays of a packet, ray by ray, against all triangles of a leaf at once. Kernel dialect.
#pragma once

#include "kernel/direct/leaf_triangles.hpp"

namespace celltrace::kernel {

template <class Spu> class LeafTests {
public:
  using S = typename Spu::simd;
  using F = typename S::F;
  using I = typename S::I;
  using M = typename S::M;
  using Tests = ObjectTests<Spu>;

  explicit LeafTests(Tests& tests) : tests_(tests) {}

  /// Tests the objects of a leaf against `rays` of a packet.
  void test(RayQuery& query, uint32_t rays, const NodeRef& leaf) {
    const bool shadows = query.hits == nullptr;
    LeafTriangles<S> triangles(tests_.scene().image());
    collect_triangles(tests_.scene(), leaf, wanted_triangles(shadows), triangles, [&](uint32_t self) {
      if (!shadows) {
        if (tests_.hit_filter().first_test(self)) tests_.test_closest(*query.rays, self, *query.hits);
      } else if ((query.lanes & rays) != 0) {
        query.lanes &= ~tests_.occluded(*query.rays, self, rays, *query.distance, *query.light);
      }
    });
    if (triangles.count() == 0) return;
    triangles.fill();
    const TriangleSides<S> sides = triangles.sides();
    for (uint32_t left = rays & query.lanes; left != 0; left &= left - 1) {
      const auto lane = static_cast<uint32_t>(__builtin_ctz(left));
      const Crossings<S> crossings = crossed(*query.rays, lane, sides, triangles);
      if (shadows)
        occlude(crossings, triangles.all(), lane, query);
      else
        keep_closest(crossings, triangles, lane, *query.hits);
    }
    tests_.counters().tests[static_cast<uint32_t>(ObjectKind::triangle)] += triangles.count();
  }

  /// Returns the crossings of one ray with the triangles in all lanes.
  static Crossings<S> crossed(const RayPacket& rays, uint32_t lane, const TriangleSides<S>& sides,
                              const LeafTriangles<S>& triangles) {
    const auto of_ray = [&](const VectorLanes& v) {
      return V3<S>{F(v.x.lane[lane]), F(v.y.lane[lane]), F(v.z.lane[lane])};
    };
    const I start = I::splat(static_cast<int32_t>(rays.start_object.lane[lane]));
    const M starts_here = I::load(reinterpret_cast<const int32_t*>(triangles.offsets())) == start;
    return TriangleTest<S>(of_ray(rays.origin), sides).crossed(of_ray(rays.direction), starts_here);
  }

  /// Keeps the closest crossing of a single ray with the triangles in lanes; see keep_closest() in
  /// crossings.hpp.
  static void keep_closest(const Crossings<S>& c, const LeafTriangles<S>& triangles, uint32_t lane,
                           HitPacket& hits) {
    const M valid = c.near_hit & (c.near > F(kMinHitDistance)) & (c.near <= F(hits.distance.lane[lane]));
    const auto offset_of = [&](uint32_t i) { return triangles.offset(i); };
    keep_closest_of<S>(c, valid.bits() & triangles.all(), lane, offset_of, hits);
  }

private:
  static void occlude(const Crossings<S>& c, uint32_t triangles, uint32_t lane, RayQuery& query) {
    const F low(kShadowEpsilon);
    const M occluding = c.near_hit & (c.near > low) & (c.near < F(query.distance->lane[lane]) - low);
    if ((occluding.bits() & triangles) != 0) query.lanes &= ~(1u << lane);
  }

  Tests& tests_;
};

} // namespace celltrace::kernel

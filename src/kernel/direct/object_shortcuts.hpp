// Tests of single objects where code takes no local store: several packets at once, and shortcuts for objects
// that are frequent or take long. Kernel dialect.
#pragma once

#include "kernel/accel/object_tests.hpp"
#include "kernel/direct/clipping.hpp"
#include "kernel/direct/crossing_list.hpp"
#include "kernel/direct/shadow_cache.hpp"
#include "kernel/direct/shape_shadows.hpp"

namespace celltrace::kernel {

/// Extends ObjectTests, which is `Tests`.
template <class Tests, class Spu> class DirectObjectShortcuts {
public:
  using S = typename Spu::simd;
  using F = typename S::F;
  using M = typename S::M;

  /// Tests several packets for closest hits; see test_closest().
  void test_closest_of_all(RayQuery* queries, uint32_t packets, uint32_t self) {
    const ObjectRecord& object = *scene().object(self);
    const uint32_t kind = object.kind_and_flags & object_flag::kind_mask;
    if (!kPlainTriangle.are_in(object.kind_and_flags)) {
      if (test_plain(queries, packets, object, self)) return;
      for_each_lane(packets,
                    [&](uint32_t i) { tests().test_closest(*queries[i].rays, self, *queries[i].hits); });
      return;
    }
    counters().tests[kind] += static_cast<uint32_t>(__builtin_popcount(packets));
    const auto sides = TriangleSides<S>::of(object);
    // The loop has no callback, so that the triangle's edges stay in registers.
    for (uint32_t left = packets; left != 0; left &= left - 1) {
      const RayQuery& query = queries[__builtin_ctz(left)];
      const TriangleTest<S> triangle(query.rays->origin.template load<S>(), sides);
      keep_closest<S>(triangle.crossed(*query.rays, self), self, *query.hits);
    }
  }

  /// Sets whether opaque objects that occlude rays are kept in the shadow cache.
  void record_occluders(bool recording) { shadow_cache_.recording = recording; }
  /// Removes the lanes that objects in the shadow cache occlude from a query.
  void test_shadow_cache(RayQuery& query) {
    tests().hit_filter().begin_packet();
    shadow_cache_.test([&](uint32_t self) {
      if (query.lanes == 0) return true;
      const uint32_t dark =
          tests().occluded(*query.rays, self, query.lanes, *query.distance, *query.light) & query.lanes;
      query.lanes &= ~dark;
      return dark != 0;
    });
  }

  /// Removes the lanes that an object occludes from the queries of several packets; see occluded(). The
  /// object must not have been tested against them before.
  void test_occlusion_of_all(RayQuery* queries, uint32_t packets, uint32_t self) {
    const ObjectRecord& object = *scene().object(self);
    const uint32_t flags = object.kind_and_flags;
    if ((flags & object_flag::no_shadow) != 0) return;
    if (!kPlainTriangle.are_in(flags) || (flags & object_flag::opaque) == 0) {
      if ((flags & object_flag::opaque) != 0 && test_plain(queries, packets, object, self)) return;
      for_each_lane(packets, [&](uint32_t i) {
        RayQuery& query = queries[i];
        tests().hit_filter().begin_packet();
        query.lanes &= ~tests().occluded(*query.rays, self, query.lanes, *query.distance, *query.light);
      });
      return;
    }
    counters().tests[flags & object_flag::kind_mask] += static_cast<uint32_t>(__builtin_popcount(packets));
    const auto sides = TriangleSides<S>::of(object);
    for (uint32_t left = packets; left != 0; left &= left - 1) {
      RayQuery& query = queries[__builtin_ctz(left)];
      const RayPacket& rays = *query.rays;
      const TriangleTest<S> triangle(rays.origin.template load<S>(), sides);
      query.lanes &= ~Tests::shadow_hits(triangle.crossed(rays, self), *query.distance).near;
    }
  }

  /// Tests an opaque object whose test takes long against the `lanes`, by packet, that may hit it.
  void test_occlusion_of_some(RayQuery* queries, uint32_t packets, const uint32_t* lanes, uint32_t self) {
    const ObjectRecord& object = *scene().object(self);
    if (has_shadow_test(object) && test_shadows_of_some(queries, packets, lanes, object, self)) return;
    for_each_lane(packets, [&](uint32_t i) {
      RayQuery& query = queries[i];
      FloatLanes distance;
      S::select(M::from_bits(lanes[i]), F::load(query.distance->lane), F(-kMaxHitDistance))
          .store(distance.lane);
      tests().hit_filter().begin_packet();
      query.lanes &= ~tests().occluded(*query.rays, self, query.lanes, distance, *query.light);
    });
  }

  /// Removes rays that a leaf's objects occlude from a query of shadow rays, until none of `lanes` is left.
  void test_occlusion_by_leaf(const NodeRef& leaf, uint32_t lanes, RayQuery& query) {
    const RayPacket& rays = *query.rays;
    const V3<S> origin = rays.origin.template load<S>(), direction = rays.direction.template load<S>();
    const F first(kShadowEpsilon), last = F::load(query.distance->lane) - first;
    uint32_t triangles = 0;
    scene().for_each_object(leaf, [&](uint32_t self) {
      const ObjectRecord& object = *scene().object(self);
      if (kOpaqueTriangle.are_in(object.kind_and_flags)) {
        ++triangles;
        const TriangleTest<S> triangle(origin, TriangleSides<S>::of(object));
        const uint32_t dark =
            triangle.crossed_between(direction, lanes_that_start_on<S>(rays, self), first, last).bits() &
            query.lanes;
        query.lanes &= ~dark;
        if (shadow_cache_.recording && dark != 0) shadow_cache_.add(self);
      } else {
        query.lanes &= ~tests().occluded(rays, self, lanes, *query.distance, *query.light);
      }
      return (query.lanes & lanes) == 0;
    });
    counters().tests[static_cast<uint32_t>(ObjectKind::triangle)] += triangles;
  }

  /// The effect of translucent objects on shadow rays.
  enum class Translucency {
    attenuates, ///< multiply the light
    is_kept,    ///< kept for later: the light is that of CrossingList
    is_listed   ///< kept for later, without the transmittance of surfaces
  };
  void set_translucency(Translucency translucency) { translucency_ = translucency; }

protected:
  void begin_occlusion(uint32_t self) { crossed_ = self; }
  void end_occlusion(uint32_t self, uint32_t flags, uint32_t dark) {
    if (shadow_cache_.recording && (flags & object_flag::opaque) != 0 && dark != 0) shadow_cache_.add(self);
  }
  void clear_shadow_cache() { shadow_cache_.forget(); }

  bool dims_at_once(const F& at, const Crossings<S>& c, uint32_t lanes, VectorLanes*& light, uint32_t& dark) {
    if (translucency_ == Translucency::attenuates) return true;
    light = static_cast<CrossingList<S>*>(light)->add(at, c, lanes, crossed_);
    if (light == nullptr) dark = lanes;
    return light != nullptr && translucency_ != Translucency::is_listed;
  }

  [[gnu::always_inline]] bool test_closest_shortly(const RayPacket& rays, const ObjectRecord& record,
                                                   uint32_t self, HitPacket& hits) {
    RayQuery query = {&rays, &hits, nullptr, nullptr, 0xFFFF};
    return test_plain(&query, 1, record, self);
  }
  [[gnu::always_inline]] bool test_occlusion_shortly(const RayPacket& rays, const ObjectRecord& record,
                                                     uint32_t self, const FloatLanes& distance,
                                                     VectorLanes& light, uint32_t& dark) {
    RayQuery query = {&rays, nullptr, &distance, &light, 0xFFFF};
    if (test_plain(&query, 1, record, self)) {
      dark = ~query.lanes & 0xFFFF;
      return true;
    }
    return has_shadow_test(record) && lanes_that_start_on<S>(rays, self).bits() == 0 &&
           test_shadows(rays, record, self, distance, dark);
  }

private:
  Tests& tests() { return static_cast<Tests&>(*this); }
  SceneAccess<Spu>& scene() { return tests().scene(); }
  auto& counters() { return tests().counters(); }

  /// Tests an object against several packets if its kind has one pair of crossings that no further record
  /// changes. Keeps the closest hits, or removes the lanes that an opaque object occludes from queries of
  /// shadow rays. Returns false if the object is of another kind.
  bool test_plain(RayQuery* queries, uint32_t packets, const ObjectRecord& object, uint32_t self) {
    if ((object.kind_and_flags & (object_flag::csg | object_flag::selective)) != 0) return false;
    const uint32_t kind = object.kind_and_flags & object_flag::kind_mask;
    bool tested = false;
    Primitives::dispatch(kind, [&](auto shape) {
      using Shape = decltype(shape);
      if constexpr (is_plain<Shape>()) {
        if (queries[__builtin_ctz(packets)].hits != nullptr)
          test_all<Shape, true>(queries, packets, object, self);
        else
          test_all<Shape, false>(queries, packets, object, self);
        tested = true;
      }
    });
    if (tested) counters().tests[kind] += static_cast<uint32_t>(__builtin_popcount(packets));
    return tested;
  }
  /// Returns true for kinds that test_plain() tests. Planes and polygons have tests of their own, and
  /// triangles are tested elsewhere.
  template <class Shape> static constexpr bool is_plain() {
    constexpr uint32_t kKind = kPrimitiveKind<Shape>;
    return Shape::kCrossingPairs == 1 && !Shape::kIsHeavy && kKind != kPrimitiveKind<TrianglePrimitive> &&
           kKind != kPrimitiveKind<PlanePrimitive> && kKind != kPrimitiveKind<PolygonPrimitive>;
  }
  /// Does test_plain() for one shape. Flattened, as otherwise the shape's test would be inlined nowhere.
  template <class Shape, bool kForHits>
  [[gnu::noinline, gnu::flatten]] void test_all(RayQuery* queries, uint32_t packets,
                                                const ObjectRecord& object, uint32_t self) {
    const ExtraRecord extra = object.extra == kNoOffset ? ExtraRecord() : *scene().extra(object.extra);
    // The loop has no callback, so that what is the same for all packets stays in registers.
    for (uint32_t left = packets; left != 0; left &= left - 1) {
      RayQuery& query = queries[__builtin_ctz(left)];
      Crossings<S> c;
      module_shapes::intersect_shape<Spu, Shape>(*query.rays, object, extra, self, &c);
      if constexpr (kForHits) {
        keep_closest<S>(c, self, *query.hits);
      } else {
        const auto shadow = Tests::shadow_hits(c, *query.distance);
        query.lanes &= ~(shadow.near | shadow.far);
      }
    }
  }

  static bool has_shadow_test(const ObjectRecord& object) {
    return Primitives::has_shadow_test(object.kind_and_flags & object_flag::kind_mask);
  }
  template <class Test> static void dispatch_shadow_test(const ObjectRecord& object, const Test& test) {
    Primitives::dispatch(object.kind_and_flags & object_flag::kind_mask, [&](auto shape) {
      if constexpr (decltype(shape)::kHasShadowTest) test(shape);
    });
  }
  /// Finds the lanes that an opaque object with kHasShadowTest occludes, if none of them starts on it.
  /// Returns false if the condition of its CSG depends on the crossings.
  [[gnu::noinline]] bool test_shadows(const RayPacket& rays, const ObjectRecord& object, uint32_t self,
                                      const FloatLanes& distance, uint32_t& dark) {
    const ExtraRecord& extra = *scene().extra(object.extra);
    ClippingObject clipping;
    if (!find_clipping(object, extra, clipping)) return false;
    ++counters().tests[object.kind_and_flags & object_flag::kind_mask];
    const CrossingRequest request = {kShadowEpsilon, &distance};
    const LocalRays<S> local = local_rays<S>(rays, object, self, 0, request);
    const F parameter(extra.value[0]);
    ClippedRays clipped;
    if (clipping.object != nullptr) clipping.template clip<S>(rays, clipped);
    const ClippedRays* const where = clipping.object != nullptr ? &clipped : nullptr;
    dispatch_shadow_test(object, [&](auto shape) {
      using Shape = decltype(shape);
      const M wanted = Shape::template may_hit<S>(local, parameter);
      dark = Shape::template crossed<S>(wanted, local, parameter, where).bits();
    });
    return true;
  }
  /// Removes from several queries the lanes that such an object occludes; candidates are `lanes` by packet.
  /// Returns false as test_shadows() does.
  [[gnu::noinline]] bool test_shadows_of_some(RayQuery* queries, uint32_t packets, const uint32_t* lanes,
                                              const ObjectRecord& object, uint32_t self) {
    const ExtraRecord& extra = *scene().extra(object.extra);
    ClippingObject clipping;
    if (!find_clipping(object, extra, clipping)) return false;
    uint32_t starting = 0;
    for_each_lane(packets,
                  [&](uint32_t i) { starting |= lanes_that_start_on<S>(*queries[i].rays, self).bits(); });
    if (starting != 0) return false;
    counters().tests[object.kind_and_flags & object_flag::kind_mask] +=
        static_cast<uint32_t>(__builtin_popcount(packets));
    dispatch_shadow_test(object, [&](auto shape) {
      ShapeShadows<decltype(shape), S> shadows(extra.value[0], clipping, queries);
      for_each_lane(packets, [&](uint32_t i) {
        const CrossingRequest request = {kShadowEpsilon, queries[i].distance};
        shadows.add(i, local_rays<S>(*queries[i].rays, object, self, 0, request), lanes[i]);
      });
      shadows.finish();
    });
    return true;
  }
  /// Finds the object that clips another one, if there is one. Returns false if the condition depends on the
  /// crossings.
  bool find_clipping(const ObjectRecord& object, const ExtraRecord& extra, ClippingObject& clipping) {
    clipping = {nullptr, false, false};
    if ((object.kind_and_flags & object_flag::csg) == 0 || extra.csg == kNoOffset) return true;
    clipping = ClippingObject::of(scene(), extra.csg);
    return clipping.object != nullptr;
  }

  Translucency translucency_ = Translucency::attenuates;
  uint32_t crossed_ = kNoOffset; ///< the object against which shadow rays are tested
  ShadowCache shadow_cache_;
};

} // namespace celltrace::kernel

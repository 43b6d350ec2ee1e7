// Tests of ray packets against single objects, whichever accelerator has found them: closest hits, and the
// transmittance of shadow rays. Kernel dialect.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/direct/clipping.hpp"
#include "kernel/direct/kept_crossings.hpp"
#include "kernel/direct/recent_occluders.hpp"
#include "kernel/direct/torus_pairs.hpp"
#include "kernel/direct/torus_shadows.hpp"
#include "kernel/primitives/csg.hpp"
#include "kernel/primitives/instances_module.hpp"
#include "kernel/primitives/list.hpp"
#include "kernel/primitives/polygons_module.hpp"
#include "kernel/scalar_work.hpp"
#include "kernel/scene_access.hpp"
#include "kernel/textures/transmittance.hpp"

namespace celltrace::kernel {

/// Counters of a frame, for its report.
struct TraversalCounters {
  uint64_t tests[kObjectKinds] = {}; ///< by kind
  uint64_t visits = 0;               ///< voxels entered by rays, or nodes of the BVH expanded
};

/// Mailboxing (Amanatides and Woo 1987): remembers which objects have been tested against the current packet,
/// so that an object in several voxels or leaves is tested once. Direct mapped: a collision costs a second
/// test.
class HitFilter {
public:
  /// Forgets all objects. Returns the packet's number, for resume_packet().
  uint32_t begin_packet() { return packet_ = ++last_packet_; }
  void resume_packet(uint32_t packet) { packet_ = packet; }
  /// True the first time that an object is asked for with the current packet; may be true again later.
  bool first_test(uint32_t object) {
    Entry& entry = entries_[(object >> 6) & (kEntries - 1)];
    if (entry.packet == packet_ && entry.object == object) return false;
    entry.packet = packet_;
    entry.object = object;
    return true;
  }

private:
  static constexpr uint32_t kEntries = 256;
  struct Entry {
    uint32_t packet, object;
  };
  Entry entries_[kEntries] = {};
  uint32_t packet_ = 0, last_packet_ = 0;
};

/// The segment of each ray beyond `enter` up to `leave`, or without these the whole ray.
struct RaySegment {
  const FloatLanes* enter;
  const FloatLanes* leave;

  /// The lanes whose `distance` is within.
  template <class S> uint32_t contains(const typename S::F& distance) const {
    using F = typename S::F;
    if (enter == nullptr) return 0xFFFF;
    return ((distance > F::load(enter->lane)) & (distance <= F::load(leave->lane))).bits();
  }
};

/// Intersection tests of packets with objects of the scene, and the merging of their results.
template <class Spu> class ObjectTests {
public:
  using S = typename Spu::simd;
  using F = typename S::F;
  using I = typename S::I;
  using M = typename S::M;

  explicit ObjectTests(SceneAccess<Spu>& scene) : scene_(scene), torus_pairs_(recent_) {}

  // Some are not inlined: the tests are most of the program's code, and one copy of each saves local store.

  /// Tests an object and keeps hits that are closer than those in `hits`.
  CELLTRACE_ONE_COPY void test_closest(const RayPacket& rays, uint32_t self, HitPacket& hits) {
    scene_.spu().compute(scalar_work::kClosest);
    const ObjectRecord& object = *scene_.object(self);
    if (is_simple(object.kind_and_flags)) return keep_closest<S>(test(rays, object, self), self, hits);
    scene_.spu().enter_module(modules::kObjects);
    test_closest_of_other(rays, object, self, hits);
  }

  /// The same for several packets.
  void test_closest_of_all(RayQuery* queries, uint32_t packets, uint32_t self) {
    const ObjectRecord& object = *scene_.object(self);
    const uint32_t kind = object.kind_and_flags & object_flag::kind_mask;
    if (!kPlainTriangle.are_in(object.kind_and_flags)) {
      if (test_plain(queries, packets, object, self)) return;
      for_each_lane(packets, [&](uint32_t i) { test_closest(*queries[i].rays, self, *queries[i].hits); });
      return;
    }
    counters_.tests[kind] += static_cast<uint32_t>(__builtin_popcount(packets));
    const auto sides = TriangleSides<S>::of(object);
    // A loop without a callback: the triangle's edges stay in registers.
    for (uint32_t left = packets; left != 0; left &= left - 1) {
      const RayQuery& query = queries[__builtin_ctz(left)];
      const SeenTriangle<S> triangle(query.rays->origin.template load<S>(), sides);
      keep_closest<S>(triangle.crossed(*query.rays, self), self, *query.hits);
    }
  }

  /// Returns the lanes that an object occludes. An opaque object is tested against all lanes of the packet,
  /// the first time only. A translucent object attenuates the light of `lanes` by each crossing within
  /// `segment`: one that lies in several voxels is tested in each of them, but every crossing counts once.
  /// Lanes that this leaves without light are returned.
  CELLTRACE_ONE_COPY uint32_t occluded(const RayPacket& rays, uint32_t self, uint32_t lanes,
                                       const FloatLanes& distance, VectorLanes& light,
                                       const RaySegment& segment = {nullptr, nullptr}) {
    scene_.spu().compute(scalar_work::kShadow);
    const ObjectRecord& object = *scene_.object(self);
    const uint32_t flags = object.kind_and_flags;
    const uint32_t material = object.material;
    if ((flags & object_flag::no_shadow) != 0) return 0;
    // Of instances, which take long, only the rays that are asked for: they may come back for others.
    const bool all_at_once = !is_instance(flags) || segment.enter != nullptr;
    if ((flags & object_flag::opaque) != 0 && all_at_once && !hit_filter_.first_test(self)) return 0;
    if constexpr (kKeepsCrossings<Spu>) crossed_ = self;
    uint32_t dark;
    if (is_simple(flags)) {
      dark = occluded_by(rays, test(rays, object, self), flags, material, lanes, distance, light, segment);
    } else {
      scene_.spu().enter_module(modules::kObjects);
      dark = occluded_by_other(rays, object, self, lanes, distance, light, segment);
    }
    if constexpr (kGathersOccluders<Spu>)
      if (recent_.remembers && (flags & object_flag::opaque) != 0 && (dark & lanes) != 0) recent_.add(self);
    return dark;
  }
  /// Where occluders are gathered: whether opaque objects are remembered that occlude rays.
  void remember_occluders(bool remembers) { recent_.remembers = remembers; }
  /// Removes the lanes that those occlude from a query.
  void test_recent(RayQuery& query) {
    hit_filter_.begin_packet();
    recent_.test([&](uint32_t self) {
      if (query.lanes == 0) return true;
      const uint32_t dark =
          occluded(*query.rays, self, query.lanes, *query.distance, *query.light) & query.lanes;
      query.lanes &= ~dark;
      return dark != 0;
    });
  }

  /// The same for the whole rays of several packets: removes occluded lanes from their queries. The object
  /// must not have been tested against them before.
  void test_occlusion_of_all(RayQuery* queries, uint32_t packets, uint32_t self) {
    const ObjectRecord& object = *scene_.object(self);
    const uint32_t flags = object.kind_and_flags;
    if ((flags & object_flag::no_shadow) != 0) return;
    if (!kPlainTriangle.are_in(flags) || (flags & object_flag::opaque) == 0) {
      if ((flags & object_flag::opaque) != 0 && test_plain(queries, packets, object, self)) return;
      for_each_lane(packets, [&](uint32_t i) {
        RayQuery& query = queries[i];
        hit_filter_.begin_packet();
        query.lanes &= ~occluded(*query.rays, self, query.lanes, *query.distance, *query.light);
      });
      return;
    }
    counters_.tests[flags & object_flag::kind_mask] += static_cast<uint32_t>(__builtin_popcount(packets));
    const auto sides = TriangleSides<S>::of(object);
    for (uint32_t left = packets; left != 0; left &= left - 1) {
      RayQuery& query = queries[__builtin_ctz(left)];
      const RayPacket& rays = *query.rays;
      const SeenTriangle<S> triangle(rays.origin.template load<S>(), sides);
      query.lanes &= ~shadow_hits(triangle.crossed(rays, self), *query.distance).near;
    }
  }

  /// The same of an opaque object whose test takes long, for those `lanes`, by packet, that may hit it.
  void test_occlusion_of_some(RayQuery* queries, uint32_t packets, const uint32_t* lanes, uint32_t self) {
    const ObjectRecord& object = *scene_.object(self);
    if ((object.kind_and_flags & object_flag::kind_mask) == kPrimitiveKind<TorusPrimitive> &&
        occlude_by_torus(queries, packets, lanes, object, self))
      return;
    for_each_lane(packets, [&](uint32_t i) {
      RayQuery& query = queries[i];
      FloatLanes distance;
      S::select(M::from_bits(lanes[i]), F::load(query.distance->lane), F(-kMaxHitDistance))
          .store(distance.lane);
      hit_filter_.begin_packet();
      query.lanes &= ~occluded(*query.rays, self, query.lanes, distance, *query.light);
    });
  }

  /// Removes rays from a query for light that the objects of a leaf occlude, until none of `lanes` is left.
  void test_occlusion_by_leaf(const NodeRef& leaf, uint32_t lanes, RayQuery& query) {
    const RayPacket& rays = *query.rays;
    const V3<S> origin = rays.origin.template load<S>(), direction = rays.direction.template load<S>();
    const F first(kShadowEpsilon), last = F::load(query.distance->lane) - first;
    uint32_t triangles = 0;
    scene_.for_each_object(leaf, [&](uint32_t self) {
      const ObjectRecord& object = *scene_.object(self);
      if (kOpaqueTriangle.are_in(object.kind_and_flags)) {
        ++triangles;
        const SeenTriangle<S> triangle(origin, TriangleSides<S>::of(object));
        const uint32_t dark =
            triangle.crossed_between(direction, lanes_that_start_on<S>(rays, self), first, last).bits() &
            query.lanes;
        query.lanes &= ~dark;
        if (recent_.remembers && dark != 0) recent_.add(self);
      } else {
        query.lanes &= ~occluded(rays, self, lanes, *query.distance, *query.light);
      }
      return (query.lanes & lanes) == 0;
    });
    counters_.tests[static_cast<uint32_t>(ObjectKind::triangle)] += triangles;
  }

  /// Tests the objects that no accelerator has, and so many of the others. They lie before these: as in
  /// POV-Ray, where one is at the same distance as another object, it is what is seen.
  void test_unbounded(const FrameBlock& frame, RayQuery& query, uint32_t others = 0) {
    test_list(frame.object_offset - frame.unbounded_count * kObjectBytes, frame.unbounded_count + others,
              query);
  }
  /// The same of `count` objects from `self` on.
  void test_list(uint32_t self, uint32_t count, RayQuery& query) {
    hit_filter_.begin_packet();
    for (uint32_t i = 0; i < count && query.lanes != 0; ++i, self += kObjectBytes) {
      if (query.hits != nullptr)
        test_closest(*query.rays, self, *query.hits);
      else
        query.lanes &= ~occluded(*query.rays, self, query.lanes, *query.distance, *query.light);
    }
  }

  /// Pairs of rays and tori that wait to be tested, where they are gathered.
  TorusPairs<Spu>& torus_pairs() { return torus_pairs_; }

  /// Lanes whose near or far crossing lies between their origin and the light.
  struct ShadowHits {
    uint32_t near, far;
  };
  static ShadowHits shadow_hits(const Crossings<S>& c, const FloatLanes& distance) {
    const F low(kShadowEpsilon);
    const F high = F::load(distance.lane) - low;
    return {(c.near_hit & (c.near > low) & (c.near < high)).bits(),
            (c.far_hit & (c.far > low) & (c.far < high)).bits()};
  }

  static constexpr auto kObjectBytes = static_cast<uint32_t>(sizeof(ObjectRecord));

  /// The lanes of the rays to be tested that come from a mirror, as no others see or do not see some objects.
  void set_reflected(uint32_t lanes) { reflected_ = lanes; }

  /// What translucent objects do to shadow rays. Where memory is not direct they attenuate them.
  enum class Translucency {
    attenuates, ///< multiplies the light
    is_kept,    ///< for later: the light is that of KeptCrossings
    is_listed   ///< the same, but what surfaces let through is still to be found
  };
  void set_translucency(Translucency translucency) { translucency_ = translucency; }
  Translucency translucency() const {
    return kKeepsCrossings<Spu> ? translucency_ : Translucency::attenuates;
  }

  SceneAccess<Spu>& scene() { return scene_; }
  HitFilter& hit_filter() { return hit_filter_; }
  TraversalCounters& counters() { return counters_; }
  const TraversalCounters& counters() const { return counters_; }
  /// The records may be another scene's from now on.
  void begin_frame() {
    counters_ = TraversalCounters();
    if constexpr (kGathersOccluders<Spu>) recent_.forget();
  }

private:
  /// Spheres, triangles and planes that are no parts of a CSG, and seen by all rays: their code is always
  /// there, and their test reads no further record.
  static bool is_simple(uint32_t flags) {
    return (flags & (object_flag::kind_mask | object_flag::csg | object_flag::selective)) <=
           static_cast<uint32_t>(ObjectKind::plane);
  }

  /// As occluded(), for crossings with the object.
  uint32_t occluded_by(const RayPacket& rays, const Crossings<S>& c, uint32_t flags, uint32_t material,
                       uint32_t lanes, const FloatLanes& distance, VectorLanes& light,
                       const RaySegment& segment) {
    const ShadowHits shadow = shadow_hits(c, distance);
    if ((flags & object_flag::opaque) != 0) return shadow.near | shadow.far;
    const uint32_t near = lanes & shadow.near & segment.template contains<S>(c.near);
    const uint32_t far = lanes & shadow.far & segment.template contains<S>(c.far);
    uint32_t dark = 0;
    if (near != 0) dark |= cross_translucent(rays, c.near, c, flags, material, near, light);
    if (far != 0) dark |= cross_translucent(rays, c.far, c, flags, material, far, light);
    return dark;
  }
  /// As attenuate(), unless what the surface lets through is kept.
  uint32_t cross_translucent(const RayPacket& rays, const F& at, const Crossings<S>& c, uint32_t flags,
                             uint32_t material, uint32_t lanes, VectorLanes& light) {
    if (translucency() == Translucency::attenuates)
      return attenuate(rays, at, c, flags, material, lanes, light);
    VectorLanes* const kept = static_cast<KeptCrossings<S>&>(light).add(at, c, lanes, crossed_);
    if (kept == nullptr) return lanes;
    if (translucency() == Translucency::is_listed) return 0;
    return attenuate(rays, at, c, flags, material, lanes, *kept);
  }

  // Objects that are not simple: their crossings are several pairs, and count where the CSG's condition
  // holds.

  CELLTRACE_ONE_COPY void test_closest_of_other(const RayPacket& rays, const ObjectRecord& record,
                                                uint32_t self, HitPacket& hits) {
    scene_.spu().run_in_module(modules::kObjects);
    const uint32_t flags = record.kind_and_flags;
    if (is_instance(flags)) return test_instance(rays, record, kMinHitDistance, false, hits);
    if constexpr (kHasRoomForCode<Spu>) {
      RayQuery query = {&rays, &hits, nullptr, nullptr, 0xFFFF};
      if (test_plain(&query, 1, record, self)) return;
    }
    if constexpr (kGathersTorusPairs<Spu>)
      if (may_wait(flags) && torus_waits(rays, record, self, hits.distance)) return;
    const uint32_t blind = blind_lanes(flags, reflected_);
    Other other(*this, rays, record, self, kMinHitDistance, hits.distance);
    for (uint32_t pair = 0; pair < other.pairs; ++pair) {
      Crossings<S>& c = other.crossings[pair];
      if ((c.near_hit | c.far_hit).bits() == 0) continue;
      if ((flags & object_flag::selective) != 0) {
        const M sees = M::from_bits(~blind & 0xFFFF);
        c.near_hit = c.near_hit & sees;
        c.far_hit = c.far_hit & sees;
      }
      if (other.csg != kNoOffset) {
        const F nearest = F::load(hits.distance.lane);
        const auto near = c.near_hit & (c.near > F(kMinHitDistance)) & (c.near <= nearest);
        const auto far = c.far_hit & (c.far > F(kMinHitDistance)) & (c.far <= nearest);
        accept(rays, other.csg, near, far, false, reflected_, c);
      }
      keep_closest<S>(c, self, hits);
    }
  }
  CELLTRACE_ONE_COPY uint32_t occluded_by_other(const RayPacket& rays, const ObjectRecord& record,
                                                uint32_t self, uint32_t lanes, const FloatLanes& distance,
                                                VectorLanes& light, const RaySegment& segment) {
    scene_.spu().run_in_module(modules::kObjects);
    const uint32_t flags = record.kind_and_flags, material = record.material;
    if (is_instance(flags))
      return occluded_by_instance(rays, record, segment.enter != nullptr ? 0xFFFF : lanes, distance);
    const bool is_opaque = (flags & object_flag::opaque) != 0;
    if constexpr (kHasRoomForCode<Spu>) {
      RayQuery query = {&rays, nullptr, &distance, &light, 0xFFFF};
      if (is_opaque && test_plain(&query, 1, record, self)) return ~query.lanes & 0xFFFF;
    }
    if constexpr (kGathersTorusPairs<Spu>)
      if (is_opaque && may_wait(flags) && torus_waits(rays, record, self, distance)) return 0;
    if constexpr (kHasRoomForCode<Spu>)
      if (is_opaque && (flags & object_flag::kind_mask) == kPrimitiveKind<TorusPrimitive> &&
          lanes_that_start_on<S>(rays, self).bits() == 0) {
        uint32_t dark;
        if (occluded_by_torus(rays, record, self, distance, dark)) return dark;
      }
    Other other(*this, rays, record, self, is_opaque ? kShadowEpsilon : kEveryCrossing, distance);
    uint32_t dark = 0;
    for (uint32_t pair = 0; pair < other.pairs; ++pair) {
      Crossings<S>& c = other.crossings[pair];
      if ((c.near_hit | c.far_hit).bits() == 0) continue;
      if (other.csg != kNoOffset) {
        const ShadowHits shadow = shadow_hits(c, distance);
        accept(rays, other.csg, M::from_bits(shadow.near), M::from_bits(shadow.far), !is_opaque, kSeesAll, c);
      }
      dark |= occluded_by(rays, c, flags, material, lanes & ~dark, distance, light, segment);
    }
    return dark;
  }

  /// Tests an object of a kind whose crossings are one pair, and that no further record changes, against
  /// several packets: keeps their closest hits, or removes the lanes that it occludes from queries for light,
  /// if it is opaque. False: it is not of such a kind.
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
    if (tested) counters_.tests[kind] += static_cast<uint32_t>(__builtin_popcount(packets));
    return tested;
  }
  /// Planes and polygons have tests of their own, and triangles are tested elsewhere.
  template <class Shape> static constexpr bool is_plain() {
    constexpr uint32_t kKind = kPrimitiveKind<Shape>;
    return Shape::kCrossingPairs == 1 && !Shape::kIsHeavy && kKind != kPrimitiveKind<TrianglePrimitive> &&
           kKind != kPrimitiveKind<PlanePrimitive> && kKind != kPrimitiveKind<PolygonPrimitive>;
  }
  /// Flattened: otherwise the test of a shape would be inlined nowhere.
  template <class Shape, bool kForHits>
  [[gnu::noinline, gnu::flatten]] void test_all(RayQuery* queries, uint32_t packets,
                                                const ObjectRecord& object, uint32_t self) {
    const ExtraRecord extra = object.extra == kNoOffset ? ExtraRecord() : *scene_.extra(object.extra);
    // A loop without a callback: what does not change from packet to packet stays in registers.
    for (uint32_t left = packets; left != 0; left &= left - 1) {
      RayQuery& query = queries[__builtin_ctz(left)];
      Crossings<S> c;
      module_shapes::intersect_shape<Spu, Shape>(*query.rays, object, extra, self, &c);
      if constexpr (kForHits) {
        keep_closest<S>(c, self, *query.hits);
      } else {
        const ShadowHits shadow = shadow_hits(c, *query.distance);
        query.lanes &= ~(shadow.near | shadow.far);
      }
    }
  }

  /// Whether an object is a torus at which rays may wait.
  bool may_wait(uint32_t flags) const {
    constexpr uint32_t kAsked = object_flag::kind_mask | object_flag::csg | object_flag::selective;
    return (flags & kAsked) == kPrimitiveKind<TorusPrimitive> && torus_pairs_.may_wait();
  }
  /// False: it has to be tested at once.
  bool torus_waits(const RayPacket& rays, const ObjectRecord& torus, uint32_t self, const FloatLanes& limit) {
    const AskedCrossings asked = {kEveryCrossing, &limit};
    if (!torus_pairs_.add(local_rays<S>(rays, torus, self, 0, asked), scene_.extra(torus.extra)->value[0],
                          self))
      return false;
    ++counters_.tests[kPrimitiveKind<TorusPrimitive>];
    return true;
  }

  /// Finds the lanes that an opaque torus occludes, off which none of them starts. False: its CSG's condition
  /// is none that is known before the crossings are.
  [[gnu::noinline]] bool occluded_by_torus(const RayPacket& rays, const ObjectRecord& torus, uint32_t self,
                                           const FloatLanes& distance, uint32_t& dark) {
    const ExtraRecord& extra = *scene_.extra(torus.extra);
    ClippingObject clipping;
    if (!find_clipping(torus, extra, clipping)) return false;
    ++counters_.tests[kPrimitiveKind<TorusPrimitive>];
    const AskedCrossings asked = {kShadowEpsilon, &distance};
    const LocalRays<S> local = local_rays<S>(rays, torus, self, 0, asked);
    const F ratio(extra.value[0]);
    ClippedRays clipped;
    if (clipping.object != nullptr) clipping.template clip<S>(rays, clipped);
    dark = TorusPrimitive::crossed<S>(TorusPrimitive::may_hit<S>(local, ratio), local, ratio,
                                      clipping.object != nullptr ? &clipped : nullptr)
               .bits();
    return true;
  }
  /// The same for lanes of several packets, by packet: removes them from their queries.
  [[gnu::noinline]] bool occlude_by_torus(RayQuery* queries, uint32_t packets, const uint32_t* lanes,
                                          const ObjectRecord& torus, uint32_t self) {
    const ExtraRecord& extra = *scene_.extra(torus.extra);
    ClippingObject clipping;
    if (!find_clipping(torus, extra, clipping)) return false;
    uint32_t starting = 0;
    for_each_lane(packets,
                  [&](uint32_t i) { starting |= lanes_that_start_on<S>(*queries[i].rays, self).bits(); });
    if (starting != 0) return false;
    counters_.tests[kPrimitiveKind<TorusPrimitive>] += static_cast<uint32_t>(__builtin_popcount(packets));
    TorusShadows<S> shadows(extra.value[0], clipping, queries);
    for_each_lane(packets, [&](uint32_t i) {
      const AskedCrossings asked = {kShadowEpsilon, queries[i].distance};
      shadows.add(i, local_rays<S>(*queries[i].rays, torus, self, 0, asked), lanes[i]);
    });
    shadows.finish();
    return true;
  }
  /// What clips a torus, if something does. False: what that is takes its crossings to tell.
  bool find_clipping(const ObjectRecord& torus, const ExtraRecord& extra, ClippingObject& clipping) {
    clipping = {nullptr, false, false};
    if ((torus.kind_and_flags & object_flag::csg) == 0 || extra.csg == kNoOffset) return true;
    clipping = ClippingObject::of(scene_, extra.csg);
    return clipping.object != nullptr;
  }

  void test_instance(const RayPacket& rays, const ObjectRecord& record, float nearest, bool any,
                     HitPacket& hits) {
    ++counters_.tests[kInstanceKind];
    scene_.spu().enter_module(modules::kInstances);
    const auto work = module_instances::intersect(scene_, rays, record, nearest, any, hits);
    counters_.visits += work.nodes;
    counters_.tests[static_cast<uint32_t>(ObjectKind::triangle)] += work.triangles;
  }
  /// All instances are opaque.
  CELLTRACE_ONE_COPY uint32_t occluded_by_instance(const RayPacket& rays, const ObjectRecord& record,
                                                   uint32_t lanes, const FloatLanes& distance) {
    HitPacket hits;
    const I none = I::splat(static_cast<int32_t>(kInstancedBit));
    S::select(M::from_bits(lanes), F::load(distance.lane) - F(kShadowEpsilon), F(-1.0f))
        .store(hits.distance.lane);
    store_words<S>(hits.object, none);
    test_instance(rays, record, kShadowEpsilon, true, hits);
    return ~(load_words<S>(hits.object) == none).bits() & 0xFFFF;
  }

  /// The crossings of a packet with an object that is not simple.
  struct Other {
    Crossings<S> crossings[kMaxCrossingPairs];
    uint32_t pairs = 1;
    uint32_t csg = kNoOffset; ///< offset of its condition

    /// Those up to `limit`, of which one beyond `enough` may do; not of an object that is a part of a CSG.
    Other(ObjectTests& tests, const RayPacket& rays, const ObjectRecord& record, uint32_t self, float enough,
          const FloatLanes& limit) {
      Kept<Spu, ObjectRecord> object = record;
      const uint32_t kind = object.kind_and_flags & object_flag::kind_mask;
      ExtraRecord room;
      if (object.extra == kNoOffset) room = {};
      const ExtraRecord& extra =
          object.extra == kNoOffset ? room : *keep<Spu>(tests.scene_.extra(object.extra), room);
      if ((object.kind_and_flags & object_flag::csg) != 0) csg = extra.csg;
      const AskedCrossings asked = {csg != kNoOffset ? kEveryCrossing : enough, &limit};
      ++tests.counters_.tests[kind];
      tests.scene_.spu().compute(scalar_work::kTestEllipsoid);
      Spu& spu = tests.scene_.spu();
      spu.enter_module(is_heavy(kind) ? modules::kHeavyShapes : modules::kShapes);
      pairs = is_heavy(kind) ? module_heavy::intersect(spu, rays, object, extra, self, asked, crossings)
                             : module_shapes::intersect(spu, rays, object, extra, self, crossings);
      if (kind != kPrimitiveKind<PolygonPrimitive>) return;
      spu.enter_module(modules::kPolygons);
      module_polygons::cut_out(tests.scene_, extra, crossings[0]);
    }
  };

  /// Leaves those of the crossings in `near` and `far` that satisfy the condition; of a ray's two the far one
  /// may be left out unless `asks_both`.
  void accept(const RayPacket& rays, uint32_t condition, const M& near, const M& far, bool asks_both,
              uint32_t reflected, Crossings<S>& c) {
    c.near_hit = accepted(rays, condition, c.near, near.bits(), reflected);
    const uint32_t known = asks_both ? 0 : c.near_hit.bits();
    c.far_hit = accepted(rays, condition, c.far, far.bits() & ~known, reflected);
  }
  /// Not inlined: it is asked in four places.
  CELLTRACE_ONE_COPY M accepted(const RayPacket& rays, uint32_t condition, const F& distance, uint32_t lanes,
                                uint32_t reflected) {
    if (lanes == 0) return M::none();
    const V3<S> origin = rays.origin.template load<S>(), direction = rays.direction.template load<S>();
    return M::from_bits(
        csg_accepted(scene_, condition, origin, origin + direction * distance, lanes, reflected));
  }

  /// Multiplies the light of `lanes` by the transmittance of a translucent surface that they cross at `at`.
  /// Returns those of which hardly any is left: a ray with less than 1e-10 of it in each channel can stop.
  CELLTRACE_ONE_COPY uint32_t attenuate(const RayPacket& rays, const F& at, const Crossings<S>& c,
                                        uint32_t flags, uint32_t material, uint32_t lanes,
                                        VectorLanes& light) {
    using R = typename Spu::rare_simd;
    using RF = typename R::F;
    scene_.spu().compute(scalar_work::kFilter);
    const V3<S> points = rays.origin.template load<S>() + rays.direction.template load<S>() * at;
    // Copies: by reference the crossings would be copied, where nothing is translucent too.
    const F all_u = c.u, all_v = c.v;
    uint32_t dark = 0;
    for_each_part<Spu>([&](uint32_t first) {
      const uint32_t some = part_of<Spu>(lanes, first);
      if (some == 0) return;
      const PatternPoints<R> crossed = {part_of<Spu>(points, first)};
      V3<R> transmittance;
      if ((flags & object_flag::blended) == 0) {
        transmittance_at(scene_, material, crossed, some, transmittance);
      } else {
        Kept<Spu, BlendRecord> blend = *scene_.blend(material);
        const RF u = part_of<Spu>(all_u, first), v = part_of<Spu>(all_v, first);
        const RF weights[3] = {RF(1.0f) - u - v, u, v};
        transmittance = {RF(0.0f), RF(0.0f), RF(0.0f)};
        V3<R> corner;
        for (uint32_t i = 0; i < 3; ++i) {
          transmittance_at(scene_, blend.material[i], crossed, some, corner);
          transmittance = transmittance + corner * weights[i];
        }
      }
      const V3<R> before = light.template load_from<R>(first), after = before * transmittance;
      light.template store_from<R>(first, select<R>(R::M::from_bits(some), after, before));
      const RF most = R::max(R::abs(after.x), R::max(R::abs(after.y), R::abs(after.z)));
      dark |= ((most < RF(1e-10f)).bits() & some) << first;
    });
    return dark;
  }

  /// Of a simple object.
  Crossings<S> test(const RayPacket& rays, const ObjectRecord& object, uint32_t self) {
    const uint32_t kind = object.kind_and_flags & object_flag::kind_mask;
    ++counters_.tests[kind];
    scene_.spu().compute(scalar_work::kTest[kind]);
    Crossings<S> c;
    if (static_cast<ObjectKind>(kind) == ObjectKind::triangle)
      TrianglePrimitive::intersect<S>(rays, object, {}, self, &c);
    else if (static_cast<ObjectKind>(kind) == ObjectKind::sphere)
      SpherePrimitive::intersect<S>(rays, object, {}, self, &c);
    else
      intersect_plane<S>(rays, object, self, c);
    return c;
  }

  SceneAccess<Spu>& scene_;
  HitFilter hit_filter_;
  TraversalCounters counters_;
  uint32_t reflected_ = 0;
  Translucency translucency_ = Translucency::attenuates;
  uint32_t crossed_ = kNoOffset; ///< the object that shadow rays are tested against
  [[no_unique_address]] Present<RecentOccluders, kGathersOccluders<Spu>> recent_;
  [[no_unique_address]] Present<TorusPairs<Spu>, kGathersTorusPairs<Spu>> torus_pairs_;
};

} // namespace celltrace::kernel

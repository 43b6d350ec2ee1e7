// Tests of ray packets against single objects for both accelerators: closest hits, and the transmittance of
// shadow rays. Kernel dialect.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/primitives/crossing_sequence.hpp"
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
  uint64_t tests[kObjectKinds] = {}; ///< index: kind
  uint64_t visits = 0;               ///< voxels entered by rays, or nodes of the BVH expanded
};

/// Mailboxing (Amanatides and Woo 1987): remembers the objects that have been tested against the current
/// packet, so that an object in several voxels or leaves is tested once. Direct mapped: a collision costs a
/// second test.
class HitFilter {
public:
  /// Forgets all objects. Returns the packet's number, for resume_packet().
  uint32_t begin_packet() { return packet_ = ++last_packet_; }
  void resume_packet(uint32_t packet) { packet_ = packet; }
  /// Returns true on the first query for an object with the current packet; may return true again later.
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

/// The segment of each ray beyond `enter` and up to `leave`, or the whole ray if both are null.
struct RaySegment {
  const FloatLanes* enter;
  const FloatLanes* leave;

  /// Returns the lanes whose `distance` is within the segment.
  template <class S> uint32_t contains(const typename S::F& distance) const {
    using F = typename S::F;
    if (enter == nullptr) return 0xFFFF;
    return ((distance > F::load(enter->lane)) & (distance <= F::load(leave->lane))).bits();
  }
};

/// Tests packets against objects of the scene, and merges the results. A strategy's ObjectShortcuts have:
///
///   begin_occlusion(self)               is called before shadow rays are tested against an object
///   end_occlusion(self, flags, dark)    is called with the lanes that an object occludes
///   dims_at_once(at, crossings, lanes, light, dark)   true if a crossed translucent surface attenuates
///                                       `light`, which may become another one, at once; if not, shadow rays
///                                       of `dark` lanes end there
///   test_closest_shortly(rays, record, self, hits)    tests an object that is not simple; false: not tested
///   test_occlusion_shortly(rays, record, self, distance, light, dark)   tests an opaque object that is not
///                                       simple against shadow rays; false: not tested
///   clear_shadow_cache()                is called when the records may be another scene's
template <class Spu>
class ObjectTests : public Strategy<Spu>::template ObjectShortcuts<ObjectTests<Spu>, Spu> {
  using Shortcuts = typename Strategy<Spu>::template ObjectShortcuts<ObjectTests, Spu>;
  friend Shortcuts;

public:
  using S = typename Spu::simd;
  using F = typename S::F;
  using I = typename S::I;
  using M = typename S::M;

  explicit ObjectTests(SceneAccess<Spu>& scene) : scene_(scene) {}

  // Some functions are not inlined: the tests are most of the program's code, and one copy of each saves
  // local store.

  /// Tests an object and keeps hits that are closer than those in `hits`.
  CELLTRACE_ONE_COPY void test_closest(const RayPacket& rays, uint32_t self, HitPacket& hits) {
    scene_.spu().compute(scalar_work::kClosest);
    const ObjectRecord& object = *scene_.object(self);
    if (is_simple(object.kind_and_flags)) return keep_closest<S>(test(rays, object, self), self, hits);
    scene_.spu().enter_module(modules::kObjects);
    test_closest_of_other(rays, object, self, hits);
  }

  /// Returns the lanes that an object occludes. An opaque object is tested once, against all lanes of the
  /// packet. A translucent object attenuates the light of `lanes` by each crossing within `segment`: an
  /// object in several voxels is tested in each of them, but every crossing counts once. Lanes left without
  /// light are returned, too.
  CELLTRACE_ONE_COPY uint32_t occluded(const RayPacket& rays, uint32_t self, uint32_t lanes,
                                       const FloatLanes& distance, VectorLanes& light,
                                       const RaySegment& segment = {nullptr, nullptr}) {
    scene_.spu().compute(scalar_work::kShadow);
    const ObjectRecord& object = *scene_.object(self);
    const uint32_t flags = object.kind_and_flags;
    const uint32_t material = material_word::offset(object.material);
    if ((flags & object_flag::no_shadow) != 0) return 0;
    // Tests of instances take long and are limited to `lanes`; other rays may have to be tested later.
    const bool all_at_once = !is_instance(flags) || segment.enter != nullptr;
    if ((flags & object_flag::opaque) != 0 && all_at_once && !hit_filter_.first_test(self)) return 0;
    Shortcuts::begin_occlusion(self);
    uint32_t dark;
    if (is_simple(flags)) {
      dark = occluded_by(rays, test(rays, object, self), flags, material, lanes, distance, light, segment);
    } else {
      scene_.spu().enter_module(modules::kObjects);
      dark = occluded_by_other(rays, object, self, lanes, distance, light, segment);
    }
    Shortcuts::end_occlusion(self, flags, dark & lanes);
    return dark;
  }
  /// Tests the unbounded objects, which are in no accelerator, and the first `others` of the other objects.
  /// Unbounded objects come first: as in POV-Ray, they are seen if another object is at the same distance.
  void test_unbounded(const FrameBlock& frame, RayQuery& query, uint32_t others = 0) {
    test_list(frame.object_offset - frame.unbounded_count * kObjectBytes, frame.unbounded_count + others,
              query);
  }
  /// Tests `count` objects that follow each other from offset `self` on.
  void test_list(uint32_t self, uint32_t count, RayQuery& query) {
    hit_filter_.begin_packet();
    for (uint32_t i = 0; i < count && query.lanes != 0; ++i, self += kObjectBytes) {
      if (query.hits != nullptr)
        test_closest(*query.rays, self, *query.hits);
      else
        query.lanes &= ~occluded(*query.rays, self, query.lanes, *query.distance, *query.light);
    }
  }

  /// Lanes whose near or far crossing lies between the ray's origin and the light.
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

  /// Sets the lanes of rays from a mirror: some objects are invisible to these rays or to all others.
  void set_reflected(uint32_t lanes) { reflected_ = lanes; }

  SceneAccess<Spu>& scene() { return scene_; }
  HitFilter& hit_filter() { return hit_filter_; }
  TraversalCounters& counters() { return counters_; }
  const TraversalCounters& counters() const { return counters_; }
  /// Resets counters and forgets occluders: the records may now be another scene's.
  void begin_frame() {
    counters_ = TraversalCounters();
    Shortcuts::clear_shadow_cache();
  }

private:
  /// Returns true for spheres, triangles and planes that are not part of a CSG and are visible to all rays:
  /// their code is resident, and their tests read no further record.
  static bool is_simple(uint32_t flags) {
    return (flags & (object_flag::kind_mask | object_flag::csg | object_flag::selective)) <=
           static_cast<uint32_t>(ObjectKind::plane);
  }

  /// Returns the lanes that an object with these crossings occludes; see occluded().
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
  /// Attenuates `light` by a surface as attenuate() does, unless a shortcut keeps the crossing for later.
  uint32_t cross_translucent(const RayPacket& rays, const F& at, const Crossings<S>& c, uint32_t flags,
                             uint32_t material, uint32_t lanes, VectorLanes& light) {
    VectorLanes* dimmed = &light;
    uint32_t dark = 0;
    if (!Shortcuts::dims_at_once(at, c, lanes, dimmed, dark)) return dark;
    return attenuate(rays, at, c, flags, material, lanes, *dimmed);
  }

  // Objects that are not simple have several pairs of crossings, which count if the condition of the CSG
  // holds.

  CELLTRACE_ONE_COPY void test_closest_of_other(const RayPacket& rays, const ObjectRecord& record,
                                                uint32_t self, HitPacket& hits) {
    scene_.spu().run_in_module(modules::kObjects);
    const uint32_t flags = record.kind_and_flags;
    if (is_instance(flags)) return test_instance(rays, record, kMinHitDistance, false, hits);
    if (Shortcuts::test_closest_shortly(rays, record, self, hits)) return;
    const uint32_t blind = blind_lanes(flags, reflected_);
    Other other(*this, rays, record, self, kMinHitDistance, hits.distance);
    while (other.next()) {
      Crossings<S>& c = other.crossings();
      if ((flags & object_flag::selective) != 0) {
        const M sees = M::from_bits(~blind & 0xFFFF);
        c.near_hit = c.near_hit & sees;
        c.far_hit = c.far_hit & sees;
      }
      if (other.csg() != kNoOffset) {
        const F nearest = F::load(hits.distance.lane);
        const auto near = c.near_hit & (c.near > F(kMinHitDistance)) & (c.near <= nearest);
        const auto far = c.far_hit & (c.far > F(kMinHitDistance)) & (c.far <= nearest);
        accept(rays, other.csg(), near, far, false, reflected_, c);
      }
      keep_closest<S>(c, self, hits);
      const F least(kMinHitDistance); // a ray with a hit needs no other crossings, which are farther
      other.end(((c.near_hit & (c.near > least)) | (c.far_hit & (c.far > least))).bits());
    }
  }
  CELLTRACE_ONE_COPY uint32_t occluded_by_other(const RayPacket& rays, const ObjectRecord& record,
                                                uint32_t self, uint32_t lanes, const FloatLanes& distance,
                                                VectorLanes& light, const RaySegment& segment) {
    scene_.spu().run_in_module(modules::kObjects);
    const uint32_t flags = record.kind_and_flags, material = material_word::offset(record.material);
    if (is_instance(flags))
      return occluded_by_instance(rays, record, segment.enter != nullptr ? 0xFFFF : lanes, distance);
    const bool is_opaque = (flags & object_flag::opaque) != 0;
    uint32_t dark = 0;
    if (is_opaque && Shortcuts::test_occlusion_shortly(rays, record, self, distance, light, dark))
      return dark;
    Other other(*this, rays, record, self, is_opaque ? kShadowEpsilon : kEveryCrossing, distance);
    while (other.next()) {
      Crossings<S>& c = other.crossings();
      if (other.csg() != kNoOffset) {
        const ShadowHits shadow = shadow_hits(c, distance);
        accept(rays, other.csg(), M::from_bits(shadow.near), M::from_bits(shadow.far), !is_opaque, kSeesAll,
               c);
      }
      dark |= occluded_by(rays, c, flags, material, lanes & ~dark, distance, light, segment);
      other.end(dark);
    }
    return dark;
  }

  void test_instance(const RayPacket& rays, const ObjectRecord& record, float nearest, bool any,
                     HitPacket& hits) {
    ++counters_.tests[kInstanceKind];
    scene_.spu().enter_module(modules::kInstances);
    const auto work = module_instances::intersect(scene_, rays, record, nearest, any, hits);
    counters_.visits += work.nodes;
    counters_.tests[static_cast<uint32_t>(ObjectKind::triangle)] += work.triangles;
  }
  /// Returns the lanes that an instance occludes; all instances are opaque.
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
  class Other {
  public:
    /// Looks for crossings up to `limit`. If a ray has a crossing beyond `enough`, its other crossings need
    /// not be found, unless the object is part of a CSG.
    CELLTRACE_ONE_COPY
    Other(ObjectTests& tests, const RayPacket& rays, const ObjectRecord& record, uint32_t self, float enough,
          const FloatLanes& limit)
        : tests_(tests), rays_(rays), self_(self) {
      Kept<Spu, ObjectRecord> object = record;
      const uint32_t kind = object.kind_and_flags & object_flag::kind_mask;
      ExtraRecord room;
      if (object.extra == kNoOffset) room = {};
      const ExtraRecord& extra =
          object.extra == kNoOffset ? room : *keep<Spu>(tests.scene_.extra(object.extra), room);
      if ((object.kind_and_flags & object_flag::csg) != 0) csg_ = extra.csg;
      request_ = {csg_ != kNoOffset ? kEveryCrossing : enough, &limit};
      ++tests.counters_.tests[kind];
      tests.scene_.spu().compute(scalar_work::kTestEllipsoid);
      Spu& spu = tests.scene_.spu();
      spu.enter_module(Primitives::is_heavy(kind) ? modules::kHeavyShapes : modules::kShapes);
      Crossings<S>* const pairs = sequence_.pairs();
      if (Primitives::is_made_of_data(kind)) {
        intersect_made_of_data(tests.scene_, rays, object, extra, self, request_, pairs[0]);
        sequence_.begin(1, true);
        return;
      }
      sequence_.begin(Primitives::is_heavy(kind)
                          ? module_heavy::intersect(spu, rays, object, extra, self, request_, pairs)
                          : module_shapes::intersect(spu, rays, object, extra, self, pairs),
                      Primitives::is_incremental(kind));
      if (!Primitives::has_edges(kind)) return;
      spu.enter_module(modules::kPolygons);
      module_polygons::cut_out(tests.scene_, extra, pairs[0]);
    }

    /// Advances to the next pair of crossings of any ray. Returns false if there is none.
    CELLTRACE_ONE_COPY bool next() {
      return sequence_.next([this](const FloatLanes& after, Crossings<S>& c) { find_after(after, c); });
    }
    Crossings<S>& crossings() { return sequence_.current(); }
    /// Ends the search for crossings of some rays.
    void end(uint32_t lanes) { sequence_.end(lanes); }
    /// Returns the offset of the object's CSG condition.
    uint32_t csg() const { return csg_; }

  private:
    CELLTRACE_ONE_COPY void find_after(const FloatLanes& after, Crossings<S>& c) {
      Kept<Spu, ObjectRecord> object = *tests_.scene_.object(self_);
      ExtraRecord room = {};
      const ExtraRecord& extra =
          object.extra == kNoOffset ? room : *keep<Spu>(tests_.scene_.extra(object.extra), room);
      request_.after = &after;
      if (Primitives::is_made_of_data(object.kind_and_flags & object_flag::kind_mask))
        return intersect_made_of_data(tests_.scene_, rays_, object, extra, self_, request_, c);
      tests_.scene_.spu().enter_module(modules::kHeavyShapes);
      module_heavy::intersect(tests_.scene_.spu(), rays_, object, extra, self_, request_, &c);
    }

    ObjectTests& tests_;
    const RayPacket& rays_;
    uint32_t self_;
    CrossingRequest request_;
    uint32_t csg_ = kNoOffset;
    CrossingSequence<S, Primitives::kSomeAreIncremental> sequence_;
  };

  /// Removes crossings that do not satisfy the condition; `near` and `far` are the candidates. If a ray's
  /// near crossing is accepted, its far crossing may be left out unless `needs_both`.
  void accept(const RayPacket& rays, uint32_t condition, const M& near, const M& far, bool needs_both,
              uint32_t reflected, Crossings<S>& c) {
    c.near_hit = accepted(rays, condition, c.near, near.bits(), reflected);
    const uint32_t known = needs_both ? 0 : c.near_hit.bits();
    c.far_hit = accepted(rays, condition, c.far, far.bits() & ~known, reflected);
  }
  /// Returns the lanes of crossings that satisfy the condition. Not inlined, as it is called in four places.
  CELLTRACE_ONE_COPY M accepted(const RayPacket& rays, uint32_t condition, const F& distance, uint32_t lanes,
                                uint32_t reflected) {
    if (lanes == 0) return M::none();
    const V3<S> origin = rays.origin.template load<S>(), direction = rays.direction.template load<S>();
    return M::from_bits(
        csg_accepted(scene_, condition, origin, origin + direction * distance, lanes, reflected));
  }

  /// Multiplies the light of `lanes` by the transmittance of a translucent surface that they cross at `at`.
  /// Returns the lanes left with less than 1e-10 in each channel, whose rays can stop.
  CELLTRACE_ONE_COPY uint32_t attenuate(const RayPacket& rays, const F& at, const Crossings<S>& c,
                                        uint32_t flags, uint32_t material, uint32_t lanes,
                                        VectorLanes& light) {
    using R = typename Spu::rare_simd;
    using RF = typename R::F;
    scene_.spu().compute(scalar_work::kFilter);
    const V3<S> points = rays.origin.template load<S>() + rays.direction.template load<S>() * at;
    // If the lambda referred to `c`, all crossings would be copied even if nothing is translucent.
    const F all_u = c.u, all_v = c.v;
    uint32_t dark = 0;
    for_each_part<Spu>([&](uint32_t first) {
      const uint32_t some = part_of<Spu>(lanes, first);
      if (some == 0) return;
      const PatternPoints<R> crossed = {part_of<Spu>(points, first)};
      V3<R> transmittance;
      surface_transmittance(scene_, material, (flags & object_flag::blended) != 0, crossed,
                            part_of<Spu>(all_u, first), part_of<Spu>(all_v, first), some, transmittance);
      const V3<R> before = light.template load_from<R>(first), after = before * transmittance;
      light.template store_from<R>(first, select<R>(R::M::from_bits(some), after, before));
      const RF most = R::max(R::abs(after.x), R::max(R::abs(after.y), R::abs(after.z)));
      dark |= ((most < RF(1e-10f)).bits() & some) << first;
    });
    return dark;
  }

  /// Tests a simple object.
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
};

} // namespace celltrace::kernel

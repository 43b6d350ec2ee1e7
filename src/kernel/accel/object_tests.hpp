// What a ray packet does with one object, however the object was found: keeps its hit if it is the closest,
// or takes from the light that passes it. Kernel dialect.
#pragma once

#include "kernel/primitives/intersect.hpp"
#include "kernel/scalar_work.hpp"
#include "kernel/scene_access.hpp"

namespace celltrace::kernel {

/// Counters of a frame that the report carries.
struct TraversalCounters {
  uint64_t tests[3] = {0, 0, 0}; ///< by ObjectKind
  uint64_t visits = 0;           ///< or nodes of the BVH
};

/// Remembers which objects were tested against the current packet. Direct mapped: a collision costs a second
/// test.
class HitFilter {
public:
  /// Returns what resume_packet() goes on with.
  uint32_t begin_packet() { return packet_ = ++last_packet_; }
  void resume_packet(uint32_t packet) { packet_ = packet; }
  /// True the first time an object is asked for within a packet; may be true again later.
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

/// Part of each ray: beyond `enter`, up to `leave`. Without them, all of it.
struct Stretch {
  const FloatLanes* enter;
  const FloatLanes* leave;

  bool has(uint32_t lane, float distance) const {
    return enter == nullptr || (distance > enter->lane[lane] && distance <= leave->lane[lane]);
  }
};

template <class Spu> class ObjectTests {
public:
  using S = typename Spu::simd;
  using F = typename S::F;
  using I = typename S::I;
  using M = typename S::M;

  explicit ObjectTests(SceneAccess<Spu>& scene) : scene_(scene) {}

  // One copy of each, whatever calls them: the tests are what most of the program's code consists of, and
  // local store is short.

  __attribute__((noinline)) void test_closest(const RayPacket& rays, uint32_t self, HitPacket& hits) {
    scene_.spu().compute(scalar_work::kClosest);
    keep_closest(test(rays, *scene_.object(self), self), self, hits);
  }

  /// The same of several packets.
  void test_closest_of_all(const RayQuery* queries, uint32_t packets, uint32_t self) {
    const ObjectRecord& object = *scene_.object(self);
    const uint32_t kind = object.kind_and_flags & object_flag::kind_mask;
    if (static_cast<ObjectKind>(kind) != ObjectKind::triangle) {
      for_each_lane(packets, [&](uint32_t i) { test_closest(*queries[i].rays, self, *queries[i].hits); });
      return;
    }
    counters_.tests[kind] += static_cast<uint32_t>(__builtin_popcount(packets));
    const auto sides = TriangleSides<S>::of(object);
    // A plain loop: what does not change in it stays in registers.
    for (uint32_t left = packets; left != 0; left &= left - 1) {
      const RayQuery& query = queries[__builtin_ctz(left)];
      const SeenTriangle<S> triangle(query.rays->origin.template load<S>(), sides);
      keep_closest(triangle.crossed(*query.rays, self), self, *query.hits);
    }
  }

  /// Lanes that an object shuts off from the light. An opaque one shuts off whatever lanes of the packet it
  /// covers, when it is met first; a translucent one dims `lanes` at each crossing on the stretch, so that
  /// each counts once although the object may be met on several.
  __attribute__((noinline)) uint32_t occluded(const RayPacket& rays, uint32_t self, uint32_t lanes,
                                              const FloatLanes& distance, VectorLanes& light,
                                              const Stretch& on = {nullptr, nullptr}) {
    scene_.spu().compute(scalar_work::kShadow);
    const ObjectRecord& object = *scene_.object(self);
    const uint32_t flags = object.kind_and_flags;
    const uint32_t material = object.material;
    if ((flags & object_flag::no_shadow) != 0) return 0;
    const bool opaque = (flags & object_flag::opaque) != 0;
    if (opaque && !hit_filter_.first_test(self)) return 0;
    const Crossings<S> c = test(rays, object, self);
    const Between between = in_between(c, distance);
    const uint32_t near_hit = between.near, far_hit = between.far;
    if (opaque) return near_hit | far_hit;
    FloatLanes near, far, u, v;
    c.near.store(near.lane);
    c.far.store(far.lane);
    c.u.store(u.lane);
    c.v.store(v.lane);
    uint32_t dark = 0;
    for_each_lane(lanes & (near_hit | far_hit), [&](uint32_t lane) {
      const auto counts = [&](uint32_t hit, const FloatLanes& at) {
        return static_cast<uint32_t>(((hit >> lane) & 1) != 0 && on.has(lane, at.lane[lane]));
      };
      const uint32_t crossings = counts(near_hit, near) + counts(far_hit, far);
      if (crossings != 0 && dim(flags, material, u.lane[lane], v.lane[lane], crossings, lane, light))
        dark |= 1u << lane;
    });
    return dark;
  }

  /// The same of several packets, each in the lanes to which light still comes, on the whole stretch. None of
  /// them has met the object before.
  void test_occlusion_of_all(RayQuery* queries, uint32_t packets, uint32_t self) {
    const ObjectRecord& object = *scene_.object(self);
    const uint32_t flags = object.kind_and_flags;
    if ((flags & object_flag::no_shadow) != 0) return;
    if (!is_opaque_triangle(flags)) {
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
      query.lanes &= ~in_between(triangle.crossed(rays, self), *query.distance).near;
    }
  }

  static void keep_closest(const Crossings<S>& c, uint32_t self, HitPacket& hits) {
    const M near_valid = c.near_hit & (c.near > F(kMinHitDistance));
    const M far_valid = c.far_hit & (c.far > F(kMinHitDistance));
    const F distance = S::select(near_valid, c.near, c.far);
    const F nearest = F::load(hits.distance.lane);
    const M hit = near_valid | far_valid;
    const M not_farther = hit & (distance <= nearest);
    // Of two hits at the same place the object that comes first in the scene counts, in whatever order they
    // are found.
    auto* objects = reinterpret_cast<int32_t*>(hits.object.lane);
    const I present = I::load(objects);
    const I candidate = I::splat(static_cast<int32_t>(self));
    const M closer = not_farther & ((distance < nearest) | (candidate < present));
    S::select(closer, distance, nearest).store(hits.distance.lane);
    S::select(closer, c.u, F::load(hits.u.lane)).store(hits.u.lane);
    S::select(closer, c.v, F::load(hits.v.lane)).store(hits.v.lane);
    S::select(closer, candidate, present).store(objects);
  }

  /// Whether an object is a triangle that keeps all light off.
  static bool is_opaque_triangle(uint32_t flags) {
    return static_cast<ObjectKind>(flags & object_flag::kind_mask) == ObjectKind::triangle &&
           (flags & (object_flag::opaque | object_flag::no_shadow)) == object_flag::opaque;
  }

  /// POV-Ray's tolerance at both ends of a shadow ray.
  static constexpr float kShadowTolerance = 1e-3f;

  SceneAccess<Spu>& scene() { return scene_; }
  HitFilter& hit_filter() { return hit_filter_; }
  TraversalCounters& counters() { return counters_; }
  const TraversalCounters& counters() const { return counters_; }
  void reset_counters() { counters_ = TraversalCounters(); }

private:
  /// Lanes that cross a surface on their way to a light.
  struct Between {
    uint32_t near, far;
  };
  static Between in_between(const Crossings<S>& c, const FloatLanes& distance) {
    const F low(kShadowTolerance);
    const F high = F::load(distance.lane) - low;
    return {(c.near_hit & (c.near > low) & (c.near < high)).bits(),
            (c.far_hit & (c.far > low) & (c.far < high)).bits()};
  }

  /// Takes from the light of one lane what `crossings` crossings of a translucent object hold back. True if
  /// that leaves it dark.
  bool dim(uint32_t flags, uint32_t material, float u, float v, uint32_t crossings, uint32_t lane,
           VectorLanes& light) {
    scene_.spu().compute(scalar_work::kFilter);
    float through[3];
    transmission(flags, material, u, v, through);
    FloatLanes* channels[3] = {&light.x, &light.y, &light.z};
    bool dark = true;
    for (int i = 0; i < 3; ++i) {
      const float passed = crossings == 2 ? through[i] * through[i] : through[i];
      float& value = channels[i]->lane[lane];
      value *= passed;
      dark = dark && value < 1e-10f && value > -1e-10f;
    }
    return dark;
  }

  Crossings<S> test(const RayPacket& rays, const ObjectRecord& object, uint32_t self) {
    const uint32_t kind = object.kind_and_flags & object_flag::kind_mask;
    ++counters_.tests[kind];
    scene_.spu().compute(scalar_work::kTest[kind]);
    return intersect<S>(rays, object, self);
  }

  /// What a surface lets through of each colour channel.
  void transmission(uint32_t flags, uint32_t material, float u, float v, float (&through)[3]) {
    uint32_t corners[3] = {material, material, material};
    float weights[3] = {1.0f, 0.0f, 0.0f};
    const bool blended = (flags & object_flag::blended) != 0;
    if (blended) {
      const BlendRecord blend = *scene_.blend(material);
      for (int i = 0; i < 3; ++i)
        corners[i] = blend.material[i];
      weights[0] = 1.0f - u - v;
      weights[1] = u;
      weights[2] = v;
    }
    for (int i = 0; i < 3; ++i)
      through[i] = 0.0f;
    for (int corner = 0; corner < (blended ? 3 : 1); ++corner) {
      const MaterialRecord& m = *scene_.material(corners[corner]);
      for (int i = 0; i < 3; ++i)
        through[i] += weights[corner] * (m.pigment[i] * m.filter + m.transmit);
    }
  }

  SceneAccess<Spu>& scene_;
  HitFilter hit_filter_;
  TraversalCounters counters_;
};

} // namespace celltrace::kernel

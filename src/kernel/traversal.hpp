// Find closest intersection, and what reaches a light: packets through the grid. Kernel dialect.
//
// The rays of a packet walk the grid one by one, as voxels differ from ray to ray; an object met by one of
// them is tested against the whole packet, and a mailbox per packet (Amanatides and Woo) keeps the next ray
// from testing it again. Each lane keeps the nearest of all tested hits and stops once that lies in the voxel
// it is in.
#pragma once

#include "kernel/intersect.hpp"
#include "kernel/scalar_work.hpp"
#include "kernel/scene_access.hpp"
#include "kernel/voxel_walk.hpp"

namespace celltrace::kernel {

/// Counters of a frame that the report carries.
struct TraversalCounters {
  uint64_t tests[3] = {0, 0, 0}; ///< by ObjectKind
  uint64_t voxels = 0;
};

/// Remembers which objects were tested against the current packet. Direct mapped: a collision costs a second
/// test.
class PacketMailbox {
public:
  void begin_packet() { ++packet_; }
  /// True the first time an object is asked for within a packet; may be true again later.
  bool first_visit(uint32_t object) {
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
  uint32_t packet_ = 0;
};

template <class Spu> class Traversal {
public:
  using S = typename Spu::simd;
  using F = typename S::F;
  using I = typename S::I;
  using M = typename S::M;

  Traversal(SceneAccess<Spu>& scene, const GridRecord& grid) : scene_(scene), grid_(grid) {}

  /// The closest hit of each ray in `lanes`. Other lanes' results are meaningless.
  void find_closest(const RayPacket& rays, uint32_t lanes, HitPacket& hits) {
    F(kMaxHitDistance).store(hits.distance.lane);
    I::splat(-1).store(reinterpret_cast<int32_t*>(hits.object.lane));
    mailbox_.begin_packet();
    for_each_lane(lanes, [&](uint32_t lane) {
      walk(rays, lane, [&](uint32_t cell, float, float leave) {
        for_each_object(cell, [&](uint32_t self) {
          if (mailbox_.first_visit(self)) test_closest(rays, self, hits);
          return false;
        });
        return hits.distance.lane[lane] <= leave;
      });
    });
  }

  /// Multiplies `light` of each ray in `lanes` by what lies between its origin and `distance` along it: 0
  /// behind an opaque object, the filtering of each surface crossed otherwise.
  void attenuate(const RayPacket& rays, uint32_t lanes, const FloatLanes& distance, VectorLanes& light) {
    mailbox_.begin_packet();
    uint32_t lit = lanes;
    for_each_lane(lanes, [&](uint32_t lane) {
      if (((lit >> lane) & 1) == 0) return;
      walk(rays, lane, [&](uint32_t cell, float enter, float leave) {
        for_each_object(cell, [&](uint32_t self) {
          lit &= ~shadowed(rays, self, lane, enter, leave, distance, light);
          return ((lit >> lane) & 1) == 0;
        });
        return ((lit >> lane) & 1) == 0 || distance.lane[lane] <= leave;
      });
    });
    const V3<S> dark = {F(0.0f), F(0.0f), F(0.0f)};
    light.template store<S>(select<S>(M::from_bits(lit), light.template load<S>(), dark));
  }

  const TraversalCounters& counters() const { return counters_; }
  void reset_counters() { counters_ = TraversalCounters(); }

private:
  /// POV-Ray's tolerance at both ends of a shadow ray.
  static constexpr float kShadowTolerance = 1e-3f;

  template <class Visit> void walk(const RayPacket& rays, uint32_t lane, Visit visit) {
    const float origin[3] = {rays.origin.x.lane[lane], rays.origin.y.lane[lane], rays.origin.z.lane[lane]};
    const float direction[3] = {rays.direction.x.lane[lane], rays.direction.y.lane[lane],
                                rays.direction.z.lane[lane]};
    uint64_t voxels = 0;
    scene_.spu().compute(scalar_work::kWalk);
    walk_voxels(grid_, origin, direction, [&](uint32_t cell, float enter, float leave) {
      ++voxels;
      scene_.spu().compute(scalar_work::kVoxel);
      return visit(cell, enter, leave);
    });
    counters_.voxels += voxels;
  }

  /// Calls `visit(object offset)` for the objects of a voxel until it returns true.
  template <class Visit> void for_each_object(uint32_t cell, Visit visit) {
    const CellRecord list = scene_.cell(grid_, cell);
    for (uint32_t i = 0; i < list.count; ++i) {
      scene_.spu().compute(scalar_work::kListedObject);
      if (visit(scene_.list_word(list.list + i * 4))) return;
    }
  }

  Crossings<S> test(const RayPacket& rays, const ObjectRecord& object, uint32_t self) {
    const uint32_t kind = object.kind_and_flags & object_flag::kind_mask;
    ++counters_.tests[kind];
    scene_.spu().compute(scalar_work::kTest[kind]);
    return intersect<S>(rays, object, self);
  }

  void test_closest(const RayPacket& rays, uint32_t self, HitPacket& hits) {
    scene_.spu().compute(scalar_work::kClosest);
    const Crossings<S> c = test(rays, *scene_.object(self), self);
    const M near_valid = c.near_hit & (c.near > F(kMinHitDistance));
    const M far_valid = c.far_hit & (c.far > F(kMinHitDistance));
    const F distance = S::select(near_valid, c.near, c.far);
    const F nearest = F::load(hits.distance.lane);
    const M closer = (near_valid | far_valid) & (distance < nearest);
    if (closer.bits() == 0) return;
    S::select(closer, distance, nearest).store(hits.distance.lane);
    S::select(closer, c.u, F::load(hits.u.lane)).store(hits.u.lane);
    S::select(closer, c.v, F::load(hits.v.lane)).store(hits.v.lane);
    auto* objects = reinterpret_cast<int32_t*>(hits.object.lane);
    S::select(closer, I::splat(static_cast<int32_t>(self)), I::load(objects)).store(objects);
  }

  /// Lanes that the object shuts off from the light. An opaque object shuts off whatever lanes it covers; a
  /// translucent one dims the ray that is walking, at those crossings that lie in the voxel it is in, so that
  /// each crossing counts once although the object is in the lists of several voxels.
  uint32_t shadowed(const RayPacket& rays, uint32_t self, uint32_t lane, float enter, float leave,
                    const FloatLanes& distance, VectorLanes& light) {
    scene_.spu().compute(scalar_work::kShadow);
    const ObjectRecord& object = *scene_.object(self);
    const uint32_t flags = object.kind_and_flags;
    if ((flags & object_flag::no_shadow) != 0) return 0;
    if ((flags & object_flag::opaque) != 0) {
      if (!mailbox_.first_visit(self)) return 0;
      const Crossings<S> c = test(rays, object, self);
      const F low(kShadowTolerance);
      const F high = F::load(distance.lane) - low;
      return ((c.near_hit & (c.near > low) & (c.near < high)) | (c.far_hit & (c.far > low) & (c.far < high)))
          .bits();
    }
    const Crossings<S> c = test(rays, object, self);
    const uint32_t bit = 1u << lane;
    FloatLanes near, far, u, v;
    c.near.store(near.lane);
    c.far.store(far.lane);
    c.u.store(u.lane);
    c.v.store(v.lane);
    const auto counts = [&](const M& hit, float t) {
      return (hit.bits() & bit) != 0 && t > kShadowTolerance && t < distance.lane[lane] - kShadowTolerance &&
             t > enter && t <= leave;
    };
    const uint32_t crossings = static_cast<uint32_t>(counts(c.near_hit, near.lane[lane])) +
                               static_cast<uint32_t>(counts(c.far_hit, far.lane[lane]));
    scene_.spu().compute(scalar_work::kFilter);
    if (crossings == 0) return 0;
    float through[3];
    transmission(object.kind_and_flags, object.material, u.lane[lane], v.lane[lane], through);
    FloatLanes* channels[3] = {&light.x, &light.y, &light.z};
    bool dark = true;
    for (int i = 0; i < 3; ++i) {
      const float passed = crossings == 2 ? through[i] * through[i] : through[i];
      float& value = channels[i]->lane[lane];
      value *= passed;
      dark = dark && value < 1e-10f && value > -1e-10f;
    }
    return dark ? bit : 0;
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
  const GridRecord& grid_;
  PacketMailbox mailbox_;
  TraversalCounters counters_;
};

} // namespace celltrace::kernel

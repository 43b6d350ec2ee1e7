// Packets through the hierarchy of boxes. Kernel dialect.
//
// The rays of a packet whose directions have the same signs go together as a beam, nearest children first;
// rays that have little in common go alone. An object met by some is tested against the whole packet.
#pragma once

#include "kernel/beam.hpp"
#include "kernel/object_tests.hpp"

namespace celltrace::kernel {

template <class Spu> class HierarchyTraversal {
public:
  using S = typename Spu::simd;
  using F = typename S::F;
  using M = typename S::M;

  HierarchyTraversal(ObjectTests<Spu>& objects, const HierarchyRecord& hierarchy)
      : objects_(objects), hierarchy_(hierarchy) {}

  /// As Traversal's, into hits that hold none yet.
  void find_closest(const RayPacket& rays, uint32_t lanes, HitPacket& hits) {
    objects_.mailbox().begin_packet();
    for_each_beam(rays, lanes, [&](const Beam<S>& beam, uint32_t group) {
      walk(beam, kMaxHitDistance, [&](uint32_t self, float& limit) {
        if (!objects_.mailbox().first_visit(self)) return false;
        objects_.test_closest(rays, self, hits);
        limit = farthest(hits.distance, group);
        return false;
      });
    });
  }

  /// As Traversal's; returns the lanes to which some light comes.
  uint32_t attenuate(const RayPacket& rays, uint32_t lanes, const FloatLanes& distance, VectorLanes& light) {
    objects_.mailbox().begin_packet();
    uint32_t lit = lanes;
    for_each_beam(rays, lanes, [&](const Beam<S>& beam, uint32_t group) {
      if ((lit & group) == 0) return;
      walk(beam, farthest(distance, group), [&](uint32_t self, float&) {
        lit &= ~shadowed(rays, self, group, distance, light);
        return (lit & group) == 0;
      });
    });
    return lit;
  }

private:
  /// Beams whose rays differ by more go as single rays: found by measurement on meshes with mirrors.
  static constexpr float kMaxDirectionSpread = 0.6f;

  /// Splits the lanes into beams: calls `visit(beam, lanes of it)` for each.
  template <class Visit> void for_each_beam(const RayPacket& rays, uint32_t lanes, Visit visit) {
    uint32_t left = lanes;
    while (left != 0) {
      const uint32_t octant = Beam<S>::octant_of(rays, static_cast<uint32_t>(__builtin_ctz(left)));
      const uint32_t group = left & lanes_in_octant(rays, octant);
      left &= ~group;
      const Beam<S> beam(rays, group, octant);
      if (beam.direction_spread() <= kMaxDirectionSpread) {
        visit(beam, group);
        continue;
      }
      for_each_lane(group, [&](uint32_t lane) { visit(Beam<S>(rays, 1u << lane, octant), 1u << lane); });
    }
  }

  static uint32_t lanes_in_octant(const RayPacket& rays, uint32_t octant) {
    const F zero(0.0f);
    const V3<S> direction = rays.direction.template load<S>();
    const uint32_t x = (direction.x < zero).bits(), y = (direction.y < zero).bits(),
                   z = (direction.z < zero).bits();
    const auto same = [](uint32_t negative, uint32_t wanted) { return wanted != 0 ? negative : ~negative; };
    return same(x, octant & 1) & same(y, octant & 2) & same(z, octant & 4);
  }

  /// The greatest value of the lanes in `group`; all are positive.
  static float farthest(const FloatLanes& values, uint32_t group) {
    FloatLanes high;
    S::select(M::from_bits(group), F::load(values.lane), F(0.0f)).store(high.lane);
    for (uint32_t half = kSimdLanes / 2; half != 0; half /= 2)
      for (uint32_t i = 0; i < half; ++i)
        high.lane[i] = larger(high.lane[i], high.lane[i + half]);
    return high.lane[0];
  }

  struct Entry {
    uint32_t child, count;
    float enter;
  };
  /// Three children wait per level, at most.
  static constexpr uint32_t kStackEntries = 3 * 48 + 4;

  /// Visits the objects in the boxes that the beam meets up to `limit`, which `visit(object, limit)` may
  /// bring nearer; it returns true to stop.
  template <class Visit> void walk(const Beam<S>& beam, float limit, Visit visit) {
    SceneAccess<Spu>& scene = objects_.scene();
    Entry stack[kStackEntries];
    uint32_t waiting = 1;
    stack[0] = {hierarchy_.node_offset, 0, 0.0f};
    uint64_t nodes = 0;
    while (waiting != 0) {
      const Entry entry = stack[--waiting];
      if (entry.enter > limit) continue;
      if (entry.count != 0) {
        for (uint32_t i = 0; i < entry.count; ++i)
          if (visit(scene.list_word(entry.child + i * 4), limit)) {
            waiting = 0;
            break;
          }
        continue;
      }
      ++nodes;
      const NodeRecord& node = *scene.node(entry.child);
      alignas(16) float enter[4];
      uint32_t met = beam.meets(node.box, limit, enter);
      const uint32_t first = waiting;
      while (met != 0) {
        const uint32_t i = static_cast<uint32_t>(__builtin_ctz(met));
        met &= met - 1;
        // Into its place among its siblings, the nearest last.
        uint32_t place = waiting++;
        for (; place > first && stack[place - 1].enter < enter[i]; --place)
          stack[place] = stack[place - 1];
        stack[place] = {node.child[i], node.count[i], enter[i]};
      }
    }
    objects_.counters().voxels += nodes;
  }

  /// Lanes of the group that the object shuts off from the light. An opaque one shuts off whatever lanes of
  /// the packet it covers; a translucent one is met once by each beam.
  uint32_t shadowed(const RayPacket& rays, uint32_t self, uint32_t group, const FloatLanes& distance,
                    VectorLanes& light) {
    const ObjectRecord& object = *objects_.scene().object(self);
    const uint32_t flags = object.kind_and_flags;
    const uint32_t material = object.material;
    if ((flags & object_flag::no_shadow) != 0) return 0;
    if ((flags & object_flag::opaque) != 0) {
      if (!objects_.mailbox().first_visit(self)) return 0;
      return objects_.crossed_before(objects_.test(rays, object, self), distance);
    }
    const Crossings<S> c = objects_.test(rays, object, self);
    const F low(ObjectTests<Spu>::kShadowTolerance);
    const F high = F::load(distance.lane) - low;
    const uint32_t near = (c.near_hit & (c.near > low) & (c.near < high)).bits() & group;
    const uint32_t far = (c.far_hit & (c.far > low) & (c.far < high)).bits() & group;
    FloatLanes u, v;
    c.u.store(u.lane);
    c.v.store(v.lane);
    uint32_t dark = 0;
    for_each_lane(near | far, [&](uint32_t lane) {
      const uint32_t crossings = ((near >> lane) & 1) + ((far >> lane) & 1);
      if (objects_.dim(flags, material, u.lane[lane], v.lane[lane], crossings, lane, light))
        dark |= 1u << lane;
    });
    return dark;
  }

  ObjectTests<Spu>& objects_;
  const HierarchyRecord& hierarchy_;
};

} // namespace celltrace::kernel

// Packets through the hierarchy of boxes. Kernel dialect.
//
// The rays of a packet whose directions have the same signs go together as a beam, nearest children first;
// rays that have little in common go alone. A box that the beam meets is held against its rays, all at once,
// before it is opened. An object met by some is tested against the whole packet.
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
    Search search{rays, &hits, nullptr, nullptr, lanes};
    run(search);
  }

  /// As Traversal's; returns the lanes to which some light comes.
  uint32_t attenuate(const RayPacket& rays, uint32_t lanes, const FloatLanes& distance, VectorLanes& light) {
    Search search{rays, nullptr, &distance, &light, lanes};
    run(search);
    return search.lanes;
  }

private:
  /// Beams whose rays differ by more go as single rays: found by measurement on meshes with mirrors.
  static constexpr float kMaxDirectionSpread = 0.6f;

  /// What is asked of a packet. One code for both questions: it is long, and local store is short.
  struct Search {
    const RayPacket& rays;
    HitPacket* hits;            ///< of a search for the closest hits
    const FloatLanes* distance; ///< of a search for what is in the way of the light
    VectorLanes* light;
    uint32_t lanes; ///< that are looked at; of shadow rays, those to which some light still comes
  };

  /// Splits the lanes into beams, and sends each through the hierarchy.
  void run(Search& search) {
    Spu& spu = objects_.scene().spu();
    objects_.mailbox().begin_packet();
    const RayPacket& rays = search.rays;
    uint32_t left = search.lanes;
    while (left != 0) {
      const uint32_t octant = Beam<S>::octant_of(rays, static_cast<uint32_t>(__builtin_ctz(left)));
      uint32_t group = left & lanes_in_octant(rays, octant);
      left &= ~group;
      bool whole = true;
      while (group != 0) {
        // First all of them; if they have little in common, one by one.
        const uint32_t part = whole ? group : group & (~group + 1);
        spu.compute(scalar_work::kBeam);
        const Beam<S> beam(rays, part, octant);
        if (whole && beam.direction_spread() > kMaxDirectionSpread) {
          whole = false;
          continue;
        }
        group &= ~part;
        if ((search.lanes & part) != 0) walk(beam, part, search);
      }
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
    return interval_of<S>(S::select(M::from_bits(group), F::load(values.lane), F(0.0f))).high;
  }

  struct Entry {
    uint32_t child, count;
    float enter;
  };
  /// Three children wait per level, at most. The builder goes no deeper.
  static constexpr uint32_t kStackEntries = 3 * 48 + 4;

  /// How far each ray looks.
  static F limits(const Search& search) {
    return F::load(search.hits != nullptr ? search.hits->distance.lane : search.distance->lane);
  }

  /// Visits the objects in the boxes that the beam, which has the rays in `group`, meets.
  void walk(const Beam<S>& beam, uint32_t group, Search& search) {
    float limit = search.hits != nullptr ? kMaxHitDistance : farthest(*search.distance, group);
    SceneAccess<Spu>& scene = objects_.scene();
    uint32_t waiting = 1;
    stack_[0] = {hierarchy_.node_offset, 0, 0.0f};
    uint64_t nodes = 0;
    while (waiting != 0) {
      const Entry entry = stack_[--waiting];
      if (entry.enter > limit) continue;
      if (entry.count != 0) {
        for (uint32_t i = 0; i < entry.count; ++i) {
          scene.spu().compute(scalar_work::kListedObject);
          const uint32_t self = scene.list_word(entry.child + i * 4);
          if (search.hits == nullptr) {
            search.lanes &= ~shadowed(search.rays, self, group, *search.distance, *search.light);
            if ((search.lanes & group) != 0) continue;
            waiting = 0;
            break;
          } else if (objects_.mailbox().first_visit(self)) {
            objects_.test_closest(search.rays, self, *search.hits);
            limit = farthest(search.hits->distance, group);
          }
        }
        continue;
      }
      ++nodes;
      scene.spu().compute(scalar_work::kNodeOfBoxes);
      const NodeRecord& node = *scene.node(entry.child);
      alignas(16) float enter[4];
      uint32_t met = beam.meets(node.box, limit, enter);
      const uint32_t first = waiting;
      while (met != 0) {
        const uint32_t i = static_cast<uint32_t>(__builtin_ctz(met));
        met &= met - 1;
        // Looser than its rays, the beam may meet what passes between them.
        if ((beam.rays_that_meet(node.box, i, limits(search)) & group) == 0) continue;
        // Into its place among its siblings, the nearest last.
        uint32_t place = waiting++;
        for (; place > first && stack_[place - 1].enter < enter[i]; --place)
          stack_[place] = stack_[place - 1];
        stack_[place] = {node.child[i], node.count[i], enter[i]};
      }
    }
    objects_.counters().voxels += nodes;
  }

  /// Lanes of the group that the object shuts off from the light. An opaque one shuts off whatever lanes of
  /// the packet it covers; a translucent one is met once by each beam.
  uint32_t shadowed(const RayPacket& rays, uint32_t self, uint32_t group, const FloatLanes& distance,
                    VectorLanes& light) {
    objects_.scene().spu().compute(scalar_work::kShadow);
    const ObjectRecord& object = *objects_.scene().object(self);
    const uint32_t flags = object.kind_and_flags;
    const uint32_t material = object.material;
    if ((flags & object_flag::no_shadow) != 0) return 0;
    const bool opaque = (flags & object_flag::opaque) != 0;
    if (opaque && !objects_.mailbox().first_visit(self)) return 0;
    ShadowCrossings c;
    objects_.test_shadow(rays, object, self, distance, c);
    if (opaque) return c.near_hit | c.far_hit;
    uint32_t dark = 0;
    for_each_lane((c.near_hit | c.far_hit) & group, [&](uint32_t lane) {
      const uint32_t crossings = ((c.near_hit >> lane) & 1) + ((c.far_hit >> lane) & 1);
      if (objects_.dim(flags, material, c.u.lane[lane], c.v.lane[lane], crossings, lane, light))
        dark |= 1u << lane;
    });
    return dark;
  }

  ObjectTests<Spu>& objects_;
  const HierarchyRecord& hierarchy_;
  Entry stack_[kStackEntries];
};

} // namespace celltrace::kernel

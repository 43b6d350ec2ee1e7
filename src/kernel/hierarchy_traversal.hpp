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
  /// Beams whose rays differ by more go in parts: found by measurement on scenes with mirrors and glass.
  static constexpr float kMaxDirectionSpread = 1.0f;
  /// What the rounding of hits' distances amounts to.
  static constexpr float kBeyond = 1.00001f;

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
      const uint32_t octant = octant_of(rays, static_cast<uint32_t>(__builtin_ctz(left)));
      uint32_t group = left & lanes_in_octant(rays, octant);
      left &= ~group;
      const OctantRays<S> octant_rays(rays, octant);
      // First all of them; if they have little in common, four neighbours at a time, or one.
      uint32_t parts = 0;
      while (group != 0) {
        const uint32_t part = group & part_of(parts, static_cast<uint32_t>(__builtin_ctz(group)));
        spu.compute(scalar_work::kBeam);
        beam_.set(rays, part, octant);
        if (beam_.direction_spread() > kMaxDirectionSpread) {
          ++parts;
          continue;
        }
        if (parts == 2) parts = 1;
        group &= ~part;
        if ((search.lanes & part) != 0) walk(octant_rays, BoxSides(octant), part, search);
      }
    }
  }

  /// The lanes that go with `lane` when a packet is taken whole (0), in blocks of 2x2 (1) or apart (2).
  static uint32_t part_of(uint32_t parts, uint32_t lane) {
    if (parts == 0) return 0xFFFF;
    return parts == 1 ? 0x33u << (lane & 0xAu) : 1u << lane;
  }

  static uint32_t lanes_in_octant(const RayPacket& rays, uint32_t octant) {
    const F zero(0.0f);
    const V3<S> direction = rays.direction.template load<S>();
    const uint32_t x = (direction.x < zero).bits(), y = (direction.y < zero).bits(),
                   z = (direction.z < zero).bits();
    const auto same = [](uint32_t negative, uint32_t wanted) { return wanted != 0 ? negative : ~negative; };
    return same(x, octant & 1) & same(y, octant & 2) & same(z, octant & 4);
  }

  static bool is_single(uint32_t lanes) { return (lanes & (lanes - 1)) == 0; }

  /// How far each ray looks.
  static F limits(const Search& search) {
    return F::load(search.hits != nullptr ? search.hits->distance.lane : search.distance->lane);
  }
  /// How far the farthest-looking ray of the group looks, as boxes at just that distance should be opened: of
  /// two hits there, it matters which object comes first. All distances are positive.
  static float limit_of(const Search& search, uint32_t group) {
    if (is_single(group)) {
      const uint32_t lane = static_cast<uint32_t>(__builtin_ctz(group));
      return kBeyond *
             (search.hits != nullptr ? search.hits->distance.lane[lane] : search.distance->lane[lane]);
    }
    return kBeyond * interval_of<S>(S::select(M::from_bits(group), limits(search), F(0.0f))).high;
  }

  /// Part of the hierarchy: a node, or `count` objects.
  struct Branch {
    uint32_t child, count;
  };
  /// A branch that is to be visited, the rays that do, and how far away it is at least.
  struct Entry {
    Branch branch;
    uint32_t lanes;
    float enter;
  };
  /// Three children wait per level, at most. The builder goes no deeper.
  static constexpr uint32_t kStackEntries = 3 * 48 + 4;

  /// Who walks at the moment: the rays in `group`, as far as `limit`. Entries below `floor` of the stack are
  /// not theirs.
  struct Course {
    const Beam<S>* beam;
    uint32_t group, floor;
    float limit;
  };

  /// Visits the objects in the boxes that beam_, which has the rays in `lanes`, meets.
  void walk(const OctantRays<S>& rays, const BoxSides& sides, uint32_t lanes, Search& search) {
    Course course = {&beam_, lanes, 0, limit_of(search, lanes)};
    Branch branch = {hierarchy_.node_offset, 0};
    waiting_ = 0;
    for (;;) {
      if (branch.count != 0) {
        test_objects(branch, course.group, search);
        if (search.hits != nullptr)
          course.limit = limit_of(search, course.group);
        else if ((search.lanes & course.group) == 0)
          waiting_ = course.floor;
      } else if (open(course, rays, sides, search, branch)) {
        continue;
      }
      if (!take_next(course, lanes, search, branch)) return;
    }
  }

  /// Takes a branch that is still to be visited off the stack; false if there is none. A node that only one
  /// of the rays in `lanes` meets is for that ray alone, which misses more of it than the beam; the others go
  /// on when nothing is left above what was waiting for them.
  bool take_next(Course& course, uint32_t lanes, const Search& search, Branch& branch) {
    for (;;) {
      if (waiting_ == course.floor) {
        if (course.group == lanes || (search.lanes & lanes) == 0) return false;
        course = {&beam_, lanes, 0, limit_of(search, lanes)};
        continue;
      }
      const Entry& next = stack_[--waiting_];
      if (next.enter > course.limit || (next.lanes & search.lanes) == 0) continue;
      if (next.branch.count == 0 && is_single(next.lanes) && course.group == lanes && !is_single(lanes)) {
        const Course alone = {&single_, next.lanes, waiting_, limit_of(search, next.lanes)};
        if (next.enter > alone.limit) continue;
        single_.set(search.rays, static_cast<uint32_t>(__builtin_ctz(next.lanes)));
        course = alone;
      }
      branch = next.branch;
      return true;
    }
  }

  void test_objects(const Branch& leaf, uint32_t group, Search& search) {
    SceneAccess<Spu>& scene = objects_.scene();
    for (uint32_t i = 1; i < leaf.count; ++i)
      scene.hint_listed(leaf.child + i * 4);
    for (uint32_t i = 0; i < leaf.count; ++i) {
      scene.spu().compute(scalar_work::kListedObject);
      const uint32_t self = scene.list_word(leaf.child + i * 4);
      if (search.hits == nullptr) {
        search.lanes &= ~shadowed(search.rays, self, group, *search.distance, *search.light);
        if ((search.lanes & group) == 0) return;
      } else if (objects_.mailbox().first_visit(self)) {
        objects_.test_closest(search.rays, self, *search.hits);
      }
    }
  }

  /// Opens the node at `branch`. If one child is met, goes on there and returns true; if several, they go on
  /// the stack.
  bool open(const Course& course, const OctantRays<S>& rays, const BoxSides& sides, const Search& search,
            Branch& branch) {
    objects_.scene().spu().compute(scalar_work::kNodeOfBoxes);
    ++objects_.counters().voxels;
    const NodeRecord& node = *objects_.scene().node(branch.child);
    alignas(16) float enter[4];
    uint32_t met = course.beam->meets(node.box, sides, course.limit, enter);
    if (met == 0) return false;
    if (is_single(met)) {
      const uint32_t i = static_cast<uint32_t>(__builtin_ctz(met));
      branch = {node.child[i], node.count[i]};
      return true;
    }
    const uint32_t group = course.group;
    const F each_limit = limits(search);
    const uint32_t first = waiting_;
    do {
      const uint32_t i = static_cast<uint32_t>(__builtin_ctz(met));
      met &= met - 1;
      // Looser than its rays, a beam may meet what passes between them.
      const uint32_t lanes = is_single(group) ? group : rays.meet(node.box, sides, i, each_limit) & group;
      if (lanes == 0) continue;
      // Into its place among its siblings, the nearest last.
      uint32_t place = waiting_++;
      for (; place > first && stack_[place - 1].enter < enter[i]; --place)
        stack_[place] = stack_[place - 1];
      stack_[place] = {{node.child[i], node.count[i]}, lanes, enter[i]};
    } while (met != 0);
    for (uint32_t place = first; place < waiting_; ++place)
      objects_.scene().hint(stack_[place].branch.child);
    return false;
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
  Beam<S> beam_, single_;
  Entry stack_[kStackEntries];
  uint32_t waiting_ = 0; ///< on the stack
};

} // namespace celltrace::kernel

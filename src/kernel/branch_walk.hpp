// Packets of rays in the hierarchy of boxes, from any of its branches on. Kernel dialect.
//
// The rays of a packet go together as a beam, nearest children first. A box that the beam meets is held
// against its rays, all at once, before it is opened; what only one of them meets, that ray visits alone. An
// object met by some is tested against the whole packet.
#pragma once

#include "kernel/beam.hpp"
#include "kernel/branch_stack.hpp"
#include "kernel/leaf_tests.hpp"

namespace celltrace::kernel {

/// Rays of a packet that go together, all of one octant.
template <class S> struct RayGroup {
  OctantRays<S> rays;
  Beam<S> beam;
};

template <class Spu> class BranchWalk {
public:
  using S = typename Spu::simd;
  using F = typename S::F;
  using M = typename S::M;

  /// What the rounding of hits' distances amounts to.
  static constexpr float kBeyond = 1.00001f;
  /// So many, with their nodes, are in the caches of one core.
  static constexpr uint32_t kObjectsAtHand = 20000;
  /// A node that no more packets of a bundle than some meet, each visits alone; that many at most.
  static constexpr uint32_t kMostAlone = kBundlePackets<Spu> >= 16 ? 4 : 1; // measured
  using Stack = BranchStack<kMostAlone>;

  /// What some rays visit: a branch that those in `met` meet; `lanes` are all that `group` is of.
  struct Visit {
    const RayGroup<S>* group;
    Search* search;
    uint32_t lanes, met;
    Branch branch;
  };
  static constexpr uint32_t kMostInTurn = Spu::direct_memory ? 4 : 1; // measured

  BranchWalk(ObjectTests<Spu>& objects, const FrameBlock& frame)
      : objects_(objects), waits_(Spu::direct_memory && frame.object_count > kObjectsAtHand),
        takes_turns_(Spu::direct_memory && frame.far_nodes != 0) {}

  Stack& stack() { return stacks_[0]; }
  /// Whether walk_in_turn() is quicker than one walk after the other.
  bool takes_turns() const { return takes_turns_; }

  /// The rays of a visit go to the objects of its branch.
  void walk(const Visit& visit, const BoxSides& sides) {
    Walk walk;
    begin(walk, visit, 0);
    do {
      go_on(walk, sides);
    } while (!walk.at_end);
  }
  /// The same of several visits, by a packet each: while a node that one of them needs is on its way, others
  /// go on.
  void walk_in_turn(const Visit* visits, uint32_t count, const BoxSides& sides) {
    Walk walks[kMostInTurn];
    uint32_t packets[kMostInTurn];
    for (uint32_t i = 0; i < count; ++i) {
      packets[i] = objects_.mailbox().begin_packet();
      begin(walks[i], visits[i], i);
    }
    uint32_t walking = (1u << count) - 1;
    while (walking != 0)
      for (uint32_t left = walking; left != 0; left &= left - 1) {
        const auto i = static_cast<uint32_t>(__builtin_ctz(left));
        objects_.mailbox().resume_packet(packets[i]);
        go_on(walks[i], sides);
        if (walks[i].at_end) walking &= ~(1u << i);
      }
  }

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

private:
  /// Who walks at the moment: the rays in `group`, as far as `limit`. Entries below `floor` of the stack are
  /// not theirs.
  struct Course {
    const Beam<S>* beam;
    uint32_t group, floor;
    float limit;
  };
  /// A leaf that the rays in `group` have met.
  struct Waiting {
    Branch leaf;
    uint32_t group;
  };
  static constexpr uint32_t kMostWaiting = Spu::direct_memory ? 8 : 1;
  static constexpr uint32_t kEnoughWaiting = kMostWaiting / 2; // measured

  struct Walk {
    Visit visit; ///< its branch is the next one
    Course whole, course;
    Stack* stack;
    Waiting* waiting;
    uint32_t waiting_count;
    Beam<S>* single; ///< of a ray that goes alone
    bool at_end;
  };

  void begin(Walk& walk, const Visit& visit, uint32_t turn) {
    Stack& stack = stacks_[turn];
    if (turn != 0) stack.shrink(0);
    const Course whole = {&visit.group->beam, visit.lanes, stack.size(),
                          limit_of(*visit.search, visit.lanes)};
    walk = {visit, whole, whole, &stack, waiting_[turn], 0, &single_[turn], false};
    if (is_single(visit.met) && !is_single(visit.lanes)) go_alone(walk, visit.met);
  }

  /// Until a node is needed that was asked for just now, or to the end.
  void go_on(Walk& walk, const BoxSides& sides) {
    for (;;) {
      bool pushed = false;
      if (walk.visit.branch.is_leaf()) {
        meet(walk);
      } else {
        const uint32_t size = walk.stack->size();
        if (open(walk, sides)) return;
        pushed = walk.stack->size() != size;
        if (walk.waiting_count >= kEnoughWaiting) test_waiting(walk);
      }
      if (!take_next(walk)) break;
      if (pushed) return;
    }
    test_waiting(walk);
    walk.stack->shrink(walk.whole.floor);
    walk.at_end = true;
  }

  /// Takes a branch that is still to be visited off the stack; false if there is none. A node that only one
  /// of all rays meets is for that ray alone, which misses more of it than the beam; the others go on when
  /// nothing is left above what was waiting for them.
  bool take_next(Walk& walk) {
    Course& course = walk.course;
    const Search& search = *walk.visit.search;
    const uint32_t lanes = walk.visit.lanes;
    for (;;) {
      if (walk.stack->size() == course.floor) {
        if (course.group == lanes || (search.lanes & lanes) == 0) return false;
        course = walk.whole;
        course.limit = limit_of(search, lanes);
        continue;
      }
      const typename Stack::Entry& next = walk.stack->pop();
      if (next.enter > course.limit || (next.lanes & search.lanes) == 0) continue;
      if (!next.branch.is_leaf() && is_single(next.lanes) && course.group == lanes && !is_single(lanes)) {
        if (next.enter > limit_of(search, next.lanes)) continue;
        go_alone(walk, next.lanes);
      }
      walk.visit.branch = next.branch;
      return true;
    }
  }

  /// One ray goes on without the others.
  void go_alone(Walk& walk, uint32_t ray) {
    const Search& search = *walk.visit.search;
    const uint32_t lane = static_cast<uint32_t>(__builtin_ctz(ray));
    walk.single->set(bounds_of_ray(*search.rays, lane), octant_of(*search.rays, lane));
    walk.course = {walk.single, ray, walk.stack->size(), limit_of(search, ray)};
  }

  /// The objects of a leaf are tested at once; where memory is direct and far away, with those of a few
  /// leaves more when a node was opened: they arrive meanwhile, and that node's children arrive while they
  /// are tested.
  void meet(Walk& walk) {
    const Branch& leaf = walk.visit.branch;
    if (!Spu::direct_memory || !waits_) {
      test_objects(leaf, walk.course.group, *walk.visit.search);
      take_results(walk);
    } else {
      if (walk.waiting_count == kMostWaiting) test_waiting(walk);
      objects_.scene().hint(leaf);
      walk.waiting[walk.waiting_count++] = {leaf, walk.course.group};
    }
  }
  void test_waiting(Walk& walk) {
    if (!Spu::direct_memory || walk.waiting_count == 0) return;
    for (uint32_t i = 0; i < walk.waiting_count; ++i)
      test_objects(walk.waiting[i].leaf, walk.waiting[i].group, *walk.visit.search);
    walk.waiting_count = 0;
    take_results(walk);
  }
  void take_results(Walk& walk) {
    const Search& search = *walk.visit.search;
    if (search.hits != nullptr)
      walk.course.limit = limit_of(search, walk.course.group);
    else if ((search.lanes & walk.course.group) == 0)
      walk.stack->shrink(walk.course.floor);
  }

  void test_objects(const Branch& leaf, uint32_t group, Search& search) {
    if constexpr (Spu::direct_memory) {
      using Tests = LeafTests<Spu>;
      if (leaf_word::count(leaf.leaf) >= Tests::kLeastTriangles &&
          __builtin_popcount(group) <= Tests::kMostRays)
        return Tests(objects_).test(search, group, leaf);
    }
    objects_.scene().for_each_object(leaf, [&](uint32_t self) {
      if (search.hits != nullptr) {
        if (objects_.mailbox().first_visit(self)) objects_.test_closest(*search.rays, self, *search.hits);
        return false;
      }
      search.lanes &= ~objects_.shadowed(*search.rays, self, group, *search.distance, *search.light);
      return (search.lanes & group) == 0;
    });
  }

  /// Opens the node that is next. If one child is met, that one is next, and it returns true; if several,
  /// they go on the stack.
  bool open(Walk& walk, const BoxSides& sides) {
    const Course& course = walk.course;
    const Search& search = *walk.visit.search;
    Branch& branch = walk.visit.branch;
    objects_.scene().spu().compute(scalar_work::kNodeOfBoxes);
    ++objects_.counters().voxels;
    const NodeRecord& node = *objects_.scene().node(branch.child);
    alignas(16) float enter[4];
    uint32_t met = course.beam->meets(node.box, sides, course.limit, enter);
    if (met == 0) return false;
    if (is_single(met)) {
      const uint32_t i = static_cast<uint32_t>(__builtin_ctz(met));
      branch = {node.child[i], node.leaf[i]};
      if (takes_turns_) objects_.scene().hint(branch);
      return true;
    }
    const uint32_t group = course.group;
    const F each_limit = limits(search);
    const uint32_t first = walk.stack->size();
    do {
      const uint32_t i = static_cast<uint32_t>(__builtin_ctz(met));
      met &= met - 1;
      // Looser than its rays, a beam may meet what passes between them.
      const uint32_t lanes =
          is_single(group) ? group : walk.visit.group->rays.meet(node.box, sides, i, each_limit) & group;
      if (lanes == 0) continue;
      const Branch child = {node.child[i], node.leaf[i]};
      objects_.scene().hint(child);
      walk.stack->push(first, {child, lanes, enter[i], 0});
    } while (met != 0);
    return false;
  }

  ObjectTests<Spu>& objects_;
  const bool waits_; ///< leaves
  const bool takes_turns_;
  // Of each walk in turn. Where one is in no turn, it takes the first.
  Stack stacks_[kMostInTurn];
  Waiting waiting_[kMostInTurn][kMostWaiting];
  Beam<S> single_[kMostInTurn];
};

} // namespace celltrace::kernel

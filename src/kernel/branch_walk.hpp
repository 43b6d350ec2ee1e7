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

  Stack& stack() { return places_[0].stack; }
  /// Whether walk_in_turn() is quicker than one walk after the other.
  bool takes_turns() const { return takes_turns_; }

  /// The rays of a visit go to the objects of its branch.
  void walk(const Visit& visit, const BoxSides& sides) {
    const RayGroup<S>& group = *visit.group;
    Search& search = *visit.search;
    const uint32_t lanes = visit.lanes;
    Branch branch = visit.branch;
    Place& place = places_[0];
    const uint32_t floor = place.stack.size();
    Course course = begin(place, visit, floor);
    for (;;) {
      if (branch.is_leaf()) {
        meet(place, course, branch, search);
      } else {
        if (open(place, course, group.rays, sides, search, branch)) continue;
        if (place.waiting_count >= kEnoughWaiting) test_waiting(place, course, search);
      }
      if (!take_next(place, course, {&group.beam, lanes, floor, 0.0f}, search, branch)) break;
    }
    test_waiting(place, course, search);
    place.stack.shrink(floor);
  }

  /// The same of several visits, by a packet each: while a node that one of them needs is on its way, others
  /// go on.
  void walk_in_turn(const Visit* visits, uint32_t count, const BoxSides& sides) {
    Turn turns[kMostInTurn];
    for (uint32_t i = 0; i < count; ++i) {
      Place& place = places_[i];
      if (i != 0) place.stack.shrink(0);
      const uint32_t floor = place.stack.size();
      const uint32_t packet = objects_.mailbox().begin_packet();
      turns[i] = {visits[i], begin(place, visits[i], floor), floor, packet};
    }
    uint32_t walking = (1u << count) - 1;
    while (walking != 0)
      for (uint32_t left = walking; left != 0; left &= left - 1) {
        const auto i = static_cast<uint32_t>(__builtin_ctz(left));
        objects_.mailbox().resume_packet(turns[i].packet);
        if (!go_on(places_[i], turns[i], sides)) walking &= ~(1u << i);
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

  /// What a walk needs for itself.
  struct Place {
    Stack stack;
    Waiting waiting[kMostWaiting];
    uint32_t waiting_count = 0;
    Beam<S> single; ///< of a ray that goes alone
  };

  /// A walk that is not at its end.
  struct Turn {
    Visit visit; ///< its branch is the next one
    Course course;
    uint32_t floor, packet; ///< `packet`: for the mailbox
  };

  Course begin(Place& place, const Visit& visit, uint32_t floor) {
    Course course = {&visit.group->beam, visit.lanes, floor, limit_of(*visit.search, visit.lanes)};
    if (is_single(visit.met) && !is_single(visit.lanes)) go_alone(place, course, visit.met, *visit.search);
    return course;
  }

  /// As walk(), until a node is needed that was asked for just now, or to the end, which returns false. A
  /// loop of its own: walk()'s state would not stay in registers if it could be left and taken up again.
  bool go_on(Place& place, Turn& turn, const BoxSides& sides) {
    Visit& visit = turn.visit;
    Course& course = turn.course;
    Search& search = *visit.search;
    for (;;) {
      const uint32_t size = place.stack.size();
      if (visit.branch.is_leaf()) {
        meet(place, course, visit.branch, search);
      } else {
        if (open(place, course, visit.group->rays, sides, search, visit.branch)) {
          objects_.scene().hint(visit.branch);
          return true;
        }
        if (place.waiting_count >= kEnoughWaiting) test_waiting(place, course, search);
      }
      const bool pushed = place.stack.size() > size;
      if (!take_next(place, course, {&visit.group->beam, visit.lanes, turn.floor, 0.0f}, search,
                     visit.branch))
        break;
      if (pushed) return true;
    }
    test_waiting(place, course, search);
    place.stack.shrink(turn.floor);
    return false;
  }

  /// Takes a branch that is still to be visited off the stack; false if there is none. A node that only one
  /// of the rays of `whole` meets is for that ray alone, which misses more of it than the beam; the others go
  /// on when nothing is left above what was waiting for them.
  bool take_next(Place& place, Course& course, const Course& whole, const Search& search, Branch& branch) {
    const uint32_t lanes = whole.group;
    for (;;) {
      if (place.stack.size() == course.floor) {
        if (course.group == lanes || (search.lanes & lanes) == 0) return false;
        course = whole;
        course.limit = limit_of(search, lanes);
        continue;
      }
      const typename Stack::Entry& next = place.stack.pop();
      if (next.enter > course.limit || (next.lanes & search.lanes) == 0) continue;
      if (!next.branch.is_leaf() && is_single(next.lanes) && course.group == lanes && !is_single(lanes)) {
        if (next.enter > limit_of(search, next.lanes)) continue;
        go_alone(place, course, next.lanes, search);
      }
      branch = next.branch;
      return true;
    }
  }

  /// One ray goes on without the others.
  void go_alone(Place& place, Course& course, uint32_t ray, const Search& search) {
    objects_.scene().spu().compute(scalar_work::kRayAlone);
    if constexpr (Spu::direct_memory)
      set_alone(place, course, ray, search);
    else
      set_alone_elsewhere(place, course, ray, search);
  }
  [[gnu::always_inline]] void set_alone(Place& place, Course& course, uint32_t ray, const Search& search) {
    const uint32_t lane = static_cast<uint32_t>(__builtin_ctz(ray));
    place.single.set(bounds_of_ray(*search.rays, lane), octant_of(*search.rays, lane));
    course = {&place.single, ray, place.stack.size(), limit_of(search, ray)};
  }
  /// One copy: local store is short.
  [[gnu::noinline]] void set_alone_elsewhere(Place& place, Course& course, uint32_t ray,
                                             const Search& search) {
    set_alone(place, course, ray, search);
  }

  /// The objects of a leaf are tested at once; where memory is direct and far away, with those of a few
  /// leaves more when a node was opened: they arrive meanwhile, and that node's children arrive while they
  /// are tested.
  void meet(Place& place, Course& course, const Branch& leaf, Search& search) {
    if (!Spu::direct_memory || !waits_) {
      test_objects(leaf, course.group, search);
      take_results(place, course, search);
    } else {
      if (place.waiting_count == kMostWaiting) test_waiting(place, course, search);
      objects_.scene().hint(leaf);
      place.waiting[place.waiting_count++] = {leaf, course.group};
    }
  }
  void test_waiting(Place& place, Course& course, Search& search) {
    if (!Spu::direct_memory || place.waiting_count == 0) return;
    for (uint32_t i = 0; i < place.waiting_count; ++i)
      test_objects(place.waiting[i].leaf, place.waiting[i].group, search);
    place.waiting_count = 0;
    take_results(place, course, search);
  }
  void take_results(Place& place, Course& course, const Search& search) {
    if (search.hits != nullptr)
      course.limit = limit_of(search, course.group);
    else if ((search.lanes & course.group) == 0)
      place.stack.shrink(course.floor);
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

  /// Opens the node at `branch`. If one child is met, goes on there and returns true; if several, they go on
  /// the stack.
  bool open(Place& place, const Course& course, const OctantRays<S>& rays, const BoxSides& sides,
            const Search& search, Branch& branch) {
    objects_.scene().spu().compute(scalar_work::kNodeOfBoxes);
    ++objects_.counters().voxels;
    const NodeRecord& node = *objects_.scene().node(branch.child);
    alignas(16) float enter[4];
    uint32_t met = course.beam->meets(node.box, sides, course.limit, enter);
    if (met == 0) return false;
    if (is_single(met)) {
      const uint32_t i = static_cast<uint32_t>(__builtin_ctz(met));
      branch = {node.child[i], node.leaf[i]};
      return true;
    }
    const uint32_t group = course.group;
    const F each_limit = limits(search);
    const uint32_t first = place.stack.size();
    do {
      const uint32_t i = static_cast<uint32_t>(__builtin_ctz(met));
      met &= met - 1;
      objects_.scene().spu().compute(scalar_work::kChildOfNode);
      // Looser than its rays, a beam may meet what passes between them.
      const uint32_t lanes = is_single(group) ? group : rays.meet(node.box, sides, i, each_limit) & group;
      if (lanes == 0) continue;
      const Branch child = {node.child[i], node.leaf[i]};
      objects_.scene().hint(child);
      place.stack.push(first, {child, lanes, enter[i], 0});
    } while (met != 0);
    return false;
  }

  ObjectTests<Spu>& objects_;
  const bool waits_; ///< leaves
  const bool takes_turns_;
  Place places_[kMostInTurn]; ///< the first is also that of a walk in no turn
};

} // namespace celltrace::kernel

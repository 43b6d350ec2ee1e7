// A packet of rays in the hierarchy of boxes, from any of its branches on. Kernel dialect.
//
// The rays go together as a beam, nearest children first. A box that the beam meets is held against its rays,
// all at once, before it is opened; what only one of them meets, that ray visits alone. An object met by some
// is tested against the whole packet.
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

  BranchWalk(ObjectTests<Spu>& objects, const FrameBlock& frame)
      : objects_(objects), waits_(Spu::direct_memory && frame.object_count > kObjectsAtHand) {}

  Stack& stack() { return stack_; }

  /// The rays in `lanes`, which `group` is of, visit the objects of a branch that those in `met` meet.
  void walk(const RayGroup<S>& group, const BoxSides& sides, uint32_t lanes, Search& search, Branch branch,
            uint32_t met) {
    const uint32_t floor = stack_.size();
    Course course = {&group.beam, lanes, floor, limit_of(search, lanes)};
    if (is_single(met) && !is_single(lanes)) go_alone(course, met, search);
    for (;;) {
      if (branch.is_leaf()) {
        meet(course, branch, search);
      } else {
        if (open(course, group.rays, sides, search, branch)) continue;
        if (waiting_count_ >= kEnoughWaiting) test_waiting(course, search);
      }
      if (!take_next(course, {&group.beam, lanes, floor, 0.0f}, search, branch)) break;
    }
    test_waiting(course, search);
    stack_.shrink(floor);
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

  /// Takes a branch that is still to be visited off the stack; false if there is none. A node that only one
  /// of the rays of `whole` meets is for that ray alone, which misses more of it than the beam; the others go
  /// on when nothing is left above what was waiting for them.
  bool take_next(Course& course, const Course& whole, const Search& search, Branch& branch) {
    const uint32_t lanes = whole.group;
    for (;;) {
      if (stack_.size() == course.floor) {
        if (course.group == lanes || (search.lanes & lanes) == 0) return false;
        course = whole;
        course.limit = limit_of(search, lanes);
        continue;
      }
      const typename Stack::Entry& next = stack_.pop();
      if (next.enter > course.limit || (next.lanes & search.lanes) == 0) continue;
      if (!next.branch.is_leaf() && is_single(next.lanes) && course.group == lanes && !is_single(lanes)) {
        if (next.enter > limit_of(search, next.lanes)) continue;
        go_alone(course, next.lanes, search);
      }
      branch = next.branch;
      return true;
    }
  }

  /// One ray goes on without the others.
  void go_alone(Course& course, uint32_t ray, const Search& search) {
    const uint32_t lane = static_cast<uint32_t>(__builtin_ctz(ray));
    single_.set(bounds_of_ray(*search.rays, lane), octant_of(*search.rays, lane));
    course = {&single_, ray, stack_.size(), limit_of(search, ray)};
  }

  /// The objects of a leaf are tested at once; where memory is direct and far away, with those of a few
  /// leaves more when a node was opened: they arrive meanwhile, and that node's children arrive while they
  /// are tested.
  void meet(Course& course, const Branch& leaf, Search& search) {
    if (!Spu::direct_memory || !waits_) {
      test_objects(leaf, course.group, search);
      take_results(course, search);
    } else {
      if (waiting_count_ == kMostWaiting) test_waiting(course, search);
      objects_.scene().hint(leaf);
      waiting_[waiting_count_++] = {leaf, course.group};
    }
  }
  void test_waiting(Course& course, Search& search) {
    if (!Spu::direct_memory || waiting_count_ == 0) return;
    for (uint32_t i = 0; i < waiting_count_; ++i)
      test_objects(waiting_[i].leaf, waiting_[i].group, search);
    waiting_count_ = 0;
    take_results(course, search);
  }
  void take_results(Course& course, const Search& search) {
    if (search.hits != nullptr)
      course.limit = limit_of(search, course.group);
    else if ((search.lanes & course.group) == 0)
      stack_.shrink(course.floor);
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
      branch = {node.child[i], node.leaf[i]};
      return true;
    }
    const uint32_t group = course.group;
    const F each_limit = limits(search);
    const uint32_t first = stack_.size();
    do {
      const uint32_t i = static_cast<uint32_t>(__builtin_ctz(met));
      met &= met - 1;
      // Looser than its rays, a beam may meet what passes between them.
      const uint32_t lanes = is_single(group) ? group : rays.meet(node.box, sides, i, each_limit) & group;
      if (lanes == 0) continue;
      const Branch child = {node.child[i], node.leaf[i]};
      objects_.scene().hint(child);
      stack_.push(first, {child, lanes, enter[i], 0});
    } while (met != 0);
    return false;
  }

  /// A leaf that the rays in `group` have met.
  struct Waiting {
    Branch leaf;
    uint32_t group;
  };
  static constexpr uint32_t kMostWaiting = Spu::direct_memory ? 8 : 1;
  static constexpr uint32_t kEnoughWaiting = kMostWaiting / 2; // measured

  ObjectTests<Spu>& objects_;
  const bool waits_; ///< leaves
  Stack stack_;
  Waiting waiting_[kMostWaiting];
  uint32_t waiting_count_ = 0;
  Beam<S> single_; ///< of a ray that goes alone
};

} // namespace celltrace::kernel

// The bounds of all leaves of a small BVH, one after the other. Kernel dialect, where memory is direct.
//
// Of a traversal it is known which node comes next when the last one has been tested, and whether that is a
// leaf can hardly be predicted: a processor waits for each node. Tests of leaves that follow from nothing
// overlap. Where rays of a packet go far apart, and so expand many of few nodes, all leaves are sooner tested
// than those nodes.
#pragma once

#include "kernel/direct/mixed_rays.hpp"
#include "kernel/tuning.hpp"

namespace celltrace::kernel {

template <class Spu> class LeafList {
public:
  using S = typename Spu::simd;
  using F = typename S::F;
  using Traversal = PacketTraversal<Spu>;

  /// The BVH may be another one from now on.
  void begin_frame() { state_ = State::unknown; }

  /// Whether the next packet had better be tested against all leaves below `root`. Otherwise count_visits()
  /// is told how many nodes its traversal has expanded.
  bool pays(SceneAccess<Spu>& scene, const NodeRef& root) {
    if (state_ == State::unknown) state_ = gather(scene, root) ? State::gathered : State::too_long;
    if (state_ == State::too_long || packets_ < kTrials) return false;
    if (packets_ == kTrials) pays_ = visits_ * tuning::kLeavesPerVisit > kTrials * count_;
    if (++packets_ == kPackets) packets_ = visits_ = 0;
    return pays_;
  }
  void count_visits(uint64_t visits) {
    if (state_ != State::gathered || packets_ >= kTrials) return;
    ++packets_;
    visits_ += static_cast<uint32_t>(visits);
  }

  /// Answers a query.
  void intersect(Traversal& traversal, RayQuery& query) const {
    uint32_t lanes[kMost], order[kMost], hits = 0;
    FloatLanes enter[kMost];
    Crossed crossed[3][kMost];
    cross_slabs(MixedRays<S>(*query.rays), crossed);
    const F tfar = Traversal::tfar(query);
    for (uint32_t i = 0; i < count_; ++i) {
      F from(Traversal::tnear(query));
      const uint32_t(&slabs)[3] = leaves_[i].slabs;
      const auto hit = MixedRays<S>::hit_box(crossed[0][slabs[0]].range(), crossed[1][slabs[1]].range(),
                                             crossed[2][slabs[2]].range(), tfar, from);
      lanes[i] = hit.bits() & query.lanes;
      from.store(enter[i].lane);
      order[hits] = i;
      hits += lanes[i] != 0 ? 1 : 0;
    }
    if (query.hits == nullptr) {
      for (uint32_t i = 0; i < hits && query.lanes != 0; ++i)
        test(traversal, order[i], lanes[order[i]] & query.lanes, query);
      return;
    }
    sort(lanes, enter, order, hits);
    for (uint32_t i = 0; i < hits; ++i) {
      // Rays may have hit something in front of it since.
      const F limit = Traversal::tfar(query) * F(Traversal::kTfarSlack);
      const uint32_t near = (F::load(enter[order[i]].lane) <= limit).bits();
      test(traversal, order[i], lanes[order[i]] & near, query);
    }
  }

private:
  static constexpr uint32_t kMost = 32; ///< leaves that there is room for
  /// Packets that are traversed to know how many nodes that takes; and those for which it is known then, with
  /// these. More trials: more packets wait for nodes; more packets: it is noticed later that rays have come
  /// to other objects.
  static constexpr uint32_t kTrials = 16, kPackets = 2048;

  enum class State { unknown, gathered, too_long };

  struct Slab {
    float low, high;
  };
  struct Leaf {
    uint32_t slabs[3]; ///< that it is in, by axis
    NodeRef ref;
  };
  /// Where each ray is within a slab.
  struct Crossed {
    FloatLanes from, to;
    [[gnu::always_inline]] typename MixedRays<S>::Range range() const {
      return {F::load(from.lane), F::load(to.lane)};
    }
  };

  /// False: there are too many leaves.
  bool gather(SceneAccess<Spu>& scene, const NodeRef& root) {
    NodeRef nodes[kMost];
    uint32_t size = 0;
    nodes[size++] = root;
    count_ = packets_ = visits_ = 0;
    for (uint32_t& count : slab_counts_)
      count = 0;
    while (size != 0) {
      const NodeRecord& node = *scene.node(nodes[--size].child);
      for (uint32_t left = MixedRays<S>::children_of(node.bounds); left != 0; left &= left - 1) {
        const auto i = static_cast<uint32_t>(__builtin_ctz(left));
        const NodeRef child = {node.child[i], node.leaf[i]};
        if ((child.is_leaf() ? count_ : size) == kMost) return false;
        if (!child.is_leaf()) {
          nodes[size++] = child;
          continue;
        }
        Leaf& leaf = leaves_[count_++];
        leaf.ref = child;
        for (uint32_t axis = 0; axis < 3; ++axis)
          leaf.slabs[axis] = slab(axis, {node.bounds[2 * axis][i], node.bounds[2 * axis + 1][i]});
      }
    }
    return true;
  }
  /// The number of a slab among those of its axis.
  uint32_t slab(uint32_t axis, const Slab& wanted) {
    uint32_t i = 0;
    while (i < slab_counts_[axis] &&
           (slabs_[axis][i].low != wanted.low || slabs_[axis][i].high != wanted.high))
      ++i;
    if (i == slab_counts_[axis]) slabs_[axis][slab_counts_[axis]++] = wanted;
    return i;
  }

  [[gnu::always_inline]] void cross_slabs(const MixedRays<S>& rays, Crossed (&crossed)[3][kMost]) const {
    for (uint32_t axis = 0; axis < 3; ++axis)
      for (uint32_t i = 0; i < slab_counts_[axis]; ++i) {
        const auto range = rays.slab(axis, slabs_[axis][i].low, slabs_[axis][i].high);
        range.from.store(crossed[axis][i].from.lane);
        range.to.store(crossed[axis][i].to.lane);
      }
  }

  /// By where the first ray that hits a leaf enters it.
  static void sort(const uint32_t (&lanes)[kMost], const FloatLanes (&enter)[kMost], uint32_t (&order)[kMost],
                   uint32_t hits) {
    float key[kMost];
    for (uint32_t i = 0; i < hits; ++i) {
      const uint32_t leaf = order[i];
      const float at = enter[leaf].lane[__builtin_ctz(lanes[leaf])];
      uint32_t place = i;
      for (; place != 0 && key[place - 1] > at; --place) {
        key[place] = key[place - 1];
        order[place] = order[place - 1];
      }
      key[place] = at;
      order[place] = leaf;
    }
  }

  void test(Traversal& traversal, uint32_t leaf, uint32_t lanes, RayQuery& query) const {
    if (lanes != 0) traversal.test_objects(leaves_[leaf].ref, lanes, query);
  }

  Leaf leaves_[kMost];
  Slab slabs_[3][kMost]; ///< by axis: many leaves of a scene share some
  uint32_t slab_counts_[3] = {};
  uint32_t count_ = 0;
  uint32_t packets_ = 0, visits_ = 0; ///< since the last trials began; in them
  bool pays_ = false;
  State state_ = State::unknown;
};

} // namespace celltrace::kernel

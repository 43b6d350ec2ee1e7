// Traversal of the BVH with all rays of a packet at once, whatever the octants of their directions are.
// Kernel dialect, for direct memory.
//
// Behind curved and disturbed surfaces the rays of a packet go to several octants. A traversal for each
// octant would have few rays, and no frustum contains all of them: here each ray is tested against all four
// children of a node.
#pragma once

#include "kernel/accel/packet_traversal.hpp"

namespace celltrace::kernel {

/// Rays prepared for slab tests in which the near planes are not known.
template <class S> class MixedRays {
public:
  using F = typename S::F;
  using F4 = typename S::F4;

  /// Returns the children that a node has: without an order of planes, slab tests do not reject empty boxes.
  static uint32_t children_of(const float (&bounds)[6][4]) {
    return not_above_bits(F4::load(bounds[0]), F4::load(bounds[1]));
  }

  explicit MixedRays(const RayPacket& rays) : origin_(rays.origin.template load<S>()) {
    const V3<S> direction = rays.direction.template load<S>();
    inverse_ = {inverse_of(direction.x), inverse_of(direction.y), inverse_of(direction.z)};
  }

  /// Finds the rays that hit each child of a node from `tnear` up to their own `tfar`, and their distances;
  /// the results for missing children are arbitrary.
  [[gnu::always_inline]] void intersect(const float (&bounds)[6][4], float tnear, const F& tfar,
                                        uint32_t (&hit)[4], F (&enter)[4]) const {
    for (uint32_t i = 0; i < 4; ++i) {
      enter[i] = F(tnear);
      hit[i] = cross(bounds, i, tfar, enter[i]).bits();
    }
  }

  /// Returns the lanes that hit child `i`, which the node must have, from `tnear` up to their own `tfar`.
  [[gnu::always_inline]] uint32_t hit_child(const float (&bounds)[6][4], uint32_t i, float tnear,
                                            const F& tfar) const {
    F from(tnear);
    return cross(bounds, i, tfar, from).bits();
  }

private:
  /// The intervals of rays within one slab of a box.
  struct Range {
    F from, to;
  };
  /// Returns the intervals in the slab between two planes perpendicular to an axis.
  [[gnu::always_inline]] static Range slab(float low, float high, const F& origin, const F& inverse) {
    const F a = (F(low) - origin) * inverse, b = (F(high) - origin) * inverse;
    return {S::min(a, b), S::max(a, b)};
  }
  /// Returns the lanes that hit child `i` of a node from `from` up to their own `tfar`; raises `from` to the
  /// rays' distances.
  [[gnu::always_inline]] typename S::M cross(const float (&bounds)[6][4], uint32_t i, const F& tfar,
                                             F& from) const {
    const Range x = slab(bounds[0][i], bounds[1][i], origin_.x, inverse_.x);
    const Range y = slab(bounds[2][i], bounds[3][i], origin_.y, inverse_.y);
    const Range z = slab(bounds[4][i], bounds[5][i], origin_.z, inverse_.z);
    from = S::max(S::max(S::max(from, x.from), y.from), z.from);
    const F to = S::min(S::min(S::min(tfar, x.to), y.to), z.to);
    return from <= to * F(detail::kRoundedUp);
  }
  static F inverse_of(const F& direction) {
    const F tiny(detail::kTinyDirection);
    return F(1.0f) / S::select(direction < F(0.0f), S::min(direction, -tiny), S::max(direction, tiny));
  }

  V3<S> origin_, inverse_;
};

/// Nodes and leaves that mixed rays still have to traverse, the nearest on top, and the distances at which
/// each ray enters them.
template <class S> class MixedStack {
public:
  using F = typename S::F;

  struct Entry {
    NodeRef ref;
    uint32_t lanes; ///< rays that hit the node
    uint32_t place; ///< index of the rays' distances in `enter_`
  };

  bool empty() const { return size_ == 0; }
  const Entry& pop() {
    const Entry& entry = entries_[--size_];
    level_ = entry.place / 4 + 1;
    return entry;
  }
  F enter(const Entry& entry) const { return F::load(enter_[entry.place].lane); }

  /// Pushes the children, hit by some rays, of the node that was popped last. Their order is that in which
  /// the ray `any` enters them, found without a branch.
  [[gnu::always_inline]] void push(const NodeRecord& node, uint32_t any, const uint32_t (&hit)[4],
                                   const F (&enter)[4]) {
    // The level above has the siblings' distances.
    const uint32_t first = 4 * level_;
    for (uint32_t i = 0; i < 4; ++i)
      enter[i].store(enter_[first + i].lane);
    float key[4];
    for (uint32_t i = 0; i < 4; ++i)
      key[i] = hit[i] != 0 ? enter_[first + i].lane[any] : -1.0f;
    uint32_t place[4];
    rank_descending(key, place);
    uint32_t count = 0;
    for (uint32_t i = 0; i < 4; ++i) {
      entries_[size_ + place[i]] = {{node.child[i], node.leaf[i]}, hit[i], first + i};
      count += hit[i] != 0 ? 1 : 0;
    }
    size_ += count;
  }

private:
  /// Largest number of levels, to which the builder limits a BVH.
  static constexpr uint32_t kLevels = 48;

  uint32_t size_ = 0, level_ = 0;
  /// One of a node's entries is popped before its children are pushed, four at a time.
  Entry entries_[3 * kLevels + 8];
  FloatLanes enter_[4 * (kLevels + 1)];
};

/// The traversal of mixed rays, for traverse_nodes().
template <class Spu> struct MixedVisitor {
  using S = typename Spu::simd;
  using Traversal = PacketTraversal<Spu>;

  Traversal& traversal;
  ObjectTests<Spu>& objects;
  RayQuery& query;
  const MixedRays<S> rays;
  MixedStack<S>& stack;
  uint32_t lanes; ///< rays that hit the node or leaf

  [[gnu::always_inline]] bool expand(NodeRef& ref) {
    ++objects.counters().visits;
    const NodeRecord& node = *objects.scene().node(ref.child);
    if (test_leaves(node)) return false;
    uint32_t hit[4];
    typename S::F enter[4];
    rays.intersect(node.bounds, Traversal::tnear(query), Traversal::tfar(query), hit, enter);
    const uint32_t present = MixedRays<S>::children_of(node.bounds);
    lanes &= query.lanes;
    for (uint32_t i = 0; i < 4; ++i)
      hit[i] &= lanes & (0u - (present >> i & 1));
    if (lanes != 0) stack.push(node, static_cast<uint32_t>(__builtin_ctz(lanes)), hit, enter);
    return false;
  }
  /// Tests the leaves of a node that has no inner nodes, one after another: sorting so few would not pay.
  /// Returns false if the node has inner nodes.
  [[gnu::always_inline]] bool test_leaves(const NodeRecord& node) {
    const uint32_t present = MixedRays<S>::children_of(node.bounds);
    uint32_t inner = 0;
    for (uint32_t i = 0; i < 4; ++i)
      inner |= static_cast<uint32_t>(node.leaf[i] == 0) << i;
    if ((present & inner) != 0) return false;
    for (uint32_t left = present; left != 0; left &= left - 1) {
      const auto i = static_cast<uint32_t>(__builtin_ctz(left));
      const uint32_t hit = rays.hit_child(node.bounds, i, Traversal::tnear(query), Traversal::tfar(query));
      if (const uint32_t group = hit & lanes & query.lanes; group != 0)
        traversal.test_objects({node.child[i], node.leaf[i]}, group, query);
    }
    return true;
  }
  [[gnu::always_inline]] void test(const NodeRef& leaf) { traversal.test_objects(leaf, lanes, query); }
  [[gnu::always_inline]] bool next(NodeRef& ref) {
    while (!stack.empty()) {
      const auto& next = stack.pop();
      lanes = next.lanes & query.lanes;
      // Hits since the push may be nearer.
      if (query.hits != nullptr)
        lanes &= (stack.enter(next) <= Traversal::tfar(query) * typename S::F(Traversal::kTfarSlack)).bits();
      if (lanes == 0) continue;
      ref = next.ref;
      return true;
    }
    return false;
  }
  static constexpr bool pauses() { return false; }
};

} // namespace celltrace::kernel

// Traverses the BVH with all rays of a packet at once, whatever octants their directions are of. Kernel
// dialect, where memory is direct.
//
// Behind curved and disturbed surfaces the rays of a packet go to several octants. A traversal for each
// octant would have few rays, and there is no frustum that all of them share: here each ray is tested against
// all four children of a node.
#pragma once

#include "kernel/accel/packet_traversal.hpp"

namespace celltrace::kernel {

/// Rays prepared for slab tests that do not know which planes are near.
template <class S> class MixedRays {
public:
  using F = typename S::F;
  using F4 = typename S::F4;

  /// The children that a node has. Without an order of planes, an empty box is like any other.
  static uint32_t children_of(const float (&bounds)[6][4]) {
    return not_above_bits(F4::load(bounds[0]), F4::load(bounds[1]));
  }

  explicit MixedRays(const RayPacket& rays) : origin_(rays.origin.template load<S>()) {
    const V3<S> direction = rays.direction.template load<S>();
    inverse_ = {inverse_of(direction.x), inverse_of(direction.y), inverse_of(direction.z)};
  }

  /// The `lanes` that hit each child of a node from `tnear` up to their own `tfar`. `enter` receives the
  /// least distance to each child that is hit, -1 for the others.
  [[gnu::always_inline]] void intersect(const float (&bounds)[6][4], float tnear, const F& tfar,
                                        uint32_t lanes, uint32_t (&hit)[4], float (&enter)[4]) const {
    const uint32_t present = children_of(bounds);
    F distance[4];
    for (uint32_t i = 0; i < 4; ++i) {
      F from(tnear);
      const auto hits = cross(bounds, i, tfar, from);
      hit[i] = hits.bits() & lanes & (0u - (present >> i & 1));
      distance[i] = S::select(hits, from, F(kMaxHitDistance));
    }
    S::transpose_quads(distance[0], distance[1], distance[2], distance[3]);
    FloatLanes least; // lane 4q + i is of child i
    S::min(S::min(distance[0], distance[1]), S::min(distance[2], distance[3])).store(least.lane);
    alignas(16) float all[4];
    const auto quad = [&](uint32_t q) { return F4::load(least.lane + 4 * q); };
    S::min(S::min(quad(0), quad(1)), S::min(quad(2), quad(3))).store(all);
    for (uint32_t i = 0; i < 4; ++i)
      enter[i] = hit[i] != 0 ? all[i] : -1.0f;
  }

  /// The lanes that hit child `i` from `tnear` up to their own `tfar`; the node has such a child.
  [[gnu::always_inline]] uint32_t hit_child(const float (&bounds)[6][4], uint32_t i, float tnear,
                                            const F& tfar) const {
    F from(tnear);
    return cross(bounds, i, tfar, from).bits();
  }

private:
  /// Where rays hit child `i`; `from` grows to the distance there.
  [[gnu::always_inline]] typename S::M cross(const float (&bounds)[6][4], uint32_t i, const F& tfar,
                                             F& from) const {
    F to = tfar;
    clip(bounds[0][i], bounds[1][i], origin_.x, inverse_.x, from, to);
    clip(bounds[2][i], bounds[3][i], origin_.y, inverse_.y, from, to);
    clip(bounds[4][i], bounds[5][i], origin_.z, inverse_.z, from, to);
    return from <= to * F(detail::kRoundedUp);
  }
  [[gnu::always_inline]] static void clip(float low, float high, const F& origin, const F& inverse, F& from,
                                          F& to) {
    const F a = (F(low) - origin) * inverse, b = (F(high) - origin) * inverse;
    from = S::max(from, S::min(a, b));
    to = S::min(to, S::max(a, b));
  }
  static F inverse_of(const F& direction) {
    const F tiny(detail::kTinyDirection);
    return F(1.0f) / S::select(direction < F(0.0f), S::min(direction, -tiny), S::max(direction, tiny));
  }

  V3<S> origin_, inverse_;
};

/// The traversal, for traverse_nodes().
template <class Spu> struct MixedVisitor {
  using S = typename Spu::simd;
  using Stack = typename PacketTraversal<Spu>::Stack;

  PacketTraversal<Spu>& traversal;
  ObjectTests<Spu>& objects;
  RayQuery& query;
  const MixedRays<S> rays;
  Stack& stack;
  float tfar;         ///< the greatest of all rays
  uint32_t lanes = 0; ///< that hit the node or leaf

  [[gnu::always_inline]] bool expand(NodeRef& ref) {
    ++objects.counters().visits;
    const NodeRecord& node = *objects.scene().node(ref.child);
    if (test_leaves(node)) return false;
    uint32_t hit[4];
    float enter[4];
    rays.intersect(node.bounds, PacketTraversal<Spu>::tnear(query), PacketTraversal<Spu>::tfar(query),
                   lanes & query.lanes, hit, enter);
    stack.push_all(enter, hit, node.child, node.leaf);
    return false;
  }
  /// Tests the leaves of a node that has nothing else, one after the other: they are too few for an order to
  /// pay. False: it has inner nodes.
  [[gnu::always_inline]] bool test_leaves(const NodeRecord& node) {
    const uint32_t present = MixedRays<S>::children_of(node.bounds);
    uint32_t inner = 0;
    for (uint32_t i = 0; i < 4; ++i)
      inner |= static_cast<uint32_t>(node.leaf[i] == 0) << i;
    if ((present & inner) != 0) return false;
    using Traversal = PacketTraversal<Spu>;
    for (uint32_t left = present; left != 0; left &= left - 1) {
      const auto i = static_cast<uint32_t>(__builtin_ctz(left));
      const uint32_t hit = rays.hit_child(node.bounds, i, Traversal::tnear(query), Traversal::tfar(query));
      if (const uint32_t group = hit & lanes & query.lanes; group != 0)
        traversal.test_objects({node.child[i], node.leaf[i]}, group, query);
    }
    shorten();
    return true;
  }
  [[gnu::always_inline]] void test(const NodeRef& leaf) {
    traversal.test_objects(leaf, lanes, query);
    shorten();
  }
  [[gnu::always_inline]] bool next(NodeRef& ref) {
    while (stack.size() != 0) {
      const typename Stack::Entry& next = stack.pop();
      lanes = next.lanes & query.lanes;
      if (next.enter > tfar || lanes == 0) continue;
      ref = next.ref;
      return true;
    }
    return false;
  }
  static constexpr bool pauses() { return false; }

private:
  /// After hits.
  [[gnu::always_inline]] void shorten() {
    if (query.hits != nullptr && stack.size() != 0) tfar = PacketTraversal<Spu>::tfar_of(query, query.lanes);
  }
};

} // namespace celltrace::kernel

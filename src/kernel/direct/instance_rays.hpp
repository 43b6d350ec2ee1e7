// Single rays in the space of an instance's mesh: each is tested against the children of a node, and against
// the triangles of a leaf, in lanes. Kernel dialect.
#pragma once

#include "kernel/direct/record_lanes.hpp"
#include "kernel/primitives/instances_module.hpp"
#include "kernel/traversal_stack.hpp"

namespace celltrace::kernel {

template <class Spu> class InstanceRays {
public:
  using S = typename Spu::simd;
  using F = typename S::F;
  using F4 = typename S::F4;
  using M = typename S::M;
  using Stack = TraversalStack<1, kMaxMeshLevels>;

  /// Stores a packet's rays in the mesh's space; `inverse` is 1 / direction.
  [[gnu::always_inline]] InstanceRays(const RayPacket& world, const V3<S>& origin, const V3<S>& direction,
                                      const V3<S>& inverse)
      : world_(world) {
    origin_.template store<S>(origin);
    direction_.template store<S>(direction);
    inverse_.template store<S>(inverse);
  }

  /// Traverses the subtree below `ref` with the rays of `lanes`, one after another, if they are few;
  /// otherwise returns false.
  [[gnu::always_inline]] bool traverse(SceneAccess<Spu>& scene, uint32_t lanes, const NodeRef& ref,
                                       const InstanceTest& test, Stack& stack, HitPacket& hits,
                                       InstanceWork& work) const {
    if (lanes == 0 || __builtin_popcount(lanes) > tuning::kMostRaysAlone) return false;
    const NodeRef below = ref;
    for_each_lane(lanes, [&](uint32_t lane) { traverse_alone(scene, lane, below, test, stack, hits, work); });
    return true;
  }

private:
  /// Traverses the subtree with one ray.
  void traverse_alone(SceneAccess<Spu>& scene, uint32_t lane, NodeRef ref, const InstanceTest& test,
                      Stack& stack, HitPacket& hits, InstanceWork& work) const {
    const uint32_t floor = stack.size();
    const Slabs slabs(*this, lane);
    for (;;) {
      if (!ref.is_leaf()) {
        ++work.nodes;
        expand(*scene.node(ref.child), slabs, hits.distance.lane[lane], stack);
      } else {
        work.triangles += leaf_word::count(ref.leaf);
        test_leaf(scene, lane, ref, test, hits);
        if (test.any && hits.object.lane[lane] != kInstancedBit) {
          hits.distance.lane[lane] = -1.0f;
          return stack.shrink(floor);
        }
      }
      do {
        if (stack.size() == floor) return;
        ref = stack.top().ref;
      } while (stack.pop().enter > hits.distance.lane[lane] * kLongerBox);
    }
  }

  /// A ray in every lane, and the rows of bounds that are nearer to it.
  struct Slabs {
    F4 origin[3], inverse[3];
    uint32_t near[3];

    [[gnu::always_inline]] Slabs(const InstanceRays& rays, uint32_t lane) {
      for (uint32_t axis = 0; axis < 3; ++axis) {
        const float inverse_of_lane = rays.inverse_[axis].lane[lane];
        origin[axis] = F4::splat(rays.origin_[axis].lane[lane]);
        inverse[axis] = F4::splat(inverse_of_lane);
        near[axis] = 2 * axis + (inverse_of_lane < 0.0f ? 1 : 0);
      }
    }
  };

  /// Pushes the children of a node that one ray enters; see MeshRays::expand().
  [[gnu::always_inline]] static void expand(const NodeRecord& node, const Slabs& slabs, float reach,
                                            Stack& stack) {
    F4 enter = F4::splat(0.0f), leave = F4::splat(reach);
    for (uint32_t axis = 0; axis < 3; ++axis) {
      const uint32_t near = slabs.near[axis];
      enter = S::max(enter, (F4::load(node.bounds[near]) - slabs.origin[axis]) * slabs.inverse[axis]);
      leave = S::min(leave, (F4::load(node.bounds[near ^ 1]) - slabs.origin[axis]) * slabs.inverse[axis]);
    }
    alignas(16) float key[4];
    enter.store(key);
    const uint32_t siblings = stack.size();
    for_each_lane(not_above_bits(enter, leave * F4::splat(kLongerBox)), [&](uint32_t i) {
      const NodeRef child = {node.child[i], node.leaf[i]};
      if ((child.child | child.leaf) != 0) stack.push(siblings, {child, 1, key[i], 0});
    });
  }

  [[gnu::always_inline]] void test_leaf(SceneAccess<Spu>& scene, uint32_t lane, const NodeRef& leaf,
                                        const InstanceTest& test, HitPacket& hits) const {
    constexpr auto kBytes = static_cast<uint32_t>(sizeof(ObjectRecord));
    const uint32_t count = leaf_word::count(leaf.leaf);
    const uint32_t first = test.first_number + (leaf.child - test.first_triangle) / kBytes;
    const ObjectRecord* const records = scene.object(leaf.child);
    // Lanes beyond the leaf's triangles repeat the first one.
    const TriangleSides<S> sides = load_sides<S>([&](uint32_t i) __attribute__((always_inline)) {
      return records[i < count ? i : 0].geometry;
    });
    const uint32_t start = world_.start_object.lane[lane] - first;
    const Crossings<S> c = TriangleTest<S>(of(origin_, lane), sides).crossed(of(direction_, lane), M::none());
    const M valid = c.near_hit & (c.near > F(test.nearest)) & (c.near <= F(hits.distance.lane[lane]));
    uint32_t hit = valid.bits() & ((1u << count) - 1);
    if (start < count) hit &= ~(1u << start);
    keep_closest_of<S>(
        c, hit, lane, [first](uint32_t i) { return first + i; }, hits);
  }

  static V3<S> of(const VectorLanes& v, uint32_t lane) {
    return {F(v.x.lane[lane]), F(v.y.lane[lane]), F(v.z.lane[lane])};
  }

  const RayPacket& world_;
  VectorLanes origin_, direction_, inverse_;
};

} // namespace celltrace::kernel

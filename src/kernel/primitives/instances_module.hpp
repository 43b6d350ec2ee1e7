// The code module of instances: objects whose mesh is in the scene image once, in a space of its own. Kernel
// dialect.
//
// A packet's rays are transformed to the mesh's space and traverse the mesh's BVH there. Their directions are
// not normalised, so that distances are those in the world.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/modules.hpp"
#include "kernel/primitives/local_shape.hpp"
#include "kernel/primitives/triangle.hpp"
#include "kernel/scalar_work.hpp"
#include "kernel/scene_access.hpp"
#include "kernel/traversal_stack.hpp"
#include "records/image.hpp"

#include <stddef.h>
#include <string.h>

namespace celltrace::kernel {

/// Returns the offset of an InstanceRecord, which an instance's ExtraRecord has in place of its first value.
inline uint32_t instance_of(const ExtraRecord& extra) {
  uint32_t offset;
  memcpy(&offset, extra.value, sizeof offset);
  return offset;
}

/// A triangle of an instance with records like those of other triangles, in the world.
struct InstancedTriangle {
  ObjectRecord object;
  ExtraRecord extra; ///< for a smooth triangle
};

/// Factor by which boxes are extended along rays, as distances of triangles are rounded.
constexpr float kLongerBox = 1.00001f;

/// The part of an instance's test that is the same for all of its rays.
struct InstanceTest {
  uint32_t first_number, first_triangle; ///< number and offset of the mesh's first triangle
  float nearest;                         ///< hits must be farther than this
  bool any;                              ///< any-hit query: rays end with their first hit
};

/// Numbers of nodes expanded and triangles tested.
struct InstanceWork {
  uint32_t nodes, triangles;
};

/// Returns the offset of the InstanceRecord that a triangle's number belongs to.
template <class Spu> uint32_t instance_with(SceneAccess<Spu>& scene, uint32_t number) {
  constexpr auto kBytes = static_cast<uint32_t>(sizeof(InstanceRecord));
  uint32_t first = scene.list_word(offsetof(ImageHeader, instance_offset));
  uint32_t count = scene.list_word(offsetof(ImageHeader, instance_count));
  while (count > 1) {
    const uint32_t half = count / 2;
    if (scene.instance(first + half * kBytes)->first_number <= number - kInstancedBit) {
      first += half * kBytes;
      count -= half;
    } else {
      count = half;
    }
  }
  return first;
}

namespace module_instances {

/// The rays of a packet in a mesh's space.
template <class S> struct MeshRays {
  V3<S> origin, direction, inverse;

  /// Pushes the children of a node that some of the rays enter before `reach`, the nearest on top unless the
  /// query is `any`.
  [[gnu::always_inline]] void expand(const NodeRecord& node, const typename S::F& reach, bool any,
                                     TraversalStack<1, kMaxMeshLevels>& stack) const {
    using F = typename S::F;
    const uint32_t siblings = stack.size();
    for (uint32_t i = 0; i < 4 && (node.child[i] | node.leaf[i]) != 0; ++i) {
      F enter;
      const uint32_t lanes = find_entry(node.bounds, i, reach, enter);
      if (lanes == 0) continue;
      float first_enter = 0.0f, last_enter;
      if (!any)
        S::extremes(S::select(S::M::from_bits(lanes), enter, F(kMaxHitDistance)), first_enter, last_enter);
      stack.push(siblings, {{node.child[i], node.leaf[i]}, lanes, first_enter, 0});
    }
  }

private:
  /// Finds the distances at which rays enter a child of a node; returns the rays that enter before `reach`.
  [[gnu::always_inline]] uint32_t find_entry(const float (&bounds)[6][4], uint32_t child,
                                             const typename S::F& reach, typename S::F& enter) const {
    using F = typename S::F;
    const F low_x = (F(bounds[0][child]) - origin.x) * inverse.x;
    const F high_x = (F(bounds[1][child]) - origin.x) * inverse.x;
    const F low_y = (F(bounds[2][child]) - origin.y) * inverse.y;
    const F high_y = (F(bounds[3][child]) - origin.y) * inverse.y;
    const F low_z = (F(bounds[4][child]) - origin.z) * inverse.z;
    const F high_z = (F(bounds[5][child]) - origin.z) * inverse.z;
    enter = S::max(S::max(S::min(low_x, high_x), S::min(low_y, high_y)), S::min(low_z, high_z));
    const F leave = S::min(S::min(S::max(low_x, high_x), S::max(low_y, high_y)), S::max(low_z, high_z));
    return ((enter <= S::min(leave, reach) * F(kLongerBox)) & (leave >= F(0.0f))).bits();
  }
};

/// Replaces hits by closer hits of the object's triangles that are farther than `nearest`. In an `any` query,
/// `hits` has kInstancedBit in place of objects, and rays end with their first hit.
template <class Spu>
CELLTRACE_ONE_COPY InstanceWork intersect(SceneAccess<Spu>& scene, const RayPacket& rays,
                                          const ObjectRecord& object, float nearest, bool any,
                                          HitPacket& hits) {
  using S = typename Spu::simd;
  using F = typename S::F;
  using I = typename S::I;
  scene.spu().run_in_module(modules::kInstances);
  MeshRays<S> local;
  local.origin = to_local<S>(object.geometry, rays.origin.template load<S>(), 1.0f);
  local.direction = to_local<S>(object.geometry, rays.direction.template load<S>(), 0.0f);
  local.inverse = {finite_inverse<S>(local.direction.x), finite_inverse<S>(local.direction.y),
                   finite_inverse<S>(local.direction.z)};
  const InstanceRecord& instance = *scene.instance(instance_of(*scene.extra(object.extra)));
  const uint32_t first_triangle = instance.first_triangle, first = kInstancedBit + instance.first_number;
  NodeRef ref = {instance.root, 0};
  const InstanceTest test = {first, first_triangle, nearest, any};
  const typename Strategy<Spu>::template InstanceRays<Spu> few(rays, local.origin, local.direction,
                                                               local.inverse);
  TraversalStack<1, kMaxMeshLevels> stack;
  InstanceWork work = {0, 0};
  for (;;) {
    if (ref.is_leaf()) {
      scene.for_each_object(ref, [&](uint32_t triangle) {
        scene.spu().compute(scalar_work::kClosest);
        scene.spu().compute(scalar_work::kTestTriangle);
        ++work.triangles;
        const uint32_t self =
            first + (triangle - first_triangle) / static_cast<uint32_t>(sizeof(ObjectRecord));
        const TriangleTest<S> seen(local.origin, TriangleSides<S>::of(*scene.object_apart(triangle)));
        Crossings<S> c = seen.crossed(local.direction, lanes_that_start_on<S>(rays, self));
        c.near_hit = c.near_hit & (c.near > F(nearest));
        keep_closest<S>(c, self, hits);
        return false;
      });
      if (any) {
        const auto ended = !(load_words<S>(hits.object) == I::splat(static_cast<int32_t>(kInstancedBit)));
        S::select(ended, F(-1.0f), F::load(hits.distance.lane)).store(hits.distance.lane);
      }
    } else {
      scene.spu().compute(scalar_work::kBvhNode);
      ++work.nodes;
      const F reach = F::load(hits.distance.lane);
      const NodeRecord& node = *scene.node(ref.child);
      local.expand(node, reach, any, stack);
    }
    for (;;) {
      if (stack.size() == 0) return work;
      const auto& next = stack.pop();
      ref = next.ref;
      // Hits since the entry was pushed may be nearer.
      const uint32_t lanes =
          next.lanes & (F(next.enter) <= F::load(hits.distance.lane) * F(kLongerBox)).bits();
      if (few.traverse(scene, lanes, ref, test, stack, hits, work)) continue;
      if (lanes != 0) break;
    }
  }
}

/// Makes the records of a triangle of an instance.
template <class Spu>
CELLTRACE_ONE_COPY void load(SceneAccess<Spu>& scene, uint32_t number, InstancedTriangle& to) {
  scene.spu().run_in_module(modules::kInstances);
  scene.spu().compute(scalar_work::kHitObject);
  Kept<Spu, InstanceRecord> instance = *scene.instance(instance_with(scene, number));
  const uint32_t index = number - kInstancedBit - instance.first_number;
  Kept<Spu, ObjectRecord> triangle =
      *scene.object_apart(instance.first_triangle + index * static_cast<uint32_t>(sizeof(ObjectRecord)));
  to.object = triangle;
  to.object.interior = instance.interior;
  if (triangle.material == kNoOffset) {
    to.object.kind_and_flags |= instance.kind_and_flags;
    to.object.material = instance.material;
  }
  for (uint32_t corner = 0; corner < 9; corner += 3)
    for (uint32_t row = 0; row < 3; ++row) {
      const float* const m = instance.to_world + row * 4;
      const float* const v = triangle.geometry + corner;
      to.object.geometry[corner + row] = m[0] * v[0] + m[1] * v[1] + m[2] * v[2] + m[3];
    }
  if (triangle.extra == kNoOffset) return;
  const ExtraRecord& extra = *scene.extra(triangle.extra);
  for (uint32_t corner = 0; corner < 9; corner += 3)
    for (uint32_t row = 0; row < 3; ++row) {
      const float* const m = instance.normal_to_world + row * 3;
      const float* const n = extra.value + corner;
      to.extra.value[corner + row] = m[0] * n[0] + m[1] * n[1] + m[2] * n[2];
    }
}

} // namespace module_instances

} // namespace celltrace::kernel

// Crossings that CSG sees with a mesh without an inside vector: those that POV-Ray's search finds before it
// ends. A part of the code module of meshes. Kernel dialect.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/modules.hpp"
#include "kernel/parts.hpp"
#include "kernel/primitives/local_shape.hpp"
#include "kernel/primitives/triangle.hpp"
#include "kernel/scene_access.hpp"

namespace celltrace::kernel {

namespace module_meshes {

/// Relative error in single precision of the distance to the points that are tested.
constexpr float kNearCrossing = 3e-5f;

template <class S> V3<S> least_of(const V3<S>& a, const V3<S>& b) {
  return {S::min(a.x, b.x), S::min(a.y, b.y), S::min(a.z, b.z)};
}
template <class S> V3<S> greatest_of(const V3<S>& a, const V3<S>& b) {
  return {S::max(a.x, b.x), S::max(a.y, b.y), S::max(a.z, b.z)};
}

template <class S> struct BoxCrossing {
  typename S::F enter, leave;

  BoxCrossing(const V3<S>& origin, const V3<S>& inverse, const V3<S>& least, const V3<S>& greatest) {
    const V3<S> low = {(least.x - origin.x) * inverse.x, (least.y - origin.y) * inverse.y,
                       (least.z - origin.z) * inverse.z};
    const V3<S> high = {(greatest.x - origin.x) * inverse.x, (greatest.y - origin.y) * inverse.y,
                        (greatest.z - origin.z) * inverse.z};
    enter = S::max(S::max(S::min(low.x, high.x), S::min(low.y, high.y)), S::min(low.z, high.z));
    leave = S::min(S::min(S::max(low.x, high.x), S::max(low.y, high.y)), S::max(low.z, high.z));
  }
};

/// Finds the crossings for a part of a packet; see found_crossings().
template <class Spu>
uint32_t found_crossings_of_part(SceneAccess<Spu>& scene, const ObjectRecord& solid,
                                 const V3<typename Spu::rare_simd>& origins,
                                 const V3<typename Spu::rare_simd>& points, uint32_t lanes) {
  using S = typename Spu::rare_simd;
  using F = typename S::F;
  using I = typename S::I;
  using M = typename S::M;
  constexpr auto kRecord = static_cast<uint32_t>(sizeof(CrossedMeshRecord));
  const uint32_t first = solid.extra, end = scene.crossed_mesh(first)->next;
  const V3<S> segment = points - origins;
  const V3<S> origin = to_local<S>(solid.geometry, origins, 1.0f);
  const V3<S> direction = to_local<S>(solid.geometry, segment, 0.0f);
  const V3<S> inverse = {finite_inverse<S>(direction.x), finite_inverse<S>(direction.y),
                         finite_inverse<S>(direction.z)};
  // Crossings at the ray's origin belong to the object that it starts on.
  const F nearest = (F(kMinHitDistance) + absolute_sum<S>(origins) * F(1e-6f)) /
                    S::max(absolute_sum<S>(segment), F(1e-20f));
  F entered(-kEveryCrossing), reached(kEveryCrossing);
  I number = I::splat(-1);
  uint32_t found = 0;
  // Each round finds the crossing whose box is entered next.
  while (lanes != 0) {
    F enter = S::min(reached + S::abs(reached) * F(kNearCrossing), F(1.0f + kNearCrossing)), at(0.0f);
    I next = I::splat(-1);
    M is_next = M::none();
    for (uint32_t offset = first; offset != end;) {
      scene.spu().compute(scalar_work::kBvhNode);
      Kept<Spu, CrossedMeshRecord> record = *scene.crossed_mesh(offset);
      const bool is_triangle = record.is_triangle != 0;
      const I own = I::splat(static_cast<int32_t>(offset));
      const V3<S> a = splat3<S>(record.corner[0]), b = splat3<S>(record.corner[1]);
      const V3<S> c = is_triangle ? splat3<S>(record.corner[2]) : b;
      const BoxCrossing<S> box(origin, inverse, least_of<S>(least_of<S>(a, b), c),
                               greatest_of<S>(greatest_of<S>(a, b), c));
      const uint32_t inside = offset + kRecord;
      offset = record.next;
      if (!is_triangle) {
        const F leave = box.leave + (F(1.0f) + S::abs(box.leave)) * F(kNearCrossing);
        if ((((box.enter <= S::min(enter, leave)) & (box.leave >= F(0.0f))).bits() & lanes) != 0)
          offset = inside;
        continue;
      }
      const M is_left = (box.enter > entered) | ((box.enter == entered) & (number < own));
      const M comes = is_left & ((box.enter < enter) | ((box.enter == enter) & !is_next));
      if ((comes.bits() & lanes) == 0) continue;
      const Crossings<S> crossing = TriangleTest<S>(origin, {a, b - a, c - a}).crossed(direction, M::none());
      const M hit = comes & crossing.near_hit & (crossing.near > nearest);
      enter = S::select(hit, box.enter, enter);
      at = S::select(hit, crossing.near, at);
      next = S::select(hit, own, next);
      is_next = is_next | hit;
    }
    lanes &= is_next.bits();
    const uint32_t here = (S::abs(at - F(1.0f)) <= F(kNearCrossing)).bits() & lanes;
    found |= here;
    lanes &= ~here;
    entered = enter;
    reached = at;
    number = next;
  }
  return found;
}

/// Returns the points of `lanes`, on triangles of a mesh, that POV-Ray's search along rays from `origins`
/// finds. The search visits triangles in the order in which their boxes are entered, and ends at a triangle
/// whose box begins behind the last crossing that was found. `solid` is part of a SolidRecord. Distances are
/// relative to the point's distance.
template <class Spu>
CELLTRACE_ONE_COPY uint32_t found_crossings(SceneAccess<Spu>& scene, const ObjectRecord& record,
                                            const V3<typename Spu::simd>& origins,
                                            const V3<typename Spu::simd>& points, uint32_t lanes) {
  scene.spu().run_in_module(modules::kMeshes);
  Kept<Spu, ObjectRecord> solid = record;
  uint32_t found = 0;
  for_each_part<Spu>([&](uint32_t first) {
    const uint32_t some = part_of<Spu>(lanes, first);
    if (some == 0) return;
    found |=
        found_crossings_of_part(scene, solid, part_of<Spu>(origins, first), part_of<Spu>(points, first), some)
        << first;
  });
  return found;
}

} // namespace module_meshes

} // namespace celltrace::kernel

// CSG parts that one other solid clips, such as a torus that a box or a plane cuts in half. Kernel dialect,
// for direct memory.
//
// A ray crosses the faces of a convex solid twice at most. Therefore the condition on a part's crossings is
// known before they are found: they have to lie between the two crossings of faces, or outside.
#pragma once

#include "kernel/primitives/csg.hpp"

namespace celltrace::kernel {

/// The only solid that a condition tests.
struct ClippingSolid {
  uint32_t solid; ///< offset of a SolidRecord, or kNoOffset: the condition tests several solids or none
  bool keeps_inside;

  template <class Spu> static ClippingSolid of(SceneAccess<Spu>& scene, uint32_t condition) {
    constexpr ClippingSolid kNone = {kNoOffset, false};
    const CsgRecord& level = *scene.csg(condition);
    const uint32_t skipped = level.skip_end - level.skip_begin;
    if (level.next != kNoOffset || level.count != skipped + 1) return kNone;
    const uint32_t number = level.skip_begin == 0 ? level.skip_end : 0;
    const CsgStep& step = *scene.csg_step(level.steps + number * static_cast<uint32_t>(sizeof(CsgStep)));
    // The next step is the end, as steps only go forward, perhaps past the skipped ones.
    const bool keeps_inside = step.if_inside != kCsgReject, keeps_outside = step.if_outside != kCsgReject;
    if (step.unseen_by != 0 || keeps_inside == keeps_outside) return kNone;
    return {step.solid, keeps_inside};
  }
};

/// Return the intervals of rays in a box, or in the half-space of a plane.
template <class S> SlabInterval<S> interval_in_box(const RayPacket& rays, const ObjectRecord& box) {
  return BoxPrimitive::slabs_along<S>(to_local<S>(box.geometry, rays.origin.template load<S>(), 1.0f),
                                      to_local<S>(box.geometry, rays.direction.template load<S>(), 0.0f));
}
template <class S> SlabInterval<S> interval_in_half_space(const RayPacket& rays, const ObjectRecord& plane) {
  using F = typename S::F;
  const V3<S> normal = splat3<S>(plane.geometry + 8);
  const F height = dot<S>(normal, rays.origin.template load<S>()) + F(plane.geometry[11]);
  const F slope = dot<S>(normal, rays.direction.template load<S>()), at = -height * finite_inverse<S>(slope);
  const auto goes_out = slope >= F(0.0f);
  return {S::select(goes_out, F(-kEveryCrossing), at), S::select(goes_out, at, F(kEveryCrossing))};
}

/// A clipping solid in which the intervals of rays are found quickly: a box or a plane.
struct ClippingObject {
  const ObjectRecord* object; ///< null: the solid is no box and no plane
  bool is_box, keeps_inside;

  template <class Spu> static ClippingObject of(SceneAccess<Spu>& scene, uint32_t condition) {
    constexpr ClippingObject kNone = {nullptr, false, false};
    const ClippingSolid clipping = ClippingSolid::of(scene, condition);
    if (clipping.solid == kNoOffset) return kNone;
    const ObjectRecord& object = scene.solid(clipping.solid)->object;
    const uint32_t kind = object.kind_and_flags & object_flag::kind_mask;
    const bool is_box = kind == kPrimitiveKind<BoxPrimitive>;
    if (!is_box && kind != kPrimitiveKind<PlanePrimitive>) return kNone;
    return {&object, is_box, clipping.keeps_inside};
  }

  template <class S> void clip(const RayPacket& rays, ClippedRays& clipped) const {
    const SlabInterval<S> inside =
        is_box ? interval_in_box<S>(rays, *object) : interval_in_half_space<S>(rays, *object);
    clipped.keeps_inside = keeps_inside;
    inside.enter.store(clipped.enter.lane);
    inside.leave.store(clipped.leave.lane);
  }
};

} // namespace celltrace::kernel

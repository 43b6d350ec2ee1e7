// Parts of CSG that one other solid clips: a torus that a box cuts in half. Kernel dialect, where memory is
// direct.
//
// A ray crosses the faces of a convex solid twice at most. What is asked of a part's crossings is so known
// before they are found: they are between those two, or they are not.
#pragma once

#include "kernel/primitives/csg.hpp"

namespace celltrace::kernel {

/// The only solid that a condition asks about.
struct ClippingSolid {
  uint32_t solid; ///< offset of a SolidRecord, or kNoOffset: it asks about several, or about none
  bool keeps_inside;

  template <class Spu> static ClippingSolid of(SceneAccess<Spu>& scene, uint32_t condition) {
    constexpr ClippingSolid kNone = {kNoOffset, false};
    const CsgRecord& level = *scene.csg(condition);
    const uint32_t skipped = level.skip_end - level.skip_begin;
    if (level.next != kNoOffset || level.count != skipped + 1) return kNone;
    const uint32_t number = level.skip_begin == 0 ? level.skip_end : 0;
    const CsgStep& step = *scene.csg_step(level.steps + number * static_cast<uint32_t>(sizeof(CsgStep)));
    // Steps only go forward: from this one to the end, perhaps past those that are skipped.
    const bool keeps_inside = step.if_inside != kCsgReject, keeps_outside = step.if_outside != kCsgReject;
    if (step.unseen_by != 0 || keeps_inside == keeps_outside) return kNone;
    return {step.solid, keeps_inside};
  }
};

/// Finds where rays are in a clipping solid. False: it is none of those for which this is fast.
template <class Spu>
bool clip_rays(SceneAccess<Spu>& scene, uint32_t condition, const RayPacket& rays, ClippedRays& clipped) {
  using S = typename Spu::simd;
  const ClippingSolid clipping = ClippingSolid::of(scene, condition);
  if (clipping.solid == kNoOffset) return false;
  const ObjectRecord& object = scene.solid(clipping.solid)->object;
  const uint32_t kind = object.kind_and_flags & object_flag::kind_mask;
  if (kind != kPrimitiveKind<BoxPrimitive>) return false;
  const SlabInterval<S> inside =
      BoxPrimitive::slabs_along<S>(to_local<S>(object.geometry, rays.origin.template load<S>(), 1.0f),
                                   to_local<S>(object.geometry, rays.direction.template load<S>(), 0.0f));
  clipped.keeps_inside = clipping.keeps_inside;
  inside.enter.store(clipped.enter.lane);
  inside.leave.store(clipped.leave.lane);
  return true;
}

} // namespace celltrace::kernel

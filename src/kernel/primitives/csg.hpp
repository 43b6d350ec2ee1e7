// Constructive solid geometry: decides which crossings with a part's surface count. Kernel dialect.
#pragma once

#include "kernel/primitives/crossed_meshes.hpp"
#include "kernel/primitives/meshes_module.hpp"
#include "kernel/primitives/shapes_module.hpp"
#include "kernel/scene_access.hpp"

namespace celltrace::kernel {

/// Returns the points of `lanes` that are inside a solid; for a mesh without an inside vector, the crossings
/// with rays from `origins` that CSG sees.
template <class Spu>
uint32_t inside_solid(SceneAccess<Spu>& scene, uint32_t solid, const V3<typename Spu::simd>& origins,
                      const V3<typename Spu::simd>& points, uint32_t lanes) {
  const SolidRecord& record = *scene.solid(solid);
  const uint32_t kind = record.object.kind_and_flags & object_flag::kind_mask;
  if (kind == kMeshSolid) {
    scene.spu().enter_module(modules::kMeshes);
    return module_meshes::inside(scene, record.object, points, lanes);
  }
  if (kind == kCrossedMeshSolid) {
    scene.spu().enter_module(modules::kMeshes);
    return module_meshes::found_crossings(scene, record.object, origins, points, lanes);
  }
  if (Primitives::is_made_of_data(kind)) return inside_made_of_data(scene, record, points, lanes);
  if (Primitives::has_heavy_points(kind)) {
    scene.spu().enter_module(modules::kHeavyPoints);
    return module_heavy_points::inside(scene.spu(), record, points) & lanes;
  }
  scene.spu().enter_module(modules::kShapes);
  return module_shapes::inside(scene.spu(), record, points) & lanes;
}

/// Value of `reflected` if rays see all objects.
constexpr uint32_t kSeesAll = 0x80000000u;

/// Returns the lanes to which an object with these flags is invisible; rays in `reflected` come from a
/// mirror.
inline uint32_t blind_lanes(uint32_t flags, uint32_t reflected) {
  if (reflected == kSeesAll) return 0;
  return ((flags & object_flag::no_image) != 0 ? ~reflected : 0) |
         ((flags & object_flag::no_reflection) != 0 ? reflected : 0);
}

/// Returns the points of `lanes`, where rays from `origins` cross the surface of a part, that satisfy the
/// part's condition and the conditions of all levels above. Each lane has its own place in the program, which
/// only advances.
template <class Spu>
[[gnu::noinline]] uint32_t
csg_accepted(SceneAccess<Spu>& scene, uint32_t condition, const V3<typename Spu::simd>& origins,
             const V3<typename Spu::simd>& points, uint32_t lanes, uint32_t reflected) {
  using S = typename Spu::simd;
  using I = typename S::I;
  const auto word = [](uint32_t value) { return I::splat(static_cast<int32_t>(value)); };
  while (condition != kNoOffset && lanes != 0) {
    Kept<Spu, CsgRecord> level = *scene.csg(condition);
    const uint32_t first = level.skip_begin == 0 ? level.skip_end : 0;
    I place = word(first == level.count ? kCsgAccept : first);
    for (uint32_t i = first; i < level.count; ++i) {
      if (i == level.skip_begin && i != level.skip_end) {
        const uint32_t after = level.skip_end == level.count ? kCsgAccept : level.skip_end;
        place = S::select(place == word(i), word(after), place);
        i = level.skip_end - 1;
        continue;
      }
      const uint32_t here = (place == word(i)).bits() & lanes;
      if (here == 0) continue;
      Kept<Spu, CsgStep> step = *scene.csg_step(level.steps + i * static_cast<uint32_t>(sizeof(CsgStep)));
      const uint32_t inside = step.unseen_by != 0 ? here & ~blind_lanes(step.unseen_by, reflected)
                                                  : inside_solid(scene, step.solid, origins, points, here);
      place = S::select(S::M::from_bits(inside), word(step.if_inside), place);
      place = S::select(S::M::from_bits(here & ~inside), word(step.if_outside), place);
    }
    lanes &= (place == word(kCsgAccept)).bits();
    condition = level.next;
  }
  return lanes;
}

} // namespace celltrace::kernel

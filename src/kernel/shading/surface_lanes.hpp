// Further input of patterns besides points: surface coordinates and normals. Kernel dialect.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/modules.hpp"
#include "kernel/shading/hit_points.hpp"
#include "kernel/textures/pattern_points.hpp"
#include "records/light_feature.hpp"

namespace celltrace::kernel {

/// Returns true if some objects of a frame have object_flag::by_surface.
constexpr bool has_surface_lanes(const FrameBlock& frame) {
  return (frame.light_features & light_feature::by_surface) != 0;
}
/// Allocates local store for surface coordinates and normals, if a frame needs them.
template <class Spu> SurfaceLanes* allocate_surface_lanes(Spu& spu, const FrameBlock& frame) {
  return has_surface_lanes(frame) ? spu.template allocate<SurfaceLanes>() : nullptr;
}

namespace detail {

/// Finds the surface coordinates of points on one object; `hit_u` and `hit_v` are the barycentric coordinates
/// of the hits.
template <class Spu>
void surface_coordinates_of(SceneAccess<Spu>& scene, const ObjectRecord& object,
                            const V3<typename Spu::rare_simd>& point, const typename Spu::rare_simd::F& hit_u,
                            const typename Spu::rare_simd::F& hit_v, typename Spu::rare_simd::F& u,
                            typename Spu::rare_simd::F& v) {
  using S = typename Spu::rare_simd;
  u = point.x;
  v = point.y;
  Primitives::dispatch(object.kind_and_flags & object_flag::kind_mask, [&](auto shape) {
    using Shape = decltype(shape);
    if constexpr (Shape::kHasCoordinates) {
      const bool reads_extra = Shape::kReadsExtraForCoordinates && object.extra != kNoOffset;
      const ExtraRecord* const extra = reads_extra ? scene.extra(object.extra) : nullptr;
      Shape::template coordinates<S>({object, extra, point, hit_u, hit_v}, u, v);
    }
  });
}

} // namespace detail

/// Sets the surface coordinates and normals of the hits of `lanes` on objects with object_flag::by_surface,
/// before normals are disturbed.
template <class Spu>
CELLTRACE_ONE_COPY void find_surface_lanes(SceneAccess<Spu>& scene,
                                           const HitPoints<typename Spu::simd>& points, const HitPacket& hits,
                                           uint32_t lanes, SurfaceLanes& surface) {
  using S = typename Spu::simd;
  using R = typename Spu::rare_simd;
  using F = typename R::F;
  scene.spu().run_in_module(modules::kSurfaces);
  surface.normal.template store<S>(points.normal);
  for_each_value<S>(hits.object, lanes, [&](uint32_t offset, uint32_t same) {
    scene.spu().compute(scalar_work::kHitObject);
    if (is_instanced(offset)) return;
    Kept<Spu, ObjectRecord> object = *scene.object(offset);
    if ((object.kind_and_flags & object_flag::by_surface) == 0) return;
    for_each_part<Spu>([&](uint32_t first) {
      const auto take = R::M::from_bits(part_of<Spu>(same, first));
      if (take.bits() == 0) return;
      F u, v;
      detail::surface_coordinates_of(scene, object, part_of<Spu>(points.point, first),
                                     F::load(hits.u.lane + first), F::load(hits.v.lane + first), u, v);
      const auto put = [&](const F& value, FloatLanes& to) {
        R::select(take, value, F::load(to.lane + first)).store(to.lane + first);
      };
      put(u, surface.u);
      put(v, surface.v);
    });
  });
}

} // namespace celltrace::kernel

// What patterns may ask of surfaces besides points: their coordinates and normals. Kernel dialect.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/modules.hpp"
#include "kernel/shading/hit_points.hpp"
#include "kernel/textures/angles.hpp"
#include "kernel/textures/pattern_points.hpp"
#include "records/light_way.hpp"

namespace celltrace::kernel {

/// Whether some objects of a frame are object_flag::by_surface.
constexpr bool has_surface_lanes(const FrameBlock& frame) {
  return (frame.light_ways & light_way::by_surface) != 0;
}
/// Local store for them, in a frame that has such.
template <class Spu> SurfaceLanes* allocate_surface_lanes(Spu& spu, const FrameBlock& frame) {
  return has_surface_lanes(frame) ? spu.template allocate<SurfaceLanes>() : nullptr;
}

namespace detail {

/// An angle in turns from 0 up to 1.
template <class S>
[[gnu::always_inline]] inline typename S::F whole_turns(const typename S::F& y, const typename S::F& x) {
  const typename S::F turns = turns_inline<S>(y, x);
  return turns - S::floor(turns);
}

/// Around the y axis, and from pole to pole.
template <class S>
[[gnu::always_inline]] inline void map_sphere(const V3<S>& p, typename S::F& u, typename S::F& v) {
  using F = typename S::F;
  u = whole_turns<S>(p.z, p.x);
  v = F(0.5f) + F(2.0f) * turns_inline<S>(p.y, S::sqrt(p.x * p.x + p.z * p.z));
}

/// The cube from -1 to 1 unfolded: four sides around it in a row, and one above and one below the second of
/// them.
template <class S>
[[gnu::always_inline]] inline void map_box(const V3<S>& p, typename S::F& u, typename S::F& v) {
  using F = typename S::F;
  const V3<S> side = BoxPrimitive::gradient<S>(p, LocalParameters<S>{F(0.0f), F(0.0f), S::M::none()});
  const F half(0.5f), zero(0.0f), one(1.0f);
  const F x = (p.x + one) * half, y = (p.y + one) * half, z = (p.z + one) * half;
  const auto is_x = !(side.x == zero), is_y = !(side.y == zero);
  F across = S::select(side.z < zero, F(4.0f) - x, one + x);
  across = S::select(is_x, S::select(side.x < zero, z, F(3.0f) - z), across);
  u = S::select(is_y, one + x, across) * F(0.25f);
  v = S::select(is_y, S::select(side.y < zero, z, F(3.0f) - z), one + y) * F(1.0f / 3);
}

/// Around the ring, and around the tube. In the torus's own space the axes are z, x, y of POV-Ray's.
template <class S>
[[gnu::always_inline]] inline void map_torus(const V3<S>& p, typename S::F& u, typename S::F& v) {
  using F = typename S::F;
  u = F(0.5f) - turns_inline<S>(p.x, p.y);
  v = F(0.5f) + turns_inline<S>(p.z, S::sqrt(p.x * p.x + p.y * p.y) - F(1.0f));
}

/// The surface coordinates of points of one object; `hit_u` and `hit_v` are those of the hits.
template <class Spu>
void surface_coordinates_of(SceneAccess<Spu>& scene, const ObjectRecord& object,
                            const V3<typename Spu::rare_simd>& point, const typename Spu::rare_simd::F& hit_u,
                            const typename Spu::rare_simd::F& hit_v, typename Spu::rare_simd::F& u,
                            typename Spu::rare_simd::F& v) {
  using S = typename Spu::rare_simd;
  using F = typename S::F;
  const float(&g)[12] = object.geometry;
  u = point.x;
  v = point.y;
  switch (object.kind_and_flags & object_flag::kind_mask) {
  case kPrimitiveKind<TrianglePrimitive>: {
    u = v = F(0.0f);
    if (object.extra == kNoOffset) return;
    const float(&uv)[6] = scene.extra(object.extra)->bounds;
    const F rest = F(1.0f) - hit_u - hit_v;
    u = F(uv[0]) * rest + F(uv[2]) * hit_u + F(uv[4]) * hit_v;
    v = F(uv[1]) * rest + F(uv[3]) * hit_u + F(uv[5]) * hit_v;
    return;
  }
  case kPrimitiveKind<SpherePrimitive>: {
    const V3<S> from = point - splat3<S>(g), x = splat3<S>(g + 4), y = splat3<S>(g + 7);
    return map_sphere<S>({dot<S>(x, from), dot<S>(y, from), dot<S>(cross<S>(x, y), from) * F(g[10])}, u, v);
  }
  case kPrimitiveKind<EllipsoidPrimitive>:
    if ((object.kind_and_flags & object_flag::flat_map) != 0) return;
    return map_sphere<S>(to_local<S>(g, point, 1.0f), u, v);
  case kPrimitiveKind<BoxPrimitive>:
    return map_box<S>(to_local<S>(g, point, 1.0f), u, v);
  case kPrimitiveKind<TorusPrimitive>:
    return map_torus<S>(to_local<S>(g, point, 1.0f), u, v);
  default:
    return;
  }
}

} // namespace detail

/// Of those hits of `lanes` that are on objects with object_flag::by_surface, before normals are disturbed.
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

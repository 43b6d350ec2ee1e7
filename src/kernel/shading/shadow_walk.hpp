// Shadow rays that go from surface to surface, as POV-Ray's do: if interiors fade, throw caustics, or look
// different from inside, the light that a surface lets through depends on where the ray comes from. Kernel
// dialect.
#pragma once

#include "kernel/accel/object_tests.hpp"
#include "kernel/shading/fading.hpp"
#include "kernel/shading/hit_points.hpp"
#include "kernel/shading/secondary_rays.hpp"
#include "kernel/shading/surface_lanes.hpp"

namespace celltrace::kernel {

/// A walk: the rays of a packet on their way to a light.
template <class S> struct alignas(128) ShadowWalk {
  RayNode* ray;    ///< rays that are still on the way, from the last surface on
  FloatLanes left; ///< distance to the light
  VectorLanes* light;
  HitPacket hits;
  HitPoints<S> points;
  SurfaceLanes surface; ///< surface coordinates and normals at the points, if has_surface_lanes()
  bool has_surface;
};

/// Allocates local store for walks, if the frame has any. `scratch` belongs to a walk while it is under way.
template <class Spu>
ShadowWalk<typename Spu::simd>* allocate_shadow_walk(Spu& spu, const FrameBlock& frame, RayNode& scratch) {
  if (!walks_shadows(frame)) return nullptr;
  auto* const walk = spu.template allocate<ShadowWalk<typename Spu::simd>>();
  walk->ray = &scratch;
  return walk;
}

/// Starts `lanes` of shadow rays inside the interiors `from`, or those of the camera if `from` is null.
template <class Spu>
[[gnu::noinline]] void begin_shadow_walk(Spu& spu, const FrameBlock& frame, const RayInteriors* from,
                                         const RayPacket& rays, uint32_t lanes, const FloatLanes& distance,
                                         VectorLanes& light, ShadowWalk<typename Spu::simd>& walk) {
  using S = typename Spu::simd;
  using F = typename S::F;
  spu.run_in_module(modules::kShadowWalk);
  walk.ray->rays = rays;
  walk.ray->lanes = lanes;
  walk.left = distance;
  const F zero(0.0f);
  light.template store<S>(select<S>(S::M::from_bits(lanes), light.template load<S>(), {zero, zero, zero}));
  walk.light = &light;
  walk.has_surface = has_surface_lanes(frame);
  if (from != nullptr) {
    walk.ray->interior_depth = from->interior_depth;
    for (uint32_t d = 0; d < kMaxInteriorDepth; ++d)
      walk.ray->interiors[d] = from->interiors[d];
    return;
  }
  for_each_lane(lanes, [&](uint32_t lane) {
    walk.ray->interior_depth.lane[lane] = frame.camera_interior_count;
    for (uint32_t d = 0; d < frame.camera_interior_count; ++d)
      walk.ray->interiors[d].lane[lane] = frame.camera_interiors[d];
  });
}

namespace detail {

/// Multiplies the light of a walk by the transmittance of surfaces with one material, or three blended ones.
template <class Spu>
void filter_light(SceneAccess<Spu>& scene, uint32_t material, bool blended, uint32_t lanes,
                  ShadowWalk<typename Spu::simd>& walk) {
  using S = typename Spu::rare_simd;
  using F = typename S::F;
  for_each_part<Spu>([&](uint32_t first) {
    const uint32_t some = part_of<Spu>(lanes, first);
    if (some == 0) return;
    const PatternPoints<S> points = {part_of<Spu>(walk.points.point, first), &walk.surface, first};
    const F u = F::load(walk.hits.u.lane + first), v = F::load(walk.hits.v.lane + first);
    V3<S> passes;
    surface_transmittance(scene, material, blended, points, u, v, some, passes);
    const V3<S> before = walk.light->template load_from<S>(first);
    walk.light->template store_from<S>(first, select<S>(S::M::from_bits(some), before * passes, before));
  });
}

/// Increases light where rays go straight through a surface, in place of the light that refraction would
/// focus.
template <class Spu>
void add_caustics(SceneAccess<Spu>& scene, uint32_t lanes, ShadowWalk<typename Spu::simd>& walk) {
  using S = typename Spu::rare_simd;
  using F = typename S::F;
  for_each_value<typename Spu::simd>(walk.points.interior, lanes, [&](uint32_t interior, uint32_t same) {
    const float exponent = scene.interior(interior)->caustics;
    if (exponent == 0.0f) return;
    const uint32_t disturbed = same & walk.points.disturbed & ~walk.points.blended;
    for_each_value<typename Spu::simd>(
        walk.points.material, disturbed, [&](uint32_t material, uint32_t some) {
          const MaterialRecord& r = *scene.material(material);
          if ((r.flags & material_flag::disturbed) == 0) return;
          const uint32_t normal = r.normal;
          scene.spu().enter_module(modules::kNormals);
          disturb_normal<Spu>(scene, normal, {walk.points.point, &walk.surface}, some, walk.points.normal);
        });
    for_each_part<Spu>([&](uint32_t first) {
      const V3<S> direction = walk.ray->rays.direction.template load_from<S>(first);
      const F cosine = S::abs(dot<S>(direction, part_of<Spu>(walk.points.normal, first)));
      const F more = F(1.0f) + pow<S>(cosine, F(exponent));
      const V3<S> before = walk.light->template load_from<S>(first);
      walk.light->template store_from<S>(
          first, select<S>(S::M::from_bits(part_of<Spu>(same, first)), before * more, before));
    });
  });
}

} // namespace detail

/// Returns the rays of a walk with a hit.
template <class Spu>
[[gnu::noinline]] uint32_t hits_of_walk(Spu& spu, const ShadowWalk<typename Spu::simd>& walk) {
  spu.run_in_module(modules::kShadowWalk);
  return hit_lanes<typename Spu::simd>(walk.hits, walk.ray->lanes);
}

/// Takes the rays through the surfaces that they have hit. Rays that reach the light or are occluded leave
/// the walk.
template <class Spu>
[[gnu::noinline]] void step_shadow_walk(SceneAccess<Spu>& scene, ShadowWalk<typename Spu::simd>& walk,
                                        uint64_t& overflows) {
  using S = typename Spu::simd;
  using F = typename S::F;
  using M = typename S::M;
  scene.spu().run_in_module(modules::kShadowWalk);
  const F epsilon(kShadowEpsilon);
  const F distance = F::load(walk.hits.distance.lane), left = F::load(walk.left.lane);
  const uint32_t before_light = hit_lanes<S>(walk.hits, walk.ray->lanes) & (distance < left - epsilon).bits();
  walk.ray->lanes = before_light;
  if (before_light == 0) return;
  uint32_t counts = before_light & (distance > epsilon).bits();
  uint32_t dark = 0;
  for_each_value<S>(walk.hits.object, before_light, [&](uint32_t object, uint32_t same) {
    const uint32_t flags = is_instanced(object) ? object_flag::opaque : scene.object(object)->kind_and_flags;
    if ((flags & object_flag::no_shadow) != 0)
      counts &= ~same;
    else if ((flags & object_flag::opaque) != 0)
      dark |= same;
  });
  dark &= counts;
  counts &= ~dark;
  if (counts != 0) {
    scene.spu().enter_module(modules::kFading);
    fade(scene, *walk.ray, walk.points.interior, walk.hits.distance, counts, *walk.light, true);
    if (walk.has_surface) {
      scene.spu().enter_module(modules::kSurfaces);
      find_surface_lanes(scene, walk.points, walk.hits, counts, walk.surface);
    }
    for_each_value<S>(
        walk.points.material, counts & ~walk.points.blended,
        [&](uint32_t material, uint32_t same) { detail::filter_light(scene, material, false, same, walk); });
    for_each_value<S>(walk.points.material, counts & walk.points.blended, [&](uint32_t blend, uint32_t same) {
      detail::filter_light(scene, blend, true, same, walk);
    });
    detail::add_caustics(scene, counts, walk);
    scene.spu().enter_module(modules::kSecondary);
    cross_surfaces(scene, walk.points.interior, counts, *walk.ray, overflows);
    const V3<S> light = walk.light->template load<S>();
    const F most = S::max(S::abs(light.x), S::max(S::abs(light.y), S::abs(light.z)));
    dark |= counts & (most < F(1e-10f)).bits();
  }
  const F zero(0.0f);
  const V3<S> light = walk.light->template load<S>();
  walk.light->template store<S>(select<S>(M::from_bits(dark), {zero, zero, zero}, light));
  walk.ray->lanes = before_light & ~dark;
  const M walking = M::from_bits(walk.ray->lanes);
  walk.ray->rays.origin.template store<S>(
      select<S>(walking, walk.points.point, walk.ray->rays.origin.template load<S>()));
  walk.ray->rays.start_object = walk.hits.object;
  (left - distance).store(walk.left.lane);
}

} // namespace celltrace::kernel

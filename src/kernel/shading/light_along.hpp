// Effects on light along rays, between their origins and their hits. Kernel dialect.
//
// All media that dim light along a ray or add to it go through light_along(): fogs, and rainbows behind them.
// Interiors do not: as in POV-Ray they dim the light that goes on from the surface at the ray's end, not the
// light that is mirrored there (fading.hpp).
#pragma once

#include "kernel/shading/atmosphere.hpp"

namespace celltrace::kernel {

/// The segments of a part of a packet's rays along which light is followed.
template <class S> struct RaySegments {
  V3<S> origin, direction;
  typename S::F length;
};

/// Light that the rays of a node see: media along the rays add to `light`, and multiply the node's throughput
/// for the hits.
template <class Spu> class PathRadiance {
public:
  using S = typename Spu::rare_simd;

  PathRadiance(const HitPacket& hits, RayNode& node, VectorLanes& seen)
      : ray(node), light(seen), hits_(hits), undimmed_(node.throughput) {}

  RaySegments<S> segments(const FrameBlock& frame, uint32_t first) const {
    const V3<S> direction = ray.rays.direction.template load_from<S>(first);
    const typename S::F before_scene = detail::distance_ahead<S>(frame, ray, first);
    return {ray.rays.origin.template load_from<S>(first) - direction * before_scene, direction,
            detail::length_of<S>(hits_, first) + before_scene};
  }
  void pass(const FrameBlock& frame, uint32_t first, const typename S::M& take, const Passage<S>& passage) {
    const V3<S> throughput = ray.throughput.template load_from<S>(first);
    const V3<S> before = light.template load_from<S>(first);
    // As in POV-Ray, light that one fog adds is not dimmed by another fog.
    light.template store_from<S>(
        first, select<S>(take, before + undimmed_.template load_from<S>(first) * passage.add, before));
    ray.throughput.template store_from<S>(first, select<S>(take, throughput * passage.pass, throughput));
    if ((frame.light_features & light_feature::alpha) != 0)
      detail::dim_transparency<S>(take, grey<S>(passage.pass), ray, first);
  }
  void see_rainbows(SceneAccess<Spu>& scene, const FrameBlock& frame, uint32_t lanes) {
    if (frame.rainbow_count != 0) detail::cross_rainbows(scene, frame, hits_, lanes, ray, light);
  }

  RayNode& ray;
  VectorLanes& light;

private:
  const HitPacket& hits_;
  const VectorLanes undimmed_; ///< the throughput before any fog
};

/// Light that arrives along shadow rays: `arriving` is multiplied by the share that passes between the rays'
/// origins and their hits, or the light, which is `left` away.
template <class Spu> class ShadowRadiance {
public:
  using S = typename Spu::rare_simd;

  ShadowRadiance(const HitPacket& hits, const FloatLanes& left, const RayNode& node, VectorLanes& arriving)
      : ray(node), light(arriving), hits_(hits), left_(left) {}

  RaySegments<S> segments(const FrameBlock&, uint32_t first) const {
    return {ray.rays.origin.template load_from<S>(first), ray.rays.direction.template load_from<S>(first),
            S::min(detail::length_of<S>(hits_, first), S::F::load(left_.lane + first))};
  }
  void pass(const FrameBlock&, uint32_t first, const typename S::M& take, const Passage<S>& passage) {
    const V3<S> before = light.template load_from<S>(first);
    light.template store_from<S>(first, select<S>(take, before * passage.pass, before));
  }
  void see_rainbows(SceneAccess<Spu>&, const FrameBlock&, uint32_t) {} // rainbows send no light to surfaces

  const RayNode& ray;
  VectorLanes& light;

private:
  const HitPacket& hits_;
  const FloatLanes& left_;
};

/// Follows light along rays with a PathRadiance or ShadowRadiance, which is made here, in the code module.
template <template <class> class Light, class Spu, class... Arguments>
[[gnu::noinline]] void light_along(SceneAccess<Spu>& scene, const FrameBlock& frame,
                                   Arguments&... arguments) {
  using S = typename Spu::rare_simd;
  scene.spu().run_in_module(modules::kAtmosphere);
  Light<Spu> light(arguments...);
  const uint32_t lanes = detail::lanes_in_the_open(scene, light.ray, light.ray.lanes);
  for (uint32_t i = 0; i < frame.fog_count; ++i) {
    Kept<Spu, FogRecord> fog = *scene.fog(frame.fog_offset + i * static_cast<uint32_t>(sizeof(FogRecord)));
    for_each_part<Spu>([&](uint32_t first) {
      const uint32_t some = part_of<Spu>(lanes, first);
      if (some == 0) return;
      const RaySegments<S> ray = light.segments(frame, first);
      const Passage<S> fogged = detail::through_fog(scene.spu(), fog, ray.origin, ray.direction, ray.length);
      light.pass(frame, first, S::M::from_bits(some), fogged);
    });
  }
  light.see_rainbows(scene, frame, lanes);
}

} // namespace celltrace::kernel

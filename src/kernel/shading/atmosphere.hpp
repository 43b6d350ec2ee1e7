// What rays pass through on their way from surface to surface: fog. Kernel dialect.
#pragma once

#include "kernel/modules.hpp"
#include "kernel/packet.hpp"
#include "kernel/scene_access.hpp"
#include "kernel/shading/ray_stack.hpp"
#include "kernel/textures/angles.hpp"
#include "kernel/textures/noise.hpp"

namespace celltrace::kernel {

/// Whether a frame's rays go through fog.
constexpr bool has_fog(const FrameBlock& frame) {
  return (frame.light_ways & light_way::fog) != 0;
}

/// What comes through: `add` + `pass` times what is behind.
template <class S> struct Passage { V3<S> pass, add; };

namespace detail {

/// atan(x) of x >= 0, over x.
template <class S> typename S::F arc_share(const typename S::F& x) {
  using F = typename S::F;
  const F far = S::max(x, F(1e-6f));
  return F(6.28318531f) * turns_of<S>(far, F(1.0f)) / far;
}

/// The mean density of ground fog on a way between two heights, in units of where it thins out: 1 below 0 and
/// 1/(1 + y^2) above. With atan(b) - atan(a) = atan((b - a)/(1 + ab)) nothing cancels.
template <class S> typename S::F ground_density(const typename S::F& start, const typename S::F& end) {
  using F = typename S::F;
  const F zero(0.0f), one(1.0f);
  const F low = S::min(start, end), high = S::max(start, end);
  const F a = S::max(low, zero), b = S::max(high, zero);
  const F length = high - low, above = b - a;
  const F slope = one / (one + a * b);
  const F mean_above = slope * arc_share<S>(above * slope);
  // Not one share from the other: on long ways the one that counts is tiny.
  const F below = S::min(high, zero) - S::min(low, zero);
  const F inverse = one / S::max(length, F(1e-6f));
  const auto is_level = length < F(1e-6f);
  const F share_below = S::select(is_level, S::select(low > zero, zero, one), below * inverse);
  const F share_above = S::select(is_level, S::select(low > zero, one, zero), above * inverse);
  return share_below + share_above * mean_above;
}

/// Of rays of `length` through one fog.
template <class Spu>
Passage<typename Spu::rare_simd>
through_fog(Spu& spu, const FogRecord& fog, const V3<typename Spu::rare_simd>& origin,
            const V3<typename Spu::rare_simd>& direction, const typename Spu::rare_simd::F& length) {
  using S = typename Spu::rare_simd;
  using F = typename S::F;
  constexpr float kToBinary = -1.44269504f;
  const F one(1.0f);
  F depth = length * F(fog.inverse_distance);
  F density = one;
  if ((fog.flags & fog_flag::ground) != 0) {
    const V3<S> up = splat3<S>(fog.up);
    const F start = dot<S>(origin, up) - F(fog.offset);
    spu.enter_module(modules::kPatterns);
    density = ground_density<S>(start, start + dot<S>(direction, up) * length);
  }
  if ((fog.flags & fog_flag::turbulent) != 0) {
    // As in POV-Ray, noise is asked halfway, and counts the less the farther the ray goes.
    const V3<S> middle = (origin + direction * (length * F(0.5f))) * splat3<S>(fog.turbulence.amount);
    spu.enter_module(modules::kNoise);
    const F noise =
        noise::turbulence_value<S>(middle, fog.turbulence, (fog.flags & fog_flag::first_generator) != 0);
    const F clear = S::min(noise * F(fog.turbulence_depth), one);
    depth = depth * (one - exp2<S>(depth * F(kToBinary)) * clear);
  }
  const F pass = S::max(exp2<S>(depth * density * F(kToBinary)), F(fog.least));
  return {splat3<S>(fog.tint) * pass, splat3<S>(fog.colour) * (one - pass)};
}

/// Those of `lanes` that are in no object without fog in it.
template <class Spu> uint32_t lanes_in_the_open(SceneAccess<Spu>& scene, const RayNode& ray, uint32_t lanes) {
  uint32_t open = lanes;
  for_each_lane(lanes, [&](uint32_t lane) {
    for (uint32_t d = 0; d < ray.interior_depth.lane[lane]; ++d)
      if (scene.interior(ray.interiors[d].lane[lane])->is_hollow == 0) open &= ~(1u << lane);
  });
  return open;
}

} // namespace detail

/// Takes the rays of a node to what they hit: adds what is on the way to `light`, and leaves the node with
/// the throughput that is left for what is there.
template <class Spu>
[[gnu::noinline]] void cross_atmosphere(SceneAccess<Spu>& scene, const FrameBlock& frame,
                                        const HitPacket& hits, RayNode& ray, VectorLanes& light) {
  using S = typename Spu::rare_simd;
  using F = typename S::F;
  using I = typename S::I;
  /// POV-Ray's distance to where there is nothing.
  constexpr float kNowhere = 1e10f;
  scene.spu().run_in_module(modules::kAtmosphere);
  const uint32_t lanes = detail::lanes_in_the_open(scene, ray, ray.lanes);
  // As in POV-Ray, no fog dims what another one adds.
  const VectorLanes undimmed = ray.throughput;
  for (uint32_t i = 0; i < frame.fog_count; ++i) {
    // A copy: the next read may replace the record.
    const FogRecord fog = *scene.fog(frame.fog_offset + i * static_cast<uint32_t>(sizeof(FogRecord)));
    for_each_part<Spu>([&](uint32_t first) {
      const uint32_t some = part_of<Spu>(lanes, first);
      if (some == 0) return;
      const V3<S> origin = ray.rays.origin.template load_from<S>(first);
      const V3<S> direction = ray.rays.direction.template load_from<S>(first);
      const I object = I::load(reinterpret_cast<const int32_t*>(hits.object.lane + first));
      const auto missed = object == I::splat(static_cast<int32_t>(kNoOffset));
      const F length = S::select(missed, F(kNowhere), F::load(hits.distance.lane + first));
      const Passage<S> fogged = detail::through_fog(scene.spu(), fog, origin, direction, length);
      const auto take = S::M::from_bits(some);
      const V3<S> throughput = ray.throughput.template load_from<S>(first);
      const V3<S> before = light.template load_from<S>(first);
      light.template store_from<S>(
          first, select<S>(take, before + undimmed.template load_from<S>(first) * fogged.add, before));
      ray.throughput.template store_from<S>(first, select<S>(take, throughput * fogged.pass, throughput));
    });
  }
}

} // namespace celltrace::kernel

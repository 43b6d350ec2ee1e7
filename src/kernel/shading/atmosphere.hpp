// Effects on light between surfaces: fog, and rainbows behind it. Kernel dialect.
#pragma once

#include "kernel/angles.hpp"
#include "kernel/cameras/list.hpp"
#include "kernel/modules.hpp"
#include "kernel/packet.hpp"
#include "kernel/scene_access.hpp"
#include "kernel/shading/finishes.hpp"
#include "kernel/shading/hit_points.hpp"
#include "kernel/shading/ray_stack.hpp"
#include "kernel/textures/noise.hpp"
#include "kernel/textures/sky.hpp"
#include "records/light_feature.hpp"

namespace celltrace::kernel {

/// Returns true if a frame has fogs or rainbows, or if the transparency of pixels is wanted.
constexpr bool has_atmosphere(const FrameBlock& frame) {
  return (frame.light_features & (light_feature::atmosphere | light_feature::alpha)) != 0;
}

/// Effect of a medium on light: `pass` times the light from behind, plus `add`.
template <class S> struct Passage { V3<S> pass, add; };

namespace detail {

/// Returns atan(x) / x for x >= 0.
template <class S> typename S::F arc_share(const typename S::F& x) {
  using F = typename S::F;
  const F far = S::max(x, F(1e-6f));
  return F(6.28318531f) * turns_of<S>(far, F(1.0f)) / far;
}

/// Returns the mean density of ground fog along a segment between two heights, in units of the height where
/// it thins out: the density is 1 below 0 and 1/(1 + y^2) above. As atan(b) - atan(a) = atan((b - a)/(1 +
/// ab)), nothing cancels.
template <class S> typename S::F ground_density(const typename S::F& start, const typename S::F& end) {
  using F = typename S::F;
  const F zero(0.0f), one(1.0f);
  const F low = S::min(start, end), high = S::max(start, end);
  const F a = S::max(low, zero), b = S::max(high, zero);
  const F length = high - low, above = b - a;
  const F slope = one / (one + a * b);
  const F mean_above = slope * arc_share<S>(above * slope);
  // Both shares are computed directly: on long segments the share that counts is tiny.
  const F below = S::min(high, zero) - S::min(low, zero);
  const F inverse = one / S::max(length, F(1e-6f));
  const auto is_level = length < F(1e-6f);
  const F share_below = S::select(is_level, S::select(low > zero, zero, one), below * inverse);
  const F share_above = S::select(is_level, S::select(low > zero, one, zero), above * inverse);
  return share_below + share_above * mean_above;
}

/// Returns the effect of one fog on rays of given lengths.
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
    // As in POV-Ray, noise is evaluated at the middle of the ray, and has less effect the farther the ray
    // goes.
    const V3<S> halfway = origin + direction * (length * F(0.5f));
    const V3<S> middle = halfway * splat3<S>(fog.turbulence.amount) + splat3<S>(fog.turbulence_offset);
    spu.enter_module(modules::kNoise);
    const F noise =
        noise::turbulence_value<S>(middle, fog.turbulence, (fog.flags & fog_flag::first_generator) != 0);
    const F thinning = S::min(noise * F(fog.turbulence_depth), one);
    depth = depth * (one - exp2<S>(depth * F(kToBinary)) * thinning);
  }
  const F pass = S::max(exp2<S>(depth * density * F(kToBinary)), F(fog.least));
  return {splat3<S>(fog.tint) * pass, splat3<S>(fog.colour) * (one - pass)};
}

template <class S> struct RainbowColour {
  V3<S> rgb;
  typename S::F filter, transmit;
};

/// Finds the colour of a rainbow's map at `value`, in the same way as other colour maps.
template <class Spu>
void rainbow_colour(SceneAccess<Spu>& scene, const RainbowRecord& bow,
                    const typename Spu::rare_simd::F& value, RainbowColour<typename Spu::rare_simd>& colour) {
  using S = typename Spu::rare_simd;
  using F = typename S::F;
  constexpr auto kBytes = static_cast<uint32_t>(sizeof(MapEntryRecord));
  MapEntryRecord before = *scene.map_entry(bow.entries);
  colour = {splat3<S>(before.rgb), F(before.filter), F(before.transmit)};
  for (uint32_t i = 1; i < bow.entry_count; ++i) {
    Kept<Spu, MapEntryRecord> entry = *scene.map_entry(bow.entries + i * kBytes);
    const auto beyond = value > F(before.position);
    F share(1.0f);
    if (entry.inverse_width != 0.0f)
      share = S::min((value - F(before.position)) * F(entry.inverse_width), share);
    const auto take = [&](F& field, float from, float to) {
      field = S::select(beyond, F(from) + share * F(to - from), field);
    };
    take(colour.rgb.x, before.rgb[0], entry.rgb[0]);
    take(colour.rgb.y, before.rgb[1], entry.rgb[1]);
    take(colour.rgb.z, before.rgb[2], entry.rgb[2]);
    take(colour.filter, before.filter, entry.filter);
    take(colour.transmit, before.transmit, entry.transmit);
    before = entry;
  }
}

/// Finds the effect of a rainbow on rays of a length, and its transparency. `seen` receives the lanes that
/// see the rainbow. The formulas are POV-Ray's.
template <class Spu>
[[gnu::noinline]] void
see_rainbow(SceneAccess<Spu>& scene, const RainbowRecord& bow, uint32_t number,
            const V3<typename Spu::rare_simd>& direction, const typename Spu::rare_simd::F& length,
            Passage<typename Spu::rare_simd>& through, typename Spu::rare_simd::F& transparency,
            typename Spu::rare_simd::M& seen) {
  using S = typename Spu::rare_simd;
  using F = typename S::F;
  constexpr float kToBinary = -1.44269504f;
  const F zero(0.0f), one(1.0f);
  const F x = dot<S>(direction, splat3<S>(bow.right)), y = dot<S>(direction, splat3<S>(bow.up)),
          z = dot<S>(direction, splat3<S>(bow.direction));
  scene.spu().enter_module(modules::kPatterns);
  const F off_axis = turns_of<S>(S::sqrt(x * x + y * y), z);
  const F along = S::abs(turns_of<S>(x, y));
  F across = (off_axis - F(bow.angle)) * F(bow.inverse_width) + F(0.5f);
  if (bow.jitter != 0.0f) {
    scene.spu().enter_module(modules::kFinishes);
    const F random = random_at<S>(direction, number + 1);
    across = across + (random + random - one) * F(bow.jitter);
  }
  seen = (across >= zero) & (across <= one) & (along <= F(bow.arc)) & (z >= zero);
  if (seen.bits() == 0) return;
  RainbowColour<S> colour;
  rainbow_colour(scene, bow, across, colour);
  const F faded = S::min(S::max((along - F(bow.falloff)) * F(bow.inverse_fade), zero), one);
  const F strength = one - faded * faded * (F(3.0f) - (faded + faded));
  const F least = one - strength * (one - colour.transmit);
  const F pass = S::max(exp2<S>(length * F(bow.inverse_distance * kToBinary)), least);
  const F opaque = one - pass;
  const F tinted = colour.filter * opaque;
  const V3<S> white = {one, one, one};
  through.pass = (white + (colour.rgb - white) * tinted) * pass;
  through.add = colour.rgb * opaque;
  transparency = pass * colour.transmit;
}

/// Returns the lanes of `lanes` that are not inside an object without fog.
template <class Spu> uint32_t lanes_in_the_open(SceneAccess<Spu>& scene, const RayNode& ray, uint32_t lanes) {
  uint32_t open = lanes;
  for_each_lane(lanes, [&](uint32_t lane) {
    for (uint32_t d = 0; d < ray.interior_depth.lane[lane]; ++d)
      if (!scene.interior(ray.interiors[d].lane[lane])->is_hollow()) open &= ~(1u << lane);
  });
  return open;
}

} // namespace detail

namespace detail {

/// Returns the lanes of a part without an object.
template <class S> typename S::M are_none(const WordLanes& objects, uint32_t first) {
  using I = typename S::I;
  const I object = I::load(reinterpret_cast<const int32_t*>(objects.lane + first));
  return object == I::splat(static_cast<int32_t>(kNoOffset));
}

/// Returns the distance of rays to their hits. As in POV-Ray, the distance is 1e10 if a ray hits nothing.
template <class S> typename S::F length_of(const HitPacket& hits, uint32_t first) {
  return S::select(are_none<S>(hits.object, first), typename S::F(1e10f),
                   S::F::load(hits.distance.lane + first));
}

/// Returns the distance from the camera to the start of a node's rays, for rays that start just before the
/// scene; 0 for rays that start on a surface.
template <class S> typename S::F distance_ahead(const FrameBlock& frame, const RayNode& ray, uint32_t first) {
  const typename S::F none(0.0f);
  if (frame.camera.ahead == 0.0f) return none;
  const V3<S> direction = ray.rays.direction.template load_from<S>(first);
  return S::select(are_none<S>(ray.rays.start_object, first), start_offset<S>(frame.camera, direction), none);
}

/// Multiplies the transparency along rays in some lanes of a part.
template <class S>
[[gnu::noinline]] void dim_transparency(const typename S::M& lanes, const typename S::F& pass, RayNode& ray,
                                        uint32_t first) {
  const auto transparency = S::F::load(ray.power.lane + first);
  S::select(lanes, transparency * pass, transparency).store(ray.power.lane + first);
}

/// Applies the rainbows, whose light fog dims. If a ray sees several rainbows, the result is their mean.
template <class Spu>
[[gnu::noinline]] void cross_rainbows(SceneAccess<Spu>& scene, const FrameBlock& frame, const HitPacket& hits,
                                      uint32_t lanes, RayNode& ray, VectorLanes& light) {
  using S = typename Spu::rare_simd;
  using F = typename S::F;
  for_each_part<Spu>([&](uint32_t first) {
    const uint32_t some = part_of<Spu>(lanes, first);
    if (some == 0) return;
    const F zero(0.0f), one(1.0f);
    const V3<S> nothing = {zero, zero, zero};
    Passage<S> sum = {nothing, nothing};
    F count = zero, transparency_sum = zero;
    for (uint32_t i = 0; i < frame.rainbow_count; ++i) {
      Kept<Spu, RainbowRecord> bow =
          *scene.rainbow(frame.rainbow_offset + i * static_cast<uint32_t>(sizeof(RainbowRecord)));
      Passage<S> through;
      F transparency = zero;
      auto seen = S::M::none();
      see_rainbow(scene, bow, i, ray.rays.direction.template load_from<S>(first),
                  length_of<S>(hits, first) + distance_ahead<S>(frame, ray, first), through, transparency,
                  seen);
      if (seen.bits() == 0) continue;
      transparency_sum = transparency_sum + S::select(seen, transparency, zero);
      sum.pass = sum.pass + select<S>(seen, through.pass, nothing);
      sum.add = sum.add + select<S>(seen, through.add, nothing);
      count = count + S::select(seen, one, zero);
    }
    const auto take = S::M::from_bits(some) & (count > zero);
    const F share = one / S::max(count, one);
    const V3<S> throughput = ray.throughput.template load_from<S>(first);
    const V3<S> before = light.template load_from<S>(first);
    light.template store_from<S>(first, select<S>(take, before + throughput * (sum.add * share), before));
    ray.throughput.template store_from<S>(first,
                                          select<S>(take, throughput * (sum.pass * share), throughput));
    if ((frame.light_features & light_feature::alpha) != 0)
      dim_transparency<S>(take, transparency_sum * share, ray, first);
  });
}

} // namespace detail

/// Adds to `sum` the transparency of the background, and of the sky in front of it, for rays that
/// hit nothing and did not come by a mirror. To be called after light_along().
template <class Spu>
[[gnu::noinline]] void see_through(SceneAccess<Spu>& scene, const FrameBlock& frame, const HitPacket& hits,
                                   RayNode& ray, FloatLanes& sum) {
  using W = typename Spu::simd;
  using S = typename Spu::rare_simd;
  using F = typename S::F;
  scene.spu().run_in_module(modules::kSky);
  const uint32_t missed = ray.lanes & ~hit_lanes<W>(hits, ray.lanes) & ~ray.reflected;
  if (missed == 0) return;
  const bool is_hidden = (frame.light_features & light_feature::no_backdrop) != 0;
  const bool dims =
      (frame.light_features & (light_feature::no_backdrop | light_feature::mirrored_background)) != 0;
  const bool has_sky = !is_hidden && frame.sky != kNoOffset;
  V3<W> seen[2]; // the sky over black, and over white
  for (uint32_t i = 0; i < 2 && has_sky; ++i) {
    const typename W::F behind(static_cast<float>(i));
    seen[i] = {behind, behind, behind};
    add_sky(scene, frame.sky, ray.rays.direction.template load<W>(), missed, seen[i]);
  }
  for_each_part<Spu>([&](uint32_t first) {
    const auto take = S::M::from_bits(part_of<Spu>(missed, first));
    const F zero(0.0f);
    F share = F::load(ray.power.lane + first);
    if (dims) {
      const V3<S> throughput = ray.throughput.template load_from<S>(first);
      const V3<S> left = throughput * F(1.0f - frame.background_transparency);
      ray.throughput.template store_from<S>(first, select<S>(take & (share > zero), left, throughput));
    }
    share = share * F(frame.background_transparency);
    if (has_sky) share = share * grey<S>(part_of<Spu>(seen[1], first) - part_of<Spu>(seen[0], first));
    (F::load(sum.lane + first) + S::select(take, share, zero)).store(sum.lane + first);
  });
}

} // namespace celltrace::kernel

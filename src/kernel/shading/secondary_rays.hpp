// Secondary rays from a surface: mirror reflection, transmission with refraction, total internal reflection.
// Kernel dialect.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/shading/hit_points.hpp"
#include "kernel/shading/material_lanes.hpp"
#include "kernel/shading/ray_stack.hpp"

namespace celltrace::kernel {

/// The media on both sides of a surface that a ray crosses. `position` is the index of the surface's interior
/// among the interiors that the ray is inside of, or their number if the ray enters the interior.
struct SolidCrossing {
  uint32_t position;
  bool leaves;
  float from, to; ///< indices of refraction; equal if the ray does not bend
};

/// Returns the media at a surface of `interior` for the ray of `lane`. A ray that leaves an interior other
/// than the innermost one does not bend.
template <class Spu>
SolidCrossing solid_crossing(SceneAccess<Spu>& scene, const RayNode& ray, uint32_t lane, uint32_t interior) {
  scene.spu().compute(scalar_work::kCrossing);
  const auto ior_of = [&](uint32_t offset) { return scene.interior(offset)->ior; };
  const uint32_t depth = ray.interior_depth.lane[lane];
  const auto at = [&](uint32_t d) { return ray.interiors[d].lane[lane]; };
  uint32_t position = depth;
  for (uint32_t d = 0; d < depth; ++d)
    if (at(d) == interior) position = d;
  if (position == depth) return {position, false, depth > 0 ? ior_of(at(depth - 1)) : 1.0f, ior_of(interior)};
  if (position + 1 < depth) return {position, true, 1.0f, 1.0f};
  return {position, true, ior_of(interior), depth > 1 ? ior_of(at(depth - 2)) : 1.0f};
}

/// Relative difference of the indices of refraction below which rays go straight on.
constexpr float kLeastBend = 1e-6f;

/// Relative index of refraction (from over to) at each lane's surface. `straight`: lanes whose rays do not
/// bend.
struct Refraction {
  FloatLanes ratio;
  uint32_t straight = 0;
};

/// Crosses the surface into or out of `interior` in each of `lanes`: updates the interiors that `ray` is
/// inside of, and returns its refraction. Counts rays that are inside more interiors than a node holds; these
/// lose the outermost.
template <class Spu>
Refraction cross_surfaces(SceneAccess<Spu>& scene, const WordLanes& interior, uint32_t lanes, RayNode& ray,
                          uint64_t& overflows) {
  Refraction result;
  lanes = Strategy<Spu>::cross_single_interiors(scene, interior, lanes, ray, result);
  for_each_lane(lanes, [&](uint32_t lane) {
    const SolidCrossing change = solid_crossing(scene, ray, lane, interior.lane[lane]);
    const float ratio = change.from / change.to;
    result.ratio.lane[lane] = ratio;
    if (ratio > 1.0f - kLeastBend && ratio < 1.0f + kLeastBend) result.straight |= 1u << lane;

    uint32_t& depth = ray.interior_depth.lane[lane];
    const auto at = [&](uint32_t d) -> uint32_t& { return ray.interiors[d].lane[lane]; };
    const auto remove = [&](uint32_t position) {
      for (uint32_t d = position; d + 1 < depth; ++d)
        at(d) = at(d + 1);
      --depth;
    };
    if (change.leaves) {
      remove(change.position);
      return;
    }
    if (depth == kMaxInteriorDepth) {
      remove(0);
      ++overflows;
    }
    at(depth++) = interior.lane[lane];
  });
  return result;
}

/// Returns the ratio that POV-Ray's Fresnel mirrors use at a surface of `interior`, as measured from its
/// pictures. If a ray enters an object or leaves the only one it is in, this is the ratio of refraction.
/// Otherwise it is the ratio for entering the innermost object from this one: 1, and so no mirror at all, if
/// the ray leaves the innermost object.
template <class Spu>
float fresnel_ratio(SceneAccess<Spu>& scene, const RayNode& ray, uint32_t lane, uint32_t interior) {
  const SolidCrossing change = solid_crossing(scene, ray, lane, interior);
  const uint32_t depth = ray.interior_depth.lane[lane];
  if (!change.leaves || depth == 1) return change.from / change.to;
  const float own = scene.interior(interior)->ior;
  return own / scene.interior(ray.interiors[depth - 1].lane[lane])->ior;
}

template <class Spu>
FloatLanes fresnel_ratios(SceneAccess<Spu>& scene, const WordLanes& interior, uint32_t lanes,
                          const RayNode& ray) {
  FloatLanes ratios;
  for (uint32_t lane = 0; lane < kSimdLanes; ++lane)
    ratios.lane[lane] = 1.0f;
  for_each_lane(lanes, [&](uint32_t lane) {
    ratios.lane[lane] = fresnel_ratio(scene, ray, lane, interior.lane[lane]);
  });
  return ratios;
}

/// Refracts a direction by Snell's law in vector form. `cosine` = -direction.normal. As in POV-Ray, a
/// disturbed normal that points away from the ray counts as if it were reversed. `total` receives the lanes
/// beyond the critical angle.
template <class S>
V3<S> refract(const V3<S>& direction, const V3<S>& normal, const typename S::F& cosine,
              const typename S::F& ratio, typename S::M& total) {
  using F = typename S::F;
  const F square = F(1.0f) + ratio * ratio * (cosine * cosine - F(1.0f));
  total = square < F(0.0f);
  const F root = S::sqrt(S::max(square, F(0.0f)));
  const F along_normal = ratio * cosine - S::select(cosine < F(0.0f), -root, root);
  return normalise<S>(direction * ratio + normal * along_normal);
}

/// Mirrors a direction at a surface whose disturbed normal is `normal`. As in POV-Ray, a normal that points
/// away from the ray is replaced by the smooth one, and a direction below the smooth surface is mirrored
/// there again.
template <class S>
[[gnu::always_inline]] inline V3<S> mirror_inline(const V3<S>& direction, const V3<S>& normal,
                                                  const V3<S>& smooth) {
  using F = typename S::F;
  const F zero(0.0f);
  const F disturbed_cosine = -dot<S>(direction, normal);
  const auto away = disturbed_cosine < zero;
  const F cosine = S::select(away, -dot<S>(direction, smooth), disturbed_cosine);
  const V3<S> mirrored = normalise<S>(direction + select<S>(away, smooth, normal) * (cosine + cosine));
  const F below = S::min(dot<S>(mirrored, smooth), zero);
  return mirrored - smooth * (below + below);
}
template <class S> V3<S> mirror(const V3<S>& direction, const V3<S>& normal, const V3<S>& smooth) {
  return mirror_inline<S>(direction, normal, smooth);
}

/// Returns the Fresnel reflectance of unpolarised light for the relative index `ratio` (from over to) at
/// `cosine` to the normal; 1 beyond the critical angle.
template <class S>
typename S::F fresnel_reflectance(const typename S::F& ratio, const typename S::F& cosine) {
  using F = typename S::F;
  // Let n = to/from; then g^2 = n^2 + c^2 - 1.
  const F n = F(1.0f) / ratio;
  const F square = n * n + cosine * cosine - F(1.0f);
  const F g = S::sqrt(S::max(square, F(0.0f)));
  const F sum = g + cosine;
  const F a = (g - cosine) / S::max(sum, F(1e-20f));
  const F b = (cosine * sum - F(1.0f)) / S::max(cosine * (g - cosine) + F(1.0f), F(1e-20f));
  const F reflectance = F(0.5f) * a * a * (F(1.0f) + b * b);
  return S::select(square > F(0.0f), S::min(reflectance, F(1.0f)), F(1.0f));
}

/// Returns the fraction of each colour that a surface mirrors. `fresnel_ratio` is read in the lanes of
/// `m.fresnel`.
template <class S>
V3<S> reflectivity(const MaterialLanes<S>& m, const typename S::F& cosine,
                   const typename S::F& fresnel_ratio) {
  using F = typename S::F;
  V3<S> result = m.reflection_min;
  const F grazing = S::max(F(1.0f) - cosine, F(0.0f));
  const F share = m.has(material_flag::falloff) ? pow<S>(grazing, m.reflection_falloff) : grazing;
  result = result + (m.reflection_max - m.reflection_min) * share;
  if (m.fresnel != 0) {
    const F f = fresnel_reflectance<S>(fresnel_ratio, cosine);
    const V3<S> curved = m.reflection_max * f + m.reflection_min * (F(1.0f) - f);
    result = select<S>(S::M::from_bits(m.fresnel), curved, result);
  }
  if (m.has(material_flag::metallic_mirror))
    result = result * metallic_tint<S>(m.reflection_metallic, cosine, m.pigment);
  return result;
}

/// Factors of mirrored and of transmitted light at surfaces, with the weights that adaptive depth control
/// gives the mirrored and the transmitted rays.
template <class S> struct SecondaryRays {
  using F = typename S::F;
  V3<S> mirror, through;
  F mirror_weight, through_weight;
  V3<S> reflected_inside;              ///< factor of totally reflected light, in lanes of `transmits`
  F reflection_power;                  ///< exponent of mirrored light, if has_reflection_exponent
  uint32_t mirrors = 0, transmits = 0; ///< lanes with mirrored light, and with transmitted light
  bool has_reflection_exponent = false;

  static SecondaryRays nothing() {
    SecondaryRays o;
    o.reset();
    return o;
  }
  void reset() {
    const F zero(0.0f);
    mirror = through = reflected_inside = {zero, zero, zero};
    mirror_weight = through_weight = zero;
    reflection_power = F(1.0f);
    mirrors = transmits = 0;
    has_reflection_exponent = false;
  }
  /// Sets the values of lanes that have none yet.
  template <class Spu> void set_part(uint32_t first, const SecondaryRays<typename Spu::rare_simd>& part) {
    kernel::set_part<Spu>(mirror, first, part.mirror);
    kernel::set_part<Spu>(through, first, part.through);
    kernel::set_part<Spu>(mirror_weight, first, part.mirror_weight);
    kernel::set_part<Spu>(through_weight, first, part.through_weight);
    kernel::set_part<Spu>(reflection_power, first, part.reflection_power);
    mirrors |= part.mirrors << first;
    transmits |= part.transmits << first;
    has_reflection_exponent = part.has_reflection_exponent;
  }
  bool is_nothing() const { return (mirrors | transmits) == 0; }
  /// Returns true if both have rays of equal weights in the same lanes, and neither a reflection exponent.
  template <class Spu> bool weighs_like(const SecondaryRays& other) const {
    using R = typename Spu::rare_simd;
    uint32_t unlike = (mirrors ^ other.mirrors) | (transmits ^ other.transmits);
    for_each_part<Spu>([&](uint32_t first) {
      const auto differ = [first](const F& a, const F& b) {
        return (R::abs(part_of<Spu>(a, first) - part_of<Spu>(b, first)) > typename R::F(1e-6f)).bits();
      };
      unlike |= differ(mirror_weight, other.mirror_weight) | differ(through_weight, other.through_weight);
    });
    return unlike == 0 && !has_reflection_exponent && !other.has_reflection_exponent;
  }
  /// Adds the light of another material of the same surfaces, with the same directions and weights.
  template <class Spu> void add(const SecondaryRays& other) {
    using R = typename Spu::rare_simd;
    for_each_part<Spu>([&](uint32_t first) {
      const auto sum = [first](V3<S>& to, const V3<S>& more) {
        kernel::set_part<Spu>(to, first, part_of<Spu>(to, first) + part_of<Spu>(more, first));
      };
      const auto greatest = [first](F& to, const F& more) {
        kernel::set_part<Spu>(to, first, R::max(part_of<Spu>(to, first), part_of<Spu>(more, first)));
      };
      sum(mirror, other.mirror);
      sum(through, other.through);
      sum(reflected_inside, other.reflected_inside);
      greatest(mirror_weight, other.mirror_weight);
      greatest(through_weight, other.through_weight);
    });
    mirrors |= other.mirrors;
    transmits |= other.transmits;
  }
};

namespace detail {

/// Finds the factors except that of total reflection. `onward` must be nothing().
template <class S>
[[gnu::always_inline]] inline void
secondary_rays_of(const MaterialLanes<S>& m, const typename S::F& cosine, const typename S::F& fresnel_ratio,
                  float adc_bailout, uint32_t lanes, const typename S::F& share, SecondaryRays<S>& onward) {
  using F = typename S::F;
  const F zero(0.0f);
  V3<S> mirrored = {zero, zero, zero};
  if (m.has(material_flag::reflects)) {
    mirrored = reflectivity<S>(m, cosine, fresnel_ratio);
    const F strength = max_component<S>(mirrored);
    // POV-Ray weighs a reflection without Fresnel by its greatest possible value.
    const F most = S::max(max_component<S>(m.reflection_min), max_component<S>(m.reflection_max));
    onward.mirrors = (strength > F(0.0f)).bits() & lanes;
    const auto mirrors = S::M::from_bits(onward.mirrors);
    onward.mirror = mirrored * S::select(mirrors, share, zero);
    onward.mirror_weight = S::select(mirrors, S::select(S::M::from_bits(m.fresnel), strength, most), zero);
    onward.has_reflection_exponent = m.has(material_flag::reflection_exponent);
    onward.reflection_power = m.inverse_reflection_exponent;
  }
  if (!m.has(material_flag::transmits)) return;

  const V3<S> one = {F(1.0f), F(1.0f), F(1.0f)};
  V3<S> filter = m.pigment * m.filter + V3<S>{m.transmit, m.transmit, m.transmit};
  filter = select<S>(S::M::from_bits(m.conserve_energy), filter * (one - mirrored), filter);
  onward.transmits = (grey<S>(filter) > F(adc_bailout)).bits() & lanes;
  const auto transmitted = S::M::from_bits(onward.transmits);
  const F counted = S::select(transmitted, share, zero);
  onward.through = filter * counted;
  onward.through_weight = S::select(transmitted, max_component<S>(filter), zero);
}

} // namespace detail

/// Finds the factors, except that of total reflection, for surfaces of the materials `m` in `lanes`, times
/// `share`. `all` must be nothing().
template <class Spu>
CELLTRACE_ONE_COPY void
find_secondary_rays(const MaterialLanes<typename Spu::simd>& m, const typename Spu::simd::F& cosine,
                    const typename Spu::simd::F& fresnel_ratio, float adc_bailout, uint32_t lanes,
                    const typename Spu::simd::F& share, SecondaryRays<typename Spu::simd>& all) {
  Strategy<Spu>::template find_secondary_rays<Spu>(m, cosine, fresnel_ratio, adc_bailout, lanes, share, all);
}

} // namespace celltrace::kernel

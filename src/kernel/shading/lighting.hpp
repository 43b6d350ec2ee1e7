// Shade pixel: the light that a surface sends toward the viewer by itself. The terms are those of Hall's
// model that POV-Ray uses: ambient, diffuse with brilliance, Phong and Blinn highlights. Kernel dialect.
#pragma once

#include "kernel/shading/hit_points.hpp"
#include "kernel/shading/material_lanes.hpp"

namespace celltrace::kernel {

/// A surface as seen by sixteen rays.
template <class S> struct Surfaces {
  V3<S> point, normal;      ///< normal flipped toward the viewer
  V3<S> direction;          ///< of the rays that arrive
  const WordLanes* objects; ///< what the points lie on
};

/// Where a light is, as seen from surfaces.
template <class S> struct Bearing {
  V3<S> direction; ///< of unit length
  typename S::F distance;
  typename S::F cosine; ///< to the normal
  uint32_t facing;      ///< lanes from which it can be seen if nothing is in the way

  [[gnu::noinline]] Bearing(const LightRecord& light, const Surfaces<S>& s, uint32_t lanes) {
    using F = typename S::F;
    const V3<S> to_light = splat3<S>(light.location) - s.point;
    distance = S::sqrt(dot<S>(to_light, to_light));
    direction = to_light * (F(1.0f) / S::max(distance, F(1e-30f)));
    cosine = dot<S>(direction, s.normal);
    facing = (cosine >= F(1e-10f)).bits() & lanes;
  }
};

/// The rays from surfaces toward a light, and how far each goes.
template <class S>
void make_shadow_rays(const Surfaces<S>& s, const Bearing<S>& to_light, RayPacket& rays,
                      FloatLanes& distance) {
  rays.origin.template store<S>(s.point);
  rays.direction.template store<S>(to_light.direction);
  rays.start_object = *s.objects;
  to_light.distance.store(distance.lane);
}

namespace detail {

/// A light as it arrives at a surface.
template <class S> struct Arrival : Bearing<S> {
  V3<S> colour; ///< after what lies between

  Arrival(const LightRecord& light, const Surfaces<S>& s, uint32_t lanes)
      : Bearing<S>(light, s, lanes), colour(splat3<S>(light.colour)) {}
};

template <class S>
typename S::F phong_term(const Surfaces<S>& s, const MaterialLanes<S>& m, const Arrival<S>& light) {
  using F = typename S::F;
  const V3<S> mirrored = s.direction - s.normal * (F(2.0f) * dot<S>(s.direction, s.normal));
  const F cosine = dot<S>(mirrored, light.direction);
  // POV-Ray cuts wide angles off where the exponent makes them invisible.
  const auto seen = (cosine > F(0.0f)) & ((m.phong_size < F(60.0f)) | (cosine > F(0.0008f)));
  return S::select(seen, m.phong * pow<S>(S::max(cosine, F(0.0f)), m.phong_size), F(0.0f));
}

template <class S>
typename S::F specular_term(const Surfaces<S>& s, const MaterialLanes<S>& m, const Arrival<S>& light) {
  using F = typename S::F;
  const V3<S> half = normalise<S>(light.direction - s.direction);
  const F cosine = dot<S>(half, s.normal);
  return S::select(cosine > F(0.0f), m.specular * pow<S>(S::max(cosine, F(0.0f)), m.inverse_roughness),
                   F(0.0f));
}

template <class S>
V3<S> reflected_light(const Surfaces<S>& s, const MaterialLanes<S>& m, const Arrival<S>& light,
                      bool highlights) {
  using F = typename S::F;
  const F bent = m.bends_diffuse ? pow<S>(light.cosine, m.brilliance) : light.cosine;
  V3<S> sum = m.pigment * light.colour * (m.diffuse * m.opacity * bent);
  if (!highlights || !(m.has_phong || m.has_specular)) return sum;
  F strength(0.0f);
  if (m.has_phong) strength = strength + phong_term<S>(s, m, light);
  if (m.has_specular) strength = strength + specular_term<S>(s, m, light);
  V3<S> highlight = light.colour * strength;
  if (m.has_metallic) highlight = highlight * metallic_tint<S>(m.metallic, light.cosine, m.pigment);
  return sum + highlight;
}

} // namespace detail

/// Number `i` of the frame's lights.
template <class Spu> LightRecord light_at(SceneAccess<Spu>& scene, const FrameBlock& frame, uint32_t i) {
  return *scene.light(frame.light_offset + i * static_cast<uint32_t>(sizeof(LightRecord)));
}

/// Ambient light, and what all lights contribute, at the surfaces of `lanes`. Counts a shadow ray per light
/// and lane that faces it. `intersector.transmittance(surfaces, bearing, number, colour)` multiplies the light of that
/// number by what comes through.
template <class Spu, class Intersector>
V3<typename Spu::simd> local_light(SceneAccess<Spu>& scene, Intersector& intersector, const FrameBlock& frame,
                                   const Surfaces<typename Spu::simd>& s,
                                   const MaterialLanes<typename Spu::simd>& m, uint32_t lanes,
                                   uint64_t& shadow_rays) {
  using S = typename Spu::simd;
  using F = typename S::F;
  V3<S> sum = m.pigment * m.ambient * m.opacity;
  for (uint32_t i = 0; i < frame.light_count; ++i) {
    const LightRecord light = light_at(scene, frame, i);
    detail::Arrival<S> arrival(light, s, lanes);
    const uint32_t facing = arrival.facing;
    if (facing == 0) continue;
    scene.spu().compute(scalar_work::kLight);
    arrival.cosine = S::max(arrival.cosine, F(0.0f));

    const bool shadowless = (light.flags & light_flag::shadowless) != 0;
    if (!shadowless) {
      VectorLanes colour;
      colour.template store<S>(arrival.colour);
      intersector.transmittance(s, arrival, i, colour);
      arrival.colour = colour.template load<S>();
      shadow_rays += static_cast<uint32_t>(__builtin_popcount(facing));
    }
    const V3<S> dark = {F(0.0f), F(0.0f), F(0.0f)};
    sum = sum +
          select<S>(S::M::from_bits(facing), detail::reflected_light<S>(s, m, arrival, !shadowless), dark);
  }
  return sum;
}

} // namespace celltrace::kernel

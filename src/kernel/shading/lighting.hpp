// Shade pixel: the light that a surface sends toward the viewer by itself. The terms are those of Hall's
// model that POV-Ray uses: ambient, diffuse with brilliance, Phong and Blinn highlights. Kernel dialect.
#pragma once

#include "kernel/lights/illumination.hpp"
#include "kernel/shading/hit_points.hpp"
#include "kernel/shading/material_lanes.hpp"

namespace celltrace::kernel {

namespace detail {

template <class S>
typename S::F phong_term(const Surfaces<S>& s, const MaterialLanes<S>& m, const IncidentLight<S>& light) {
  using F = typename S::F;
  const V3<S> mirrored = s.direction - s.normal * (F(2.0f) * dot<S>(s.direction, s.normal));
  const F cosine = dot<S>(mirrored, light.direction);
  // POV-Ray cuts wide angles off where the exponent makes them invisible.
  const auto seen = (cosine > F(0.0f)) & ((m.phong_size < F(60.0f)) | (cosine > F(0.0008f)));
  return S::select(seen, m.phong * pow<S>(S::max(cosine, F(0.0f)), m.phong_size), F(0.0f));
}

template <class S>
typename S::F specular_term(const Surfaces<S>& s, const MaterialLanes<S>& m, const IncidentLight<S>& light) {
  using F = typename S::F;
  const V3<S> half = normalise<S>(light.direction - s.direction);
  const F cosine = dot<S>(half, s.normal);
  return S::select(cosine > F(0.0f), m.specular * pow<S>(S::max(cosine, F(0.0f)), m.inverse_roughness),
                   F(0.0f));
}

template <class S>
V3<S> reflected_light(const Surfaces<S>& s, const MaterialLanes<S>& m, const IncidentLight<S>& light,
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

/// Ambient light, and what all lights contribute, at the surfaces of `lanes`. Counts shadow rays.
/// `intersector.transmittance(light, surfaces, incident, number, colour)` multiplies the light of that number
/// by what comes through, and returns how many rays that took.
template <class Spu, class Intersector>
V3<typename Spu::simd> local_light(SceneAccess<Spu>& scene, Intersector& intersector, const FrameBlock& frame,
                                   const Surfaces<typename Spu::simd>& s,
                                   const MaterialLanes<typename Spu::simd>& m, uint32_t lanes,
                                   uint64_t& shadow_rays) {
  using S = typename Spu::simd;
  using F = typename S::F;
  V3<S> sum = m.pigment * m.ambient * m.opacity;
  for_each_light(scene, frame, kAllLights, [&](uint32_t number, const LightRecord& light) {
    IncidentLight<S> incident(light.colour);
    illuminate(scene.spu(), light, s, lanes, incident);
    const uint32_t facing = incident.facing;
    if (facing == 0) return;
    scene.spu().compute(scalar_work::kLight);
    incident.cosine = S::max(incident.cosine, F(0.0f));

    if (!is_shadowless(light)) {
      VectorLanes colour;
      colour.template store<S>(incident.colour);
      shadow_rays += intersector.transmittance(light, s, incident, number, colour);
      incident.colour = colour.template load<S>();
    }
    const V3<S> dark = {F(0.0f), F(0.0f), F(0.0f)};
    sum = sum + select<S>(S::M::from_bits(facing),
                          detail::reflected_light<S>(s, m, incident, !is_shadowless(light)), dark);
  });
  return sum;
}

} // namespace celltrace::kernel

// The lights of a frame, and the light that surfaces receive from each. Kernel dialect.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/lights/attenuation.hpp"
#include "kernel/lights/list.hpp"
#include "kernel/lights/parallel.hpp"
#include "kernel/modules.hpp"
#include "kernel/scene_access.hpp"

namespace celltrace::kernel {

/// Calls `visit(number, light)` for lights [first, first + count) of the frame.
template <class Spu, class Visit>
void for_each_light(SceneAccess<Spu>& scene, const FrameBlock& frame, uint32_t first, uint32_t count,
                    const Visit& visit) {
  for (uint32_t i = first; i < first + count; ++i) {
    Kept<Spu, LightRecord> light =
        *scene.light(frame.light_offset + i * static_cast<uint32_t>(sizeof(LightRecord)));
    visit(i, light);
  }
}

namespace module_lights {

/// Returns the lanes of `lanes` with objects on which a selective light shines. As in POV-Ray, all objects
/// cast shadows in that light.
template <class Spu>
uint32_t lanes_of_its_objects(SceneAccess<Spu>& scene, const LightRecord& light, const WordLanes& objects,
                              uint32_t lanes) {
  uint32_t lit = 0;
  for_each_value<typename Spu::simd>(objects, lanes, [&](uint32_t object, uint32_t same) {
    // Instances are lit by all global lights.
    const uint32_t set =
        is_instanced(object) ? 0 : scene.object(object)->kind_and_flags >> object_flag::light_set_shift;
    const uint32_t word = scene.list_word(light.lit_sets + set / 32 * 4);
    if ((word >> set % 32 & 1) != 0) lit |= same;
  });
  return lit;
}

/// Attenuates the light that has been aimed by its beam and its distance.
template <class Spu>
CELLTRACE_ONE_COPY void attenuate(SceneAccess<Spu>& scene, const LightRecord& light,
                                  const Surfaces<typename Spu::simd>& s,
                                  IncidentLight<typename Spu::simd>& incident) {
  using S = typename Spu::simd;
  using F = typename S::F;
  scene.spu().run_in_module(modules::kLights);
  F share(1.0f);
  Lights::dispatch(light.kind_and_flags & light_flag::kind_mask, [&](auto kind) {
    using Kind = decltype(kind);
    if constexpr (Kind::kIsBeam) share = beam_share<S>(light, Kind::template off_axis<S>(light, s, incident));
  });
  if ((light.kind_and_flags & light_flag::fades) != 0)
    share = share * fade_share<Spu>(light, incident.distance);
  incident.distance = S::max(incident.distance, F(0.0f));
  incident.colour = incident.colour * share;
  incident.facing &= (S::abs(share) > F(kLeastShare)).bits();
}

/// Turns the light of a point light at the same place into the light of a source that is not plain.
template <class Spu>
CELLTRACE_ONE_COPY void shape(SceneAccess<Spu>& scene, const LightRecord& light,
                              const Surfaces<typename Spu::simd>& s, uint32_t lanes,
                              IncidentLight<typename Spu::simd>& incident) {
  scene.spu().run_in_module(modules::kLights);
  if ((light.kind_and_flags & light_flag::selective) != 0) {
    lanes = lanes_of_its_objects(scene, light, *s.objects, lanes);
    incident.facing &= lanes;
  }
  if (is_parallel(light)) make_parallel(light, s, lanes, incident);
  attenuate(scene, light, s, incident);
}

template <class Spu>
CELLTRACE_ONE_COPY void aim_parallel(Spu& spu, const LightRecord& light, const V3<typename Spu::simd>& points,
                                     IncidentLight<typename Spu::simd>& incident) {
  using S = typename Spu::simd;
  spu.run_in_module(modules::kLights);
  kernel::aim_parallel<S>(light, points, incident);
  incident.distance = S::max(incident.distance, typename S::F(0.0f));
}

} // namespace module_lights

/// Completes `incident`, which has only the light's colour, with the light that the surfaces of `lanes`
/// receive. The light is not returned, as an SPU would copy it.
template <class Spu>
void illuminate(SceneAccess<Spu>& scene, const LightRecord& light, const Surfaces<typename Spu::simd>& s,
                uint32_t lanes, IncidentLight<typename Spu::simd>& incident) {
  PointLight::illuminate<Spu>(light, s, lanes, incident);
  if (is_plain(light) || (incident.facing == 0 && !is_parallel(light))) return;
  scene.spu().enter_module(modules::kLights);
  module_lights::shape(scene, light, s, lanes, incident);
}

/// Sets only the direction to a light and the length of shadow rays.
template <class Spu>
void aim(Spu& spu, const LightRecord& light, const V3<typename Spu::simd>& points,
         IncidentLight<typename Spu::simd>& incident) {
  PointLight::aim<Spu>(light, points, incident);
  if (!is_parallel(light)) return;
  spu.enter_module(modules::kLights);
  module_lights::aim_parallel(spu, light, points, incident);
}

} // namespace celltrace::kernel

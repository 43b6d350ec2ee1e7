// All kinds of light sources. The order gives each its number in records. Kernel dialect.
//
// A kind L has
//   kName
//   kIsBeam       whether it has an edge and a tightness
//   kIsParallel   whether all its rays go along its axis even if it is not said to be parallel
// and if it is a beam
//   way_off(light, surfaces, incident)
#pragma once

#include "kernel/lights/cylinder.hpp"
#include "kernel/lights/point.hpp"
#include "kernel/lights/spotlight.hpp"
#include "kernel/type_list.hpp"
#include "records/frame.hpp"
#include "records/light_way.hpp"

namespace celltrace::kernel {

using Lights = TypeList<PointLight, SpotLight, CylinderLight>;
template <class L> constexpr uint32_t kLightKind = Lights::number<L>();

/// Whether a light sends the same to all sides, however far.
constexpr bool is_plain(const LightRecord& light) {
  static_assert(kLightKind<PointLight> == 0);
  constexpr uint32_t of_shadows = light_flag::shadowless | light_flag::area | light_flag::circular |
                                  light_flag::orient | light_flag::jitter | light_flag::projected |
                                  light_flag::dimmed;
  return (light.kind_and_flags & ~of_shadows) == 0;
}
constexpr bool is_shadowless(const LightRecord& light) {
  return (light.kind_and_flags & light_flag::shadowless) != 0;
}
constexpr bool is_projected(const LightRecord& light) {
  return (light.kind_and_flags & light_flag::projected) != 0;
}
/// Whether fogs take some of it on its way.
constexpr bool is_dimmed(const LightRecord& light) {
  return (light.kind_and_flags & light_flag::dimmed) != 0;
}
/// Whether it has to be found out what of the light comes to surfaces.
constexpr bool is_asked_for(const LightRecord& light) {
  return (light.kind_and_flags & (light_flag::shadowless | light_flag::projected)) != light_flag::shadowless;
}
constexpr bool has_area(const LightRecord& light) {
  return (light.kind_and_flags & light_flag::area) != 0;
}
/// Whether some light of a frame has an area. Its sampling takes the local store of resident ray nodes.
constexpr bool has_areas(const FrameBlock& frame) {
  return frame.light_places != frame.light_count;
}

/// Whether shadow rays that cross something translucent are walked (ShadowWalk): all of them.
constexpr bool walks_translucent(const FrameBlock& frame) {
  return (frame.light_ways & light_way::stepwise) != 0;
}
/// Of these, whether it is enough to know all that a ray crosses.
constexpr bool walks_for_fading(const FrameBlock& frame) {
  return (frame.light_ways & light_way::only_fading) != 0;
}
/// As walks_translucent(), whether any of them are.
constexpr bool walks_shadows(const FrameBlock& frame) {
  return (frame.light_ways & (light_way::stepwise | light_way::near_surfaces)) != 0;
}
/// Of these, whether it takes a search from each surface on.
constexpr bool restarts_shadows(const FrameBlock& frame) {
  return (frame.light_ways & light_way::restarts) != 0;
}
constexpr bool is_parallel(const LightRecord& light) {
  return (light.kind_and_flags & light_flag::parallel) != 0;
}

} // namespace celltrace::kernel

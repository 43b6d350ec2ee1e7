// All kinds of light sources. The order determines their numbers in records. Kernel dialect.
//
// A kind L has
//   kName
//   kIsBeam       true if the light has an edge and a tightness
//   kIsParallel   true if all rays are parallel to the axis even without light_flag::parallel
// and if it is a beam
//   off_axis(light, surfaces, incident)   returns the offset of surfaces from the axis (LightRecord)
#pragma once

#include "kernel/lights/cylinder.hpp"
#include "kernel/lights/point.hpp"
#include "kernel/lights/spotlight.hpp"
#include "kernel/type_list.hpp"
#include "records/frame.hpp"
#include "records/light_feature.hpp"

namespace celltrace::kernel {

using Lights = TypeList<PointLight, SpotLight, CylinderLight>;
template <class L> constexpr uint32_t kLightKind = Lights::number<L>();

/// Returns true if a light sends the same to all sides and to any distance.
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
/// Returns true if fogs dim the light on its way.
constexpr bool is_dimmed(const LightRecord& light) {
  return (light.kind_and_flags & light_flag::dimmed) != 0;
}
/// Returns true if shadow rays have to determine how much of the light reaches surfaces.
constexpr bool needs_shadow_rays(const LightRecord& light) {
  return (light.kind_and_flags & (light_flag::shadowless | light_flag::projected)) != light_flag::shadowless;
}
constexpr bool has_area(const LightRecord& light) {
  return (light.kind_and_flags & light_flag::area) != 0;
}
/// Returns true if a light of the frame has an area. Its sampling takes the local store of resident ray
/// nodes.
constexpr bool has_areas(const FrameBlock& frame) {
  return frame.light_places != frame.light_count;
}

/// Returns true if all shadow rays that cross a translucent surface are walked (ShadowWalk).
constexpr bool walks_translucent(const FrameBlock& frame) {
  return (frame.light_features & light_feature::stepwise) != 0;
}
/// Returns true if walks only need to know all surfaces that a ray crosses.
constexpr bool walks_for_fading(const FrameBlock& frame) {
  return (frame.light_features & light_feature::only_fading) != 0;
}
/// Returns true if any shadow rays are walked.
constexpr bool walks_shadows(const FrameBlock& frame) {
  return (frame.light_features & (light_feature::stepwise | light_feature::near_surfaces)) != 0;
}
/// Returns true if some walks need a new search from each surface on.
constexpr bool restarts_shadows(const FrameBlock& frame) {
  return (frame.light_features & light_feature::restarts) != 0;
}
constexpr bool is_parallel(const LightRecord& light) {
  return (light.kind_and_flags & light_flag::parallel) != 0;
}

} // namespace celltrace::kernel

// Parallel light, whose rays go along the axis of the source. Kernel dialect.
#pragma once

#include "kernel/lights/incident_light.hpp"
#include "records/light.hpp"

namespace celltrace::kernel {

/// Sets the direction and the distance of light. Shadow rays go as far as the plane through the light's
/// location. Surfaces behind that plane are lit, too; their distance is negative.
template <class S>
void aim_parallel(const LightRecord& light, const V3<S>& points, IncidentLight<S>& incident) {
  const V3<S> to_light = {-typename S::F(light.axis[0]), -typename S::F(light.axis[1]),
                          -typename S::F(light.axis[2])};
  incident.distance = dot<S>(splat3<S>(light.location) - points, to_light);
  incident.direction = to_light;
}
/// Changes the light of a point light to parallel light, except for the colour.
template <class S>
void make_parallel(const LightRecord& light, const Surfaces<S>& s, uint32_t lanes,
                   IncidentLight<S>& incident) {
  aim_parallel(light, s.point, incident);
  incident.face(s, lanes);
}

} // namespace celltrace::kernel

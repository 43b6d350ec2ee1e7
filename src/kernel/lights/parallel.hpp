// Light whose rays all go along the axis of its source. Kernel dialect.
#pragma once

#include "kernel/lights/incident_light.hpp"
#include "records/light.hpp"

namespace celltrace::kernel {

/// Sets where light comes from and how far. Shadow rays go as far as the plane through the light's location.
/// Surfaces behind that are lit, too; to them the distance is negative.
template <class S>
void aim_parallel(const LightRecord& light, const V3<S>& points, IncidentLight<S>& incident) {
  const V3<S> to_light = {-typename S::F(light.axis[0]), -typename S::F(light.axis[1]),
                          -typename S::F(light.axis[2])};
  incident.distance = dot<S>(splat3<S>(light.location) - points, to_light);
  incident.direction = to_light;
}
/// Turns light that comes from a point, without the colour.
template <class S>
void make_parallel(const LightRecord& light, const Surfaces<S>& s, uint32_t lanes,
                   IncidentLight<S>& incident) {
  aim_parallel(light, s.point, incident);
  incident.face(s, lanes);
}

} // namespace celltrace::kernel

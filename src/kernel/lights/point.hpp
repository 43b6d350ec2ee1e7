// Light from a point to all sides. Kernel dialect.
#pragma once

#include "kernel/lights/incident_light.hpp"

namespace celltrace::kernel {

struct PointLight {
  static constexpr const char* kName = "point";
  static constexpr bool kIsBeam = false;
  static constexpr bool kIsParallel = false;

  /// All of `incident` but the colour. Not inlined: every light begins with it, in few places of the code.
  template <class S>
  [[gnu::noinline]] static void illuminate(const LightRecord& light, const Surfaces<S>& s, uint32_t lanes,
                                           IncidentLight<S>& incident) {
    incident.set_ray(splat3<S>(light.location) - s.point);
    incident.face(s, lanes);
  }
};

} // namespace celltrace::kernel

// The point light, which shines in all directions. Kernel dialect.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/lights/incident_light.hpp"
#include "records/light.hpp"

namespace celltrace::kernel {

struct PointLight {
  static constexpr const char* kName = "point";
  static constexpr bool kIsBeam = false;
  static constexpr bool kIsParallel = false;

  /// Sets the direction and the distance of the light.
  template <class Spu>
  CELLTRACE_ONE_COPY static void aim(const LightRecord& light, const V3<typename Spu::simd>& points,
                                     IncidentLight<typename Spu::simd>& incident) {
    incident.set_ray(splat3<typename Spu::simd>(light.location) - points);
  }
  /// Sets all of `incident` except the colour. Not inlined: every light begins with it, in few places of the
  /// code.
  template <class Spu>
  CELLTRACE_ONE_COPY static void illuminate(const LightRecord& light, const Surfaces<typename Spu::simd>& s,
                                            uint32_t lanes, IncidentLight<typename Spu::simd>& incident) {
    aim<Spu>(light, s.point, incident);
    incident.face(s, lanes);
  }
};

} // namespace celltrace::kernel

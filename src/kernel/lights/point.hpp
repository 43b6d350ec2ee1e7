// Light from a point to all sides. Kernel dialect.
#pragma once

#include "kernel/lights/incident_light.hpp"

namespace celltrace::kernel {

struct PointLight {
  static constexpr const char* kName = "point";
  static constexpr bool kIsBeam = false;
  static constexpr bool kIsParallel = false;

  /// Where the light comes from.
  template <class Spu>
  static void aim(const LightRecord& light, const V3<typename Spu::simd>& points,
                  IncidentLight<typename Spu::simd>& incident) {
    if constexpr (kHasRoomForCode<Spu>)
      incident.set_ray(splat3<typename Spu::simd>(light.location) - points);
    else
      aim_out_of_line<typename Spu::simd>(light, points, incident);
  }
  /// All of `incident` but the colour. Not inlined: every light begins with it, in few places of the code.
  template <class Spu>
  [[gnu::noinline]] static void illuminate(const LightRecord& light, const Surfaces<typename Spu::simd>& s,
                                           uint32_t lanes, IncidentLight<typename Spu::simd>& incident) {
    aim<Spu>(light, s.point, incident);
    incident.face(s, lanes);
  }

private:
  /// Not inlined on an SPE: one copy saves local store.
  template <class S>
  [[gnu::noinline]] static void aim_out_of_line(const LightRecord& light, const V3<S>& points,
                                                IncidentLight<S>& incident) {
    incident.set_ray(splat3<S>(light.location) - points);
  }
};

} // namespace celltrace::kernel

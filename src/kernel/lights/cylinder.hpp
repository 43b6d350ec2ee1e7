// The cylinder light: parallel light in a cylinder that begins at the light's location. Kernel dialect.
#pragma once

#include "kernel/lights/incident_light.hpp"
#include "records/light.hpp"

namespace celltrace::kernel {

struct CylinderLight {
  static constexpr const char* kName = "cylinder";
  static constexpr bool kIsBeam = true;
  static constexpr bool kIsParallel = true;

  /// Returns the distance of surfaces from the axis, in units of the radius at which the light ends. Surfaces
  /// behind the location get 1, as no light goes there.
  template <class S>
  static typename S::F off_axis(const LightRecord& light, const Surfaces<S>& s, const IncidentLight<S>&) {
    using F = typename S::F;
    const V3<S> axis = splat3<S>(light.axis);
    const V3<S> from_light = s.point - splat3<S>(light.location);
    const F depth = dot<S>(from_light, axis);
    const V3<S> across = from_light - axis * depth;
    const F distance = S::sqrt(dot<S>(across, across));
    return S::select(depth > F(0.0f), distance * F(light.inverse_width), F(1.0f));
  }
};

} // namespace celltrace::kernel

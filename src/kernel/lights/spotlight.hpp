// The spotlight: light from a point in a cone. Kernel dialect.
#pragma once

#include "kernel/lights/incident_light.hpp"
#include "records/light.hpp"

namespace celltrace::kernel {

struct SpotLight {
  static constexpr const char* kName = "spotlight";
  static constexpr bool kIsBeam = true;
  static constexpr bool kIsParallel = false;

  /// Returns the offset of surfaces from the axis: 1 minus the cosine of the angle at the light. The offset
  /// is computed from the vector between the two directions, as the cosine of a small angle has few digits.
  template <class S>
  static typename S::F off_axis(const LightRecord& light, const Surfaces<S>&,
                                const IncidentLight<S>& incident) {
    const V3<S> between = splat3<S>(light.axis) + incident.direction;
    return dot<S>(between, between) * typename S::F(0.5f);
  }
};

} // namespace celltrace::kernel

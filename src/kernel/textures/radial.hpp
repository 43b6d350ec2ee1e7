// The radial pattern: a ramp around the y axis that begins at -z. Kernel dialect.
#pragma once

#include "kernel/angles.hpp"
#include "kernel/textures/pattern_traits.hpp"
#include "records/pattern.hpp"

namespace celltrace::kernel {

struct RadialPattern : BlendPattern {
  static constexpr const char* kName = "radial";

  /// Returns the value; on the axis it is that at +z, as in POV-Ray.
  template <class S> static typename S::F value(const V3<S>& p, const PatternRecord&) {
    using F = typename S::F;
    constexpr float kOnAxis = 0.001f;
    const auto on_axis = (S::abs(p.x) < F(kOnAxis)) & (S::abs(p.z) < F(kOnAxis));
    return S::select(on_axis, F(0.25f), F(0.75f) + turns_of<S>(p.x, p.z));
  }
};

} // namespace celltrace::kernel

// The gradient pattern: a ramp along a direction, repeated every unit. Kernel dialect.
#pragma once

#include "kernel/textures/lattice.hpp"
#include "kernel/textures/pattern_traits.hpp"
#include "records/pattern.hpp"

namespace celltrace::kernel {

/// The parameters are the direction, a unit vector.
struct GradientPattern : BlendPattern {
  static constexpr const char* kName = "gradient";
  static constexpr PatternCode kCode = PatternCode::resident;

  /// Returns the value. As in POV-Ray 1 stays 1, and negative numbers are left to the wave.
  template <class S>
  [[gnu::always_inline]] static typename S::F value(const V3<S>& p, const PatternRecord& r) {
    using F = typename S::F;
    const F along = snap<S>(dot<S>(p, splat3<S>(r.parameter)));
    return S::select(along > F(1.0f), along - S::floor(along), along);
  }
};

} // namespace celltrace::kernel

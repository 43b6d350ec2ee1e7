// The wood pattern: rings around the z axis, which turbulence bends. Kernel dialect.
#pragma once

#include "kernel/textures/noise.hpp"
#include "kernel/textures/pattern_traits.hpp"

namespace celltrace::kernel {

struct WoodPattern : NoisePattern {
  static constexpr const char* kName = "wood";
  static constexpr bool kReadsNoise = false; // false, as it reads vectors of noise only

  template <class S, class Source>
  [[gnu::always_inline]] static typename S::F value(const V3<S>& p, const PatternRecord& r, const Source&) {
    using F = typename S::F;
    const TurbulenceWords& t = r.turbulence;
    F x = p.x, y = p.y;
    if (t.amount[0] != 0.0f || t.amount[1] != 0.0f) {
      const V3<S> noise = noise::turbulence_across_z<S>(p, t.octaves, t.lambda, t.omega);
      const auto bend = [](const F& turns) { return sine_of_turns<S>(turns - S::floor(turns)); };
      x = x + bend((x + noise.x) * F(t.amount[0]));
      y = y + bend((y + noise.y) * F(t.amount[1]));
    }
    return S::sqrt(x * x + y * y);
  }
};

} // namespace celltrace::kernel

// The quilted pattern: pillows, which are cubes with bulging surfaces. Kernel dialect.
#pragma once

#include "kernel/textures/lattice.hpp"
#include "kernel/textures/pattern_traits.hpp"
#include "records/pattern.hpp"

namespace celltrace::kernel {

struct QuiltedPattern : BlendPattern {
  static constexpr const char* kName = "quilted";

  static constexpr bool kDisturbs = true;

  /// Returns the value. The parameters are the two controls of the bulge.
  template <class S> static typename S::F value(const V3<S>& p, const PatternRecord& r) {
    const V3<S> d = from_centre<S>(p);
    return S::abs((S::abs(d.x) + S::abs(d.y) + S::abs(d.z)) * bulge<S>(d, r) * typename S::F(kScale / 3));
  }
  template <class S> static V3<S> disturbance(const V3<S>& p, const PatternRecord& r) {
    const V3<S> d = from_centre<S>(p);
    return d * (bulge<S>(d, r) * typename S::F(kScale));
  }

private:
  static constexpr float kScale = 2 * 0.577350269f;

  template <class S> static V3<S> from_centre(const V3<S>& p) {
    using F = typename S::F;
    const F half(0.5f);
    return {p.x - S::floor(p.x) - half, p.y - S::floor(p.y) - half, p.z - S::floor(p.z) - half};
  }
  template <class S> static typename S::F bulge(const V3<S>& d, const PatternRecord& r) {
    using F = typename S::F;
    const F radius = S::sqrt(dot<S>(d, d)), rest = F(1.0f) - radius;
    return radius *
           (radius * radius + F(3 * r.parameter[0]) * rest * rest + F(3 * r.parameter[1]) * radius * rest);
  }
};

} // namespace celltrace::kernel

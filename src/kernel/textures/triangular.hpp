// The triangular pattern: triangles in the xz plane, of six kinds around a corner. Kernel dialect.
#pragma once

#include "kernel/textures/lattice.hpp"
#include "kernel/textures/pattern_traits.hpp"
#include "records/pattern.hpp"

namespace celltrace::kernel {

struct TriangularPattern : ListPattern {
  static constexpr const char* kName = "triangular";

  template <class S> static typename S::F value(const V3<S>& p, const PatternRecord&) {
    using F = typename S::F;
    constexpr float kInverseRoot = 0.577350269f; // 1 / square root of 3
    const F row = p.z * F(kInverseRoot);
    const F a = S::floor(snap<S>(row + row));
    const F b = -S::floor(snap<S>(row - p.x)) - F(1.0f);
    const F c = S::floor(snap<S>(p.x + row));
    const F third = remainder<S>(b + c, 3.0f), half = remainder<S>(c - b - a, 2.0f);
    // (third, half) stands for: (0, 0) 0, (0, 1) 5, (1, 0) 2, (1, 1) 3, (2, 0) 4, (2, 1) 1.
    const F odd = S::select(third == F(0.0f), F(5.0f), S::select(third == F(1.0f), F(3.0f), F(1.0f)));
    return S::select(half > F(0.5f), odd, third + third);
  }
};

} // namespace celltrace::kernel

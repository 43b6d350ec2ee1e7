// The square pattern: unit squares in the xz plane, of four kinds. Kernel dialect.
#pragma once

#include "kernel/textures/lattice.hpp"
#include "kernel/textures/pattern_traits.hpp"
#include "records/pattern.hpp"

namespace celltrace::kernel {

struct SquarePattern : ListPattern {
  static constexpr const char* kName = "square";

  template <class S> static typename S::F value(const V3<S>& p, const PatternRecord&) {
    using F = typename S::F;
    using I = typename S::I;
    I x, z;
    fraction<S>(snap<S>(p.x), x);
    fraction<S>(snap<S>(p.z), z);
    const F odd_x = S::to_float(x & I::splat(1)), odd_z = S::to_float(z & I::splat(1));
    // The kinds around a corner are 0, 1, 2, 3.
    return odd_z + odd_x * (F(3.0f) - odd_z - odd_z);
  }
};

} // namespace celltrace::kernel

// Unit cubes by turns. Kernel dialect.
#pragma once

#include "kernel/records.hpp"
#include "kernel/textures/lattice.hpp"

namespace celltrace::kernel {

struct CheckerPattern {
  static constexpr const char* kName = "checker";
  static constexpr bool kIsList = true;
  static constexpr bool kNeedsNoise = false;
  static constexpr bool kDisturbs = false;

  template <class S> static typename S::F value(const V3<S>& p, const PatternRecord&) {
    using I = typename S::I;
    I x, y, z;
    fraction<S>(snap<S>(p.x), x);
    fraction<S>(snap<S>(p.y), y);
    fraction<S>(snap<S>(p.z), z);
    return S::to_float((x + y + z) & I::splat(1));
  }
};

} // namespace celltrace::kernel

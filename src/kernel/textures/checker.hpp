// The checker pattern: unit cubes of two kinds, in turn. Kernel dialect.
#pragma once

#include "kernel/textures/lattice.hpp"
#include "kernel/textures/pattern_traits.hpp"
#include "records/pattern.hpp"

namespace celltrace::kernel {

struct CheckerPattern : ListPattern {
  static constexpr const char* kName = "checker";
  static constexpr PatternCode kCode = PatternCode::resident;

  template <class S> [[gnu::always_inline]] static typename S::F value(const V3<S>& p, const PatternRecord&) {
    using I = typename S::I;
    I x, y, z;
    fraction<S>(snap<S>(p.x), x);
    fraction<S>(snap<S>(p.y), y);
    fraction<S>(snap<S>(p.z), z);
    return S::to_float((x + y + z) & I::splat(1));
  }
};

} // namespace celltrace::kernel

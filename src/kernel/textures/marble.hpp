// The marble pattern: veins across x, which turbulence bends. Kernel dialect.
#pragma once

#include "kernel/math.hpp"
#include "kernel/textures/pattern_traits.hpp"
#include "records/pattern.hpp"

namespace celltrace::kernel {

struct MarblePattern : ShiftedPattern {
  static constexpr const char* kName = "marble";

  template <class S> static typename S::F value(const V3<S>& p, const PatternRecord&) { return p.x; }
};

} // namespace celltrace::kernel

// The leopard pattern: spots in all directions. Kernel dialect.
#pragma once

#include "kernel/math.hpp"
#include "kernel/textures/pattern_traits.hpp"
#include "records/pattern.hpp"

namespace celltrace::kernel {

struct LeopardPattern : BlendPattern {
  static constexpr const char* kName = "leopard";

  template <class S> static typename S::F value(const V3<S>& p, const PatternRecord&) {
    using F = typename S::F;
    const auto sine = [](const F& radians) {
      const F turns = radians * F(0.159154943f);
      return sine_of_turns<S>(turns - S::floor(turns));
    };
    const F sum = (sine(p.x) + sine(p.y) + sine(p.z)) * F(1.0f / 3);
    return sum * sum;
  }
};

} // namespace celltrace::kernel

// The brick pattern: courses of bricks, number 1, and the mortar between them, number 0. Kernel dialect.
#pragma once

#include "kernel/textures/lattice.hpp"
#include "kernel/textures/pattern_traits.hpp"
#include "records/pattern.hpp"

namespace celltrace::kernel {

struct BrickPattern : ListPattern {
  static constexpr const char* kName = "brick";

  /// Returns the value. The parameters are the inverse of the size, and the thickness of the mortar.
  template <class S> static typename S::F value(const V3<S>& p, const PatternRecord& r) {
    using F = typename S::F;
    const V3<S> q = p * splat3<S>(r.parameter);
    const F y = snap<S>(q.y), course = S::floor(y);
    const F shift = remainder<S>(course, 2.0f) * F(0.5f); // added to x in odd courses, to z in even ones
    const F x = snap<S>(q.x - shift), z = snap<S>(q.z + shift - F(0.5f));
    // Mortar begins where it does in double precision, to within rounding.
    const auto is_brick = [&](const F& at, const F& from, uint32_t axis) {
      return at - from < F(1.0f - r.parameter[3] * r.parameter[axis]) - lattice_epsilon<S>(at);
    };
    const auto brick = is_brick(x, S::floor(x), 0) & is_brick(y, course, 1) & is_brick(z, S::floor(z), 2);
    return S::select(brick, F(1.0f), F(0.0f));
  }
};

} // namespace celltrace::kernel

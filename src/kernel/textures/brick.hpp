// Courses of bricks, number 1, and the mortar between them, number 0. Kernel dialect.
#pragma once

#include "kernel/textures/lattice.hpp"
#include "kernel/textures/pattern_traits.hpp"

namespace celltrace::kernel {

struct BrickPattern : ListPattern {
  static constexpr const char* kName = "brick";

  /// Its parameters: the inverse of the size, and what of the size by axis is brick.
  template <class S> static typename S::F value(const V3<S>& p, const PatternRecord& r) {
    using F = typename S::F;
    const V3<S> q = p * splat3<S>(r.parameter);
    const F y = snap<S>(q.y), course = whole_below<S>(y);
    const F shift = remainder<S>(course, 2.0f) * F(0.5f); // of x in odd courses, of z in even ones
    const F x = snap<S>(q.x - shift), z = snap<S>(q.z + shift - F(0.5f));
    const auto brick = ((x - whole_below<S>(x)) < F(r.parameter[3])) & ((y - course) < F(r.parameter[4])) &
                       ((z - whole_below<S>(z)) < F(r.parameter[5]));
    return S::select(brick, F(1.0f), F(0.0f));
  }
};

} // namespace celltrace::kernel

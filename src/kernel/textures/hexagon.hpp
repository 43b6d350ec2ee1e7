// The hexagon pattern: hexagons in the xz plane, with sides of length 1, of three kinds. Kernel dialect.
#pragma once

#include "kernel/textures/lattice.hpp"
#include "kernel/textures/pattern_traits.hpp"
#include "records/pattern.hpp"

namespace celltrace::kernel {

struct HexagonPattern : ListPattern {
  static constexpr const char* kName = "hexagon";

  template <class S> static typename S::F value(const V3<S>& p, const PatternRecord&) {
    using F = typename S::F;
    constexpr float kWidth = 1.5f, kHeight = 0.866025404f;
    const F u = p.x * F(1 / kWidth), v = p.z * F(1 / kHeight);
    const F column = S::floor(u), row = S::floor(v);
    // Two of the rectangle's four corners are centres: where column and row have an even sum.
    const F odd = remainder<S>(column + row, 2.0f);
    const auto square = [](const F& x) { return x * x; };
    const F x = (u - column) * F(kWidth), z = (v - row) * F(kHeight);
    const F left = square(x), right = square(F(kWidth) - x);
    const F lower = square(z), upper = square(F(kHeight) - z);
    const auto is_odd = odd > F(0.5f);
    const F to_lower = lower + S::select(is_odd, right, left);
    const F to_upper = upper + S::select(is_odd, left, right);
    const F centre = row + S::select(to_upper < to_lower, F(1.0f), F(0.0f));
    return remainder<S>(-centre, 3.0f);
  }
};

} // namespace celltrace::kernel

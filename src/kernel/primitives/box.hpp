// Box: from -1 to 1 on each axis of its space. Kernel dialect.
#pragma once

#include "kernel/primitives/local_shape.hpp"

namespace celltrace::kernel {

struct BoxPrimitive : LocalPrimitive<BoxPrimitive> {
  static constexpr const char* kName = "box";
  static constexpr uint32_t kCrossingPairs = 1;
  static constexpr bool kHasParameters = false;

  /// The slab test (Kay and Kajiya 1986).
  template <class S>
  static void intersect_local(const LocalRays<S>& rays, const LocalParameters<S>& parameters,
                              Crossings<S>* crossings) {
    using F = typename S::F;
    const F low(-1.0f), high(1.0f);
    const V3<S>&o = rays.origin, &d = rays.direction;
    const SlabInterval<S> x(o.x, d.x, low, high), y(o.y, d.y, low, high), z(o.z, d.z, low, high);
    Crossings<S>& c = *crossings;
    c.clear();
    c.near = S::max(S::max(x.enter, y.enter), z.enter);
    c.far = S::min(S::min(x.leave, y.leave), z.leave);
    c.near_hit = c.far_hit = c.near <= c.far;
    drop_start<BoxPrimitive, S>(rays, parameters, c);
  }

  template <class S> static typename S::M inside_local(const V3<S>& p, const LocalParameters<S>&) {
    using F = typename S::F;
    return S::max(S::max(S::abs(p.x), S::abs(p.y)), S::abs(p.z)) < F(1.0f);
  }

  /// The face is the one whose plane is nearest.
  template <class S> [[gnu::always_inline]] static V3<S> gradient(const V3<S>& p, const LocalParameters<S>&) {
    using F = typename S::F;
    const F x = S::abs(p.x), y = S::abs(p.y), z = S::abs(p.z), zero(0.0f);
    const auto is_x = (x >= y) & (x >= z);
    const auto is_y = (y >= z) & !is_x;
    return {S::select(is_x, p.x, zero), S::select(is_y, p.y, zero), S::select(is_x | is_y, zero, p.z)};
  }

  static LocalBounds local_bounds(float) { return {-1.0f, 1.0f, 1.0f, true}; }
};

} // namespace celltrace::kernel

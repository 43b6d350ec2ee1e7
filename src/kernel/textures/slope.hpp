// The slope pattern: the angle of surfaces to a direction, and their altitude. Kernel dialect.
#pragma once

#include "kernel/textures/pattern_points.hpp"
#include "kernel/textures/pattern_traits.hpp"
#include "records/pattern.hpp"

namespace celltrace::kernel {

/// A pattern that reads normals in the scene, whatever the pattern's space is.
struct SlopePattern : RarePattern {
  static constexpr const char* kName = "slope";
  static constexpr bool kReadsSurface = true;

  template <class Spu>
  [[gnu::always_inline]] static typename Spu::rare_simd::F
  value(SceneAccess<Spu>& scene, const PatternPoints<typename Spu::rare_simd>& points,
        const PatternRecord& r) {
    using S = typename Spu::rare_simd;
    using F = typename S::F;
    Kept<Spu, SlopeRecord> slope = *scene.template pattern_table<SlopeRecord>(r.table);
    const V3<S> normal = points.surface->normal.template load_from<S>(points.first);
    const F cosine = dot<S>(normal, splat3<S>(slope.direction)), one(1.0f);
    // Flat ground is often at exactly 0, 1 or another whole number, where rounding would decide which end of
    // the map it gets: values within rounding of a whole number count as this number.
    const F size = S::abs(cosine), slack = F(2e-6f) + S::abs(F(slope.factor)) * F(5e-6f);
    const F acute = acos_unit<S>(S::select(size < F(1.0f - 3e-7f), size, one)) * F(0.318309886f);
    const F faces = S::select(cosine < F(0.0f), acute, one - acute);
    const F whole = faces * F(slope.factor) + dot<S>(points.at, splat3<S>(slope.altitude)) + F(slope.offset);
    // As in POV-Ray, values beyond 0 and 1 wrap around before frequency and phase are applied; whole numbers
    // become 0, and 1 below 0.
    const F beyond = S::select(whole < F(0.0f), whole - slack, whole + slack);
    const F part = whole - S::to_float(S::to_int(beyond));
    const F above = S::max(S::select(whole > one + slack, part, S::min(whole, one)), F(0.0f));
    return S::select(whole < -slack, S::min(part + one, one), above);
  }
};

} // namespace celltrace::kernel

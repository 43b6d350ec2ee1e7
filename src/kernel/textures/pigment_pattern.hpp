// The pigment_pattern: the brightness of a pigment. Kernel dialect.
#pragma once

#include "kernel/math.hpp"
#include "kernel/textures/pattern_traits.hpp"
#include "records/pattern.hpp"

namespace celltrace::kernel {

/// A pattern whose value MapWalk finds: patterns that evaluate each other would be recursion.
struct PigmentPattern : RarePattern {
  static constexpr const char* kName = "pigment_pattern";

  template <class Spu, class Scene, class Points>
  [[gnu::always_inline]] static typename Spu::rare_simd::F value(Scene&, const Points&,
                                                                 const PatternRecord&) {
    return typename Spu::rare_simd::F(0.0f);
  }
};

/// Return the grey of a colour, with POV-Ray's weights.
inline float grey_of(const float (&rgb)[3]) {
  return 0.297f * rgb[0] + 0.589f * rgb[1] + 0.114f * rgb[2];
}

template <class S> typename S::F grey_of(const V3<S>& rgb) {
  using F = typename S::F;
  return F(0.297f) * rgb.x + F(0.589f) * rgb.y + F(0.114f) * rgb.z;
}

} // namespace celltrace::kernel

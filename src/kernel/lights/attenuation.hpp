// Less light off the axis of a beam and far away. The formulas are POV-Ray's. Kernel dialect.
#pragma once

#include "kernel/math.hpp"
#include "kernel/records.hpp"

namespace celltrace::kernel {

/// The share of the light on the axis that there is `way_off` of it. Its edge is a cubic.
template <class S> typename S::F beam_share(const LightRecord& light, const typename S::F& way_off) {
  using F = typename S::F;
  const F zero(0.0f), one(1.0f);
  const F into_edge = S::min(S::max((way_off - F(light.inner)) * F(light.inverse_edge), zero), one);
  F share = one - into_edge * into_edge * (F(3.0f) - (into_edge + into_edge));
  if (light.tightness != 0.0f) share = share * pow<S>(S::max(one - way_off, zero), F(light.tightness));
  return S::select(way_off < one, share, zero);
}

/// The share of the light at the distance of fading that there is at `distance`.
template <class S> typename S::F fade_share(const LightRecord& light, const typename S::F& distance) {
  using F = typename S::F;
  const F ratio = S::abs(distance) * F(light.inverse_fade_distance);
  return F(2.0f) / (F(1.0f) + pow<S>(ratio, F(light.fade_power)));
}

} // namespace celltrace::kernel

// Attenuation of light away from a beam's axis and with distance. The formulas are POV-Ray's. Kernel dialect.
#pragma once

#include "kernel/math.hpp"
#include "kernel/strategy.hpp"
#include "records/light.hpp"

namespace celltrace::kernel {

/// Share of a light below which the light counts as none.
constexpr float kLeastShare = 1e-10f;

/// Returns the share of a beam's light at the offset `off_axis` from the axis. The edge of the beam is a
/// cubic.
template <class S> typename S::F beam_share(const LightRecord& light, const typename S::F& off_axis) {
  using F = typename S::F;
  const F zero(0.0f), one(1.0f);
  const F into_edge = S::min(S::max((off_axis - F(light.inner)) * F(light.inverse_edge), zero), one);
  F share = one - into_edge * into_edge * (F(3.0f) - (into_edge + into_edge));
  if (light.tightness != 0.0f) share = share * pow<S>(S::max(one - off_axis, zero), F(light.tightness));
  return S::select(off_axis < one, share, zero);
}

/// Returns the light at `distance` relative to the light at the fade distance. The result is negative where
/// an odd power of a negative distance is below -1.
template <class Spu>
typename Spu::simd::F fade_share(const LightRecord& light, const typename Spu::simd::F& distance) {
  using S = typename Spu::simd;
  using F = typename S::F;
  const F ratio = distance * F(light.inverse_fade_distance), one(1.0f);
  const F behind = S::select(ratio < F(0.0f), F(light.fade_behind), one);
  return F(2.0f) / (one + Strategy<Spu>::template raised<S>(S::abs(ratio), light.fade_power) * behind);
}

} // namespace celltrace::kernel

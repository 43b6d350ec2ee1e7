// Colours of surfaces in lanes. Kernel dialect.
#pragma once

#include "kernel/math.hpp"
#include "records/pattern.hpp"

namespace celltrace::kernel {

/// Colours with their transparency.
template <class S> struct PigmentLanes {
  V3<S> rgb;
  typename S::F filter, transmit;

  V3<S> transmittance() const { return rgb * filter + V3<S>{transmit, transmit, transmit}; }
};

template <class S> PigmentLanes<S> pigment_of(const MapEntryRecord& entry) {
  using F = typename S::F;
  return {splat3<S>(entry.rgb), F(entry.filter), F(entry.transmit)};
}
template <class S> PigmentLanes<S> operator*(const PigmentLanes<S>& pigment, const typename S::F& weight) {
  return {pigment.rgb * weight, pigment.filter * weight, pigment.transmit * weight};
}
template <class S> PigmentLanes<S> operator+(const PigmentLanes<S>& a, const PigmentLanes<S>& b) {
  return {a.rgb + b.rgb, a.filter + b.filter, a.transmit + b.transmit};
}
template <class S>
PigmentLanes<S> select(const typename S::M& lanes, const PigmentLanes<S>& a, const PigmentLanes<S>& b) {
  return {select<S>(lanes, a.rgb, b.rgb), S::select(lanes, a.filter, b.filter),
          S::select(lanes, a.transmit, b.transmit)};
}

} // namespace celltrace::kernel

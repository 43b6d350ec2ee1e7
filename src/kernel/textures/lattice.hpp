// Where surfaces lie on lattice planes exactly. Kernel dialect.
#pragma once

#include "kernel/math.hpp"

namespace celltrace::kernel {

/// How far rounding may have taken a coordinate from where it is in double precision.
template <class S> typename S::F lattice_epsilon(const typename S::F& x) {
  using F = typename S::F;
  constexpr float kEpsilon = 1e-5f; // many times the rounding of coordinates about 1
  return F(kEpsilon) + S::abs(x) * F(1e-6f);
}

/// A coordinate that is a whole number but for the rounding of single precision becomes that number. People
/// put floors and walls where patterns have a step: rounding would speckle them with both sides of it.
template <class S> typename S::F snap(const typename S::F& x) {
  using F = typename S::F;
  const F nearest = S::floor(x + F(0.5f));
  return S::select(S::abs(x - nearest) < lattice_epsilon<S>(x), nearest, x);
}

/// What division by `divisor` leaves of a whole number, from 0 up to the divisor.
template <class S> typename S::F remainder(const typename S::F& x, float divisor) {
  using F = typename S::F;
  // Half of a unit more keeps the quotient clear of the rounding of 1 / divisor.
  return x - S::floor((x + F(0.5f)) * F(1.0f / divisor)) * F(divisor);
}

} // namespace celltrace::kernel

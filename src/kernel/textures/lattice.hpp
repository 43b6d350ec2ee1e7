// Lattice planes with which surfaces coincide. Kernel dialect.
#pragma once

#include "kernel/math.hpp"

namespace celltrace::kernel {

/// Returns the largest distance of a rounded coordinate from its value in double precision.
template <class S> typename S::F lattice_epsilon(const typename S::F& x) {
  using F = typename S::F;
  constexpr float kEpsilon = 1e-5f; // many times the rounding of coordinates about 1
  return F(kEpsilon) + S::abs(x) * F(1e-6f);
}

/// Rounds a coordinate to a whole number if it differs only by the rounding of single precision. Floors and
/// walls often lie where patterns have a step: rounding would speckle them with both sides of the step.
template <class S> typename S::F snap(const typename S::F& x) {
  using F = typename S::F;
  const F nearest = S::floor(x + F(0.5f));
  return S::select(S::abs(x - nearest) < lattice_epsilon<S>(x), nearest, x);
}

/// Returns the remainder of a whole number divided by `divisor`, from 0 up to the divisor.
template <class S> typename S::F remainder(const typename S::F& x, float divisor) {
  using F = typename S::F;
  // Half a unit is added to keep the quotient clear of the rounding of 1 / divisor.
  return x - S::floor((x + F(0.5f)) * F(1.0f / divisor)) * F(divisor);
}

} // namespace celltrace::kernel

// Where surfaces lie on lattice planes exactly. Kernel dialect.
#pragma once

#include "kernel/math.hpp"

namespace celltrace::kernel {

/// A coordinate that is a whole number but for the rounding of single precision becomes that number. People
/// put floors and walls where patterns have a step: rounding would speckle them with both sides of it.
template <class S> typename S::F snap(const typename S::F& x) {
  using F = typename S::F;
  constexpr float kEpsilon = 1e-5f; // many times the rounding of coordinates about 1
  const F nearest = whole_below<S>(x + F(0.5f));
  const F off = S::abs(x - nearest);
  return S::select(off < F(kEpsilon) + S::abs(x) * F(1e-6f), nearest, x);
}

} // namespace celltrace::kernel

// Fractals that iterate squares, as most do. Kernel dialect, for direct memory.
#pragma once

#include "kernel/direct/fractal_ahead.hpp"
#include "kernel/scene_access.hpp"

namespace celltrace::kernel {

struct FractalSquares {
  /// Returns values at points, which may have been found before.
  template <class Spu>
  [[gnu::always_inline]] static typename Spu::rare_simd::F
  value_of_squares(SceneAccess<Spu>& scene, const Complex<typename Spu::rare_simd>& at,
                   const SquareIteration& iteration) {
    using S = typename Spu::rare_simd;
    using F = typename S::F;
    using M = typename S::M;
    const Complex<S> c = iteration.constant<S>(at);
    uint32_t rounds = 0;
    if (iteration.wants_least()) return counted_squares<S, true>(at, c, M::none(), iteration, rounds);
    auto* const ahead = scene.pattern_caches().fractals;
    F value(iteration.inner());
    M known = iteration.is_julia() ? M::none() : surely_bounded<S>(c);
    if (ahead != nullptr) known = known | ahead->find(iteration.record, at, value);
    if (known.bits() == (1u << S::kLanes) - 1) return value;
    value = S::select(known, value, counted_squares<S, false>(at, c, known, iteration, rounds));
    if (ahead != nullptr) ahead->count(rounds);
    return value;
  }

  /// Iterates numbers that are squared, except in `known` lanes, whose values are undefined. A number that
  /// comes back after some rounds, as convergent ones do, would do so for ever and is not followed further
  /// (Brent 1980): all later numbers have occurred, so that the least size is known. This is checked after
  /// several rounds at a time only. Not inlined, so that the loop has all registers for itself.
  template <class S, bool kWantsLeast>
  [[gnu::noinline]] static typename S::F counted_squares(const Complex<S>& first, const Complex<S>& c,
                                                         const typename S::M& known,
                                                         const SquareIteration& iteration, uint32_t& rounds) {
    using F = typename S::F;
    using M = typename S::M;
    constexpr uint32_t kRoundsAtATime = 4;
    const uint32_t most = iteration.most();
    IteratedSquares<S, kWantsLeast> squares(first);
    M iterating = !known;
    Complex<S> kept = first;
    uint32_t keeps_next = 4 * kRoundsAtATime;
    uint32_t i = 0;
    for (; most - i >= kRoundsAtATime && iterating.bits() != 0; i += kRoundsAtATime) {
      if (i == keeps_next) {
        kept = squares.z;
        keeps_next *= 2;
      }
      for (uint32_t round = 0; round < kRoundsAtATime; ++round)
        squares.iterate(c);
      iterating = iterating & squares.bounded & !squares.is_at(kept);
    }
    if (iterating.bits() != 0)
      for (; i < most; ++i)
        squares.iterate(c);
    rounds = i;
    const F inner(iteration.inner());
    return S::select(squares.bounded, kWantsLeast ? S::sqrt(squares.least) * inner : inner,
                     iteration.outer<S>(squares.rounds));
  }
};

} // namespace celltrace::kernel

// Wave forms, which are applied to a pattern's values before its map. Kernel dialect.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/math.hpp"
#include "records/pattern.hpp"

namespace celltrace::kernel {

inline PatternWave wave_of(const PatternRecord& r) {
  return static_cast<PatternWave>(r.kind_and_flags >> pattern_flag::wave_shift & pattern_flag::wave_mask);
}

/// Applies a wave form. As in POV-Ray, values repeat after slightly more than 1, so that 1 itself is the end
/// and not the beginning; a result may exceed 1 by as much. Has one resident copy, as both modules of
/// patterns end with it.
template <class S>
CELLTRACE_ONE_COPY typename S::F in_wave_form(const PatternRecord& r, const typename S::F& value) {
  using F = typename S::F;
  constexpr float kRepeat = 1.00001f;
  const bool repeats = (r.kind_and_flags & pattern_flag::never_repeats) == 0;
  F v = value * F(r.frequency) + F(r.phase);
  v = v - S::to_float(S::to_int(v * F(repeats ? 1.0f / kRepeat : 0.0f))) * F(kRepeat);
  v = v - S::select(v < F(0.0f), S::floor(v), F(0.0f));
  if (wave_of(r) == PatternWave::ramp) return v;
  const F turn = v - S::floor(v);
  switch (wave_of(r)) {
  case PatternWave::triangle:
    return S::select(turn <= F(0.5f), turn + turn, F(2.0f) - turn - turn);
  case PatternWave::sine:
    return (F(1.0f) + sine_of_turns<S>(turn)) * F(0.5f);
  case PatternWave::scallop:
    return S::abs(sine_of_turns<S>(v * F(0.5f)));
  case PatternWave::cubic:
    return v * v * (F(3.0f) - v - v);
  case PatternWave::poly:
    return pow<S>(v, F(r.wave_exponent));
  case PatternWave::ramp:
  case PatternWave::none:
    break;
  }
  return v;
}

} // namespace celltrace::kernel

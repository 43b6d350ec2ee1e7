// The SIMD facade of simd.hpp on a host CPU: its 16 lanes are kSimdLanes / size batches of simd_batch.hpp.
//
// `Arch` is an xsimd architecture ("xsimd::sse2", "xsimd::avx2", "xsimd::avx512dq", "xsimd::neon64") or GenericArch; it is
// part of every type's name, so that translation units compiled for different CPUs share no inline function.
#pragma once

#include "celltrace/spe/simd.hpp"
#include "celltrace/spe/simd_batch.hpp"
#include "celltrace/spe/simd_host_rows.hpp"

#include <stdint.h>

namespace celltrace {

namespace simd_host {

template <class Batch> constexpr bool is_generic = std::is_same_v<typename Batch::arch_type, GenericArch>;

/// Returns one bit per lane of a mask of `Batch`, lane 0 in bit 0.
template <class Batch>
uint32_t lane_bits(const typename Batch::batch_bool_type& mask) {
#if defined(__AVX512F__)
  if constexpr (Batch::size == 16) return static_cast<uint32_t>(mask.data);
#endif
#if defined(__AVX__)
  if constexpr (Batch::size == 8) return static_cast<uint32_t>(_mm256_movemask_ps(reinterpret_cast<__m256>(mask.data)));
#endif
#if defined(__SSE2__)
  if constexpr (Batch::size == 4 && !is_generic<Batch>) return static_cast<uint32_t>(_mm_movemask_ps(reinterpret_cast<__m128>(mask.data)));
#endif
  bool lanes[Batch::size];
  mask.store_unaligned(lanes);
  uint32_t bits = 0;
  for (uint32_t i = 0; i < Batch::size; ++i)
    bits |= static_cast<uint32_t>(lanes[i]) << i;
  return bits;
}

/// Sets `least` to the least number of `low` and `greatest` to the greatest number of `high`.
template <class Batch> void extremes(const Batch& low, const Batch& high, float& least, float& greatest) {
#if defined(__AVX512F__)
  if constexpr (Batch::size == 16) {
    least = _mm512_reduce_min_ps(low);
    greatest = _mm512_reduce_max_ps(high);
    return;
  }
#endif
  alignas(64) float lows[Batch::size], highs[Batch::size];
  low.store_aligned(lows);
  high.store_aligned(highs);
  least = lows[0];
  greatest = highs[0];
  for (uint32_t i = 1; i < Batch::size; ++i) {
    least = lows[i] < least ? lows[i] : least;
    greatest = highs[i] > greatest ? highs[i] : greatest;
  }
}

/// 16 lanes as batches, which join() makes of four registers of four lanes.
template <class Batch> struct Joined { Batch part[kSimdLanes / Batch::size]; };
template <class Batch, class Four>
Joined<Batch> join(const Four& a, const Four& b, const Four& c, const Four& d) {
#if defined(__AVX512DQ__)
  if constexpr (Batch::size == 16)
    return {{_mm512_insertf32x8(_mm512_castps256_ps512(_mm256_set_m128(b, a)), _mm256_set_m128(d, c), 1)}};
#endif
#if defined(__AVX__)
  if constexpr (Batch::size == 8) return {{_mm256_set_m128(b, a), _mm256_set_m128(d, c)}};
#endif
#if defined(__SSE2__)
  if constexpr (Batch::size == 4 && !is_generic<Batch>) return {{__m128(a), __m128(b), __m128(c), __m128(d)}};
#endif
  alignas(64) float lanes[kSimdLanes];
  a.store_aligned(lanes);
  b.store_aligned(lanes + 4);
  c.store_aligned(lanes + 8);
  d.store_aligned(lanes + 12);
  Joined<Batch> all;
  for (uint32_t i = 0; i < kSimdLanes / Batch::size; ++i)
    all.part[i] = Batch::load_aligned(lanes + i * Batch::size);
  return all;
}

} // namespace simd_host

template <class Arch> struct HostSimd {
  using FloatBatch = typename simd_host::Batches<float, Arch>::Batch;
  using IntBatch = typename simd_host::Batches<int32_t, Arch>::Batch;
  using FloatMask = typename simd_host::Batches<float, Arch>::Mask;
  static constexpr uint32_t kWidth = static_cast<uint32_t>(FloatBatch::size);
  static constexpr uint32_t kParts = kSimdLanes / kWidth;
  static constexpr uint32_t kLanes = kSimdLanes;

  struct I;

  struct M {
    FloatMask part[kParts];

    static M from_bits(uint32_t bits) {
      M result;
#if defined(__AVX512F__)
      if constexpr (kWidth == kSimdLanes) {
        result.part[0] = static_cast<typename FloatMask::register_type>(bits);
        return result;
      }
#endif
      const IntBatch all(static_cast<int32_t>(bits));
      for (uint32_t i = 0; i < kParts; ++i)
        result.part[i] =
            simd_host::bool_cast((all & IntBatch::load_aligned(simd_lane_bits + i * kWidth)) != IntBatch(0));
      return result;
    }
    static M none() {
      return from_bits(0);
    }
    static M all() {
      return from_bits(0xFFFF);
    }
    uint32_t bits() const {
      uint32_t result = 0;
      for (uint32_t i = 0; i < kParts; ++i)
        result |= simd_host::lane_bits<FloatBatch>(part[i]) << (i * kWidth);
      return result;
    }
    friend M operator&(const M& a, const M& b) {
      M r;
      for (uint32_t i = 0; i < kParts; ++i)
        r.part[i] = a.part[i] & b.part[i];
      return r;
    }
    friend M operator|(const M& a, const M& b) {
      M r;
      for (uint32_t i = 0; i < kParts; ++i)
        r.part[i] = a.part[i] | b.part[i];
      return r;
    }
    friend M operator!(const M& a) {
      M r;
      for (uint32_t i = 0; i < kParts; ++i)
        r.part[i] = !a.part[i];
      return r;
    }
  };

  struct F {
    FloatBatch part[kParts];

    F() = default;
    F(float value) {
      for (uint32_t i = 0; i < kParts; ++i)
        part[i] = FloatBatch(value);
    }
    static F load(const float* lanes) {
      F r;
      for (uint32_t i = 0; i < kParts; ++i)
        r.part[i] = FloatBatch::load_aligned(lanes + i * kWidth);
      return r;
    }
    static F load_unaligned(const float* lanes) {
      F r;
      for (uint32_t i = 0; i < kParts; ++i)
        r.part[i] = FloatBatch::load_unaligned(lanes + i * kWidth);
      return r;
    }
    void store(float* lanes) const {
      for (uint32_t i = 0; i < kParts; ++i)
        part[i].store_aligned(lanes + i * kWidth);
    }
    void store_unaligned(float* lanes) const {
      for (uint32_t i = 0; i < kParts; ++i)
        part[i].store_unaligned(lanes + i * kWidth);
    }
    template <class Operation> static F zip(const F& a, const F& b, Operation operation) {
      F r;
      for (uint32_t i = 0; i < kParts; ++i)
        r.part[i] = operation(a.part[i], b.part[i]);
      return r;
    }
    template <class Operation> static F map(const F& a, Operation operation) {
      F r;
      for (uint32_t i = 0; i < kParts; ++i)
        r.part[i] = operation(a.part[i]);
      return r;
    }
    template <class Operation> static M test(const F& a, const F& b, Operation operation) {
      M r;
      for (uint32_t i = 0; i < kParts; ++i)
        r.part[i] = operation(a.part[i], b.part[i]);
      return r;
    }
    friend F operator+(const F& a, const F& b) {
      return zip(a, b, [](auto x, auto y) { return x + y; });
    }
    friend F operator-(const F& a, const F& b) {
      return zip(a, b, [](auto x, auto y) { return x - y; });
    }
    friend F operator*(const F& a, const F& b) {
      return zip(a, b, [](auto x, auto y) { return x * y; });
    }
    friend F operator/(const F& a, const F& b) {
      return zip(a, b, [](auto x, auto y) { return simd_host::divide(x, y); });
    }
    friend F operator-(const F& a) {
      // Flips the sign: 0 - x, which some architectures use for -x, would give zeros the wrong sign.
      return map(a, [](auto x) { return x ^ FloatBatch(-0.0f); });
    }
    friend M operator<(const F& a, const F& b) {
      return test(a, b, [](auto x, auto y) { return x < y; });
    }
    friend M operator<=(const F& a, const F& b) {
      return test(a, b, [](auto x, auto y) { return x <= y; });
    }
    friend M operator>(const F& a, const F& b) { return b < a; }
    friend M operator>=(const F& a, const F& b) { return b <= a; }
    friend M operator==(const F& a, const F& b) {
      return test(a, b, [](auto x, auto y) { return x == y; });
    }
  };

  struct I {
    IntBatch part[kParts];

    static I splat(int32_t value) {
      I r;
      for (uint32_t i = 0; i < kParts; ++i)
        r.part[i] = IntBatch(value);
      return r;
    }
    static I load_words(const void* line, const I& offsets) {
      alignas(64) int32_t lanes[kSimdLanes];
      for (uint32_t i = 0; i < kParts; ++i)
        (offsets.part[i] & IntBatch(124)).store_aligned(lanes + i * kWidth);
      for (int32_t& lane : lanes)
        lane = *reinterpret_cast<const int32_t*>(static_cast<const uint8_t*>(line) + lane);
      I r;
      for (uint32_t i = 0; i < kParts; ++i)
        r.part[i] = IntBatch::load_aligned(lanes + i * kWidth);
      return r;
    }
    static I load(const int32_t* lanes) {
      I r;
      for (uint32_t i = 0; i < kParts; ++i)
        r.part[i] = IntBatch::load_aligned(lanes + i * kWidth);
      return r;
    }
    static I gather(const int32_t* table, const I& indices) {
      I r;
      for (uint32_t i = 0; i < kParts; ++i)
        r.part[i] = IntBatch::gather(table, indices.part[i]);
      return r;
    }
    void store(int32_t* lanes) const {
      for (uint32_t i = 0; i < kParts; ++i)
        part[i].store_aligned(lanes + i * kWidth);
    }
    void store_unaligned(int32_t* lanes) const {
      for (uint32_t i = 0; i < kParts; ++i)
        part[i].store_unaligned(lanes + i * kWidth);
    }
    template <class Operation> static I zip(const I& a, const I& b, Operation operation) {
      I r;
      for (uint32_t i = 0; i < kParts; ++i)
        r.part[i] = operation(a.part[i], b.part[i]);
      return r;
    }
    friend I operator+(const I& a, const I& b) {
      return zip(a, b, [](auto x, auto y) { return x + y; });
    }
    friend I operator-(const I& a, const I& b) {
      return zip(a, b, [](auto x, auto y) { return x - y; });
    }
    friend I operator&(const I& a, const I& b) {
      return zip(a, b, [](auto x, auto y) { return x & y; });
    }
    friend I operator|(const I& a, const I& b) {
      return zip(a, b, [](auto x, auto y) { return x | y; });
    }
    friend I operator^(const I& a, const I& b) {
      return zip(a, b, [](auto x, auto y) { return x ^ y; });
    }
    friend M operator==(const I& a, const I& b) {
      M r;
      for (uint32_t i = 0; i < kParts; ++i)
        r.part[i] = simd_host::bool_cast(a.part[i] == b.part[i]);
      return r;
    }
    friend M operator<(const I& a, const I& b) {
      M r;
      for (uint32_t i = 0; i < kParts; ++i)
        r.part[i] = simd_host::bool_cast(a.part[i] < b.part[i]);
      return r;
    }
  };

  static F min(const F& a, const F& b) {
    return F::zip(a, b, [](auto x, auto y) { return simd_host::min(x, y); });
  }
  static F max(const F& a, const F& b) {
    return F::zip(a, b, [](auto x, auto y) { return simd_host::max(x, y); });
  }
  /// Sets `least` and `greatest` to the least and the greatest of all lanes.
  static void extremes(const F& a, float& least, float& greatest) {
    FloatBatch low = a.part[0], high = a.part[0];
    for (uint32_t i = 1; i < kParts; ++i) {
      low = simd_host::min(low, a.part[i]);
      high = simd_host::max(high, a.part[i]);
    }
    simd_host::extremes(low, high, least, greatest);
  }
  static F abs(const F& a) {
    return F::map(a, [](auto x) { return simd_host::abs(x); });
  }
  static F sqrt(const F& a) {
    return F::map(a, [](auto x) { return simd_host::sqrt(x); });
  }
  static F select(const M& m, const F& a, const F& b) {
    F r;
    for (uint32_t i = 0; i < kParts; ++i)
      r.part[i] = simd_host::select(m.part[i], a.part[i], b.part[i]);
    return r;
  }
  static I select(const M& m, const I& a, const I& b) {
    I r;
    for (uint32_t i = 0; i < kParts; ++i)
      r.part[i] = simd_host::select(simd_host::bool_cast(m.part[i]), a.part[i], b.part[i]);
    return r;
  }
  static F floor(const F& a) {
    F r;
    for (uint32_t i = 0; i < kParts; ++i)
      r.part[i] = simd_host::floor(a.part[i]);
    return r;
  }
  static I to_int(const F& a) {
    I r;
    for (uint32_t i = 0; i < kParts; ++i)
      r.part[i] = simd_host::to_int(a.part[i]);
    return r;
  }
  static F to_float(const I& a) {
    F r;
    for (uint32_t i = 0; i < kParts; ++i)
      r.part[i] = simd_host::to_float(a.part[i]);
    return r;
  }
  static I bits_of(const F& a) {
    I r;
    for (uint32_t i = 0; i < kParts; ++i)
      r.part[i] = simd_host::bitwise_cast<IntBatch>(a.part[i]);
    return r;
  }
  static F float_of(const I& a) {
    F r;
    for (uint32_t i = 0; i < kParts; ++i)
      r.part[i] = simd_host::bitwise_cast<FloatBatch>(a.part[i]);
    return r;
  }
  template <int bits> static I shift_left(const I& a) {
    I r;
    for (uint32_t i = 0; i < kParts; ++i)
      r.part[i] = a.part[i] << bits;
    return r;
  }
  template <int bits> static I shift_right(const I& a) {
    I r;
    for (uint32_t i = 0; i < kParts; ++i)
      r.part[i] = a.part[i] >> bits;
    return r;
  }

  static F pick(const F& a, const I& lanes) {
#if defined(__AVX512F__)
    if constexpr (kParts == 1) {
      F r;
      r.part[0] = _mm512_permutexvar_ps(lanes.part[0], a.part[0]);
      return r;
    }
#endif
    alignas(64) float from[kSimdLanes], to[kSimdLanes];
    alignas(64) int32_t numbers[kSimdLanes];
    a.store(from);
    lanes.store(numbers);
    for (uint32_t i = 0; i < kSimdLanes; ++i)
      to[i] = from[numbers[i]];
    return F::load(to);
  }
  static I pick(const I& a, const I& lanes) { return bits_of(pick(float_of(a), lanes)); }
  static I lane_numbers(uint32_t lanes) {
#if defined(__AVX512F__)
    if constexpr (kParts == 1) {
      const __m512i all = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
      I r;
      r.part[0] = _mm512_maskz_compress_epi32(static_cast<__mmask16>(lanes), all);
      return r;
    }
#endif
    alignas(64) int32_t numbers[kSimdLanes] = {};
    for (uint32_t i = 0; lanes != 0; lanes &= lanes - 1)
      numbers[i++] = __builtin_ctz(lanes);
    return I::load(numbers);
  }
  static uint32_t spread(uint32_t bits, uint32_t lanes) {
#if defined(__AVX512DQ__)
    if constexpr (kParts == 1)
      return _mm512_movepi32_mask(_mm512_maskz_expand_epi32(static_cast<__mmask16>(lanes),
                                                            _mm512_movm_epi32(static_cast<__mmask16>(bits))));
#endif
    uint32_t result = 0;
    for (; lanes != 0; lanes &= lanes - 1, bits >>= 1)
      result |= (lanes & -lanes) & -(bits & 1);
    return result;
  }

  struct F4 {
    using Batch = typename simd_host::Batches<float, Arch>::template OfSize<4>;
    Batch lanes;

    static F4 splat(float value) { return {Batch(value)}; }
    static F4 load(const float* words) { return {Batch::load_aligned(words)}; }
    void store(float* words) const { lanes.store_aligned(words); }
    friend F4 operator+(const F4& a, const F4& b) { return {a.lanes + b.lanes}; }
    friend F4 operator-(const F4& a, const F4& b) { return {a.lanes - b.lanes}; }
    friend F4 operator*(const F4& a, const F4& b) { return {a.lanes * b.lanes}; }
    friend uint32_t not_above_bits(const F4& a, const F4& b) {
      return simd_host::lane_bits<Batch>(a.lanes <= b.lanes);
    }
  };
  static F join(const F4& a, const F4& b, const F4& c, const F4& d) {
    const auto all = simd_host::join<FloatBatch>(a.lanes, b.lanes, c.lanes, d.lanes);
    F r;
    for (uint32_t i = 0; i < kParts; ++i)
      r.part[i] = all.part[i];
    return r;
  }
  static void transpose_quads(F& a, F& b, F& c, F& d) {
    for (uint32_t i = 0; i < kParts; ++i)
      simd_host::transpose_quads(a.part[i], b.part[i], c.part[i], d.part[i]);
  }
  template <uint32_t kRows, uint32_t kChannels, class StartsOf, class FactorsOf>
  [[gnu::always_inline]] static void sum_rows(const float* table, const StartsOf& starts_of,
                                              const FactorsOf& factors_of, F (&sums)[kChannels]) {
    simd_host::RowSums<HostSimd, kRows, kChannels>::sum(table, starts_of, factors_of, sums);
  }
  static F4 min(const F4& a, const F4& b) {
    return {simd_host::min(a.lanes, b.lanes)};
  }
  static F4 max(const F4& a, const F4& b) {
    return {simd_host::max(a.lanes, b.lanes)};
  }

  struct U4 {
    using Batch = typename simd_host::Batches<uint32_t, Arch>::template OfSize<4>;
    Batch lanes;

    static U4 splat(uint32_t value) { return {Batch(value)}; }
    static U4 load(const uint32_t* words) { return {Batch::load_aligned(words)}; }
    void store(uint32_t* words) const { lanes.store_aligned(words); }
    friend U4 operator&(const U4& a, const U4& b) { return {a.lanes & b.lanes}; }
    friend U4 operator|(const U4& a, const U4& b) { return {a.lanes | b.lanes}; }
    friend uint32_t equal_bits(const U4& a, const U4& b) {
      return simd_host::lane_bits<Batch>(a.lanes == b.lanes);
    }
  };
};

} // namespace celltrace

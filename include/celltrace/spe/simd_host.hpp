// The SIMD facade of simd.hpp on a host CPU, over xsimd: 16 lanes are sixteen/size batches of the
// architecture.
//
// `Arch` is an xsimd architecture ("xsimd::sse2", "xsimd::avx2", "xsimd::avx512dq"); it is part of every
// type's name, so that translation units compiled for different CPUs share no inline function.
#pragma once

#include "celltrace/spe/simd.hpp"

#include <stdint.h>

#include <xsimd/xsimd.hpp>

namespace celltrace {

namespace simd_host {

/// One bit per lane of an xsimd mask, lane 0 in bit 0.
template <class Batch>
uint32_t lane_bits(const xsimd::batch_bool<typename Batch::value_type, typename Batch::arch_type>& mask) {
  using Arch = typename Batch::arch_type;
  (void)sizeof(Arch);
#if defined(__AVX512F__)
  if constexpr (Batch::size == 16) return static_cast<uint32_t>(mask.data);
#endif
#if defined(__AVX__)
  if constexpr (Batch::size == 8) return static_cast<uint32_t>(_mm256_movemask_ps((__m256)mask.data));
#endif
#if defined(__SSE2__)
  if constexpr (Batch::size == 4) return static_cast<uint32_t>(_mm_movemask_ps((__m128)mask.data));
#endif
  bool lanes[Batch::size];
  mask.store_unaligned(lanes);
  uint32_t bits = 0;
  for (uint32_t i = 0; i < Batch::size; ++i)
    bits |= static_cast<uint32_t>(lanes[i]) << i;
  return bits;
}

} // namespace simd_host

template <class Arch> struct HostSimd {
  using FloatBatch = xsimd::batch<float, Arch>;
  using IntBatch = xsimd::batch<int32_t, Arch>;
  using FloatMask = xsimd::batch_bool<float, Arch>;
  static constexpr uint32_t kWidth = static_cast<uint32_t>(FloatBatch::size);
  static constexpr uint32_t kParts = kSimdLanes / kWidth;

  struct I;

  struct M {
    FloatMask part[kParts];

    static M from_bits(uint32_t bits) {
      M result;
      const I lane_bit = I::load(simd_lane_bits);
      const I all = I::splat(static_cast<int32_t>(bits));
      for (uint32_t i = 0; i < kParts; ++i)
        result.part[i] = xsimd::bool_cast((all.part[i] & lane_bit.part[i]) != IntBatch(0));
      return result;
    }
    static M none() { return from_bits(0); }
    static M all() { return from_bits(0xFFFF); }
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
    void store(float* lanes) const {
      for (uint32_t i = 0; i < kParts; ++i)
        part[i].store_aligned(lanes + i * kWidth);
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
      return zip(a, b, [](auto x, auto y) { return x / y; });
    }
    friend F operator-(const F& a) {
      // Not 0 - x, which is what some architectures make of -x: that of a zero would have another sign.
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
    static I load(const int32_t* lanes) {
      I r;
      for (uint32_t i = 0; i < kParts; ++i)
        r.part[i] = IntBatch::load_aligned(lanes + i * kWidth);
      return r;
    }
    void store(int32_t* lanes) const {
      for (uint32_t i = 0; i < kParts; ++i)
        part[i].store_aligned(lanes + i * kWidth);
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
    friend M operator==(const I& a, const I& b) {
      M r;
      for (uint32_t i = 0; i < kParts; ++i)
        r.part[i] = xsimd::bool_cast(a.part[i] == b.part[i]);
      return r;
    }
    friend M operator<(const I& a, const I& b) {
      M r;
      for (uint32_t i = 0; i < kParts; ++i)
        r.part[i] = xsimd::bool_cast(a.part[i] < b.part[i]);
      return r;
    }
  };

  static F min(const F& a, const F& b) {
    return F::zip(a, b, [](auto x, auto y) { return xsimd::min(x, y); });
  }
  static F max(const F& a, const F& b) {
    return F::zip(a, b, [](auto x, auto y) { return xsimd::max(x, y); });
  }
  static F abs(const F& a) {
    return F::map(a, [](auto x) { return xsimd::abs(x); });
  }
  static F sqrt(const F& a) {
    return F::map(a, [](auto x) { return xsimd::sqrt(x); });
  }
  static F select(const M& m, const F& a, const F& b) {
    F r;
    for (uint32_t i = 0; i < kParts; ++i)
      r.part[i] = xsimd::select(m.part[i], a.part[i], b.part[i]);
    return r;
  }
  static I select(const M& m, const I& a, const I& b) {
    I r;
    for (uint32_t i = 0; i < kParts; ++i)
      r.part[i] = xsimd::select(xsimd::bool_cast(m.part[i]), a.part[i], b.part[i]);
    return r;
  }
  static I to_int(const F& a) {
    I r;
    for (uint32_t i = 0; i < kParts; ++i)
      r.part[i] = xsimd::to_int(a.part[i]);
    return r;
  }
  static F to_float(const I& a) {
    F r;
    for (uint32_t i = 0; i < kParts; ++i)
      r.part[i] = xsimd::to_float(a.part[i]);
    return r;
  }
  static I bits_of(const F& a) {
    I r;
    for (uint32_t i = 0; i < kParts; ++i)
      r.part[i] = xsimd::bitwise_cast<IntBatch>(a.part[i]);
    return r;
  }
  static F float_of(const I& a) {
    F r;
    for (uint32_t i = 0; i < kParts; ++i)
      r.part[i] = xsimd::bitwise_cast<FloatBatch>(a.part[i]);
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

  struct U4 {
    using Batch = xsimd::batch<uint32_t, xsimd::make_sized_batch_t<uint32_t, 4>::arch_type>;
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

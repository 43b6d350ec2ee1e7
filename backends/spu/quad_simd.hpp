// QuadSimd: the SIMD facade with the four lanes of one quadword. Code with it takes a quarter of the local
// store of the same code with 16 lanes, so rarely run code uses it.
#pragma once

#include "backends/spu/simd.hpp"

namespace celltrace::spu {

struct QuadSimd {
  static constexpr uint32_t kLanes = 4;

  struct M {
    vec_uint4 quad; ///< each lane all ones or all zeros

    static M none() { return {spu_splats(0u)}; }
    static M all() { return {spu_splats(~0u)}; }
    static M from_bits(uint32_t bits) {
      const vec_uint4 own = Simd::lane_bits(0);
      return {spu_cmpeq(spu_and(spu_splats(bits), own), own)};
    }
    uint32_t bits() const { return spu_extract(spu_orx(spu_and(quad, Simd::lane_bits(0))), 0); }
    friend M operator&(const M& a, const M& b) { return {spu_and(a.quad, b.quad)}; }
    friend M operator|(const M& a, const M& b) { return {spu_or(a.quad, b.quad)}; }
    friend M operator!(const M& a) { return {spu_nor(a.quad, a.quad)}; }
  };

  struct F {
    vec_float4 quad;

    F() = default;
    F(float value) : quad(spu_splats(value)) {}
    F(vec_float4 lanes) : quad(lanes) {}

    static F load(const float* lanes) { return *reinterpret_cast<const vec_float4*>(lanes); }
    static F load_unaligned(const float* lanes) { return Simd::load_floats(lanes); }
    void store(float* lanes) const { *reinterpret_cast<vec_float4*>(lanes) = quad; }
    friend F operator+(const F& a, const F& b) { return spu_add(a.quad, b.quad); }
    friend F operator-(const F& a, const F& b) { return spu_sub(a.quad, b.quad); }
    friend F operator*(const F& a, const F& b) { return spu_mul(a.quad, b.quad); }
    friend F operator/(const F& a, const F& b) { return Simd::divide(a.quad, b.quad); }
    friend F operator-(const F& a) { return (vec_float4)spu_xor((vec_uint4)a.quad, spu_splats(0x80000000u)); }
    friend M operator<(const F& a, const F& b) { return b > a; }
    friend M operator>(const F& a, const F& b) { return {spu_cmpgt(a.quad, b.quad)}; }
    // There are no NaNs: "not greater" means "less or equal".
    friend M operator<=(const F& a, const F& b) { return !(a > b); }
    friend M operator>=(const F& a, const F& b) { return !(b > a); }
    friend M operator==(const F& a, const F& b) { return {spu_cmpeq(a.quad, b.quad)}; }
  };

  struct I {
    vec_int4 quad;

    static I splat(int32_t value) { return {spu_splats(static_cast<int>(value))}; }
    static I load(const int32_t* lanes) { return {*reinterpret_cast<const vec_int4*>(lanes)}; }
    void store(int32_t* lanes) const { *reinterpret_cast<vec_int4*>(lanes) = quad; }
    friend I operator+(const I& a, const I& b) { return {spu_add(a.quad, b.quad)}; }
    friend I operator-(const I& a, const I& b) { return {spu_sub(a.quad, b.quad)}; }
    friend I operator&(const I& a, const I& b) { return {spu_and(a.quad, b.quad)}; }
    friend I operator|(const I& a, const I& b) { return {spu_or(a.quad, b.quad)}; }
    friend I operator^(const I& a, const I& b) { return {spu_xor(a.quad, b.quad)}; }
    friend M operator==(const I& a, const I& b) { return {spu_cmpeq(a.quad, b.quad)}; }
    friend M operator<(const I& a, const I& b) { return {spu_cmpgt(b.quad, a.quad)}; }
  };

  static F part(const Simd::F& numbers, uint32_t first) { return numbers.quad[first / kLanes]; }
  static void set_part(Simd::F& numbers, uint32_t first, const F& part) {
    numbers.quad[first / kLanes] = part.quad;
  }

  /// Sums rows, with the loop over a lane's rows unrolled: an SPU executes in order, and would wait for each
  /// look-up in the table if no others were under way.
  template <uint32_t kRows, uint32_t kChannels, class StartsOf, class FactorsOf>
  static void sum_rows(const float* table, const StartsOf& starts_of, const FactorsOf& factors_of,
                       F (&sums)[kChannels]) {
    F factors[kRows][4];
    for (uint32_t row = 0; row < kRows; ++row) {
      F(&four)[4] = factors[row];
      factors_of(row, four);
      Simd::transpose(four[0].quad, four[1].quad, four[2].quad, four[3].quad);
    }
    vec_float4 totals[kChannels][kLanes];
    for (uint32_t lane = 0; lane < kLanes; ++lane) {
      uint32_t starts[kRows];
      starts_of(lane, starts);
      vec_float4 total[kChannels];
#pragma GCC unroll 4
      for (uint32_t channel = 0; channel < kChannels; ++channel)
        total[channel] = spu_splats(0.0f);
#pragma GCC unroll 8
      for (uint32_t row = 0; row < kRows; ++row) {
        // An unaligned row spans one quadword more than it has channels.
        const float* const numbers = table + starts[row];
        const qword address = si_from_ptr(numbers);
        const vec_uchar16 bytes = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
        const vec_uchar16 offset = spu_splats(static_cast<unsigned char>(si_to_uint(address) & 15));
        const vec_uchar16 pattern = (vec_uchar16)spu_add((vec_uint4)bytes, (vec_uint4)offset);
        vec_float4 quad = (vec_float4)si_lqd(address, 0);
#pragma GCC unroll 4
        for (uint32_t channel = 0; channel < kChannels; ++channel) {
          const vec_float4 next = *reinterpret_cast<const vec_float4*>(numbers + 4 * (channel + 1));
          total[channel] =
              spu_madd(spu_shuffle(quad, next, pattern), factors[row][lane].quad, total[channel]);
          quad = next;
        }
      }
#pragma GCC unroll 4
      for (uint32_t channel = 0; channel < kChannels; ++channel)
        totals[channel][lane] = total[channel];
    }
    for (uint32_t channel = 0; channel < kChannels; ++channel) {
      vec_float4(&four)[kLanes] = totals[channel];
      Simd::transpose(four[0], four[1], four[2], four[3]);
      sums[channel] = spu_add(spu_add(four[0], four[1]), spu_add(four[2], four[3]));
    }
  }

  static F min(const F& a, const F& b) {
    return spu_sel(a.quad, b.quad, spu_cmpgt(a.quad, b.quad));
  }
  static F max(const F& a, const F& b) {
    return spu_sel(b.quad, a.quad, spu_cmpgt(a.quad, b.quad));
  }
  static F abs(const F& a) {
    return (vec_float4)spu_and((vec_uint4)a.quad, spu_splats(0x7FFFFFFFu));
  }
  static F sqrt(const F& a) {
    return Simd::square_root(a.quad);
  }
  static F select(const M& m, const F& a, const F& b) {
    return spu_sel(b.quad, a.quad, m.quad);
  }
  static I select(const M& m, const I& a, const I& b) {
    return {spu_sel(b.quad, a.quad, m.quad)};
  }
  static F floor(const F& a) {
    return Simd::floor(a.quad);
  }
  static I to_int(const F& a) {
    return {spu_convts(a.quad, 0)};
  }
  static F to_float(const I& a) {
    return spu_convtf(a.quad, 0);
  }
  static I bits_of(const F& a) {
    return {(vec_int4)a.quad};
  }
  static F float_of(const I& a) {
    return (vec_float4)a.quad;
  }
  template <int bits> static I shift_left(const I& a) {
    return {spu_sl(a.quad, static_cast<unsigned>(bits))};
  }
  template <int bits> static I shift_right(const I& a) {
    return {spu_rlmaska(a.quad, -bits)};
  }
};

} // namespace celltrace::spu

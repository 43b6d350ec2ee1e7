// The SIMD facade of celltrace/spe/simd.hpp on an SPU: 16 lanes are four quadwords, lane l is word l % 4 of
// quad l / 4. Intrinsics: C/C++ Language Extensions for Cell Broadband Engine Architecture.
#pragma once

#include "celltrace/spe/simd.hpp"

#include <spu_intrinsics.h>
#include <stdint.h>

namespace celltrace::spu {

struct Simd {
  static constexpr uint32_t kLanes = kSimdLanes;
  static constexpr int kQuads = 4;

  /// Returns the bit of each lane: lane l of the result is 1 << (4 * quad + l).
  static vec_uint4 lane_bits(int quad) {
    const vec_uint4 first = {1, 2, 4, 8};
    return spu_sl(first, static_cast<unsigned>(4 * quad));
  }
  /// Returns 1/x to within one unit in the last place, by the estimate and one Newton-Raphson step.
  static vec_float4 reciprocal(vec_float4 x) {
    const vec_float4 estimate = spu_re(x);
    return spu_madd(estimate, spu_nmsub(x, estimate, spu_splats(1.0f)), estimate);
  }
  /// Returns a / b. The quotient is corrected by the remainder, because SPU arithmetic truncates.
  static vec_float4 divide(vec_float4 a, vec_float4 b) {
    const vec_float4 inverse = reciprocal(b);
    const vec_float4 quotient = spu_mul(a, inverse);
    return spu_madd(spu_nmsub(quotient, b, a), inverse, quotient);
  }
  /// Returns the square root, by Goldschmidt's iteration from the estimate of 1/sqrt(x), and a correction by
  /// the remainder. The root of 0 is 0, because the estimate of 1/sqrt(0) is finite.
  static vec_float4 square_root(vec_float4 x) {
    const vec_float4 half = spu_splats(0.5f);
    const vec_float4 estimate = spu_rsqrte(x);
    vec_float4 root = spu_mul(x, estimate);
    vec_float4 half_inverse = spu_mul(estimate, half);
    const vec_float4 error = spu_nmsub(root, half_inverse, half);
    root = spu_madd(root, error, root);
    half_inverse = spu_madd(half_inverse, error, half_inverse);
    return spu_madd(spu_nmsub(root, root, x), half_inverse, root);
  }

  /// Loads four floats, which need not be aligned to a quadword, by a shuffle of the quadwords of the first
  /// and the last.
  static vec_float4 load_floats(const float* words) {
    const auto quad_at = [](const void* place) {
      return *reinterpret_cast<const vec_uchar16*>(reinterpret_cast<uintptr_t>(place) & ~uintptr_t{15});
    };
    const vec_uint4 bytes = {0x00010203, 0x04050607, 0x08090A0B, 0x0C0D0E0F};
    const unsigned first = static_cast<unsigned>(reinterpret_cast<uintptr_t>(words) & 15);
    const vec_uint4 pattern = spu_add(bytes, spu_splats(first * 0x01010101u));
    return (vec_float4)spu_shuffle(quad_at(words), quad_at(words + 3), (vec_uchar16)pattern);
  }

  struct M {
    vec_uint4 quad[kQuads]; ///< each lane all ones or all zeros

    static M from_bits(uint32_t bits) {
      const vec_uint4 all = spu_splats(static_cast<unsigned>(bits));
      M r;
      r.quad[0] = spu_cmpeq(spu_and(all, lane_bits(0)), lane_bits(0));
      r.quad[1] = spu_cmpeq(spu_and(all, lane_bits(1)), lane_bits(1));
      r.quad[2] = spu_cmpeq(spu_and(all, lane_bits(2)), lane_bits(2));
      r.quad[3] = spu_cmpeq(spu_and(all, lane_bits(3)), lane_bits(3));
      return r;
    }
    static M none() { return splat(0); }
    static M all() { return splat(~0u); }
    uint32_t bits() const {
      const vec_uint4 low = spu_or(spu_and(quad[0], lane_bits(0)), spu_and(quad[1], lane_bits(1)));
      const vec_uint4 high = spu_or(spu_and(quad[2], lane_bits(2)), spu_and(quad[3], lane_bits(3)));
      return spu_extract(spu_orx(spu_or(low, high)), 0);
    }
    friend M operator&(const M& a, const M& b) {
      return zip(a, b, [](vec_uint4 x, vec_uint4 y) { return spu_and(x, y); });
    }
    friend M operator|(const M& a, const M& b) {
      return zip(a, b, [](vec_uint4 x, vec_uint4 y) { return spu_or(x, y); });
    }
    friend M operator!(const M& a) {
      return zip(a, a, [](vec_uint4 x, vec_uint4 y) { return spu_nor(x, y); });
    }

  private:
    static M splat(unsigned word) {
      const vec_uint4 q = spu_splats(word);
      return {{q, q, q, q}};
    }
    template <class Operation> static M zip(const M& a, const M& b, Operation operation) {
      return {{operation(a.quad[0], b.quad[0]), operation(a.quad[1], b.quad[1]),
               operation(a.quad[2], b.quad[2]), operation(a.quad[3], b.quad[3])}};
    }
  };

  struct F {
    vec_float4 quad[kQuads];

    F() = default;
    F(float value) : F(spu_splats(value), spu_splats(value), spu_splats(value), spu_splats(value)) {}
    F(vec_float4 q0, vec_float4 q1, vec_float4 q2, vec_float4 q3) : quad{q0, q1, q2, q3} {}

    static F load(const float* lanes) {
      const vec_float4* quads = reinterpret_cast<const vec_float4*>(lanes);
      return {quads[0], quads[1], quads[2], quads[3]};
    }
    static F load_unaligned(const float* lanes) {
      return {load_floats(lanes), load_floats(lanes + 4), load_floats(lanes + 8), load_floats(lanes + 12)};
    }
    void store(float* lanes) const {
      vec_float4* quads = reinterpret_cast<vec_float4*>(lanes);
      quads[0] = quad[0];
      quads[1] = quad[1];
      quads[2] = quad[2];
      quads[3] = quad[3];
    }
    template <class Operation> static F map(const F& a, Operation operation) {
      return {operation(a.quad[0]), operation(a.quad[1]), operation(a.quad[2]), operation(a.quad[3])};
    }
    template <class Operation> static F zip(const F& a, const F& b, Operation operation) {
      return {operation(a.quad[0], b.quad[0]), operation(a.quad[1], b.quad[1]),
              operation(a.quad[2], b.quad[2]), operation(a.quad[3], b.quad[3])};
    }
    template <class Operation> static M test(const F& a, const F& b, Operation operation) {
      return {{operation(a.quad[0], b.quad[0]), operation(a.quad[1], b.quad[1]),
               operation(a.quad[2], b.quad[2]), operation(a.quad[3], b.quad[3])}};
    }
    friend F operator+(const F& a, const F& b) {
      return zip(a, b, [](vec_float4 x, vec_float4 y) { return spu_add(x, y); });
    }
    friend F operator-(const F& a, const F& b) {
      return zip(a, b, [](vec_float4 x, vec_float4 y) { return spu_sub(x, y); });
    }
    friend F operator*(const F& a, const F& b) {
      return zip(a, b, [](vec_float4 x, vec_float4 y) { return spu_mul(x, y); });
    }
    friend F operator/(const F& a, const F& b) {
      return zip(a, b, [](vec_float4 x, vec_float4 y) { return divide(x, y); });
    }
    friend F operator-(const F& a) {
      return map(a, [](vec_float4 x) { return (vec_float4)spu_xor((vec_uint4)x, spu_splats(0x80000000u)); });
    }
    friend M operator<(const F& a, const F& b) { return b > a; }
    friend M operator>(const F& a, const F& b) {
      return test(a, b, [](vec_float4 x, vec_float4 y) { return spu_cmpgt(x, y); });
    }
    // There are no NaNs: "not greater" means "less or equal".
    friend M operator<=(const F& a, const F& b) { return !(a > b); }
    friend M operator>=(const F& a, const F& b) { return !(b > a); }
    friend M operator==(const F& a, const F& b) {
      return test(a, b, [](vec_float4 x, vec_float4 y) { return spu_cmpeq(x, y); });
    }
  };

  struct I {
    vec_int4 quad[kQuads];

    static I splat(int32_t value) {
      const vec_int4 q = spu_splats(static_cast<int>(value));
      return {{q, q, q, q}};
    }
    static I load_words(const void* line, const I& offsets) {
      return map(offsets, [&](vec_int4 four) {
        const vec_int4 at = spu_and(four, 124);
        return join_words([&](int lane) {
          const int offset = spu_extract(at, lane);
          // A load ignores the low four bits of the address.
          const qword quad = si_lqx(si_from_ptr(line), si_from_int(offset));
          return (vec_int4)si_rotqby(quad, si_from_int(offset));
        });
      });
    }
    static I load(const int32_t* lanes) {
      const vec_int4* quads = reinterpret_cast<const vec_int4*>(lanes);
      return {{quads[0], quads[1], quads[2], quads[3]}};
    }
    void store(int32_t* lanes) const {
      vec_int4* quads = reinterpret_cast<vec_int4*>(lanes);
      quads[0] = quad[0];
      quads[1] = quad[1];
      quads[2] = quad[2];
      quads[3] = quad[3];
    }
    template <class Operation> static I map(const I& a, Operation operation) {
      return {{operation(a.quad[0]), operation(a.quad[1]), operation(a.quad[2]), operation(a.quad[3])}};
    }
    template <class Operation> static I zip(const I& a, const I& b, Operation operation) {
      return {{operation(a.quad[0], b.quad[0]), operation(a.quad[1], b.quad[1]),
               operation(a.quad[2], b.quad[2]), operation(a.quad[3], b.quad[3])}};
    }
    template <class Operation> static M test(const I& a, const I& b, Operation operation) {
      return {{operation(a.quad[0], b.quad[0]), operation(a.quad[1], b.quad[1]),
               operation(a.quad[2], b.quad[2]), operation(a.quad[3], b.quad[3])}};
    }
    friend I operator+(const I& a, const I& b) {
      return zip(a, b, [](vec_int4 x, vec_int4 y) { return spu_add(x, y); });
    }
    friend I operator-(const I& a, const I& b) {
      return zip(a, b, [](vec_int4 x, vec_int4 y) { return spu_sub(x, y); });
    }
    friend I operator&(const I& a, const I& b) {
      return zip(a, b, [](vec_int4 x, vec_int4 y) { return spu_and(x, y); });
    }
    friend I operator|(const I& a, const I& b) {
      return zip(a, b, [](vec_int4 x, vec_int4 y) { return spu_or(x, y); });
    }
    friend I operator^(const I& a, const I& b) {
      return zip(a, b, [](vec_int4 x, vec_int4 y) { return spu_xor(x, y); });
    }
    friend M operator==(const I& a, const I& b) {
      return test(a, b, [](vec_int4 x, vec_int4 y) { return spu_cmpeq(x, y); });
    }
    friend M operator<(const I& a, const I& b) {
      return test(a, b, [](vec_int4 x, vec_int4 y) { return spu_cmpgt(y, x); });
    }
  };

  /// Returns the first words of the four quadwords `quad_of(lane)`.
  template <class QuadOf> static vec_int4 join_words(QuadOf quad_of) {
    const vec_uchar16 first_two = {0, 1, 2, 3, 16, 17, 18, 19, 0, 0, 0, 0, 0, 0, 0, 0};
    const vec_uchar16 halves = {0, 1, 2, 3, 4, 5, 6, 7, 16, 17, 18, 19, 20, 21, 22, 23};
    return spu_shuffle(spu_shuffle(quad_of(0), quad_of(1), first_two),
                       spu_shuffle(quad_of(2), quad_of(3), first_two), halves);
  }

  static F min(const F& a, const F& b) {
    return F::zip(a, b, [](vec_float4 x, vec_float4 y) { return spu_sel(x, y, spu_cmpgt(x, y)); });
  }
  static F max(const F& a, const F& b) {
    return F::zip(a, b, [](vec_float4 x, vec_float4 y) { return spu_sel(y, x, spu_cmpgt(x, y)); });
  }
  static F abs(const F& a) {
    return F::map(a, [](vec_float4 x) { return (vec_float4)spu_and((vec_uint4)x, spu_splats(0x7FFFFFFFu)); });
  }
  static F sqrt(const F& a) {
    return F::map(a, [](vec_float4 x) { return square_root(x); });
  }
  static F select(const M& m, const F& a, const F& b) {
    return {spu_sel(b.quad[0], a.quad[0], m.quad[0]), spu_sel(b.quad[1], a.quad[1], m.quad[1]),
            spu_sel(b.quad[2], a.quad[2], m.quad[2]), spu_sel(b.quad[3], a.quad[3], m.quad[3])};
  }
  static I select(const M& m, const I& a, const I& b) {
    return {{spu_sel(b.quad[0], a.quad[0], m.quad[0]), spu_sel(b.quad[1], a.quad[1], m.quad[1]),
             spu_sel(b.quad[2], a.quad[2], m.quad[2]), spu_sel(b.quad[3], a.quad[3], m.quad[3])}};
  }
  static vec_float4 floor(vec_float4 a) {
    const vec_float4 toward_zero = spu_convtf(spu_convts(a, 0), 0);
    const vec_uint4 above = spu_cmpgt(toward_zero, a);
    return spu_sub(toward_zero, (vec_float4)spu_and(above, (vec_uint4)spu_splats(1.0f)));
  }
  static F floor(const F& a) {
    return {floor(a.quad[0]), floor(a.quad[1]), floor(a.quad[2]), floor(a.quad[3])};
  }
  static I to_int(const F& a) {
    return {{spu_convts(a.quad[0], 0), spu_convts(a.quad[1], 0), spu_convts(a.quad[2], 0),
             spu_convts(a.quad[3], 0)}};
  }
  static F to_float(const I& a) {
    return {spu_convtf(a.quad[0], 0), spu_convtf(a.quad[1], 0), spu_convtf(a.quad[2], 0),
            spu_convtf(a.quad[3], 0)};
  }
  static I bits_of(const F& a) {
    return {{(vec_int4)a.quad[0], (vec_int4)a.quad[1], (vec_int4)a.quad[2], (vec_int4)a.quad[3]}};
  }
  static F float_of(const I& a) {
    return {(vec_float4)a.quad[0], (vec_float4)a.quad[1], (vec_float4)a.quad[2], (vec_float4)a.quad[3]};
  }
  template <int bits> static I shift_left(const I& a) {
    return I::map(a, [](vec_int4 x) { return spu_sl(x, static_cast<unsigned>(bits)); });
  }
  template <int bits> static I shift_right(const I& a) {
    return I::map(a, [](vec_int4 x) { return spu_rlmaska(x, -bits); });
  }

  struct F4 {
    vec_float4 lanes;

    static F4 splat(float value) { return {spu_splats(value)}; }
    static F4 load(const float* words) { return {*reinterpret_cast<const vec_float4*>(words)}; }
    void store(float* words) const { *reinterpret_cast<vec_float4*>(words) = lanes; }
    friend F4 operator+(const F4& a, const F4& b) { return {spu_add(a.lanes, b.lanes)}; }
    friend F4 operator-(const F4& a, const F4& b) { return {spu_sub(a.lanes, b.lanes)}; }
    friend F4 operator*(const F4& a, const F4& b) { return {spu_mul(a.lanes, b.lanes)}; }
    friend uint32_t not_above_bits(const F4& a, const F4& b) {
      return ~spu_extract(spu_orx(spu_and(spu_cmpgt(a.lanes, b.lanes), lane_bits(0))), 0) & 0xFu;
    }
  };
  static F4 min(const F4& a, const F4& b) { return {spu_sel(a.lanes, b.lanes, spu_cmpgt(a.lanes, b.lanes))}; }
  static F4 max(const F4& a, const F4& b) { return {spu_sel(b.lanes, a.lanes, spu_cmpgt(a.lanes, b.lanes))}; }

  static F join(const F4& a, const F4& b, const F4& c, const F4& d) {
    return F(a.lanes, b.lanes, c.lanes, d.lanes);
  }
  static void transpose(vec_float4& a, vec_float4& b, vec_float4& c, vec_float4& d) {
    const vec_uchar16 low = {0, 1, 2, 3, 16, 17, 18, 19, 4, 5, 6, 7, 20, 21, 22, 23};
    const vec_uchar16 high = {8, 9, 10, 11, 24, 25, 26, 27, 12, 13, 14, 15, 28, 29, 30, 31};
    // Interleaves rows a and c, and b and d, then the results.
    const vec_float4 ac_low = spu_shuffle(a, c, low), ac_high = spu_shuffle(a, c, high);
    const vec_float4 bd_low = spu_shuffle(b, d, low), bd_high = spu_shuffle(b, d, high);
    a = spu_shuffle(ac_low, bd_low, low);
    b = spu_shuffle(ac_low, bd_low, high);
    c = spu_shuffle(ac_high, bd_high, low);
    d = spu_shuffle(ac_high, bd_high, high);
  }
  static void transpose_quads(F& a, F& b, F& c, F& d) {
    for (int q = 0; q < kQuads; ++q)
      transpose(a.quad[q], b.quad[q], c.quad[q], d.quad[q]);
  }
  static void extremes(const F& a, float& least, float& greatest) {
    const auto pick = [](const vec_float4& x, const vec_float4& y, bool wants_greater) {
      return wants_greater ? spu_sel(y, x, spu_cmpgt(x, y)) : spu_sel(x, y, spu_cmpgt(x, y));
    };
    const auto of_all = [&](bool wants_greater) {
      const vec_float4 four = pick(pick(a.quad[0], a.quad[1], wants_greater),
                                   pick(a.quad[2], a.quad[3], wants_greater), wants_greater);
      const vec_float4 two = pick(four, spu_rlqwbyte(four, 8), wants_greater);
      return spu_extract(pick(two, spu_rlqwbyte(two, 4), wants_greater), 0);
    };
    least = of_all(false);
    greatest = of_all(true);
  }

  struct U4 {
    vec_uint4 lanes;

    static U4 splat(uint32_t value) { return {spu_splats(static_cast<unsigned>(value))}; }
    static U4 load(const uint32_t* words) { return {*reinterpret_cast<const vec_uint4*>(words)}; }
    void store(uint32_t* words) const { *reinterpret_cast<vec_uint4*>(words) = lanes; }
    friend U4 operator&(const U4& a, const U4& b) { return {spu_and(a.lanes, b.lanes)}; }
    friend U4 operator|(const U4& a, const U4& b) { return {spu_or(a.lanes, b.lanes)}; }
    friend uint32_t equal_bits(const U4& a, const U4& b) {
      return spu_extract(spu_orx(spu_and(spu_cmpeq(a.lanes, b.lanes), lane_bits(0))), 0);
    }
  };
};

} // namespace celltrace::spu

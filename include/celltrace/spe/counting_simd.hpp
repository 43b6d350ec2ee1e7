// The SIMD facade of the emulated SPU: forwards every operation to another implementation of simd.hpp, and
// counts the instructions that an SPU issues for the operation.
#pragma once

#include "celltrace/spe/operation_counter.hpp"

#include <concepts>
#include <cstdint>

namespace celltrace::cell_emu {

/// Counts operations, and computes their results by `Uncounted`, another implementation of simd.hpp.
template <class Uncounted> struct CountingSimd {
  static constexpr std::uint32_t kWidth = Uncounted::kWidth;
  static constexpr std::uint32_t kLanes = Uncounted::kLanes;

  struct M {
    typename Uncounted::M value;

    static M from_bits(std::uint32_t bits) {
      count_chain({.shuf = 1});
      count_packet({.fx2 = 2, .ls = 1});
      return {Uncounted::M::from_bits(bits)};
    }
    static M none() {
      count_chain({.fx2 = 1});
      return {Uncounted::M::none()};
    }
    static M all() {
      count_chain({.fx2 = 1});
      return {Uncounted::M::all()};
    }
    std::uint32_t bits() const {
      count_packet({.fx2 = 1, .ls = 1});
      count_chain({.fx2 = 3, .br = 1});
      return value.bits();
    }
    friend M operator&(const M& a, const M& b) {
      count_packet({.fx2 = 1});
      return {a.value & b.value};
    }
    friend M operator|(const M& a, const M& b) {
      count_packet({.fx2 = 1});
      return {a.value | b.value};
    }
    /// Counts nothing: on an SPU, the negation becomes part of the next operation, as andc, orc or exchanged
    /// operands of selb.
    friend M operator!(const M& a) { return {!a.value}; }
  };

  struct F {
    typename Uncounted::F value;

    F() = default;
    /// Counts a constant as two immediates or a load; a number from memory as a load, a rotation and a
    /// shuffle.
    F(float number) : value(number) { count_chain({.fx2 = 1, .ls = 1, .shuf = 1}); }
    /// Makes the result of `compute` in place, because copies made emulation a tenth slower.
    template <std::invocable Compute> explicit F(Compute compute) : value(compute()) {}
    static F load(const float* lanes) {
      count_packet({.ls = 1});
      return F([&] { return Uncounted::F::load(lanes); });
    }
    static F load_unaligned(const float* lanes) {
      count_packet({.ls = 2, .shuf = 1});
      count_chain({.fx2 = 2, .shuf = 1}); // makes the pattern of the shuffles
      return F([&] { return Uncounted::F::load_unaligned(lanes); });
    }
    void store(float* lanes) const {
      count_packet({.ls = 1});
      value.store(lanes);
    }
    friend F operator+(const F& a, const F& b) {
      count_packet({.fp6 = 1});
      return F([&] { return a.value + b.value; });
    }
    friend F operator-(const F& a, const F& b) {
      count_packet({.fp6 = 1});
      return F([&] { return a.value - b.value; });
    }
    friend F operator*(const F& a, const F& b) {
      count_packet({.fp6 = 1});
      return F([&] { return a.value * b.value; });
    }
    friend F operator/(const F& a, const F& b) {
      count_packet({.fp6 = 5, .fp7 = 1, .shuf = 1});
      return F([&] { return a.value / b.value; });
    }
    friend F operator-(const F& a) {
      count_packet({.fx2 = 1});
      return F([&] { return -a.value; });
    }
    friend M operator<(const F& a, const F& b) {
      count_packet({.fx2 = 1});
      return {a.value < b.value};
    }
    friend M operator<=(const F& a, const F& b) {
      count_packet({.fx2 = 1});
      return {a.value <= b.value};
    }
    friend M operator>(const F& a, const F& b) { return b < a; }
    friend M operator>=(const F& a, const F& b) { return b <= a; }
    friend M operator==(const F& a, const F& b) {
      count_packet({.fx2 = 1});
      return {a.value == b.value};
    }
  };

  struct I {
    typename Uncounted::I value;

    static I splat(std::int32_t number) {
      count_chain({.shuf = 1});
      return {Uncounted::I::splat(number)};
    }
    /// Counts for each lane a load and a rotation, and for each four lanes three more rotations, which
    /// extract offsets, and three shuffles.
    static I load_words(const void* line, const I& offsets) {
      count_packet({.fx2 = 1, .ls = 4, .shuf = 10});
      return {Uncounted::I::load_words(line, offsets.value)};
    }
    static I load(const std::int32_t* lanes) {
      count_packet({.ls = 1});
      return {Uncounted::I::load(lanes)};
    }
    void store(std::int32_t* lanes) const {
      count_packet({.ls = 1});
      value.store(lanes);
    }
    friend I operator+(const I& a, const I& b) {
      count_packet({.fx2 = 1});
      return {a.value + b.value};
    }
    friend I operator-(const I& a, const I& b) {
      count_packet({.fx2 = 1});
      return {a.value - b.value};
    }
    friend I operator&(const I& a, const I& b) {
      count_packet({.fx2 = 1});
      return {a.value & b.value};
    }
    friend I operator|(const I& a, const I& b) {
      count_packet({.fx2 = 1});
      return {a.value | b.value};
    }
    friend I operator^(const I& a, const I& b) {
      count_packet({.fx2 = 1});
      return {a.value ^ b.value};
    }
    friend M operator==(const I& a, const I& b) {
      count_packet({.fx2 = 1});
      return {a.value == b.value};
    }
    friend M operator<(const I& a, const I& b) {
      count_packet({.fx2 = 1});
      return {a.value < b.value};
    }
  };

  /// Counts for each lane and row a load and a rotation for the row's start, a load of the factors, and for
  /// each channel a load and a shuffle; then the sums, and the shuffles that transpose factors and sums.
  template <std::uint32_t kRows, std::uint32_t kChannels, class StartsOf, class FactorsOf>
  static void sum_rows(const float* table, const StartsOf& starts_of, const FactorsOf& factors_of,
                       F (&sums)[kChannels]) {
    constexpr std::uint32_t kPairs = 4 * kRows;
    count_packet({.fx2 = kPairs,
                  .fp6 = kPairs * kChannels + 3 * kChannels,
                  .ls = kPairs * (3 + kChannels) + 4 * kRows,
                  .shuf = kPairs * (2 + kChannels) + 8 * kRows + 8 * kChannels});
    typename Uncounted::F factors[kRows][4], plain_sums[kChannels];
    for (std::uint32_t row = 0; row < kRows; ++row) {
      F counted[4];
      factors_of(row, counted);
      for (std::uint32_t i = 0; i < 4; ++i)
        factors[row][i] = counted[i].value;
    }
    const auto plain_factors_of = [&](std::uint32_t row, typename Uncounted::F(&four)[4]) {
      for (std::uint32_t i = 0; i < 4; ++i)
        four[i] = factors[row][i];
    };
    Uncounted::template sum_rows<kRows>(table, starts_of, plain_factors_of, plain_sums);
    for (std::uint32_t channel = 0; channel < kChannels; ++channel)
      sums[channel].value = plain_sums[channel];
  }

  static F min(const F& a, const F& b) {
    count_packet({.fx2 = 2});
    return F([&] { return Uncounted::min(a.value, b.value); });
  }
  static F max(const F& a, const F& b) {
    count_packet({.fx2 = 2});
    return F([&] { return Uncounted::max(a.value, b.value); });
  }
  static void extremes(const F& a, float& least, float& greatest) {
    count_packet({.fx2 = 2});
    count_chain({.fx2 = 12, .shuf = 4});
    Uncounted::extremes(a.value, least, greatest);
  }
  static F abs(const F& a) {
    count_packet({.fx2 = 1});
    return F([&] { return Uncounted::abs(a.value); });
  }
  static F sqrt(const F& a) {
    count_packet({.fp6 = 7, .fp7 = 1, .shuf = 1});
    return F([&] { return Uncounted::sqrt(a.value); });
  }
  static F select(const M& m, const F& a, const F& b) {
    count_packet({.fx2 = 1});
    return F([&] { return Uncounted::select(m.value, a.value, b.value); });
  }
  static I select(const M& m, const I& a, const I& b) {
    count_packet({.fx2 = 1});
    return {Uncounted::select(m.value, a.value, b.value)};
  }
  /// Counts conversions to an integer and back, a comparison with `a`, and the subtraction of 1.
  static F floor(const F& a) {
    count_packet({.fx2 = 2, .fp6 = 1, .fp7 = 2});
    return F([&] { return Uncounted::floor(a.value); });
  }
  static I to_int(const F& a) {
    count_packet({.fp7 = 1});
    return {Uncounted::to_int(a.value)};
  }
  static F to_float(const I& a) {
    count_packet({.fp7 = 1});
    return F([&] { return Uncounted::to_float(a.value); });
  }
  /// Count nothing, because an SPU's registers have no type.
  static I bits_of(const F& a) { return {Uncounted::bits_of(a.value)}; }
  static F float_of(const I& a) {
    return F([&] { return Uncounted::float_of(a.value); });
  }
  template <int bits> static I shift_left(const I& a) {
    count_packet({.fx3 = 1});
    return {Uncounted::template shift_left<bits>(a.value)};
  }
  template <int bits> static I shift_right(const I& a) {
    count_packet({.fx3 = 1});
    return {Uncounted::template shift_right<bits>(a.value)};
  }

  struct F4 {
    typename Uncounted::F4 value;

    static F4 splat(float number) {
      count_chain({.shuf = 1});
      return {Uncounted::F4::splat(number)};
    }
    static F4 load(const float* words) {
      count_chain({.ls = 1});
      return {Uncounted::F4::load(words)};
    }
    void store(float* words) const {
      count_chain({.ls = 1});
      value.store(words);
    }
    friend F4 operator+(const F4& a, const F4& b) {
      count_chain({.fp6 = 1});
      return {a.value + b.value};
    }
    friend F4 operator-(const F4& a, const F4& b) {
      count_chain({.fp6 = 1});
      return {a.value - b.value};
    }
    friend F4 operator*(const F4& a, const F4& b) {
      count_chain({.fp6 = 1});
      return {a.value * b.value};
    }
    friend std::uint32_t not_above_bits(const F4& a, const F4& b) {
      count_chain({.fx2 = 2, .shuf = 2});
      return not_above_bits(a.value, b.value);
    }
  };
  /// Counts nothing, because each F4 is already a register of the result.
  static F join(const F4& a, const F4& b, const F4& c, const F4& d) {
    return F([&] { return Uncounted::join(a.value, b.value, c.value, d.value); });
  }
  static void transpose_quads(F& a, F& b, F& c, F& d) {
    count_packet({.shuf = 8});
    Uncounted::transpose_quads(a.value, b.value, c.value, d.value);
  }
  static F4 min(const F4& a, const F4& b) {
    count_chain({.fx2 = 2});
    return {Uncounted::min(a.value, b.value)};
  }
  static F4 max(const F4& a, const F4& b) {
    count_chain({.fx2 = 2});
    return {Uncounted::max(a.value, b.value)};
  }

  struct U4 {
    typename Uncounted::U4 value;

    static U4 splat(std::uint32_t number) {
      count_chain({.shuf = 1});
      return {Uncounted::U4::splat(number)};
    }
    static U4 load(const std::uint32_t* words) {
      count_chain({.ls = 1});
      return {Uncounted::U4::load(words)};
    }
    void store(std::uint32_t* words) const {
      count_chain({.ls = 1});
      value.store(words);
    }
    friend U4 operator&(const U4& a, const U4& b) {
      count_chain({.fx2 = 1});
      return {a.value & b.value};
    }
    friend U4 operator|(const U4& a, const U4& b) {
      count_chain({.fx2 = 1});
      return {a.value | b.value};
    }
    friend std::uint32_t equal_bits(const U4& a, const U4& b) {
      count_chain({.fx2 = 2, .ls = 1, .br = 1});
      return equal_bits(a.value, b.value);
    }
  };
};

} // namespace celltrace::cell_emu

// Opcodes of 11 bits: floating point.
#include "isa/fields.hpp"
#include "isa/reference.hpp"
#include "isa/reference_double.hpp"
#include "isa/reference_single.hpp"

namespace celltrace::test {

namespace {

template <class F> Register test_parts(unsigned size, F f) {
  return for_parts(size, [&](unsigned i) { return f(i) ? ~std::uint64_t{0} : std::uint64_t{0}; });
}

/// Word 0 of the FPSCR has the modes: two bits for slot 0, then two for slot 1.
Rounding rounding_of(const Register& fpscr, unsigned slot) {
  return static_cast<Rounding>(fpscr.word(0) >> (slot == 0 ? 10 : 8) & 3);
}

/// Word 1 has the exceptions of slot 0, word 2 those of slot 1.
void add_exceptions(Register& fpscr, unsigned slot, std::uint32_t exceptions) {
  fpscr.set_part(4, 1 + slot, fpscr.word(1 + slot) | exceptions << 8);
}

/// Word 3 has them, bit 20 that of slot 0.
void add_divisions_by_zero(Register& fpscr, const Register& divisor) {
  for (unsigned i = 0; i < 4; ++i)
    if (single_is_zero(divisor.word(i))) fpscr.set_bit(3 * 32 + 20 + i, true);
}

} // namespace

bool Reference::execute_float(std::uint32_t word) {
  const Register a = gpr[ra_of(word)], b = gpr[rb_of(word)];
  Register& t = gpr[rt_of(word)];
  const auto compute = [&](auto f) {
    t = compute_singles(
        [&](unsigned i, std::uint32_t& exceptions) { return f(a.word(i), b.word(i), exceptions); });
    return true;
  };
  const auto estimate = [&](auto f) {
    add_divisions_by_zero(fpscr, a);
    t = for_parts(4, [&](unsigned i) { return f(a.word(i)); });
    return true;
  };
  switch (word >> 21) {
  case 0x2C4: // fa
    return compute(single_add);
  case 0x2C5: // fs
    return compute(single_subtract);
  case 0x2C6: // fm
    return compute(single_multiply);
  case 0x3C2: // fceq
    t = test_parts(4, [&](unsigned i) { return single_equal(a.word(i), b.word(i)); });
    return true;
  case 0x3CA: // fcmeq
    t = test_parts(4, [&](unsigned i) {
      return single_equal(single_magnitude(a.word(i)), single_magnitude(b.word(i)));
    });
    return true;
  case 0x2C2: // fcgt
    t = test_parts(4, [&](unsigned i) { return single_greater(a.word(i), b.word(i)); });
    return true;
  case 0x2CA: // fcmgt
    t = test_parts(4, [&](unsigned i) {
      return single_greater(single_magnitude(a.word(i)), single_magnitude(b.word(i)));
    });
    return true;
  case 0x1B8: // frest
    return estimate(reciprocal_estimate);
  case 0x1B9: // frsqest
    return estimate(reciprocal_square_root_estimate);
  case 0x3D4: // fi
    t = for_parts(4, [&](unsigned i) { return interpolate(a.word(i), b.word(i)); });
    return true;
  default:
    return false;
  }
}

bool Reference::execute_double(std::uint32_t word) {
  const Register a = gpr[ra_of(word)], b = gpr[rb_of(word)], before = gpr[rt_of(word)];
  Register& t = gpr[rt_of(word)];
  const auto compute = [&](auto f) {
    t = for_parts(8, [&](unsigned i) {
      DoubleStatus status{rounding_of(fpscr, i)};
      const auto result = f(i, status);
      add_exceptions(fpscr, i, status.exceptions);
      return result;
    });
    return true;
  };
  const auto fused = [&](bool subtract, bool negate) {
    return compute([&](unsigned i, DoubleStatus& status) {
      const std::uint64_t result =
          double_multiply_add(a.part(8, i), b.part(8, i), before.part(8, i), subtract, status);
      return negate ? double_negate(result) : result;
    });
  };
  switch (word >> 21) {
  case 0x2CC: // dfa
    return compute([&](unsigned i, DoubleStatus& s) { return double_add(a.part(8, i), b.part(8, i), s); });
  case 0x2CD: // dfs
    return compute(
        [&](unsigned i, DoubleStatus& s) { return double_subtract(a.part(8, i), b.part(8, i), s); });
  case 0x2CE: // dfm
    return compute(
        [&](unsigned i, DoubleStatus& s) { return double_multiply(a.part(8, i), b.part(8, i), s); });
  case 0x35C: // dfma
    return fused(false, false);
  case 0x35D: // dfms
    return fused(true, false);
  case 0x35E: // dfnms
    return fused(true, true);
  case 0x35F: // dfnma
    return fused(false, true);
  case 0x3B8: // fesd: from the left word of each doubleword
    return compute([&](unsigned i, DoubleStatus& s) { return double_from_single(a.word(2 * i), s); });
  case 0x3B9: // frds: to it
    return compute(
        [&](unsigned i, DoubleStatus& s) { return std::uint64_t{double_to_single(a.part(8, i), s)} << 32; });

  case 0x3C3: // dfceq
    t = test_parts(8, [&](unsigned i) { return double_equal(a.part(8, i), b.part(8, i)); });
    return true;
  case 0x3CB: // dfcmeq
    t = test_parts(8, [&](unsigned i) {
      return double_equal(double_magnitude(a.part(8, i)), double_magnitude(b.part(8, i)));
    });
    return true;
  case 0x2C3: // dfcgt
    t = test_parts(8, [&](unsigned i) { return double_greater(a.part(8, i), b.part(8, i)); });
    return true;
  case 0x2CB: // dfcmgt
    t = test_parts(8, [&](unsigned i) {
      return double_greater(double_magnitude(a.part(8, i)), double_magnitude(b.part(8, i)));
    });
    return true;
  case 0x3BF: // dftsv
    t = test_parts(8, [&](unsigned i) { return double_is_special(a.part(8, i), word >> 14 & 0x7F); });
    return true;

  case 0x398: // fscrrd
    t = fpscr;
    return true;
  case 0x3BA: // fscrwr
    fpscr = for_parts(4, [&](unsigned i) { return a.word(i) & kDefinedFpscr[i]; });
    return true;
  default:
    return false;
  }
}

} // namespace celltrace::test

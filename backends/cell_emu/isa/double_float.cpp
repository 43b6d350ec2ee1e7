// Execution: double precision. It is IEEE 754 with the rounding mode and the flags of the FPSCR for each
// slot, except that denormal operands and results become zeros of the same sign, and that each NaN result is
// the default NaN. Compares are those of the Cell with enhanced double precision (PowerXCell 8i); the flags
// that compares may set are not modelled.
#include "backends/cell_emu/isa/execute.hpp"
#include "backends/cell_emu/isa/floating_status.hpp"
#include "backends/cell_emu/isa/parts.hpp"

#include <cfenv>
#include <cmath>
#include <limits>
#include <type_traits>

#if defined(__SSE2_MATH__)
#include <immintrin.h>
#endif

namespace celltrace::isa::execute {
namespace {

using U32 = std::uint32_t;
using U64 = std::uint64_t;

constexpr U64 kSign = U64{1} << 63, kExponent = U64{0x7FF} << 52, kQuiet = U64{1} << 51;
constexpr U64 kDefaultNan = kExponent | kQuiet;
constexpr U32 kDefaultNanSingle = 0x7FC00000;

constexpr bool is_nan(U64 x) {
  return (x & ~kSign) > kExponent;
}
constexpr bool is_signalling(U64 x) {
  return is_nan(x) && (x & kQuiet) == 0;
}
constexpr bool is_infinity(U64 x) {
  return (x & ~kSign) == kExponent;
}
constexpr bool is_zero(U64 x) {
  return (x & ~kSign) == 0;
}
constexpr bool is_denormal(U64 x) {
  return (x & kExponent) == 0 && !is_zero(x);
}

/// Returns the operand; if it is denormal, a zero of the same sign.
U64 operand(U64 x, U32& exceptions) {
  if (!is_denormal(x)) return x;
  exceptions |= double_exception::denormal;
  return x & kSign;
}

#if defined(__SSE2_MATH__)
/// Sets the host's rounding mode and clears its flags for the lifetime of this object. Changes only SSE's
/// environment: <cfenv> also changes the x87's, which takes several times as long as the arithmetic.
class HostEnvironment {
public:
  explicit HostEnvironment(Rounding rounding) : kept_(_mm_getcsr()) { _mm_setcsr(kMasked | mode(rounding)); }
  ~HostEnvironment() { _mm_setcsr(kept_); }
  HostEnvironment(const HostEnvironment&) = delete;
  HostEnvironment& operator=(const HostEnvironment&) = delete;

  static U32 exceptions() {
    const unsigned raised = _mm_getcsr();
    U32 exceptions = 0;
    if ((raised & _MM_EXCEPT_INVALID) != 0) exceptions |= double_exception::invalid;
    if ((raised & _MM_EXCEPT_OVERFLOW) != 0) exceptions |= double_exception::overflow;
    if ((raised & _MM_EXCEPT_INEXACT) != 0) exceptions |= double_exception::inexact;
    return exceptions;
  }

private:
  static constexpr unsigned kMasked = _MM_MASK_MASK;
  static unsigned mode(Rounding rounding) {
    constexpr unsigned modes[] = {_MM_ROUND_NEAREST, _MM_ROUND_TOWARD_ZERO, _MM_ROUND_UP, _MM_ROUND_DOWN};
    return modes[static_cast<unsigned>(rounding)];
  }
  unsigned kept_;
};
#else
/// Sets the host's rounding mode and clears its flags for the lifetime of this object.
class HostEnvironment {
public:
  explicit HostEnvironment(Rounding rounding) {
    constexpr int modes[] = {FE_TONEAREST, FE_TOWARDZERO, FE_UPWARD, FE_DOWNWARD};
    std::feholdexcept(&kept_);
    std::fesetround(modes[static_cast<unsigned>(rounding)]);
  }
  ~HostEnvironment() { std::fesetenv(&kept_); }
  HostEnvironment(const HostEnvironment&) = delete;
  HostEnvironment& operator=(const HostEnvironment&) = delete;

  static U32 exceptions() {
    const int raised = std::fetestexcept(FE_ALL_EXCEPT);
    U32 exceptions = 0;
    if ((raised & FE_INVALID) != 0) exceptions |= double_exception::invalid;
    if ((raised & FE_OVERFLOW) != 0) exceptions |= double_exception::overflow;
    if ((raised & FE_INEXACT) != 0) exceptions |= double_exception::inexact;
    return exceptions;
  }

private:
  std::fenv_t kept_;
};
#endif

/// Computes f(operands) on the host. Operands and result are volatile, because compilers move arithmetic
/// across changes of the environment.
template <class F, class... Operands>
[[gnu::noinline]] auto by_host(Rounding rounding, U32& exceptions, F f, Operands... operands) {
  const HostEnvironment environment(rounding);
  using Result = decltype(f(operands...));
  const volatile Result result = [&](const volatile Operands&... x) { return f(x...); }(operands...);
  const Result value = result;
  exceptions |= HostEnvironment::exceptions();
  return value;
}

/// Returns f(operands), or zero if the result, before rounding, is below the normal numbers.
template <class F, class... Operands>
auto rounded(Rounding rounding, U32& exceptions, F f, Operands... operands) {
  U32 raised = 0;
  const auto result = by_host(rounding, raised, f, operands...);
  using Result = std::remove_const_t<decltype(result)>;
  constexpr Result smallest = std::numeric_limits<Result>::min();
  const auto is_normal = [&](Result x) { return !(std::fabs(x) < smallest); };
  const bool inexact = (raised & double_exception::inexact) != 0;
  bool too_small = !is_normal(result) && (result != 0 || inexact);
  if (std::fabs(result) == smallest && inexact) {
    U32 ignored = 0;
    too_small = !is_normal(by_host(Rounding::to_zero, ignored, f, operands...));
  }
  exceptions |= raised;
  if (!too_small) return result;
  exceptions |= double_exception::underflow | double_exception::inexact;
  return std::copysign(Result{0}, result);
}

U64 bits_of(double result) {
  return std::isnan(result) ? kDefaultNan : std::bit_cast<U64>(result);
}

/// Returns true if the result is a NaN because an operand is a NaN. Adds to `exceptions`.
template <class... Operands> bool has_nan(U32& exceptions, Operands... operands) {
  if (!(is_nan(operands) || ...)) return false;
  exceptions |= double_exception::nan;
  if ((is_signalling(operands) || ...)) exceptions |= double_exception::invalid;
  return true;
}

constexpr auto number = [](U64 bits) { return std::bit_cast<double>(bits); };

/// Computes rt = f(ra, rb) in both slots.
template <class F> void operation(State& state, const Instruction& i, F f) {
  Quadword result;
  for (unsigned slot = 0; slot < 2; ++slot) {
    U32 exceptions = 0;
    const U64 a = operand(state.gpr[i.ra].doubleword(slot), exceptions);
    const U64 b = operand(state.gpr[i.rb].doubleword(slot), exceptions);
    U64 bits = kDefaultNan;
    if (!has_nan(exceptions, a, b)) {
      const Rounding rounding = double_rounding(state.fpscr, slot);
      bits = bits_of(rounded(rounding, exceptions, f, number(a), number(b)));
    }
    raise_double(state.fpscr, slot, exceptions);
    result.set(slot, bits);
  }
  state.gpr[i.rt] = result;
}

struct Signs {
  bool minus_rt, negative;
};

/// Computes rt = ra * rb + rt or rt = ra * rb - rt, rounded once. `signs` may negate the result, unless it is
/// a NaN.
void multiply_add(State& state, const Instruction& i, Signs signs) {
  Quadword result;
  for (unsigned slot = 0; slot < 2; ++slot) {
    U32 exceptions = 0;
    const U64 a = operand(state.gpr[i.ra].doubleword(slot), exceptions);
    const U64 b = operand(state.gpr[i.rb].doubleword(slot), exceptions);
    const U64 c = operand(state.gpr[i.rt].doubleword(slot), exceptions);
    U64 bits = kDefaultNan;
    if (has_nan(exceptions, a, b, c)) {
      if ((is_infinity(a) && is_zero(b)) || (is_zero(a) && is_infinity(b)))
        exceptions |= double_exception::invalid;
    } else {
      constexpr auto f = [](double x, double y, double z) { return std::fma(x, y, z); };
      const double z = signs.minus_rt ? -number(c) : number(c);
      const Rounding rounding = double_rounding(state.fpscr, slot);
      bits = bits_of(rounded(rounding, exceptions, f, number(a), number(b), z));
      if (signs.negative && !is_nan(bits)) bits ^= kSign;
    }
    raise_double(state.fpscr, slot, exceptions);
    result.set(slot, bits);
  }
  state.gpr[i.rt] = result;
}

U64 extended(U32 single, U32& exceptions) {
  const U64 sign = static_cast<U64>(single & 0x80000000) << 32, rest = single & 0x7FFFFFFF;
  if (rest == 0) return sign;
  if (rest < 0x00800000) {
    exceptions |= double_exception::denormal;
    return sign;
  }
  if (rest > 0x7F800000) {
    exceptions |= double_exception::nan;
    if ((rest & 0x00400000) == 0) exceptions |= double_exception::invalid;
    return kDefaultNan;
  }
  if (rest == 0x7F800000) return sign | kExponent;
  return sign | ((rest << 29) + (U64{1023 - 127} << 52));
}

U32 shortened(U64 value, Rounding rounding, U32& exceptions) {
  const U64 bits = operand(value, exceptions);
  if (has_nan(exceptions, bits)) return kDefaultNanSingle;
  constexpr auto f = [](double x) { return static_cast<float>(x); };
  return std::bit_cast<U32>(rounded(rounding, exceptions, f, number(bits)));
}

/// Returns an integer for compares: integers of two numbers are ordered as the numbers. Not for NaN.
constexpr std::int64_t ordered(U64 x) {
  const auto rest = static_cast<std::int64_t>((x & kExponent) == 0 ? 0 : x & ~kSign);
  return (x & kSign) != 0 ? -rest : rest;
}
constexpr U64 without_sign(U64 x) {
  return x & ~kSign;
}
constexpr U64 equal(U64 x, U64 y) {
  return mask_of<U64>(!is_nan(x) && !is_nan(y) && ordered(x) == ordered(y));
}
constexpr U64 greater(U64 x, U64 y) {
  return mask_of<U64>(!is_nan(x) && !is_nan(y) && ordered(x) > ordered(y));
}

constexpr bool is_special(U64 x, U32 tests) {
  const bool negative = (x & kSign) != 0;
  U32 is = 0;
  if (is_nan(x)) is = 0x40;
  if (is_infinity(x)) is = negative ? 0x10 : 0x20;
  if (is_zero(x)) is = negative ? 0x04 : 0x08;
  if (is_denormal(x)) is = negative ? 0x01 : 0x02;
  return (is & tests) != 0;
}

} // namespace

void dfa(State& state, const Instruction& i) {
  operation(state, i, [](double x, double y) { return x + y; });
}
void dfs(State& state, const Instruction& i) {
  operation(state, i, [](double x, double y) { return x - y; });
}
void dfm(State& state, const Instruction& i) {
  operation(state, i, [](double x, double y) { return x * y; });
}
void dfma(State& state, const Instruction& i) {
  multiply_add(state, i, {.minus_rt = false, .negative = false});
}
void dfms(State& state, const Instruction& i) {
  multiply_add(state, i, {.minus_rt = true, .negative = false});
}
void dfnms(State& state, const Instruction& i) {
  multiply_add(state, i, {.minus_rt = true, .negative = true});
}
void dfnma(State& state, const Instruction& i) {
  multiply_add(state, i, {.minus_rt = false, .negative = true});
}

// Converts the left word of each slot, a single in IEEE's format, in which the exponent 255 means infinity or
// NaN.
void fesd(State& state, const Instruction& i) {
  Quadword result;
  for (unsigned slot = 0; slot < 2; ++slot) {
    U32 exceptions = 0;
    result.set(slot, extended(state.gpr[i.ra].word(2 * slot), exceptions));
    raise_double(state.fpscr, slot, exceptions);
  }
  state.gpr[i.rt] = result;
}
void frds(State& state, const Instruction& i) {
  Quadword result = Quadword::zero();
  for (unsigned slot = 0; slot < 2; ++slot) {
    U32 exceptions = 0;
    const Rounding rounding = double_rounding(state.fpscr, slot);
    result.set(2 * slot, shortened(state.gpr[i.ra].doubleword(slot), rounding, exceptions));
    raise_double(state.fpscr, slot, exceptions);
  }
  state.gpr[i.rt] = result;
}

void dfceq(State& state, const Instruction& i) {
  of_ra_rb<U64>(state, i, equal);
}
void dfcmeq(State& state, const Instruction& i) {
  of_ra_rb<U64>(state, i, [](U64 x, U64 y) { return equal(without_sign(x), without_sign(y)); });
}
void dfcgt(State& state, const Instruction& i) {
  of_ra_rb<U64>(state, i, greater);
}
void dfcmgt(State& state, const Instruction& i) {
  of_ra_rb<U64>(state, i, [](U64 x, U64 y) { return greater(without_sign(x), without_sign(y)); });
}
void dftsv(State& state, const Instruction& i) {
  const auto tests = static_cast<U32>(i.immediate);
  of_ra<U64>(state, i, [=](U64 x) { return mask_of<U64>(is_special(x, tests)); });
}

} // namespace celltrace::isa::execute

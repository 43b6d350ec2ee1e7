// Execution: single precision. Sums, products and conversions from integers set the FPSCR's flags of
// overflow, underflow and "differs from IEEE"; estimates set the flags of division by zero. Flags that fi and
// conversions to integers may set are not modelled.
#include "backends/cell_emu/isa/single_float.hpp"
#include "backends/cell_emu/isa/estimate.hpp"
#include "backends/cell_emu/isa/execute.hpp"
#include "backends/cell_emu/isa/floating_status.hpp"
#include "backends/cell_emu/isa/parts.hpp"

namespace celltrace::isa::execute {
namespace {

using U32 = std::uint32_t;
using S32 = std::int32_t;
/// Four numbers, or results before rounding: of the low words and of the high words of both doublewords.
struct Exact {
  Doubles low, high;
};

inline Bits words(const Quadword& q) {
  return std::bit_cast<Bits>(q);
}
inline Exact exact(Bits from) {
  return {from_single(from & 0xFFFFFFFF), from_single(from >> 32)};
}

/// Returns the exception flags of the results in two slots.
Bits flags_of(Doubles x) {
  const Bits overflow = reaches_mask(x, 0x1p129), underflow = underflow_mask(x);
  const Bits differs = reaches_mask(x, 0x1p128) | underflow;
  return (overflow & single_exception::overflow) | (underflow & single_exception::underflow) |
         (differs & single_exception::differs);
}

[[gnu::noinline]] Quadword rounded_with_flags(Quadword& fpscr, const Exact& value, Bits differing_operands) {
  constexpr std::uint64_t kBothDiffer =
      std::uint64_t{single_exception::differs} << 32 | single_exception::differs;
  // The flags of a slot are the lowest bits of its word.
  const Bits raised = flags_of(value.low) | flags_of(value.high) << 32 | (differing_operands & kBothDiffer);
  fpscr = std::bit_cast<Quadword>(std::bit_cast<Bits>(fpscr) | raised);
  return std::bit_cast<Quadword>(to_single(value.low) | to_single(value.high) << 32);
}

/// Rounds results and raises flags. Numbers that raise flags or are too large are rare, so one test finds out
/// whether there are any.
inline Quadword rounded(State& state, const Exact& value, Bits differing_operands) {
  const Bits odd = differing_operands | underflow_mask(value.low) | underflow_mask(value.high) |
                   reaches_mask(value.low, 0x1p128) | reaches_mask(value.high, 0x1p128);
  if ((odd[0] | odd[1]) != 0) [[unlikely]]
    return rounded_with_flags(state.fpscr, value, differing_operands);
  return std::bit_cast<Quadword>(to_single_in_range(value.low) | to_single_in_range(value.high) << 32);
}

/// Computes rt = f(ra, rb).
template <class F> inline void operation(State& state, const Instruction& i, F f) {
  const Bits a = words(state.gpr[i.ra]), b = words(state.gpr[i.rb]);
  const Exact x = exact(a), y = exact(b);
  state.gpr[i.rt] = rounded(state, {f(x.low, y.low), f(x.high, y.high)}, differs_mask(a) | differs_mask(b));
}
/// Computes rt = f(ra * rb, rc).
template <class F> inline void of_product(State& state, const Instruction& i, F f) {
  const Bits a = words(state.gpr[i.ra]), b = words(state.gpr[i.rb]), c = words(state.gpr[i.rc]);
  const Exact x = exact(a), y = exact(b), z = exact(c);
  state.gpr[i.rt] = rounded(state, {f(x.low * y.low, z.low), f(x.high * y.high, z.high)},
                            differs_mask(a) | differs_mask(b) | differs_mask(c));
}

/// Returns 2^exponent, for -1022 to 1023.
constexpr double power_of_two(S32 exponent) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(1023 + exponent) << 52);
}

template <class Integer> inline void from_integer(State& state, const Instruction& i) {
  const auto numbers = parts<Integer>(state.gpr[i.ra]);
  const double scale = power_of_two(-i.immediate);
  constexpr unsigned low = Quadword::kReversed ? 0 : 1, high = 1 - low;
  const Doubles low_numbers = {static_cast<double>(numbers[low]), static_cast<double>(numbers[low + 2])};
  const Doubles high_numbers = {static_cast<double>(numbers[high]), static_cast<double>(numbers[high + 2])};
  state.gpr[i.rt] = rounded(state, {low_numbers * scale, high_numbers * scale}, Bits{});
}

/// Returns a single times `scale`, which callers cut to an integer.
double scaled(U32 single, double scale) {
  return from_single(Bits{single, 0})[0] * scale;
}

void raise_divisions_by_zero(State& state, const Quadword& divisor) {
  for (unsigned slot = 0; slot < 4; ++slot)
    if ((divisor.word(slot) & 0x7F800000) == 0) raise_division_by_zero(state.fpscr, slot);
}

} // namespace

void fa(State& state, const Instruction& i) {
  operation(state, i, [](Doubles x, Doubles y) { return sum_towards_zero(x, y); });
}
void fs(State& state, const Instruction& i) {
  operation(state, i, [](Doubles x, Doubles y) { return sum_towards_zero(x, -y); });
}
void fm(State& state, const Instruction& i) {
  operation(state, i, [](Doubles x, Doubles y) { return x * y; });
}
void fma(State& state, const Instruction& i) {
  of_product(state, i, [](Doubles product, Doubles z) { return sum_towards_zero(product, z); });
}
void fms(State& state, const Instruction& i) {
  of_product(state, i, [](Doubles product, Doubles z) { return sum_towards_zero(product, -z); });
}
void fnms(State& state, const Instruction& i) {
  of_product(state, i, [](Doubles product, Doubles z) { return sum_towards_zero(z, -product); });
}

void frest(State& state, const Instruction& i) {
  raise_divisions_by_zero(state, state.gpr[i.ra]);
  of_ra<U32>(state, i, reciprocal_estimate);
}
void frsqest(State& state, const Instruction& i) {
  raise_divisions_by_zero(state, state.gpr[i.ra]);
  of_ra<U32>(state, i, reciprocal_square_root_estimate);
}
void fi(State& state, const Instruction& i) {
  of_ra_rb<U32>(state, i, interpolate);
}

void csflt(State& state, const Instruction& i) {
  from_integer<S32>(state, i);
}
void cuflt(State& state, const Instruction& i) {
  from_integer<U32>(state, i);
}
void cflts(State& state, const Instruction& i) {
  const double scale = power_of_two(i.immediate);
  of_ra<U32>(state, i, [=](U32 x) {
    const double value = scaled(x, scale);
    const double limited = value > 0x7FFFFFFF ? 0x7FFFFFFF : value < -0x1p31 ? -0x1p31 : value;
    return static_cast<U32>(static_cast<S32>(limited));
  });
}
void cfltu(State& state, const Instruction& i) {
  const double scale = power_of_two(i.immediate);
  of_ra<U32>(state, i, [=](U32 x) {
    const double value = scaled(x, scale);
    const double limited = value > 0xFFFFFFFF ? 0xFFFFFFFF : value < 0 ? 0 : value;
    return static_cast<U32>(static_cast<std::int64_t>(limited));
  });
}

void fceq(State& state, const Instruction& i) {
  of_ra_rb<U32>(state, i, [](U32 x, U32 y) { return mask_of<U32>(ordered(x) == ordered(y)); });
}
void fcmeq(State& state, const Instruction& i) {
  of_ra_rb<U32>(state, i,
                [](U32 x, U32 y) { return mask_of<U32>(ordered_magnitude(x) == ordered_magnitude(y)); });
}
void fcgt(State& state, const Instruction& i) {
  of_ra_rb<U32>(state, i, [](U32 x, U32 y) { return mask_of<U32>(ordered(x) > ordered(y)); });
}
void fcmgt(State& state, const Instruction& i) {
  of_ra_rb<U32>(state, i,
                [](U32 x, U32 y) { return mask_of<U32>(ordered_magnitude(x) > ordered_magnitude(y)); });
}

} // namespace celltrace::isa::execute

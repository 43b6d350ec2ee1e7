// Execution: single precision. Of the FPSCR's flags those of overflow, underflow and "differs from IEEE" are
// kept for sums, products and conversions from integers, and those of division by zero for the estimates;
// what fi and the conversions to integers may set is not modelled.
#include "backends/cell_emu/isa/single_float.hpp"
#include "backends/cell_emu/isa/estimate.hpp"
#include "backends/cell_emu/isa/execute.hpp"
#include "backends/cell_emu/isa/floating_status.hpp"
#include "backends/cell_emu/isa/parts.hpp"

namespace celltrace::isa::execute {
namespace {

using U32 = std::uint32_t;
using S32 = std::int32_t;
using Words = Parts<U32>;

/// The slot that the k-th part in the host's order is.
constexpr unsigned slot_of(unsigned k) {
  return Quadword::kReversed ? 3 - k : k;
}

/// Results before they become singles, and what to look for in a slot: operands that IEEE takes differently.
struct Exact {
  std::array<double, 4> value;
  Words odd_operand;
};

[[gnu::noinline]] void raise_flags(Quadword& fpscr, const Exact& exact) {
  for (unsigned k = 0; k < 4; ++k) {
    U32 exceptions = 0;
    if (magnitude(exact.value[k]) >= 0x1p129) exceptions |= single_exception::overflow;
    if (underflow_mask(exact.value[k]) != 0) exceptions |= single_exception::underflow;
    if ((exceptions | exact.odd_operand[k] | differs_mask(to_single(exact.value[k]))) != 0)
      exceptions |= single_exception::differs;
    raise_single(fpscr, slot_of(k), exceptions);
  }
}

/// Flags are rare: one test says whether there is any.
inline Quadword rounded(State& state, const Exact& exact) {
  Words result, odd;
  for (unsigned k = 0; k < 4; ++k) {
    result[k] = to_single(exact.value[k]);
    odd[k] = exact.odd_operand[k] | differs_mask(result[k]) | underflow_mask(exact.value[k]);
  }
  if ((odd[0] | odd[1] | odd[2] | odd[3]) != 0) [[unlikely]]
    raise_flags(state.fpscr, exact);
  return quadword<U32>(result);
}

/// rt = f(ra, rb)
template <class F> inline void operation(State& state, const Instruction& i, F f) {
  const auto a = parts<U32>(state.gpr[i.ra]), b = parts<U32>(state.gpr[i.rb]);
  Exact exact;
  for (unsigned k = 0; k < 4; ++k) {
    exact.value[k] = f(from_single(a[k]), from_single(b[k]));
    exact.odd_operand[k] = differs_mask(a[k]) | differs_mask(b[k]);
  }
  state.gpr[i.rt] = rounded(state, exact);
}
/// rt = f(ra * rb, rc)
template <class F> inline void of_product(State& state, const Instruction& i, F f) {
  const auto a = parts<U32>(state.gpr[i.ra]), b = parts<U32>(state.gpr[i.rb]),
             c = parts<U32>(state.gpr[i.rc]);
  Exact exact;
  for (unsigned k = 0; k < 4; ++k) {
    exact.value[k] = f(from_single(a[k]) * from_single(b[k]), from_single(c[k]));
    exact.odd_operand[k] = differs_mask(a[k]) | differs_mask(b[k]) | differs_mask(c[k]);
  }
  state.gpr[i.rt] = rounded(state, exact);
}

/// 2^exponent, of -1022 to 1023
constexpr double power_of_two(S32 exponent) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(1023 + exponent) << 52);
}

template <class Integer> inline void from_integer(State& state, const Instruction& i) {
  const auto a = parts<Integer>(state.gpr[i.ra]);
  const double scale = power_of_two(-i.immediate);
  Exact exact{};
  for (unsigned k = 0; k < 4; ++k)
    exact.value[k] = static_cast<double>(a[k]) * scale;
  state.gpr[i.rt] = rounded(state, exact);
}

void raise_divisions_by_zero(State& state, const Quadword& divisor) {
  for (unsigned slot = 0; slot < 4; ++slot)
    if ((divisor.word(slot) & 0x7F800000) == 0) raise_division_by_zero(state.fpscr, slot);
}

} // namespace

void fa(State& state, const Instruction& i) {
  operation(state, i, [](double x, double y) { return sum_towards_zero(x, y); });
}
void fs(State& state, const Instruction& i) {
  operation(state, i, [](double x, double y) { return sum_towards_zero(x, -y); });
}
void fm(State& state, const Instruction& i) {
  operation(state, i, [](double x, double y) { return x * y; });
}
void fma(State& state, const Instruction& i) {
  of_product(state, i, [](double product, double z) { return sum_towards_zero(product, z); });
}
void fms(State& state, const Instruction& i) {
  of_product(state, i, [](double product, double z) { return sum_towards_zero(product, -z); });
}
void fnms(State& state, const Instruction& i) {
  of_product(state, i, [](double product, double z) { return sum_towards_zero(z, -product); });
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
    const double scaled = from_single(x) * scale;
    const double limited = scaled > 0x7FFFFFFF ? 0x7FFFFFFF : scaled < -0x1p31 ? -0x1p31 : scaled;
    return static_cast<U32>(static_cast<S32>(limited));
  });
}
void cfltu(State& state, const Instruction& i) {
  const double scale = power_of_two(i.immediate);
  of_ra<U32>(state, i, [=](U32 x) {
    const double scaled = from_single(x) * scale;
    const double limited = scaled > 0xFFFFFFFF ? 0xFFFFFFFF : scaled < 0 ? 0 : scaled;
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

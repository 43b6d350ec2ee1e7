// Execution: constants, integer arithmetic and logic, shifts of halfwords and words, compares, halts.
#include "backends/cell_emu/isa/execute.hpp"
#include "backends/cell_emu/isa/parts.hpp"

namespace celltrace::isa::execute {
namespace {

using U8 = std::uint8_t;
using U16 = std::uint16_t;
using U32 = std::uint32_t;
using S8 = std::int8_t;
using S16 = std::int16_t;
using S32 = std::int32_t;

constexpr S32 low(U32 word) {
  return static_cast<S16>(word);
}
constexpr S32 high(U32 word) {
  return static_cast<S32>(word) >> 16;
}
constexpr U32 low_unsigned(U32 word) {
  return word & 0xFFFF;
}
constexpr U32 product(S32 x, S32 y) {
  return static_cast<U32>(x * y); // products of halfwords cannot overflow
}
/// Counts the ones. Compilers vectorise this for all bytes, but not std::popcount(), which would look up each
/// byte in a table.
constexpr U8 ones_of_byte(U8 x) {
  const U8 pairs = static_cast<U8>(x - ((x >> 1) & 0x55));
  const U8 nibbles = static_cast<U8>((pairs & 0x33) + ((pairs >> 2) & 0x33));
  return static_cast<U8>((nibbles + (nibbles >> 4)) & 0x0F);
}
constexpr U32 sum_of_bytes(U32 x) {
  return (x >> 24) + (x >> 16 & 0xFF) + (x >> 8 & 0xFF) + (x & 0xFF);
}

template <class Part> constexpr unsigned kBits = 8 * sizeof(Part);

// A count has one bit more than the width of a part needs; a count above the width shifts everything out.
template <class Part> constexpr Part shift_left(Part x, U32 count) {
  count &= 2 * kBits<Part> - 1;
  return static_cast<Part>(count < kBits<Part> ? static_cast<U32>(x) << count : 0);
}
template <class Part> constexpr Part rotate_left(Part x, U32 count) {
  return std::rotl(x, static_cast<int>(count & (kBits<Part> - 1)));
}
/// Shifts right by the negated count: "rotate and mask".
template <class Part> constexpr Part shift_right(Part x, U32 count) {
  count = (0 - count) & (2 * kBits<Part> - 1);
  return static_cast<Part>(count < kBits<Part> ? static_cast<U32>(x) >> count : 0);
}
template <class Part> constexpr Part shift_right_algebraic(Part x, U32 count) {
  count = (0 - count) & (2 * kBits<Part> - 1);
  if (count >= kBits<Part>) count = kBits<Part> - 1;
  return static_cast<Part>(static_cast<std::make_signed_t<Part>>(x) >> count);
}

constexpr auto equal = [](auto x, auto y) { return mask_of<decltype(x)>(x == y); };
constexpr auto greater = [](auto x, auto y) { return mask_of<decltype(x)>(x > y); };

} // namespace

// Constants.

void ilh(State& state, const Instruction& i) {
  state.gpr[i.rt] = Quadword::splat(static_cast<U32>(i.immediate) * 0x10001);
}
void ilhu(State& state, const Instruction& i) {
  state.gpr[i.rt] = Quadword::splat(static_cast<U32>(i.immediate) << 16);
}
void il(State& state, const Instruction& i) {
  state.gpr[i.rt] = Quadword::splat(static_cast<U32>(i.immediate));
}
void ila(State& state, const Instruction& i) {
  state.gpr[i.rt] = Quadword::splat(static_cast<U32>(i.immediate));
}
void iohl(State& state, const Instruction& i) {
  const auto low_half = static_cast<U32>(i.immediate);
  state.gpr[i.rt] = map<U32>(state.gpr[i.rt], [=](U32 x) { return x | low_half; });
}

// Integers.

void ah(State& state, const Instruction& i) {
  of_ra_rb<U16>(state, i, [](U16 x, U16 y) { return x + y; });
}
void a(State& state, const Instruction& i) {
  of_ra_rb<U32>(state, i, [](U32 x, U32 y) { return x + y; });
}
void ahi(State& state, const Instruction& i) {
  of_ra_immediate<U16>(state, i, [](U16 x, U16 y) { return x + y; });
}
void ai(State& state, const Instruction& i) {
  of_ra_immediate<U32>(state, i, [](U32 x, U32 y) { return x + y; });
}
void sfh(State& state, const Instruction& i) {
  of_ra_rb<U16>(state, i, [](U16 x, U16 y) { return y - x; });
}
void sf(State& state, const Instruction& i) {
  of_ra_rb<U32>(state, i, [](U32 x, U32 y) { return y - x; });
}
void sfhi(State& state, const Instruction& i) {
  of_ra_immediate<U16>(state, i, [](U16 x, U16 y) { return y - x; });
}
void sfi(State& state, const Instruction& i) {
  of_ra_immediate<U32>(state, i, [](U32 x, U32 y) { return y - x; });
}

// Carry and borrow are in the lowest bit of a word; a borrow bit of 1 means no borrow.
void cg(State& state, const Instruction& i) {
  of_ra_rb<U32>(state, i, [](U32 x, U32 y) { return x + y < x; });
}
void bg(State& state, const Instruction& i) {
  of_ra_rb<U32>(state, i, [](U32 x, U32 y) { return y >= x; });
}
void addx(State& state, const Instruction& i) {
  of_ra_rb_rt<U32>(state, i, [](U32 x, U32 y, U32 c) { return x + y + (c & 1); });
}
void sfx(State& state, const Instruction& i) {
  of_ra_rb_rt<U32>(state, i, [](U32 x, U32 y, U32 c) { return y + ~x + (c & 1); });
}
void cgx(State& state, const Instruction& i) {
  of_ra_rb_rt<U32>(state, i, [](U32 x, U32 y, U32 c) { return (c & 1) != 0 ? x >= ~y : x > ~y; });
}
void bgx(State& state, const Instruction& i) {
  of_ra_rb_rt<U32>(state, i, [](U32 x, U32 y, U32 c) { return (c & 1) != 0 ? y >= x : y > x; });
}

void mpy(State& state, const Instruction& i) {
  of_ra_rb<U32>(state, i, [](U32 x, U32 y) { return product(low(x), low(y)); });
}
void mpyu(State& state, const Instruction& i) {
  of_ra_rb<U32>(state, i, [](U32 x, U32 y) { return low_unsigned(x) * low_unsigned(y); });
}
void mpyh(State& state, const Instruction& i) {
  of_ra_rb<U32>(state, i, [](U32 x, U32 y) { return ((x >> 16) * low_unsigned(y)) << 16; });
}
void mpys(State& state, const Instruction& i) {
  of_ra_rb<U32>(state, i, [](U32 x, U32 y) { return (low(x) * low(y)) >> 16; });
}
void mpyhh(State& state, const Instruction& i) {
  of_ra_rb<U32>(state, i, [](U32 x, U32 y) { return product(high(x), high(y)); });
}
void mpyhhu(State& state, const Instruction& i) {
  of_ra_rb<U32>(state, i, [](U32 x, U32 y) { return (x >> 16) * (y >> 16); });
}
void mpyhha(State& state, const Instruction& i) {
  of_ra_rb_rt<U32>(state, i, [](U32 x, U32 y, U32 z) { return product(high(x), high(y)) + z; });
}
void mpyhhau(State& state, const Instruction& i) {
  of_ra_rb_rt<U32>(state, i, [](U32 x, U32 y, U32 z) { return (x >> 16) * (y >> 16) + z; });
}
void mpyi(State& state, const Instruction& i) {
  of_ra_immediate<U32>(state, i, [](U32 x, U32 y) { return product(low(x), low(y)); });
}
void mpyui(State& state, const Instruction& i) {
  of_ra_immediate<U32>(state, i, [](U32 x, U32 y) { return low_unsigned(x) * low_unsigned(y); });
}
void mpya(State& state, const Instruction& i) {
  of_ra_rb_rc<U32>(state, i, [](U32 x, U32 y, U32 z) { return product(low(x), low(y)) + z; });
}

void clz(State& state, const Instruction& i) {
  // Counts in 64 bits, where a bit behind the word ends the count at 32. Counting in 32 bits fails without
  // POWER's vectors: GCC 12 then takes two words in one register for one number.
  of_ra<U32>(state, i, [](U32 x) { return std::countl_zero(std::uint64_t{x} << 32 | 0x80000000u); });
}
void cntb(State& state, const Instruction& i) {
  of_ra<U8>(state, i, ones_of_byte);
}
void avgb(State& state, const Instruction& i) {
  of_ra_rb<U8>(state, i, [](U8 x, U8 y) { return (x + y + 1) >> 1; });
}
void absdb(State& state, const Instruction& i) {
  of_ra_rb<U8>(state, i, [](U8 x, U8 y) { return x > y ? x - y : y - x; });
}
void sumb(State& state, const Instruction& i) {
  of_ra_rb<U32>(state, i, [](U32 x, U32 y) { return sum_of_bytes(y) << 16 | sum_of_bytes(x); });
}
void xsbh(State& state, const Instruction& i) {
  of_ra<U16>(state, i, [](U16 x) { return static_cast<S8>(x); });
}
void xshw(State& state, const Instruction& i) {
  of_ra<U32>(state, i, [](U32 x) { return static_cast<S16>(x); });
}
void xswd(State& state, const Instruction& i) {
  of_ra<std::uint64_t>(state, i, [](std::uint64_t x) { return static_cast<S32>(x); });
}

// Logic.

void and_(State& state, const Instruction& i) {
  of_ra_rb<U32>(state, i, [](U32 x, U32 y) { return x & y; });
}
void andc(State& state, const Instruction& i) {
  of_ra_rb<U32>(state, i, [](U32 x, U32 y) { return x & ~y; });
}
void or_(State& state, const Instruction& i) {
  of_ra_rb<U32>(state, i, [](U32 x, U32 y) { return x | y; });
}
void orc(State& state, const Instruction& i) {
  of_ra_rb<U32>(state, i, [](U32 x, U32 y) { return x | ~y; });
}
void xor_(State& state, const Instruction& i) {
  of_ra_rb<U32>(state, i, [](U32 x, U32 y) { return x ^ y; });
}
void nand(State& state, const Instruction& i) {
  of_ra_rb<U32>(state, i, [](U32 x, U32 y) { return ~(x & y); });
}
void nor(State& state, const Instruction& i) {
  of_ra_rb<U32>(state, i, [](U32 x, U32 y) { return ~(x | y); });
}
void eqv(State& state, const Instruction& i) {
  of_ra_rb<U32>(state, i, [](U32 x, U32 y) { return ~(x ^ y); });
}
void andbi(State& state, const Instruction& i) {
  of_ra_immediate<U8>(state, i, [](U8 x, U8 y) { return x & y; });
}
void andhi(State& state, const Instruction& i) {
  of_ra_immediate<U16>(state, i, [](U16 x, U16 y) { return x & y; });
}
void andi(State& state, const Instruction& i) {
  of_ra_immediate<U32>(state, i, [](U32 x, U32 y) { return x & y; });
}
void orbi(State& state, const Instruction& i) {
  of_ra_immediate<U8>(state, i, [](U8 x, U8 y) { return x | y; });
}
void orhi(State& state, const Instruction& i) {
  of_ra_immediate<U16>(state, i, [](U16 x, U16 y) { return x | y; });
}
void ori(State& state, const Instruction& i) {
  of_ra_immediate<U32>(state, i, [](U32 x, U32 y) { return x | y; });
}
void xorbi(State& state, const Instruction& i) {
  of_ra_immediate<U8>(state, i, [](U8 x, U8 y) { return x ^ y; });
}
void xorhi(State& state, const Instruction& i) {
  of_ra_immediate<U16>(state, i, [](U16 x, U16 y) { return x ^ y; });
}
void xori(State& state, const Instruction& i) {
  of_ra_immediate<U32>(state, i, [](U32 x, U32 y) { return x ^ y; });
}
void selb(State& state, const Instruction& i) {
  of_ra_rb_rc<U32>(state, i, [](U32 x, U32 y, U32 m) { return (y & m) | (x & ~m); });
}

// Shifts and rotates.

void shlh(State& state, const Instruction& i) {
  of_ra_rb<U16>(state, i, shift_left<U16>);
}
void shl(State& state, const Instruction& i) {
  of_ra_rb<U32>(state, i, shift_left<U32>);
}
void roth(State& state, const Instruction& i) {
  of_ra_rb<U16>(state, i, rotate_left<U16>);
}
void rot(State& state, const Instruction& i) {
  of_ra_rb<U32>(state, i, rotate_left<U32>);
}
void rothm(State& state, const Instruction& i) {
  of_ra_rb<U16>(state, i, shift_right<U16>);
}
void rotm(State& state, const Instruction& i) {
  of_ra_rb<U32>(state, i, shift_right<U32>);
}
void rotmah(State& state, const Instruction& i) {
  of_ra_rb<U16>(state, i, shift_right_algebraic<U16>);
}
void rotma(State& state, const Instruction& i) {
  of_ra_rb<U32>(state, i, shift_right_algebraic<U32>);
}
void shlhi(State& state, const Instruction& i) {
  of_ra_immediate<U16>(state, i, shift_left<U16>);
}
void shli(State& state, const Instruction& i) {
  of_ra_immediate<U32>(state, i, shift_left<U32>);
}
void rothi(State& state, const Instruction& i) {
  of_ra_immediate<U16>(state, i, rotate_left<U16>);
}
void roti(State& state, const Instruction& i) {
  of_ra_immediate<U32>(state, i, rotate_left<U32>);
}
void rothmi(State& state, const Instruction& i) {
  of_ra_immediate<U16>(state, i, shift_right<U16>);
}
void rotmi(State& state, const Instruction& i) {
  of_ra_immediate<U32>(state, i, shift_right<U32>);
}
void rotmahi(State& state, const Instruction& i) {
  of_ra_immediate<U16>(state, i, shift_right_algebraic<U16>);
}
void rotmai(State& state, const Instruction& i) {
  of_ra_immediate<U32>(state, i, shift_right_algebraic<U32>);
}

// Compares.

void ceqb(State& state, const Instruction& i) {
  of_ra_rb<U8>(state, i, equal);
}
void ceqh(State& state, const Instruction& i) {
  of_ra_rb<U16>(state, i, equal);
}
void ceq(State& state, const Instruction& i) {
  of_ra_rb<U32>(state, i, equal);
}
void cgtb(State& state, const Instruction& i) {
  of_ra_rb<S8>(state, i, greater);
}
void cgth(State& state, const Instruction& i) {
  of_ra_rb<S16>(state, i, greater);
}
void cgt(State& state, const Instruction& i) {
  of_ra_rb<S32>(state, i, greater);
}
void clgtb(State& state, const Instruction& i) {
  of_ra_rb<U8>(state, i, greater);
}
void clgth(State& state, const Instruction& i) {
  of_ra_rb<U16>(state, i, greater);
}
void clgt(State& state, const Instruction& i) {
  of_ra_rb<U32>(state, i, greater);
}
void ceqbi(State& state, const Instruction& i) {
  of_ra_immediate<U8>(state, i, equal);
}
void ceqhi(State& state, const Instruction& i) {
  of_ra_immediate<U16>(state, i, equal);
}
void ceqi(State& state, const Instruction& i) {
  of_ra_immediate<U32>(state, i, equal);
}
void cgtbi(State& state, const Instruction& i) {
  of_ra_immediate<S8>(state, i, greater);
}
void cgthi(State& state, const Instruction& i) {
  of_ra_immediate<S16>(state, i, greater);
}
void cgti(State& state, const Instruction& i) {
  of_ra_immediate<S32>(state, i, greater);
}
void clgtbi(State& state, const Instruction& i) {
  of_ra_immediate<U8>(state, i, greater);
}
void clgthi(State& state, const Instruction& i) {
  of_ra_immediate<U16>(state, i, greater);
}
void clgti(State& state, const Instruction& i) {
  of_ra_immediate<U32>(state, i, greater);
}

// Halts, which compare the preferred slot alone.

namespace {

void halt_if(State& state, bool condition) {
  if (condition) [[unlikely]]
    state.environment->halt();
}
U32 word_ra(const State& state, const Instruction& i) {
  return state.gpr[i.ra].word(0);
}
U32 word_rb(const State& state, const Instruction& i) {
  return state.gpr[i.rb].word(0);
}

} // namespace

void heq(State& state, const Instruction& i) {
  halt_if(state, word_ra(state, i) == word_rb(state, i));
}
void hgt(State& state, const Instruction& i) {
  halt_if(state, static_cast<S32>(word_ra(state, i)) > static_cast<S32>(word_rb(state, i)));
}
void hlgt(State& state, const Instruction& i) {
  halt_if(state, word_ra(state, i) > word_rb(state, i));
}
void heqi(State& state, const Instruction& i) {
  halt_if(state, word_ra(state, i) == static_cast<U32>(i.immediate));
}
void hgti(State& state, const Instruction& i) {
  halt_if(state, static_cast<S32>(word_ra(state, i)) > i.immediate);
}
void hlgti(State& state, const Instruction& i) {
  halt_if(state, word_ra(state, i) > static_cast<U32>(i.immediate));
}

} // namespace celltrace::isa::execute

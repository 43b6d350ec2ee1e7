// Execution: instructions on quadwords as a whole.
#include "backends/cell_emu/isa/execute.hpp"
#include "backends/cell_emu/isa/parts.hpp"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace celltrace::isa::execute {
namespace {

using U32 = std::uint32_t;
using U64 = std::uint64_t;

struct Wide {
  U64 high, low;
};
Wide wide(const Quadword& q) {
  return {q.doubleword(0), q.doubleword(1)};
}
Quadword quadword(Wide x) {
  return isa::quadword<U64>(Quadword::kReversed ? Parts<U64>{x.low, x.high} : Parts<U64>{x.high, x.low});
}

// Rotates left. Shifts right by 64 - n in two steps, by 1 and by 63 - n, because a shift by 64 is undefined.
Wide rotate(Wide x, U32 bits) {
  if ((bits & 64) != 0) x = {x.low, x.high};
  const U32 n = bits & 63;
  return {x.high << n | x.low >> 1 >> (63 - n), x.low << n | x.high >> 1 >> (63 - n)};
}
/// Shifts left by `bits` < 256; 128 and more give 0.
Wide shift_left(Wide x, U32 bits) {
  if ((bits & 64) != 0) x = {x.low, 0};
  if ((bits & 128) != 0) x = {0, 0};
  const U32 n = bits & 63;
  return {x.high << n | x.low >> 1 >> (63 - n), x.low << n};
}
Wide shift_right(Wide x, U32 bits) {
  if ((bits & 64) != 0) x = {0, x.high};
  if ((bits & 128) != 0) x = {0, 0};
  const U32 n = bits & 63;
  return {x.high >> n, x.low >> n | x.high << 1 << (63 - n)};
}

/// Return the count of a shift, from the preferred slot of rb or from the immediate.
U32 count_rb(const State& state, const Instruction& i) {
  return state.gpr[i.rb].word(0);
}
U32 count_immediate(const Instruction& i) {
  return static_cast<U32>(i.immediate);
}

template <class F> void shift(State& state, const Instruction& i, F f, U32 bits) {
  state.gpr[i.rt] = quadword(f(wide(state.gpr[i.ra]), bits));
}
constexpr U32 bits_of(U32 count) {
  return count & 7;
}
constexpr U32 bytes_of(U32 count) {
  return (count & 31) * 8;
}

/// Generates the control of a shufb that inserts the `size` bytes in the preferred slot at the address and
/// keeps the other bytes.
void generate_control(State& state, const Instruction& i, U32 address, U32 size) {
  // In the preferred slot a doubleword starts at byte 0, a smaller part ends at byte 3.
  constexpr U64 kDoubleword = 0x0001020304050607, kWord = kDoubleword >> 32 << 32;
  const U64 all = size == 8 ? kDoubleword : kWord << (8 * (4 - size));
  const U64 bytes = ~U64{0} << (64 - 8 * size);
  const U32 place = 8 * (address & 15 & ~(size - 1));
  const Wide inserted = shift_right({all & bytes, 0}, place), replaced = shift_right({bytes, 0}, place);
  state.gpr[i.rt] = quadword({(0x1011121314151617 & ~replaced.high) | inserted.high,
                              (0x18191A1B1C1D1E1F & ~replaced.low) | inserted.low});
}
U32 displaced(const State& state, const Instruction& i) {
  return state.gpr[i.ra].word(0) + static_cast<U32>(i.immediate);
}
U32 indexed(const State& state, const Instruction& i) {
  return state.gpr[i.ra].word(0) + state.gpr[i.rb].word(0);
}

/// Returns a mask: for each of the low bits, the highest bit first, a part of all ones or zeros.
template <class Part> Quadword form_mask(U32 bits) {
  Parts<Part> mask;
  constexpr unsigned count = sizeof mask / sizeof(Part);
  for (unsigned k = 0; k < count; ++k) {
    const unsigned bit = Quadword::kReversed ? k : count - 1 - k;
    mask[k] = mask_of<Part>((bits >> bit & 1) != 0);
  }
  return isa::quadword<Part>(mask);
}
/// Forms a mask of bytes with one vector compare: each byte tests its bit in a copy of eight bits.
template <> [[gnu::always_inline]] inline Quadword form_mask<std::uint8_t>(U32 bits) {
  constexpr U64 kEach = 0x8040201008040201;
  const auto bit = parts<std::uint8_t>(quadword({kEach, kEach}));
  const auto first = static_cast<std::uint8_t>(bits >> 8), last = static_cast<std::uint8_t>(bits);
  Parts<std::uint8_t> mask;
  for (unsigned k = 0; k < 16; ++k) {
    const std::uint8_t eight = Quadword::kReversed == (k < 8) ? last : first;
    mask[k] = mask_of<std::uint8_t>((eight & bit[k]) != 0);
  }
  return isa::quadword<std::uint8_t>(mask);
}
/// Gathers the lowest bits of all parts.
template <class Part> Quadword gather(const Quadword& from) {
  const auto x = parts<Part>(from);
  U32 bits = 0;
  for (unsigned k = 0; k < x.size(); ++k) {
    const unsigned bit = Quadword::kReversed ? k : static_cast<unsigned>(x.size()) - 1 - k;
    bits |= static_cast<U32>(x[k] & 1) << bit;
  }
  return preferred(bits);
}

/// Returns, for each byte of the control, byte (control & 31) of a followed by b.
Quadword look_up(const Quadword& a, const Quadword& b, const Quadword& control) {
  // On a little-endian host byte k of a followed by b is byte 31 - k of b followed by a.
  std::uint8_t table[32];
  std::memcpy(table + (Quadword::kReversed ? 16 : 0), a.bytes, 16);
  std::memcpy(table + (Quadword::kReversed ? 0 : 16), b.bytes, 16);
  constexpr unsigned flip = Quadword::kReversed ? 31 : 0;
  return map<std::uint8_t>(control, [&](std::uint8_t c) { return table[(c & 31u) ^ flip]; });
}

/// Returns the constant that a control byte of 0x80 and above stands for.
constexpr std::uint8_t constant_of(std::uint8_t control) {
  return static_cast<std::uint8_t>(control < 0xC0 ? 0 : control < 0xE0 ? 0xFF : 0x80);
}
Quadword with_constants(const Quadword& found, const Quadword& control) {
  return map<std::uint8_t>(found, control,
                           [](std::uint8_t x, std::uint8_t c) { return c < 0x80 ? x : constant_of(c); });
}

#if defined(__x86_64__)
/// Executes shufb by pshufb, which most x86 processors have: shuffles are frequent, and sixteen look-ups are
/// slow.
[[gnu::target("ssse3")]] void shufb_by_pshufb(State& state, const Instruction& i) {
  const auto a = std::bit_cast<__m128i>(state.gpr[i.ra]), b = std::bit_cast<__m128i>(state.gpr[i.rb]);
  const auto control = std::bit_cast<__m128i>(state.gpr[i.rc]);
  const __m128i bit4 = _mm_set1_epi8(16), place = _mm_andnot_si128(control, _mm_set1_epi8(15));
  const __m128i of_a = _mm_shuffle_epi8(a, place), of_b = _mm_shuffle_epi8(b, place);
  const __m128i from_b = _mm_cmpeq_epi8(_mm_and_si128(control, bit4), bit4);
  const __m128i found = _mm_or_si128(_mm_and_si128(from_b, of_b), _mm_andnot_si128(from_b, of_a));
  state.gpr[i.rt] = with_constants(std::bit_cast<Quadword>(found), state.gpr[i.rc]);
}
const bool kHasPshufb = __builtin_cpu_supports("ssse3");
#endif

} // namespace

void shufb(State& state, const Instruction& i) {
#if defined(__x86_64__)
  if (kHasPshufb) return shufb_by_pshufb(state, i);
#endif
  const Quadword control = state.gpr[i.rc];
  state.gpr[i.rt] = with_constants(look_up(state.gpr[i.ra], state.gpr[i.rb], control), control);
}

void cbd(State& state, const Instruction& i) {
  generate_control(state, i, displaced(state, i), 1);
}
void chd(State& state, const Instruction& i) {
  generate_control(state, i, displaced(state, i), 2);
}
void cwd(State& state, const Instruction& i) {
  generate_control(state, i, displaced(state, i), 4);
}
void cdd(State& state, const Instruction& i) {
  generate_control(state, i, displaced(state, i), 8);
}
void cbx(State& state, const Instruction& i) {
  generate_control(state, i, indexed(state, i), 1);
}
void chx(State& state, const Instruction& i) {
  generate_control(state, i, indexed(state, i), 2);
}
void cwx(State& state, const Instruction& i) {
  generate_control(state, i, indexed(state, i), 4);
}
void cdx(State& state, const Instruction& i) {
  generate_control(state, i, indexed(state, i), 8);
}

void shlqbi(State& state, const Instruction& i) {
  shift(state, i, shift_left, bits_of(count_rb(state, i)));
}
void shlqby(State& state, const Instruction& i) {
  shift(state, i, shift_left, bytes_of(count_rb(state, i)));
}
void shlqbybi(State& state, const Instruction& i) {
  shift(state, i, shift_left, bytes_of(count_rb(state, i) >> 3));
}
void shlqbii(State& state, const Instruction& i) {
  shift(state, i, shift_left, bits_of(count_immediate(i)));
}
void shlqbyi(State& state, const Instruction& i) {
  shift(state, i, shift_left, bytes_of(count_immediate(i)));
}
void rotqbi(State& state, const Instruction& i) {
  shift(state, i, rotate, bits_of(count_rb(state, i)));
}
void rotqby(State& state, const Instruction& i) {
  shift(state, i, rotate, bytes_of(count_rb(state, i)));
}
void rotqbybi(State& state, const Instruction& i) {
  shift(state, i, rotate, bytes_of(count_rb(state, i) >> 3));
}
void rotqbii(State& state, const Instruction& i) {
  shift(state, i, rotate, bits_of(count_immediate(i)));
}
void rotqbyi(State& state, const Instruction& i) {
  shift(state, i, rotate, bytes_of(count_immediate(i)));
}
// The instructions "rotate and mask" shift right by the negated count.
void rotqmbi(State& state, const Instruction& i) {
  shift(state, i, shift_right, bits_of(0 - count_rb(state, i)));
}
void rotqmby(State& state, const Instruction& i) {
  shift(state, i, shift_right, bytes_of(0 - count_rb(state, i)));
}
void rotqmbybi(State& state, const Instruction& i) {
  shift(state, i, shift_right, bytes_of(0 - (count_rb(state, i) >> 3)));
}
void rotqmbii(State& state, const Instruction& i) {
  shift(state, i, shift_right, bits_of(0 - count_immediate(i)));
}
void rotqmbyi(State& state, const Instruction& i) {
  shift(state, i, shift_right, bytes_of(0 - count_immediate(i)));
}

void fsmbi(State& state, const Instruction& i) {
  state.gpr[i.rt] = form_mask<std::uint8_t>(count_immediate(i));
}
void fsmb(State& state, const Instruction& i) {
  state.gpr[i.rt] = form_mask<std::uint8_t>(state.gpr[i.ra].word(0));
}
void fsmh(State& state, const Instruction& i) {
  state.gpr[i.rt] = form_mask<std::uint16_t>(state.gpr[i.ra].word(0));
}
void fsm(State& state, const Instruction& i) {
  state.gpr[i.rt] = form_mask<U32>(state.gpr[i.ra].word(0));
}
void gbb(State& state, const Instruction& i) {
  state.gpr[i.rt] = gather<std::uint8_t>(state.gpr[i.ra]);
}
void gbh(State& state, const Instruction& i) {
  state.gpr[i.rt] = gather<std::uint16_t>(state.gpr[i.ra]);
}
void gb(State& state, const Instruction& i) {
  state.gpr[i.rt] = gather<U32>(state.gpr[i.ra]);
}

void orx(State& state, const Instruction& i) {
  const auto x = parts<U32>(state.gpr[i.ra]);
  state.gpr[i.rt] = preferred(x[0] | x[1] | x[2] | x[3]);
}

} // namespace celltrace::isa::execute

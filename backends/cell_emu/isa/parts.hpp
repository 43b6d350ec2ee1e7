// Operations on all bytes, halfwords, words or doublewords of registers at once. Parts are processed in the
// host's order, because their order does not matter, by loops of fixed length that compilers vectorise.
#pragma once

#include "backends/cell_emu/isa/instruction.hpp"

#include <array>
#include <bit>
#include <cstdint>

namespace celltrace::isa {

template <class Part> using Parts = std::array<Part, 16 / sizeof(Part)>;

template <class Part> inline Parts<Part> parts(const Quadword& q) {
  return std::bit_cast<Parts<Part>>(q);
}
template <class Part> inline Quadword quadword(const Parts<Part>& from) {
  return std::bit_cast<Quadword>(from);
}

template <class Part, class F> inline Quadword map(const Quadword& a, F f) {
  const auto x = parts<Part>(a);
  Parts<Part> result;
  for (std::size_t k = 0; k < result.size(); ++k)
    result[k] = static_cast<Part>(f(x[k]));
  return quadword<Part>(result);
}

template <class Part, class F> inline Quadword map(const Quadword& a, const Quadword& b, F f) {
  const auto x = parts<Part>(a), y = parts<Part>(b);
  Parts<Part> result;
  for (std::size_t k = 0; k < result.size(); ++k)
    result[k] = static_cast<Part>(f(x[k], y[k]));
  return quadword<Part>(result);
}

template <class Part, class F>
inline Quadword map(const Quadword& a, const Quadword& b, const Quadword& c, F f) {
  const auto x = parts<Part>(a), y = parts<Part>(b), z = parts<Part>(c);
  Parts<Part> result;
  for (std::size_t k = 0; k < result.size(); ++k)
    result[k] = static_cast<Part>(f(x[k], y[k], z[k]));
  return quadword<Part>(result);
}

/// Computes rt = f(ra), part by part.
template <class Part, class F> inline void of_ra(State& state, const Instruction& i, F f) {
  state.gpr[i.rt] = map<Part>(state.gpr[i.ra], f);
}
/// Computes rt = f(ra, rb).
template <class Part, class F> inline void of_ra_rb(State& state, const Instruction& i, F f) {
  state.gpr[i.rt] = map<Part>(state.gpr[i.ra], state.gpr[i.rb], f);
}
/// Computes rt = f(ra, rb, rt).
template <class Part, class F> inline void of_ra_rb_rt(State& state, const Instruction& i, F f) {
  state.gpr[i.rt] = map<Part>(state.gpr[i.ra], state.gpr[i.rb], state.gpr[i.rt], f);
}
/// Computes rt = f(ra, rb, rc).
template <class Part, class F> inline void of_ra_rb_rc(State& state, const Instruction& i, F f) {
  state.gpr[i.rt] = map<Part>(state.gpr[i.ra], state.gpr[i.rb], state.gpr[i.rc], f);
}
/// Computes rt = f(ra, immediate), with the immediate cut to the size of a part.
template <class Part, class F> inline void of_ra_immediate(State& state, const Instruction& i, F f) {
  const auto immediate = static_cast<Part>(i.immediate);
  state.gpr[i.rt] = map<Part>(state.gpr[i.ra], [=](Part x) { return f(x, immediate); });
}

/// Returns the result of a compare: all ones if `condition` is true, else zeros.
template <class Part> constexpr Part mask_of(bool condition) {
  return static_cast<Part>(condition ? -1 : 0);
}

/// Returns a register with the word in the preferred slot and zeros in the other slots.
inline Quadword preferred(std::uint32_t word) {
  Quadword q = Quadword::zero();
  q.set<std::uint32_t>(0, word);
  return q;
}

} // namespace celltrace::isa

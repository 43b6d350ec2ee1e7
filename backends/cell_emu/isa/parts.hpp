#pragma once
#include "backends/cell_emu/isa/instruction.hpp"
#include <array>
#include <bit>
namespace celltrace::isa {
#define CELLTRACE_INSTRUCTION(name, ...) void execute_##name(State& s, const Instruction& i);
#include "backends/cell_emu/isa/opcodes.def"
#undef CELLTRACE_INSTRUCTION
template <class Part> using Parts = std::array<Part, 16 / sizeof(Part)>;
template <class Part> Parts<Part> parts(const Quadword& q) { return std::bit_cast<Parts<Part>>(q); }
template <class Part> Quadword joined(const Parts<Part>& p) { return std::bit_cast<Quadword>(p); }
template <class Part, class F> void unary(State& s, const Instruction& i, F f) {
  const auto a = parts<Part>(s.gpr[i.ra]);
  Parts<Part> r;
  for (std::size_t k = 0; k < r.size(); ++k) r[k] = static_cast<Part>(f(a[k]));
  s.gpr[i.rt] = joined<Part>(r);
}
template <class Part, class F> void binary(State& s, const Instruction& i, F f) {
  const auto a = parts<Part>(s.gpr[i.ra]); const auto b = parts<Part>(s.gpr[i.rb]);
  Parts<Part> r;
  for (std::size_t k = 0; k < r.size(); ++k) r[k] = static_cast<Part>(f(a[k], b[k]));
  s.gpr[i.rt] = joined<Part>(r);
}
template <class Part, class F> void accumulate(State& s, const Instruction& i, F f) {
  const auto a = parts<Part>(s.gpr[i.ra]); const auto b = parts<Part>(s.gpr[i.rb]); const auto t = parts<Part>(s.gpr[i.rt]);
  Parts<Part> r;
  for (std::size_t k = 0; k < r.size(); ++k) r[k] = static_cast<Part>(f(a[k], b[k], t[k]));
  s.gpr[i.rt] = joined<Part>(r);
}
template <class Part, class F> void ternary(State& s, const Instruction& i, F f) {
  const auto a = parts<Part>(s.gpr[i.ra]); const auto b = parts<Part>(s.gpr[i.rb]); const auto c = parts<Part>(s.gpr[i.rc]);
  Parts<Part> r;
  for (std::size_t k = 0; k < r.size(); ++k) r[k] = static_cast<Part>(f(a[k], b[k], c[k]));
  s.gpr[i.rt] = joined<Part>(r);
}
inline Quadword preferred(std::uint32_t w) { Quadword q = Quadword::zero(); q.set<std::uint32_t>(0, w); return q; }
}

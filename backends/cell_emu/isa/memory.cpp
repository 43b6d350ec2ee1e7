// Execution: loads and stores.
#include "backends/cell_emu/isa/execute.hpp"

namespace celltrace::isa::execute {
namespace {

std::uint32_t displaced(const State& state, const Instruction& i) {
  return state.gpr[i.ra].word(0) + static_cast<std::uint32_t>(i.immediate);
}
std::uint32_t indexed(const State& state, const Instruction& i) {
  return state.gpr[i.ra].word(0) + state.gpr[i.rb].word(0);
}
std::uint32_t absolute(const Instruction& i) {
  return static_cast<std::uint32_t>(i.immediate);
}
std::uint32_t relative(const State& state, const Instruction& i) {
  return state.pc + static_cast<std::uint32_t>(i.immediate);
}

} // namespace

void lqd(State& state, const Instruction& i) {
  state.gpr[i.rt] = state.load(displaced(state, i));
}
void lqx(State& state, const Instruction& i) {
  state.gpr[i.rt] = state.load(indexed(state, i));
}
void lqa(State& state, const Instruction& i) {
  state.gpr[i.rt] = state.load(absolute(i));
}
void lqr(State& state, const Instruction& i) {
  state.gpr[i.rt] = state.load(relative(state, i));
}
void stqd(State& state, const Instruction& i) {
  state.store(displaced(state, i), state.gpr[i.rt]);
}
void stqx(State& state, const Instruction& i) {
  state.store(indexed(state, i), state.gpr[i.rt]);
}
void stqa(State& state, const Instruction& i) {
  state.store(absolute(i), state.gpr[i.rt]);
}
void stqr(State& state, const Instruction& i) {
  state.store(relative(state, i), state.gpr[i.rt]);
}

} // namespace celltrace::isa::execute

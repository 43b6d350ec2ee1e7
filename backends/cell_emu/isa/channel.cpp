// Execution: channels, special registers, the floating-point status, and instructions that only order other
// instructions.
#include "backends/cell_emu/isa/execute.hpp"
#include "backends/cell_emu/isa/parts.hpp"

namespace celltrace::isa::execute {

void rdch(State& state, const Instruction& i) {
  state.gpr[i.rt] = preferred(state.environment->read_channel(i.ra));
}
void rchcnt(State& state, const Instruction& i) {
  state.gpr[i.rt] = preferred(state.environment->channel_count(i.ra));
}
void wrch(State& state, const Instruction& i) {
  state.environment->write_channel(i.ra, state.gpr[i.rt].word(0));
}

// No special-purpose register is defined, and undefined registers read as zero.
void mfspr(State& state, const Instruction& i) {
  state.gpr[i.rt] = Quadword::zero();
}
void mtspr(State&, const Instruction&) {
}

void fscrrd(State& state, const Instruction& i) {
  state.gpr[i.rt] = state.fpscr;
}
void fscrwr(State& state, const Instruction& i) {
  // Undefined bits stay zero: see floating_status.hpp.
  Quadword defined;
  defined.set<std::uint32_t>(0, 0x00000F07);
  defined.set<std::uint32_t>(1, 0x00003F07);
  defined.set<std::uint32_t>(2, 0x00003F07);
  defined.set<std::uint32_t>(3, 0x00000F07);
  state.fpscr =
      map<std::uint32_t>(state.gpr[i.ra], defined, [](std::uint32_t x, std::uint32_t y) { return x & y; });
}

// The instructions below do nothing, because instructions are executed one by one and stores are visible at
// once.
void nop(State&, const Instruction&) {
}
void lnop(State&, const Instruction&) {
}
void sync(State&, const Instruction&) {
}
void dsync(State&, const Instruction&) {
}

} // namespace celltrace::isa::execute

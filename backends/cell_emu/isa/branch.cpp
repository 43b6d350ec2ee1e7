// Execution: branches, hints, stops.
#include "backends/cell_emu/isa/execute.hpp"
#include "backends/cell_emu/isa/parts.hpp"

namespace celltrace::isa::execute {
namespace {

constexpr std::uint32_t kAddressMask = kLocalStoreLimit & ~3u;
// Feature bits of branches to a register. To set both bits is reserved; this implementation then first
// disables and then enables interrupts.
constexpr std::uint32_t kDisableInterrupts = 1u << 19, kEnableInterrupts = 1u << 18;
/// The stop code of stopd, whose instruction word has no code.
constexpr std::uint32_t kStopWithDependenciesCode = 0x3FFF;

std::uint32_t relative(const State& state, const Instruction& i) {
  return (state.pc + static_cast<std::uint32_t>(i.immediate)) & kAddressMask;
}
std::uint32_t absolute(const Instruction& i) {
  return static_cast<std::uint32_t>(i.immediate) & kAddressMask;
}
std::uint32_t in_register(const State& state, const Instruction& i) {
  return state.gpr[i.ra].word(0) & kAddressMask;
}
Quadword link(const State& state) {
  return preferred((state.pc + 4) & kAddressMask);
}

/// Takes a branch to a register, and obeys the feature bits, which have no effect if a branch is not taken.
void branch(State& state, const Instruction& i, std::uint32_t target) {
  state.next = target;
  if ((i.word & (kDisableInterrupts | kEnableInterrupts)) == 0) [[likely]]
    return;
  if ((i.word & kDisableInterrupts) != 0) state.environment->enable_interrupts(false);
  if ((i.word & kEnableInterrupts) != 0) state.environment->enable_interrupts(true);
}

std::uint32_t tested_word(const State& state, const Instruction& i) {
  return state.gpr[i.rt].word(0);
}
std::uint16_t tested_half(const State& state, const Instruction& i) {
  return state.gpr[i.rt].half(1);
}

} // namespace

void br(State& state, const Instruction& i) {
  state.next = relative(state, i);
}
void brsl(State& state, const Instruction& i) {
  state.next = relative(state, i);
  state.gpr[i.rt] = link(state);
}
void bra(State& state, const Instruction& i) {
  state.next = absolute(i);
}
void brasl(State& state, const Instruction& i) {
  state.next = absolute(i);
  state.gpr[i.rt] = link(state);
}
void brz(State& state, const Instruction& i) {
  if (tested_word(state, i) == 0) state.next = relative(state, i);
}
void brnz(State& state, const Instruction& i) {
  if (tested_word(state, i) != 0) state.next = relative(state, i);
}
void brhz(State& state, const Instruction& i) {
  if (tested_half(state, i) == 0) state.next = relative(state, i);
}
void brhnz(State& state, const Instruction& i) {
  if (tested_half(state, i) != 0) state.next = relative(state, i);
}

void bi(State& state, const Instruction& i) {
  branch(state, i, in_register(state, i));
}
void iret(State& state, const Instruction& i) {
  branch(state, i, state.environment->srr0() & kAddressMask);
}
void bisl(State& state, const Instruction& i) {
  const std::uint32_t target = in_register(state, i); // read first: it may be the register that gets the link
  state.gpr[i.rt] = link(state);
  branch(state, i, target);
}
void bisled(State& state, const Instruction& i) {
  const std::uint32_t target = in_register(state, i);
  state.gpr[i.rt] = link(state);
  if (state.environment->has_event()) branch(state, i, target);
}
void biz(State& state, const Instruction& i) {
  if (tested_word(state, i) == 0) branch(state, i, in_register(state, i));
}
void binz(State& state, const Instruction& i) {
  if (tested_word(state, i) != 0) branch(state, i, in_register(state, i));
}
void bihz(State& state, const Instruction& i) {
  if (tested_half(state, i) == 0) branch(state, i, in_register(state, i));
}
void bihnz(State& state, const Instruction& i) {
  if (tested_half(state, i) != 0) branch(state, i, in_register(state, i));
}

// Hints affect only time.
void hbr(State&, const Instruction&) {
}
void hbra(State&, const Instruction&) {
}
void hbrr(State&, const Instruction&) {
}

void stop(State& state, const Instruction& i) {
  state.environment->stop(static_cast<std::uint32_t>(i.immediate));
}
void stopd(State& state, const Instruction&) {
  state.environment->stop(kStopWithDependenciesCode);
}

void invalid(State& state, const Instruction& i) {
  state.environment->invalid_instruction(i.word);
}

} // namespace celltrace::isa::execute

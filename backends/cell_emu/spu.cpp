#include "backends/cell_emu/spu.hpp"

#include "celltrace/error.hpp"

#include <algorithm>
#include <string>

namespace celltrace::cell_emu {

Spu::Spu(unsigned id, Bus& bus, ProblemState& problem_state, Counters& counters, const ArenaState& arena)
    : id_(id), bus_(bus), problem_state_(problem_state), counters_(counters),
      mfc_(id, bus, problem_state, counters), arena_(arena), bytes_before_(mfc_.bytes_moved()) {
  initialise_base();
}

void Spu::finish() {
  mfc_.finish();
  arena();
}

SpeAddresses Spu::addresses(std::uint32_t spe) const {
  if (spe >= count())
    throw SpeError("SPE " + std::to_string(id_) + ": there is no SPE " + std::to_string(spe) + ", only " +
                   std::to_string(count()));
  return bus_.map().addresses(spe);
}

/// Every change of the fill is preceded by a call of arena(), so the peak is seen here.
ArenaState& Spu::arena() {
  counters_.local_store_peak.raise_to(static_cast<std::uint64_t>(arena_.next - arena_.begin));
  return arena_;
}

void Spu::halt(HaltCode code) {
  std::string text = "SPE " + std::to_string(id_) + ": halted: " + to_text(code);
  if (code == HaltCode::local_store_exhausted)
    text += ", " + std::to_string(available()) + " of " + std::to_string(arena_.end - arena_.begin) +
            " bytes of the arena are free";
  throw SpeError(text);
}

// --- MFC commands ---

std::uint32_t Spu::local_address(const void* pointer) const {
  const std::uintptr_t base = reinterpret_cast<std::uintptr_t>(bus_.map().local_store(id_));
  const std::uintptr_t offset = reinterpret_cast<std::uintptr_t>(pointer) - base;
  return offset < kLocalStoreBytes ? static_cast<std::uint32_t>(offset) : kOutsideLocalStore;
}

void Spu::command(const MfcCommand& command) {
  if (mfc_.free_entries() == 0 && problem_state_.interrupted()) problem_state_.stop_at(Channel::mfc_cmd);
  // Six channel writes: the parameters and the command.
  cycles_ += 6 * kCyclesPerChannel;
  parameters_ = command;
  mfc_.issue(command);
}

void Spu::command_word(std::uint32_t word) {
  // The high half holds replacement class and transfer class ids; bits of performance, not of meaning. So is
  // the "result" bit of a put.
  std::uint32_t opcode = word & 0xFFFF;
  if ((opcode & 0xFFF8) == 0x30) opcode -= 0x10;
  MfcCommand issued = parameters_;
  issued.opcode = static_cast<MfcOpcode>(opcode);
  command(issued);
}

// --- events and decrementer ---

std::uint32_t Spu::event_status_channel() {
  update_decrementer();
  // Nothing but the decrementer counts while the SPU stalls: let its time pass.
  const bool expects_expiry =
      decrementer_.running() && (problem_state_.event_mask() & event::decrementer) != 0;
  if (expects_expiry && problem_state_.event_count() == 0) {
    cycles_ += decrementer_.expiry() - std::min(cycles(), decrementer_.expiry());
    update_decrementer();
  }
  return problem_state_.read_event_status();
}

void Spu::update_decrementer() {
  if (decrementer_.advance(cycles())) problem_state_.raise_own(event::decrementer);
}

std::uint32_t Spu::decrementer() {
  update_decrementer();
  return decrementer_.value();
}

void Spu::start_decrementer(std::uint32_t value) {
  update_decrementer();
  decrementer_.write(value, cycles());
}

void Spu::event_ack_channel(std::uint32_t events) {
  update_decrementer();
  problem_state_.acknowledge_events(events);
  // Masked off and acknowledged is how the decrementer is stopped.
  if ((events & ~problem_state_.event_mask() & event::decrementer) != 0) decrementer_.freeze(cycles());
}

} // namespace celltrace::cell_emu

#include "backends/cell_emu/spu.hpp"

#include "backends/cell_emu/coroutine.hpp"
#include "backends/cell_emu/pipeline.hpp"

#include <algorithm>
#include <string>

namespace celltrace::cell_emu {

Spu::~Spu() = default;

Spu* Spu::running_or_null() {
  return static_cast<Spu*>(stack_local());
}

Spu& Spu::running() {
  if (stack_local() == nullptr) throw SpeError("an operation of an SPE where no SPE program runs");
  return *static_cast<Spu*>(stack_local());
}

HostCodeSpu::HostCodeSpu(Spe& spe, const SpuContext& context, const ArenaState& arena)
    : SpuCore(spe, context),
      Spu(spe.id, context.mfc.bus.map().spes(), context.mfc.bus.map().local_store(spe.id),
          context.mfc.config.recorder, site_),
      arena_(arena) {
  take_operation_counts();
  initialise_base();
  mfc_.begin_allocations(arena_.next);
  stack_local() = static_cast<Spu*>(this);
}

HostCodeSpu::~HostCodeSpu() {
  stack_local() = nullptr;
}

void HostCodeSpu::finish() {
  settle();
  arena();
  SpuCore::finish();
}

void HostCodeSpu::abandon() {
  arena();
  leave();
}

SpeAddresses HostCodeSpu::addresses(std::uint32_t spe) const {
  if (spe >= count())
    throw SpeError("SPE " + std::to_string(id()) + ": there is no SPE " + std::to_string(spe) + ", only " +
                   std::to_string(count()));
  return context_.mfc.bus.map().addresses(spe);
}

/// Returns the arena, and updates the peak of its use: each change of ArenaState::next is preceded by a call
/// of arena().
ArenaState& HostCodeSpu::arena() {
  counters_.local_store_peak.raise_to(static_cast<std::uint64_t>(arena_.next - arena_.begin) -
                                      mfc_.red_zone_bytes());
  return arena_;
}

void HostCodeSpu::throw_halted(HaltCode code, CallSite site) {
  site_ = site;
  std::string text = std::string("halted: ") + to_text(code);
  if (code != HaltCode::local_store_exhausted) fail(Rule::halted, text);
  fail(Rule::local_store_exhausted, text + ", " + std::to_string(available()) + " of " +
                                        std::to_string(arena_.end - arena_.begin) +
                                        " bytes of the arena are free");
}

void HostCodeSpu::throw_halted_by_instruction() {
  fail(Rule::halted, std::string(text_of(Rule::halted)));
}

void HostCodeSpu::stop(std::uint32_t code) {
  settle();
  stop_with(code);
}

void HostCodeSpu::fetch_module(const CodeModule& module) {
  settle();
  resident_modules_[module.region] = module.number;
  const TimingParameters& timing = context_.mfc.config.timing;
  const std::uint64_t lines = (module.bytes + kLineBytes - 1) / kLineBytes;
  const Cycle begin = now();
  waited(begin + timing.first_line_memory + lines * timing.memory_line, module.name);
  counters_.module_fetches.add(1);
  counters_.module_bytes.add(module.bytes);
  counters_.module_cycles.add(now() - begin);
}

void HostCodeSpu::report_absent_module(const CodeModule& module, CallSite site) {
  site_ = site;
  fail(Rule::absent_module,
       std::string("code of module '") + module.name + "': " + std::string(text_of(Rule::absent_module)));
}

void HostCodeSpu::note(const char* what, std::uint32_t value) {
  if (context_.mfc.trace == nullptr) return;
  settle();
  context_.mfc.trace->note(id(), what, value, now());
}

// --- virtual time ---

void HostCodeSpu::settle() {
  spend(cycles_of(take_operation_counts(), context_.mfc.config.timing));
}

void HostCodeSpu::charge(std::uint32_t channel_reads, std::uint32_t channel_writes) {
  settle();
  arena();
  const TimingParameters& timing = context_.mfc.config.timing;
  const std::uint64_t accesses = channel_reads + channel_writes;
  SpuCycles cycles;
  cycles.total_cycle = std::uint64_t{channel_reads} * timing.channel_read +
                       std::uint64_t{channel_writes} * timing.channel_write;
  cycles.spr = accesses;
  cycles.single_cycle = std::min(accesses, cycles.total_cycle);
  cycles.stall_due_to_dependency = cycles.total_cycle - cycles.single_cycle;
  spend_on_channels(cycles);
  check_limits();
  if (context_.mfc.config.faults.pause_probability > 0) inject_faults();
  if (interrupts_enabled_) run_interrupts();
}

// --- local store ---

void HostCodeSpu::allocated(void* begin, std::uint32_t bytes, std::uint32_t alignment, CallSite site) {
  mfc_.allocated(static_cast<const std::uint8_t*>(begin), bytes, alignment, site, arena_);
}

void HostCodeSpu::release(std::uint8_t* marked, CallSite site) {
  arena(); // updates the peak
  mfc_.release(marked, site, now(), arena_);
}

void* HostCodeSpu::local_static(const void* key, std::uint32_t bytes, std::uint32_t alignment) {
  void*& object = statics_[key];
  if (object == nullptr) object = allocate<std::uint8_t>(bytes, alignment);
  return object;
}

void HostCodeSpu::issue(MfcOpcode op, std::uint32_t lsa, ea_t ea, std::uint32_t size, std::uint32_t tag) {
  // A command takes six channel writes: five parameters and the opcode.
  charge(0, 6);
  issue_command({op, tag, lsa, size, ea});
}

// --- interrupts ---

void HostCodeSpu::enable_interrupts(std::function<void(Spu&)> handler) {
  interrupt_handler_ = std::move(handler);
  interrupts_enabled_ = true;
}

void HostCodeSpu::enable_interrupts() {
  if (!interrupt_handler_)
    throw SpeError("SPE " + std::to_string(id()) +
                   ": interrupts are enabled, but no handler was given to enable_interrupts()");
  interrupts_enabled_ = true;
}

void HostCodeSpu::run_interrupts() {
  if (in_handler_) return;
  update_decrementer();
  while (interrupts_enabled_ && state_.event_count() != 0) {
    in_handler_ = true;
    interrupts_enabled_ = false;
    interrupt_handler_(*this);
    in_handler_ = false;
    interrupts_enabled_ = true;
  }
}

// --- channels by number ---

std::uint32_t HostCodeSpu::read_channel(unsigned channel) {
  charge(1, 0);
  return channel_read(channel);
}

void HostCodeSpu::write_channel(unsigned channel, std::uint32_t value) {
  charge(0, 1);
  channel_write(channel, value);
}

std::uint32_t HostCodeSpu::channel_count(unsigned channel) {
  charge(1, 0);
  return channel_count_of(channel);
}

} // namespace celltrace::cell_emu

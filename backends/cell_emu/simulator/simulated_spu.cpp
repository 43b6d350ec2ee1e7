#include "backends/cell_emu/simulator/simulated_spu.hpp"

#include "backends/cell_emu/local_store_watch.hpp"
#include "backends/cell_emu/simulator/big_endian.hpp"

#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <cstring>

namespace celltrace::cell_emu {
namespace {

/// Number of instructions after which other SPEs get a turn: a program that polls its local store for data of
/// another SPE's DMA must let this SPE run. A compromise, because every turn may switch coroutines.
constexpr std::uint32_t kSlice = 2048;

std::uint32_t word_at(const std::uint8_t* from) {
  std::uint32_t word;
  std::memcpy(&word, from, sizeof word);
  return std::endian::native == std::endian::big ? word : __builtin_bswap32(word);
}

constexpr std::uint32_t kFirstPpeCall = 0x2100, kLastPpeCall = 0x21FF;

} // namespace

SimulatedSpu::SimulatedSpu(Spe& spe, const SpuContext& context, const SimulatedProgram& program,
                           CallPpe call_ppe, SpuProfile* profile)
    : SpuCore(spe, context), program_(program), call_ppe_(std::move(call_ppe)), profile_(profile),
      decoded_(kLocalStoreBytes / 4, isa::decode(0)), watch_(kLocalStoreBytes / 16),
      model_(context.mfc.config.timing) {
  state_of_spu_.local_store = context.mfc.bus.map().local_store(id());
  state_of_spu_.watch = watch_.data();
  state_of_spu_.environment = this;
  mfc_.watch_flights(watch_.data());
  if (profile != nullptr) words_.resize(SpuProfile::kWords);
}

void SimulatedSpu::run(const StartRegisters& registers) {
  state_of_spu_.pc = program_.elf().entry();
  state_of_spu_.gpr[3] = registers.spe_id;
  state_of_spu_.gpr[4] = registers.argp;
  state_of_spu_.gpr[5] = registers.envp;
  state_of_spu_.gpr[6] = registers.local_store;
  if (profile_ == nullptr) {
    for (;;) {
      attend();
      run_slice<false>();
    }
  }
  for (;;) {
    attend();
    run_slice<true>();
  }
}

void SimulatedSpu::finish() {
  settle();
  flush_profile();
  SpuCore::finish();
}

void SimulatedSpu::abandon() {
  settle();
  flush_profile();
  leave();
}

// --- the loop ---

const isa::Instruction& SimulatedSpu::fetch(std::uint32_t pc) {
  const isa::Instruction& instruction = decoded_[pc / 4];
  const std::uint32_t word = word_at(state_of_spu_.local_store + pc);
  // The decoded word is compared with local store, so that writers of local store need not announce changes
  // of code.
  if (instruction.word != word) [[unlikely]]
    return decode_again(pc, word);
  return instruction;
}

const isa::Instruction& SimulatedSpu::decode_again(std::uint32_t pc, std::uint32_t word) {
  const std::uint8_t* const code = state_of_spu_.local_store + (pc & ~7u);
  if (is_poison(code, 8) || is_as_in_flight(code, 8))
    fail_at(pc, Rule::unwritten_code, place_of(pc) + ": " + std::string(text_of(Rule::unwritten_code)));
  return decoded_[pc / 4] = isa::decode(word);
}

template <bool profiled> void SimulatedSpu::run_slice() {
  isa::State& state = state_of_spu_;
  while (left_in_slice_ != 0) {
    --left_in_slice_;
    const std::uint32_t pc = state.pc;
    const isa::Instruction& instruction = fetch(pc);
    const isa::Unit unit = instruction.unit;
    const std::uint8_t target = instruction.target;
    [[maybe_unused]] const Cycle before = model_.last();
    model_.issue(instruction, pc);
    if constexpr (profiled) executing_ = {pc, true, model_.last() == before};
    const std::uint32_t following = (pc + 4) & isa::kLocalStoreLimit;
    state.next = following;
    if (early_loads_.any()) [[unlikely]]
      look_for_early_use(instruction);
    instruction.execute(state, instruction);
    if (unit == isa::Unit::br)
      model_.branched(pc, state.next, state.next != following);
    else if (unit == isa::Unit::hbr) [[unlikely]]
      hint(instruction, pc);
    if (target == 1) [[unlikely]]
      check_stack();
    if constexpr (profiled) record();
    state.pc = state.next;
  }
}

void SimulatedSpu::record() {
  SpuProfile::Word& word = words_[executing_.pc / 4];
  ++word.hits;
  word.instruction = decoded_[executing_.pc / 4].word;
  word.dual += executing_.paired;
  executing_.issued = false;
  record_cycles();
}

void SimulatedSpu::record_cycles() {
  SpuProfile::Word& word = words_[executing_.pc / 4];
  word.cycles += model_.last() - profiled_until_;
  word.dependency += model_.recent(StallReason::dependency);
  word.branch_miss += model_.recent(StallReason::branch_miss);
  word.prefetch_miss += model_.recent(StallReason::prefetch_miss);
  word.hint_target += model_.recent(StallReason::hint_target);
  word.fp_resource += model_.recent(StallReason::fp_resource);
  word.channel += waited_;
  profiled_until_ = model_.last();
  model_.forget_recent();
  waited_ = 0;
}

void SimulatedSpu::flush_profile() {
  if (profile_ == nullptr) return;
  // The instruction that ended the program has not been recorded yet.
  if (executing_.issued) record();
  record_cycles();
  profile_->add(words_);
}

void SimulatedSpu::attend() {
  settle();
  site_ = site_of(state_of_spu_.pc);
  if (state_.interrupted()) {
    const std::string place = to_text(site_);
    state_.stop_running(place.empty() ? place_of(state_of_spu_.pc) : place);
  }
  check_limits();
  if (context_.mfc.config.faults.pause_probability > 0) inject_faults();
  reach();
  if (interrupts_enabled_) {
    update_decrementer();
    if (state_.event_count() != 0) take_interrupt();
  }
  // If interrupts are enabled, an event interrupts before the next instruction.
  left_in_slice_ = interrupts_enabled_ ? 1 : kSlice;
}

void SimulatedSpu::take_interrupt() {
  srr0_ = state_of_spu_.pc;
  interrupts_enabled_ = false;
  state_of_spu_.pc = 0;
}

void SimulatedSpu::hint(const isa::Instruction& instruction, std::uint32_t pc) {
  std::uint32_t target = static_cast<std::uint32_t>(instruction.immediate);
  if (instruction.opcode == isa::Opcode::hbr) {
    if ((instruction.word >> 20 & 1) != 0)
      return; // hbrp is no hint for a branch: it only makes room for instruction fetches
    target = state_of_spu_.gpr[instruction.ra].word(0);
  } else if (instruction.opcode == isa::Opcode::hbrr) {
    target += pc;
  }
  model_.hint(isa::hinted_branch(instruction, pc), target & (isa::kLocalStoreLimit & ~3u));
}

void SimulatedSpu::look_for_early_use(const isa::Instruction& instruction) {
  const EarlyLoads::Load* const used = early_loads_.use(state_of_spu_, instruction);
  if (used == nullptr) return;
  settle();
  const EarlyLoads::Load load = *used;
  early_loads_.forget(); // reported once
  mfc_.report_early_load(load.flight, load.lsa, load.site, site_of(state_of_spu_.pc), now());
}

// --- the clock ---

void SimulatedSpu::settle() {
  const std::uint64_t bytes = counters_.dma_bytes_read.value() + counters_.dma_bytes_written.value();
  model_.contend((bytes - dma_bytes_seen_ + kLineBytes - 1) / kLineBytes);
  dma_bytes_seen_ = bytes;
  spend(model_.take());
}

template <class Access> auto SimulatedSpu::access(Access use) {
  settle();
  site_ = site_of(state_of_spu_.pc);
  if (context_.mfc.config.faults.pause_probability > 0) inject_faults();
  struct Pass {
    SimulatedSpu& spu;
    Cycle before = spu.now();
    ~Pass() {
      spu.waited_ += spu.now() - before;
      spu.model_.pass(spu.now() - before);
    }
  } pass{*this};
  return use();
}

// --- callbacks of instructions ---

std::uint32_t SimulatedSpu::read_channel(unsigned channel) {
  return access([&] { return channel_read(channel); });
}

void SimulatedSpu::write_channel(unsigned channel, std::uint32_t value) {
  access([&] { channel_write(channel, value); });
}

std::uint32_t SimulatedSpu::channel_count(unsigned channel) {
  return access([&] { return channel_count_of(channel); });
}

void SimulatedSpu::stop(std::uint32_t code) {
  access([&] {
    const std::uint32_t halt = code - kHaltStop;
    if (program_.convention() == Convention::kernel && halt >= 1 &&
        halt <= static_cast<std::uint32_t>(kLastHaltCode)) {
      const auto why = static_cast<HaltCode>(halt);
      fail(why == HaltCode::local_store_exhausted ? Rule::local_store_exhausted : Rule::halted,
           std::string("halted: ") + to_text(why));
    }
    if (code >= kFirstPpeCall && code <= kLastPpeCall)
      call_ppe(code);
    else
      stop_with(code);
  });
}

void SimulatedSpu::call_ppe(std::uint32_t code) {
  reach();
  const std::uint32_t word = state_of_spu_.next & ~3u;
  if (!call_ppe_(code, state_of_spu_.local_store, word, now())) return stop_with(code);
  waited(now() + context_.mfc.config.timing.ppe_call, "call of the PPE");
  state_of_spu_.next = (word + 4) & isa::kLocalStoreLimit;
}

void SimulatedSpu::halt() {
  fail_at(state_of_spu_.pc, Rule::halted,
          place_of(state_of_spu_.pc) + ": " + std::string(text_of(Rule::halted)));
}

void SimulatedSpu::invalid_instruction(std::uint32_t word) {
  char text[32];
  std::snprintf(text, sizeof text, ": 0x%08" PRIx32 ": ", word);
  fail_at(state_of_spu_.pc, Rule::invalid_instruction,
          place_of(state_of_spu_.pc) + text + std::string(text_of(Rule::invalid_instruction)));
}

bool SimulatedSpu::has_event() {
  return access([&] {
    reach();
    update_decrementer();
    return state_.event_count() != 0;
  });
}

void SimulatedSpu::enable_interrupts(bool enabled) {
  interrupts_enabled_ = enabled;
  left_in_slice_ = 0;
}

// --- local store ---

void SimulatedSpu::watched_load(std::uint32_t lsa) {
  const auto flight = mfc_.get_in_flight(lsa);
  if (!flight) return;
  const std::uint32_t pc = state_of_spu_.pc;
  early_loads_.loaded(decoded_[pc / 4].target, {lsa, site_of(pc), *flight});
}

void SimulatedSpu::watched_store(std::uint32_t lsa, const isa::Quadword& value) {
  settle();
  std::uint8_t bytes[16];
  value.store(bytes);
  mfc_.check_store(lsa, bytes, site_of(state_of_spu_.pc), now());
}

void SimulatedSpu::check_stack() {
  if (!program_.has_abi_stack()) return;
  const isa::Quadword& pointer = state_of_spu_.gpr[1];
  const std::int32_t left = static_cast<std::int32_t>(pointer.word(1));
  // Checked here, before the program stores into the frame that does not fit.
  if (stack_left_ >= 0 && left < 0)
    fail_at(state_of_spu_.pc, Rule::stack_overflow,
            place_of(state_of_spu_.pc) + ": " + std::to_string(-static_cast<std::int64_t>(left)) +
                " bytes too many: " + std::string(text_of(Rule::stack_overflow)));
  stack_left_ = left;
  if (left < 0 || pointer.word(0) > isa::kLocalStoreLimit) return;
  lowest_stack_ = std::min(lowest_stack_, pointer.word(0));
  counters_.local_store_peak.raise_to(program_.elf().program_end() + (kLocalStoreBytes - lowest_stack_));
}

// --- places ---

const CallSite& SimulatedSpu::site_of(std::uint32_t pc) {
  const auto [place, is_new] = sites_.try_emplace(pc);
  if (is_new) place->second = program_.site(pc);
  return place->second;
}

std::string SimulatedSpu::place_of(std::uint32_t pc) {
  char text[32];
  std::snprintf(text, sizeof text, "LS 0x%05" PRIx32, pc);
  return text;
}

void SimulatedSpu::fail_at(std::uint32_t pc, Rule rule, const std::string& what) {
  settle();
  site_ = site_of(pc);
  fail(rule, what);
}

} // namespace celltrace::cell_emu

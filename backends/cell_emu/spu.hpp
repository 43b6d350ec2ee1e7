// The SPU that a kernel sees on the emulated Cell: spells SpuBase's operations in channels and MFC commands,
// and keeps the SPE's virtual clock.
#pragma once

#include "backends/cell_emu/channels.hpp"
#include "backends/cell_emu/decrementer.hpp"
#include "backends/cell_emu/operation_counter.hpp"
#include "backends/cell_emu/scheduler.hpp"
#include "celltrace/spe/simd_host.hpp"
#include "celltrace/spe/spu.hpp"

#include <functional>
#include <map>

namespace celltrace::cell_emu {

/// What the SPUs of a machine share.
struct SpuContext {
  const MfcContext& mfc;
  Scheduler& scheduler;
};

/// One run of a kernel on one SPE. Thread safety: belongs to the thread that runs the SPE.
///
/// A stall, or a poll that finds a count of 0, throws SpeError when the SPE has been interrupted; a broken
/// rule whose action is to stop throws RuleViolation.
class Spu : public SpuBase<Spu> {
public:
  static constexpr const char* kKey = "cell_emu";
  static constexpr bool direct_memory = false;
  using simd = HostSimd<xsimd::sse2, CountOperations>;

  /// `arena` is the part of the SPE's local store that is the kernel's.
  Spu(Spe& spe, const SpuContext& context, const ArenaState& arena);
  ~Spu();
  Spu(const Spu&) = delete;
  Spu& operator=(const Spu&) = delete;

  /// That of the program which runs here: for code that has no Spu at hand. Throws SpeError if none does.
  static Spu& running();

  std::uint32_t id() const { return spe_.id; }
  std::uint32_t count() const { return context_.mfc.bus.map().spes(); }
  /// Throws SpeError if there is no such SPE.
  SpeAddresses addresses(std::uint32_t spe) const;
  ArenaState& arena();
  [[noreturn]] void halt(HaltCode code, CallSite site = CallSite::here());
  [[noreturn]] void halt_exhausted(CallSite site) { halt(HaltCode::local_store_exhausted, site); }
  template <std::uint32_t code> void stop() { stop_with(code); }

  template <Channel c> std::uint32_t read_channel();
  template <Channel c> void write_channel(std::uint32_t value);
  /// A channel that does not exist has the count 0.
  template <Channel c> std::uint32_t channel_count();

  template <MfcOpcode op> void mfc_command(void* ls, ea_t ea, std::uint32_t size, std::uint32_t tag) {
    command({op, tag, local_address(ls), size, ea});
  }
  template <MfcOpcode op>
  void mfc_list_command(void* ls, ea_t ea, const ListElement* list, std::uint32_t bytes, std::uint32_t tag) {
    command({op, tag, local_address(ls), bytes, (ea & ~ea_t{0xFFFFFFFF}) | local_address(list)});
  }

  // --- what only the emulator has ---

  void compute(const ScalarWork& work) { cell_emu::count(work); }
  void note(const char* what, std::uint32_t value);
  void record(const void* source, std::uint32_t word) {
    if (SpeRecorder* recorder = context_.mfc.config.recorder) recorder->record(spe_.id, source, word);
  }
  void at(CallSite site) { site_ = site; }

  /// Offset in this SPE's local store; kOutsideLocalStore for a pointer to elsewhere.
  std::uint32_t local_address(const void* pointer) const;
  /// Zeroed local store that belongs to `key` until the program ends: what a static object is on a real SPE.
  void* local_static(const void* key, std::uint32_t bytes, std::uint32_t alignment);

  /// Channels by number, for programs that compute it; one that does not exist in this direction ends the
  /// program as an invalid channel does.
  std::uint32_t read_channel(unsigned channel);
  void write_channel(unsigned channel, std::uint32_t value);
  std::uint32_t channel_count(unsigned channel);

  /// SPU interrupts: while they are enabled and the event status has a count, `handler` runs before the next
  /// channel access, with interrupts disabled; it is called again until it has read the event status.
  void enable_interrupts(std::function<void(Spu&)> handler);
  void disable_interrupts() { interrupts_enabled_ = false; }
  /// bisled: calls `handler` if the event status has a count.
  template <class Handler> void branch_if_event(Handler handler) {
    if (event_count() != 0) handler(*this);
  }

  /// The virtual time, in cycles since the machine was made.
  Cycle cycles() {
    settle();
    return now_;
  }

  /// The kernel has returned, or stopped with an exit code: completes what is queued and looks for what it
  /// left undone.
  void finish();
  /// The kernel was broken off.
  void abandon();

  /// Thrown by stop() with one of the exit codes.
  struct Exit {
    std::uint32_t code;
  };

private:
  void command(const MfcCommand& command);
  void command_word(std::uint32_t word);
  void stop_with(std::uint32_t code);
  [[noreturn]] void fail(Rule rule, const std::string& what);

  // --- virtual time ---

  /// Charges what has been computed since the last access to a channel.
  void settle();
  void charge(std::uint32_t channel_reads, std::uint32_t channel_writes);
  /// The SPU has stood still until `until`.
  void waited(Cycle until, const char* what);
  /// Makes the cycles so far visible to the PPE's statistics.
  void publish_cycles() { counters_.cycles.publish(cycles_); }
  void inject_faults();
  void run_interrupts();

  std::uint32_t read_in_mailbox_channel();
  std::uint32_t read_signal(Signal which);
  std::uint32_t event_status_channel();
  std::uint32_t decrementer();
  void start_decrementer(std::uint32_t value);
  void event_ack_channel(std::uint32_t events);
  void update_decrementer();
  Cycle decrementer_deadline() const;

  /// Before an access to a channel that others can notice.
  void reach();
  /// Waits until channel `c` has a count.
  template <Channel c> void await();
  void await_other(Channel channel);
  void await_mfc(Channel channel);
  template <Channel c> std::uint32_t present_count();

  Spe& spe_;
  const SpuContext context_;
  Mfc& mfc_;
  ProblemState& state_;
  Counters& counters_;
  SeededRandom random_;
  ArenaState arena_;
  std::map<const void*, void*> statics_;
  MfcCommand parameters_{}; ///< channels 16..21 keep what was written
  unsigned written_parameters_ = 0;
  Decrementer decrementer_;
  std::uint32_t srr0_ = 0;
  CallSite site_;
  bool phantom_ = false; ///< the last event status was 0
  bool interrupts_enabled_ = false;
  bool in_handler_ = false;
  std::function<void(Spu&)> interrupt_handler_;

  SpuCycles cycles_; ///< since the machine was made
  Cycle now_;
  Cycle computing_since_;  ///< for the trace
  std::uint64_t slowness_; ///< in 1/65536: what faults make of a cycle of work
};

template <Channel c> void Spu::await() {
  if (present_count<c>() != 0) return;
  if (belongs_to_mfc(c))
    await_mfc(c);
  else
    await_other(c);
}

template <Channel c> std::uint32_t Spu::read_channel() {
  static_assert(is_readable(c), "no such channel, or it cannot be read");
  charge(1, 0);
  if constexpr (may_stall(c)) {
    reach();
    await<c>();
  }
  if constexpr (c == Channel::rd_event_stat) return event_status_channel();
  if constexpr (c == Channel::rd_sig_notify_1) return read_signal(Signal::one);
  if constexpr (c == Channel::rd_sig_notify_2) return read_signal(Signal::two);
  if constexpr (c == Channel::rd_dec) return decrementer();
  if constexpr (c == Channel::rd_event_mask) return state_.event_mask();
  if constexpr (c == Channel::rd_tag_mask) return mfc_.tag_mask();
  if constexpr (c == Channel::rd_mach_stat) return interrupts_enabled_ ? 1 : 0; // not isolated
  if constexpr (c == Channel::rd_srr0) return srr0_;
  if constexpr (c == Channel::rd_tag_stat) return mfc_.take_tag_status(now_);
  if constexpr (c == Channel::rd_list_stall_stat) return mfc_.take_list_stall_status(now_);
  if constexpr (c == Channel::rd_atomic_stat) return mfc_.take_atomic_status();
  if constexpr (c == Channel::rd_in_mbox) return read_in_mailbox_channel();
}

template <Channel c> void Spu::write_channel(std::uint32_t value) {
  static_assert(exists(c) && !is_readable(c), "no such channel, or it cannot be written");
  charge(0, 1);
  constexpr bool visible = may_stall(c) || c == Channel::wr_event_mask || c == Channel::wr_event_ack ||
                           c == Channel::wr_ms_sync_req || c == Channel::wr_tag_mask ||
                           c == Channel::wr_tag_update || c == Channel::wr_list_stall_ack;
  if constexpr (visible && c != Channel::mfc_cmd) {
    reach();
    await<c>();
  }
  if constexpr (c == Channel::wr_event_mask) state_.write_event_mask(value);
  if constexpr (c == Channel::wr_event_ack) event_ack_channel(value);
  if constexpr (c == Channel::wr_dec) start_decrementer(value);
  // What other SPEs have queued has not started, so nothing is on its way to this SPE.
  if constexpr (c == Channel::wr_ms_sync_req) state_.raise_own(event::multi_source_sync);
  if constexpr (c == Channel::wr_srr0) srr0_ = value;
  if constexpr (c == Channel::mfc_lsa) parameters_.lsa = value;
  if constexpr (c == Channel::mfc_eah) parameters_.ea = (ea_t{value} << 32) | (parameters_.ea & 0xFFFFFFFF);
  if constexpr (c == Channel::mfc_eal) parameters_.ea = (parameters_.ea & ~ea_t{0xFFFFFFFF}) | value;
  if constexpr (c == Channel::mfc_size) parameters_.size = value;
  if constexpr (c == Channel::mfc_tag_id) parameters_.tag = value;
  if constexpr (c >= Channel::mfc_lsa && c <= Channel::mfc_tag_id)
    written_parameters_ |= 1u << static_cast<unsigned>(c);
  if constexpr (c == Channel::mfc_cmd) command_word(value);
  if constexpr (c == Channel::wr_tag_mask) mfc_.write_tag_mask(value);
  if constexpr (c == Channel::wr_tag_update) mfc_.write_tag_update(value, site_, now_);
  if constexpr (c == Channel::wr_list_stall_ack) mfc_.acknowledge_list_stall(value, site_, now_);
  if constexpr (c == Channel::wr_out_mbox) {
    publish_cycles();
    state_.write_out_mailbox(value, now_);
    counters_.mailbox_words_sent.add(1);
    context_.scheduler.ring();
  }
  if constexpr (c == Channel::wr_out_intr_mbox) {
    publish_cycles();
    state_.write_out_interrupt_mailbox(value, now_);
    counters_.mailbox_words_sent.add(1);
    context_.scheduler.ring();
  }
}

template <Channel c> std::uint32_t Spu::present_count() {
  if constexpr (c == Channel::mfc_cmd) return mfc_.free_entries();
  if constexpr (c == Channel::rd_tag_stat) return mfc_.tag_status_available() ? 1 : 0;
  if constexpr (c == Channel::rd_list_stall_stat) return mfc_.list_stall_status_available() ? 1 : 0;
  if constexpr (c == Channel::rd_atomic_stat)
    return mfc_.atomic_status_available() && mfc_.atomic_status_time() <= now_ ? 1 : 0;
  if constexpr (!exists(c)) return 0;
  return state_.count(c);
}

template <Channel c> std::uint32_t Spu::channel_count() {
  charge(1, 0);
  if constexpr (may_stall(c)) {
    reach();
    if constexpr (c == Channel::rd_event_stat) update_decrementer();
    const std::uint32_t count = present_count<c>();
    if (count == 0 && state_.interrupted()) state_.stop_at(c);
    return count;
  }
  return present_count<c>();
}

} // namespace celltrace::cell_emu

// The common parts of the SPUs that run host code and machine code: channels, parameters of the next MFC
// command, decrementer, and the SPE's virtual clock.
//
// Before a derived SPU calls a member, it advances the clock by the cycles of computing and of the channel
// access; members act at now().
#pragma once

#include "backends/cell_emu/decrementer.hpp"
#include "backends/cell_emu/scheduler.hpp"
#include "celltrace/spe/channels.hpp"
#include "celltrace/spe/program.hpp"

#include <chrono>
#include <string>
#include <type_traits>

namespace celltrace::cell_emu {

/// State that the SPUs of a machine share.
struct SpuContext {
  const MfcContext& mfc;
  Scheduler& scheduler;
};

/// The SPU during one run of a program on one SPE. Thread safety: belongs to the thread that runs the SPE.
///
/// A stall, or a poll of a channel whose count is 0, throws SpeError if the SPE has been interrupted. A
/// broken rule with Action::stop throws RuleViolation.
class SpuCore {
public:
  SpuCore(Spe& spe, const SpuContext& context);
  SpuCore(const SpuCore&) = delete;
  SpuCore& operator=(const SpuCore&) = delete;

  std::uint32_t id() const { return spe_.id; }

protected:
  ~SpuCore() = default;

  // --- channels ---

  template <Channel c> std::uint32_t channel_read();
  template <Channel c> void channel_write(std::uint32_t value);
  /// Returns the count of a channel; 0 if the channel does not exist.
  template <Channel c> std::uint32_t channel_count_of();
  // Channel access by number; a channel that does not exist in this direction ends the program.
  std::uint32_t channel_read(unsigned channel);
  void channel_write(unsigned channel, std::uint32_t value);
  std::uint32_t channel_count_of(unsigned channel);
  /// Issues a whole command at once, without writing its parameters channel by channel.
  void issue_command(const MfcCommand& command);

  // --- run control ---

  /// Stops with a code and returns when the PPE has resumed the program; throws SpeExit if the code ends the
  /// program.
  void stop_with(std::uint32_t code);
  [[noreturn]] void fail(Rule rule, const std::string& what);
  /// Completes queued commands at the end of the program, and reports what the program left undone.
  void finish();
  /// Stores the program's virtual time in the SPE, when the program has ended or was broken off.
  void leave();

  // --- virtual time ---

  Cycle now() const { return now_; }
  /// Adds cycles in which the SPU was busy, or waited for its own pipelines. Configured faults lengthen them.
  void spend(SpuCycles cycles);
  /// Reports Rule::time_limit if the program takes longer than the configuration allows. Cheap enough for
  /// every channel access. SPUs whose program makes no accesses have to call this regularly.
  void check_limits() {
    if (now_ >= cycle_end_ || --checks_left_ == 0) [[unlikely]]
      check_clocks();
  }
  /// Adds cycles of channel accesses.
  void spend_on_channels(const SpuCycles& cycles) {
    now_ += cycles.total_cycle;
    cycles_ += cycles;
  }
  /// Adds the random pauses at channel accesses that the configuration asks for.
  void inject_faults();
  /// Advances the clock to the end `until` of a stall; `what` names the stall in the trace.
  void waited(Cycle until, const char* what);
  /// Makes the cycles so far visible to Machine::statistics().
  void publish_cycles() { counters_.cycles.publish(cycles_); }
  /// Waits for the SPE's turn. Call it before a channel access that other processors can notice.
  void reach() { context_.scheduler.reach(spe_, now_); }
  void update_decrementer();

  Spe& spe_;
  const SpuContext context_;
  Mfc& mfc_;
  ProblemState& state_;
  Counters& counters_;
  CallSite site_; ///< place of the present operation
  std::uint32_t srr0_ = 0;
  bool interrupts_enabled_ = false;

private:
  void spend_on_fault(std::uint64_t cycles);
  void check_clocks();
  void report_limit(const std::string& passed);
  void command_word(std::uint32_t word);
  std::uint32_t read_in_mailbox_channel();
  std::uint32_t read_signal_channel(Signal which);
  std::uint32_t event_status_channel();
  std::uint32_t decrementer();
  void start_decrementer(std::uint32_t value);
  void event_mask_channel(std::uint32_t mask);
  void event_ack_channel(std::uint32_t events);
  Cycle decrementer_deadline() const;

  /// Waits until the count of channel `c` is not 0.
  template <Channel c> void await();
  void await_other(Channel channel);
  void await_mfc(Channel channel);
  template <Channel c> std::uint32_t present_count();

  static constexpr std::uint64_t kUnit = 65536;
  /// Mask of the address bits of an instruction.
  static constexpr std::uint32_t kInstructionAddress = kLocalStoreBytes - 4;

  SeededRandom random_;
  MfcCommand parameters_{}; ///< channels 16..21 keep their values
  unsigned written_parameters_ = 0;
  Decrementer decrementer_;
  bool phantom_ = false; ///< true if the last event status was 0

  SpuCycles cycles_; ///< since the machine was made
  Cycle now_;
  Cycle computing_since_; ///< start of the current interval of computing, for the trace
  /// Number of calls of check_limits() for each look at the clock of the host.
  static constexpr std::uint32_t kClockCheckInterval = 1024;
  Cycle start_;
  Cycle cycle_end_ = kNever;
  std::uint32_t checks_left_ = kClockCheckInterval;
  std::optional<std::chrono::steady_clock::time_point> host_end_;
  std::uint64_t slowness_ = kUnit; ///< factor of configured faults for each cycle of work, in 1/65536
};

template <Channel c> void SpuCore::await() {
  if (present_count<c>() != 0) return;
  if (belongs_to_mfc(c))
    await_mfc(c);
  else
    await_other(c);
}

template <Channel c> std::uint32_t SpuCore::channel_read() {
  static_assert(is_readable(c), "no such channel, or it cannot be read");
  if constexpr (may_stall(c)) {
    reach();
    await<c>();
  }
  if constexpr (c == Channel::rd_event_stat) return event_status_channel();
  if constexpr (c == Channel::rd_sig_notify_1) return read_signal_channel(Signal::one);
  if constexpr (c == Channel::rd_sig_notify_2) return read_signal_channel(Signal::two);
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

template <Channel c> void SpuCore::channel_write(std::uint32_t value) {
  static_assert(exists(c) && !is_readable(c), "no such channel, or it cannot be written");
  constexpr bool visible = may_stall(c) || c == Channel::wr_event_mask || c == Channel::wr_event_ack ||
                           c == Channel::wr_ms_sync_req || c == Channel::wr_tag_mask ||
                           c == Channel::wr_tag_update || c == Channel::wr_list_stall_ack;
  if constexpr (visible && c != Channel::mfc_cmd) {
    reach();
    await<c>();
  }
  if constexpr (c == Channel::wr_event_mask) event_mask_channel(value);
  if constexpr (c == Channel::wr_event_ack) event_ack_channel(value);
  if constexpr (c == Channel::wr_dec) start_decrementer(value);
  // Transfers of other SPEs to this SPE are either complete or have not started, so there is nothing to wait
  // for.
  if constexpr (c == Channel::wr_ms_sync_req) state_.raise_own(event::multi_source_sync);
  if constexpr (c == Channel::wr_srr0) srr0_ = value & kInstructionAddress;
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

template <Channel c> std::uint32_t SpuCore::present_count() {
  if constexpr (c == Channel::mfc_cmd) return mfc_.free_entries();
  if constexpr (c == Channel::rd_tag_stat) return mfc_.tag_status_available() ? 1 : 0;
  if constexpr (c == Channel::rd_list_stall_stat) return mfc_.list_stall_status_available() ? 1 : 0;
  if constexpr (c == Channel::rd_atomic_stat)
    return mfc_.atomic_status_available() && mfc_.atomic_status_time() <= now_ ? 1 : 0;
  if constexpr (!exists(c)) return 0;
  return state_.count(c);
}

template <Channel c> std::uint32_t SpuCore::channel_count_of() {
  if constexpr (may_stall(c)) {
    reach();
    if constexpr (c == Channel::rd_event_stat) update_decrementer();
    const std::uint32_t count = present_count<c>();
    if constexpr (c == Channel::mfc_cmd)
      if (count == kMfcQueueEntries) mfc_.observe_empty_queue(site_, now_);
    if (count == 0 && state_.interrupted()) state_.stop_at(c);
    return count;
  }
  return present_count<c>();
}

} // namespace celltrace::cell_emu

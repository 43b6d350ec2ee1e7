// The SPU that a kernel sees on the emulated Cell: spells SpuBase's operations in channels and MFC commands.
#pragma once

#include "backends/cell_emu/channels.hpp"
#include "backends/cell_emu/counters.hpp"
#include "backends/cell_emu/decrementer.hpp"
#include "backends/cell_emu/mfc.hpp"
#include "celltrace/spe/simd_host.hpp"
#include "celltrace/spe/spu.hpp"

namespace celltrace::cell_emu {

/// One run of a kernel on one SPE. Thread safety: belongs to the thread of that SPE.
///
/// Every stall first lets the MFC move what it still can, so that nobody waits for data that this SPE holds
/// back. A stall, or a poll that finds a count of 0, throws SpeError when the SPE has been interrupted.
class Spu : public SpuBase<Spu> {
public:
  static constexpr const char* kKey = "cell_emu";
  static constexpr bool direct_memory = false;
  using simd = HostSimd<xsimd::sse2>;

  /// `arena` is the part of the SPE's local store that is the kernel's.
  Spu(unsigned id, Bus& bus, ProblemState& problem_state, Counters& counters, const ArenaState& arena);

  std::uint32_t id() const { return id_; }
  std::uint32_t count() const { return bus_.map().spes(); }
  /// Throws SpeError if there is no such SPE.
  SpeAddresses addresses(std::uint32_t spe) const;
  ArenaState& arena();
  [[noreturn]] void halt(HaltCode code);

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

  /// The kernel has returned: completes what is queued.
  void finish();

private:
  static constexpr std::uint64_t kCyclesPerChannel = 6;
  static constexpr std::uint64_t kBytesPerCycle = 8;

  std::uint32_t local_address(const void* pointer) const;
  void command(const MfcCommand& command);
  void command_word(std::uint32_t word);

  std::uint32_t event_status_channel();
  std::uint32_t decrementer();
  void start_decrementer(std::uint32_t value);
  void event_ack_channel(std::uint32_t events);
  void update_decrementer();
  /// The virtual clock since the kernel started: a fixed cost for channel accesses and for bytes moved.
  std::uint64_t cycles() const { return cycles_ + (mfc_.bytes_moved() - bytes_before_) / kBytesPerCycle; }

  /// Before an access to a channel that may stall.
  template <Channel c> void prepare();
  template <Channel c> std::uint32_t present_count();

  const unsigned id_;
  Bus& bus_;
  ProblemState& problem_state_;
  Counters& counters_;
  Mfc mfc_;
  ArenaState arena_;
  MfcCommand parameters_{}; ///< channels 16..21 keep what was written
  Decrementer decrementer_;
  std::uint32_t srr0_ = 0;
  std::uint64_t cycles_ = 0; ///< without bytes moved
  const std::uint64_t bytes_before_;
};

template <Channel c> void Spu::prepare() {
  // A lock-line command never stalls, but a program that spins on one waits all the same.
  if (present_count<c>() != 0 && c != Channel::rd_atomic_stat) return;
  if (problem_state_.interrupted()) problem_state_.stop_at(c);
  // The MFC's own channels move what they need themselves.
  if constexpr (!belongs_to_mfc(c)) mfc_.drain();
}

template <Channel c> std::uint32_t Spu::read_channel() {
  static_assert(is_readable(c), "no such channel, or it cannot be read");
  cycles_ += kCyclesPerChannel;
  if constexpr (may_stall(c)) prepare<c>();
  if constexpr (c == Channel::rd_event_stat) return event_status_channel();
  if constexpr (c == Channel::rd_sig_notify_1) return problem_state_.read_signal(Signal::one);
  if constexpr (c == Channel::rd_sig_notify_2) return problem_state_.read_signal(Signal::two);
  if constexpr (c == Channel::rd_dec) return decrementer();
  if constexpr (c == Channel::rd_event_mask) return problem_state_.event_mask();
  if constexpr (c == Channel::rd_tag_mask) return mfc_.tag_mask();
  if constexpr (c == Channel::rd_mach_stat) return 0; // not isolated, interrupts disabled
  if constexpr (c == Channel::rd_srr0) return srr0_;
  if constexpr (c == Channel::rd_tag_stat) return mfc_.read_tag_status();
  if constexpr (c == Channel::rd_list_stall_stat) return mfc_.read_list_stall_status();
  if constexpr (c == Channel::rd_atomic_stat) return mfc_.read_atomic_status();
  if constexpr (c == Channel::rd_in_mbox) return problem_state_.read_in_mailbox();
}

template <Channel c> void Spu::write_channel(std::uint32_t value) {
  static_assert(exists(c) && !is_readable(c), "no such channel, or it cannot be written");
  cycles_ += kCyclesPerChannel;
  if constexpr (may_stall(c) && c != Channel::mfc_cmd) prepare<c>();
  if constexpr (c == Channel::wr_event_mask) problem_state_.write_event_mask(value);
  if constexpr (c == Channel::wr_event_ack) event_ack_channel(value);
  if constexpr (c == Channel::wr_dec) start_decrementer(value);
  // What other SPEs have queued has not started, so nothing is on its way to this SPE.
  if constexpr (c == Channel::wr_ms_sync_req) problem_state_.raise_own(event::multi_source_sync);
  if constexpr (c == Channel::wr_srr0) srr0_ = value;
  if constexpr (c == Channel::mfc_lsa) parameters_.lsa = value;
  if constexpr (c == Channel::mfc_eah) parameters_.ea = (ea_t{value} << 32) | (parameters_.ea & 0xFFFFFFFF);
  if constexpr (c == Channel::mfc_eal) parameters_.ea = (parameters_.ea & ~ea_t{0xFFFFFFFF}) | value;
  if constexpr (c == Channel::mfc_size) parameters_.size = value;
  if constexpr (c == Channel::mfc_tag_id) parameters_.tag = value;
  if constexpr (c == Channel::mfc_cmd) command_word(value);
  if constexpr (c == Channel::wr_tag_mask) mfc_.write_tag_mask(value);
  if constexpr (c == Channel::wr_tag_update) mfc_.write_tag_update(value);
  if constexpr (c == Channel::wr_list_stall_ack) mfc_.acknowledge_list_stall(value);
  if constexpr (c == Channel::wr_out_mbox) {
    problem_state_.write_out_mailbox(value);
    counters_.mailbox_words_sent.add(1);
  }
  if constexpr (c == Channel::wr_out_intr_mbox) {
    problem_state_.write_out_interrupt_mailbox(value);
    counters_.mailbox_words_sent.add(1);
  }
}

template <Channel c> std::uint32_t Spu::present_count() {
  if constexpr (c == Channel::rd_event_stat) return problem_state_.event_count();
  if constexpr (c == Channel::rd_sig_notify_1) return problem_state_.signal_count(Signal::one);
  if constexpr (c == Channel::rd_sig_notify_2) return problem_state_.signal_count(Signal::two);
  if constexpr (c == Channel::rd_in_mbox) return problem_state_.in_mailbox_count();
  if constexpr (c == Channel::wr_out_mbox) return problem_state_.out_mailbox_space();
  if constexpr (c == Channel::wr_out_intr_mbox) return problem_state_.out_interrupt_mailbox_space();
  if constexpr (c == Channel::mfc_cmd) return mfc_.free_entries();
  if constexpr (c == Channel::rd_tag_stat) return mfc_.tag_status_available() ? 1 : 0;
  if constexpr (c == Channel::rd_list_stall_stat) return mfc_.list_stall_status_available() ? 1 : 0;
  if constexpr (c == Channel::rd_atomic_stat) return mfc_.atomic_status_available() ? 1 : 0;
  return exists(c) ? 1 : 0;
}

template <Channel c> std::uint32_t Spu::channel_count() {
  cycles_ += kCyclesPerChannel;
  if constexpr (c == Channel::rd_event_stat) update_decrementer();
  const std::uint32_t count = present_count<c>();
  if constexpr (may_stall(c)) {
    if (count != 0) return count;
    if (problem_state_.interrupted()) problem_state_.stop_at(c);
    mfc_.advance();
  }
  return count;
}

} // namespace celltrace::cell_emu

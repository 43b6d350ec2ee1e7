// What of an SPE others can touch: mailboxes, signal notification registers, and the events that they raise;
// and the stalling of the SPU on those.
//
// Thread safety: all members from any thread, except those that the comments give to the SPU's own thread.
// Counts are answered from one atomic word, so that kernels may poll them at little cost.
#pragma once

#include "backends/cell_emu/events.hpp"
#include "backends/cell_emu/mailbox.hpp"
#include "backends/cell_emu/ppe_bell.hpp"
#include "backends/cell_emu/signal.hpp"

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>

namespace celltrace::cell_emu {

class ProblemState {
public:
  ProblemState(unsigned spe, const SignalMode (&modes)[2], PpeBell& bell);

  // --- registers, for other SPEs and the PPE ---

  /// A write to the mapped register: a full inbound mailbox loses its newest word.
  void write_in_mailbox(std::uint32_t value);
  /// Blocks while the mailbox is full. Throws SpeError if the SPE is not running and the mailbox is full.
  void write_in_mailbox_when_free(std::uint32_t value);
  void write_signal(Signal which, std::uint32_t value);
  std::uint32_t peek_signal(Signal which) const;
  std::optional<std::uint32_t> take_out_mailbox();
  std::optional<std::uint32_t> take_out_interrupt_mailbox();
  /// An event of this SPE has occurred.
  void raise(std::uint32_t events);

  // --- counts: one atomic load each ---

  unsigned event_count() const { return status() & kEvent ? 1 : 0; }
  unsigned signal_count(Signal which) const { return status() & signal_bit(which) ? 1 : 0; }
  unsigned in_mailbox_count() const { return (status() & kInMailboxCount) / kInMailboxUnit; }
  /// Free entries: 1 or 0.
  unsigned out_mailbox_space() const { return status() & kOutMailboxFull ? 0 : 1; }
  unsigned out_interrupt_mailbox_space() const { return status() & kOutInterruptMailboxFull ? 0 : 1; }
  bool has_outbound_mail() const { return (status() & (kOutMailboxFull | kOutInterruptMailboxFull)) != 0; }
  bool running() const { return (status() & kRunning) != 0; }
  bool interrupted() const { return (status() & kInterrupted) != 0; }

  // --- channels, for the SPU's own thread
  // -------------------------------------------------------------------------- Those that stall throw
  // SpeError when the SPE is interrupted.

  std::uint32_t read_in_mailbox();
  std::uint32_t read_signal(Signal which);
  void write_out_mailbox(std::uint32_t value);
  void write_out_interrupt_mailbox(std::uint32_t value);
  std::uint32_t read_event_status();
  std::uint32_t event_mask() const { return mask_.load(std::memory_order_relaxed); }
  void write_event_mask(std::uint32_t mask);
  void acknowledge_events(std::uint32_t events);
  /// As raise(); cheap when the event is pending and masked already.
  void raise_own(std::uint32_t events) {
    if ((masked_pending_.load(std::memory_order_relaxed) & events) != events) raise(events);
  }
  /// Throws the SpeError of an SPE that was interrupted at a channel.
  [[noreturn]] void stop_at(Channel channel) const;

  // --- run control ---

  /// The SPE starts: the event facility is as after a reset, except that full mailboxes and signals are
  /// pending.
  void start();
  void stop();
  /// Makes the SPU stop where it stalls or polls. `because` is the error of the SPE that failed first, or
  /// empty. Only the first call counts.
  void interrupt(std::string because) noexcept;
  /// Takes an interrupt back. Only while the SPE is not running.
  void resume();

private:
  static constexpr std::uint32_t kEvent = 1u << 0;
  static constexpr std::uint32_t kSignal1 = 1u << 1;
  static constexpr std::uint32_t kSignal2 = 1u << 2;
  static constexpr std::uint32_t kInMailboxUnit = 1u << 4;
  static constexpr std::uint32_t kInMailboxCount = 7u << 4;
  static constexpr std::uint32_t kOutMailboxFull = 1u << 8;
  static constexpr std::uint32_t kOutInterruptMailboxFull = 1u << 9;
  static constexpr std::uint32_t kRunning = 1u << 10;
  static constexpr std::uint32_t kInterrupted = 1u << 11;

  static constexpr std::uint32_t signal_bit(Signal which) {
    return which == Signal::one ? kSignal1 : kSignal2;
  }
  static constexpr std::uint32_t signal_event(Signal which) {
    return which == Signal::one ? event::signal_1 : event::signal_2;
  }
  SignalRegister& signal(Signal which) { return which == Signal::one ? signal_1_ : signal_2_; }
  const SignalRegister& signal(Signal which) const { return which == Signal::one ? signal_1_ : signal_2_; }
  std::uint32_t status() const { return status_.load(std::memory_order_acquire); }

  /// Stalls on a channel until `ready()`.
  template <class Ready> void stall(std::unique_lock<std::mutex>& lock, Channel channel, Ready ready);
  void deliver_mail(std::uint32_t value);
  std::optional<std::uint32_t> take(Mailbox<1>& mailbox, std::uint32_t event);
  void put(Mailbox<1>& mailbox, Channel channel, std::uint32_t value);
  /// Makes a change visible: to polls by the status word, to sleepers by the condition.
  void publish();

  const unsigned spe_;
  PpeBell& bell_;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  Mailbox<kInboundMailboxEntries> in_mailbox_;
  Mailbox<1> out_mailbox_;
  Mailbox<1> out_interrupt_mailbox_;
  SignalRegister signal_1_;
  SignalRegister signal_2_;
  EventFacility events_;
  bool running_ = false;
  bool interrupted_ = false;
  std::string because_;

  std::atomic<std::uint32_t> status_{0};
  std::atomic<std::uint32_t> mask_{0};
  std::atomic<std::uint32_t> masked_pending_{0};
};

} // namespace celltrace::cell_emu

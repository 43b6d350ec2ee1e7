// The part of an SPE that the PPE and other SPEs can access: mailboxes, signal notification registers, and
// the events that these raise.
//
// Thread safety: all members from any thread, except members that are marked as the SPU's own. Counts are
// parts of one atomic word, so that kernels can poll channels at little cost.
#pragma once

#include "backends/cell_emu/cycle.hpp"
#include "backends/cell_emu/events.hpp"
#include "backends/cell_emu/mailbox.hpp"
#include "backends/cell_emu/signal.hpp"
#include "backends/cell_emu/trace.hpp"
#include "celltrace/spe/call_site.hpp"

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>

namespace celltrace::cell_emu {

/// The sender of a word, and the virtual time of the word's arrival.
struct Sender {
  unsigned spe; ///< number of the SPE, or Diagnostic::kPpe
  Cycle at;
};

/// An observer of the beginnings and ends of stalls. Called with the SPE's problem state locked.
class StallObserver {
public:
  virtual ~StallObserver() = default;
  virtual void stalled(unsigned spe) = 0;
  /// Called when a change has ended the stall.
  virtual void unstalled(unsigned spe) = 0;
};

class ProblemState {
public:
  ProblemState(unsigned spe, const SignalMode (&modes)[2], StallObserver& observer, Trace* trace);

  // --- registers, for other SPEs and the PPE ---

  /// Writes the mapped register. Returns false if the mailbox was full and lost its newest word.
  bool write_in_mailbox(std::uint32_t value, Sender sender);
  /// Writes a signal. Returns false if an unread value was lost.
  bool write_signal(Signal which, std::uint32_t value, Sender sender);
  std::uint32_t peek_signal(Signal which) const;
  std::optional<std::uint32_t> read_out_mailbox(Cycle now);
  std::optional<std::uint32_t> read_out_interrupt_mailbox(Cycle now);
  /// Raises events of this SPE.
  void raise(std::uint32_t events);

  // --- counts: one atomic load each ---

  unsigned event_count() const { return status() & kEvent ? 1 : 0; }
  unsigned signal_count(Signal which) const { return status() & signal_bit(which) ? 1 : 0; }
  unsigned in_mailbox_count() const { return (status() & kInMailboxCount) / kInMailboxUnit; }
  /// Return the number of free entries: 1 or 0.
  unsigned out_mailbox_space() const { return status() & kOutMailboxFull ? 0 : 1; }
  unsigned out_interrupt_mailbox_space() const { return status() & kOutInterruptMailboxFull ? 0 : 1; }
  bool has_outbound_mail() const { return (status() & (kOutMailboxFull | kOutInterruptMailboxFull)) != 0; }
  bool interrupted() const { return (status() & kInterrupted) != 0; }
  /// Returns the count of a channel that depends on other processors.
  unsigned count(Channel channel) const;

  // --- channels, for the SPU's own thread; only while the count is not 0 ---

  // A read happens at time `now`, which is raised to the word's time of arrival if that is later: when
  // exploring, an SPE may read a word before its own virtual time has reached the sender's.
  std::uint32_t read_in_mailbox(Cycle& now);
  std::uint32_t read_signal(Signal which, Cycle& now);
  void write_out_mailbox(std::uint32_t value, Cycle now);
  void write_out_interrupt_mailbox(std::uint32_t value, Cycle now);
  std::uint32_t read_event_status();
  std::uint32_t event_mask() const { return mask_.load(std::memory_order_relaxed); }
  void write_event_mask(std::uint32_t mask);
  void acknowledge_events(std::uint32_t events);
  /// As raise(); fast if the events are already pending and disabled.
  void raise_own(std::uint32_t events) {
    if ((masked_pending_.load(std::memory_order_relaxed) & events) != events) raise(events);
  }
  /// Throws SpeError for an SPE that was interrupted at a channel.
  [[noreturn]] void stop_at(Channel channel) const;
  /// Throws SpeError for an SPE that was interrupted while it ran, at `place`.
  [[noreturn]] void stop_running(const std::string& place) const;
  /// Throws SpeError for an SPE that was interrupted while it was stopped with a signal.
  [[noreturn]] void stop_while_stopped(std::uint32_t code) const;

  // --- stalls ---

  struct Stall {
    Channel channel;
    CallSite site;
    bool after_phantom; ///< true if the last event status that the program read was 0
  };
  /// Begins to wait until the count of `stall.channel` is not 0. Returns false if the count is not 0 already,
  /// or if the SPE was interrupted.
  bool begin_stall(const Stall& stall);
  /// Blocks until a change has ended the stall. Used if the SPE has a thread of its own.
  void sleep_until_unstalled();
  void end_stall();
  std::optional<Stall> stall() const;

  // --- run control ---

  /// Starts the SPE: the event facility is as after a reset, except that events of full mailboxes and signals
  /// are pending.
  void start();
  /// Makes the SPU stop where it stalls or polls. The SPU's error ends with `because`, which may be empty.
  /// Calls after the first are ignored.
  void interrupt(std::string because) noexcept;
  /// Withdraws an interrupt. The SPE must not be running.
  void resume();

private:
  static constexpr std::uint32_t kEvent = 1u << 0;
  static constexpr std::uint32_t kSignal1 = 1u << 1;
  static constexpr std::uint32_t kSignal2 = 1u << 2;
  static constexpr std::uint32_t kInMailboxUnit = 1u << 4;
  static constexpr std::uint32_t kInMailboxCount = 7u << 4;
  static constexpr std::uint32_t kOutMailboxFull = 1u << 8;
  static constexpr std::uint32_t kOutInterruptMailboxFull = 1u << 9;
  static constexpr std::uint32_t kInterrupted = 1u << 10;

  static constexpr std::uint32_t signal_bit(Signal which) {
    return which == Signal::one ? kSignal1 : kSignal2;
  }
  static constexpr std::uint32_t signal_event(Signal which) {
    return which == Signal::one ? event::signal_1 : event::signal_2;
  }
  static constexpr const char* name_of_signal(Signal which) {
    return which == Signal::one ? "signal 1" : "signal 2";
  }
  SignalRegister& signal(Signal which) { return which == Signal::one ? signal_1_ : signal_2_; }
  const SignalRegister& signal(Signal which) const { return which == Signal::one ? signal_1_ : signal_2_; }
  std::uint32_t status() const { return status_.load(std::memory_order_acquire); }

  Word sent(const char* what, std::uint32_t value, Sender sender) const;
  std::uint32_t received(const char* what, Word word, unsigned by, Cycle now) const;
  std::optional<std::uint32_t> take(Mailbox<1>& mailbox, const char* what, std::uint32_t event, Cycle now);
  /// Makes a change visible to polls, by the status word, and to a stalled SPU, whose stall ends.
  void publish();

  const unsigned spe_;
  StallObserver& observer_;
  Trace* const trace_;

  mutable std::mutex mutex_;
  std::condition_variable unstalled_;
  Mailbox<kInboundMailboxEntries> in_mailbox_;
  Mailbox<1> out_mailbox_;
  Mailbox<1> out_interrupt_mailbox_;
  SignalRegister signal_1_;
  SignalRegister signal_2_;
  EventFacility events_;
  bool interrupted_ = false;
  std::string because_;
  std::optional<Stall> stall_;

  std::atomic<std::uint32_t> status_{0};
  std::atomic<std::uint32_t> mask_{0};
  std::atomic<std::uint32_t> masked_pending_{0};
};

} // namespace celltrace::cell_emu

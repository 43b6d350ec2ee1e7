// What of an SPE others can touch: mailboxes, signal notification registers, and the events that they raise.
//
// Thread safety: all members from any thread, except those that the comments give to the SPU's own thread.
// Counts are answered from one atomic word, so that kernels may poll them at little cost.
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

/// Who wrote a word, and when.
struct Sender {
  unsigned spe; ///< or Diagnostic::kPpe
  Cycle at;
};

/// Is told of stalls. Called with the SPE's problem state locked.
class StallObserver {
public:
  virtual ~StallObserver() = default;
  virtual void stalled(unsigned spe) = 0;
  /// A change has ended the stall.
  virtual void unstalled(unsigned spe) = 0;
};

class ProblemState {
public:
  ProblemState(unsigned spe, const SignalMode (&modes)[2], StallObserver& observer, Trace* trace);

  // --- registers, for other SPEs and the PPE ---

  /// A write to the mapped register. False if the mailbox was full and lost its newest word.
  bool write_in_mailbox(std::uint32_t value, Sender sender);
  /// False if a value that nobody had read was lost.
  bool write_signal(Signal which, std::uint32_t value, Sender sender);
  std::uint32_t peek_signal(Signal which) const;
  std::optional<std::uint32_t> take_out_mailbox(Cycle now);
  std::optional<std::uint32_t> take_out_interrupt_mailbox(Cycle now);
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
  bool interrupted() const { return (status() & kInterrupted) != 0; }
  /// The count of a channel whose count depends on others.
  unsigned count(Channel channel) const;

  // --- channels, for the SPU's own thread; only while the count is not 0 ---

  // Reads at time `now`, which rises to the time at which the word arrived if that is later: exploring, an
  // SPE may come to read a word before it is as late as the word's sender.
  std::uint32_t read_in_mailbox(Cycle& now);
  std::uint32_t read_signal(Signal which, Cycle& now);
  void write_out_mailbox(std::uint32_t value, Cycle now);
  void write_out_interrupt_mailbox(std::uint32_t value, Cycle now);
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
  /// The same for one that was interrupted on its way, at `place`.
  [[noreturn]] void stop_running(const std::string& place) const;
  /// The same for one that was interrupted while it was stopped with a signal.
  [[noreturn]] void stop_while_stopped(std::uint32_t code) const;

  // --- stalls: who waits for what ---

  struct Stall {
    Channel channel;
    CallSite site;
    bool after_phantom; ///< the last event status that the program read was 0
  };
  /// The SPU waits from now on for `stall.channel` to have a count. False if it has one already, or the SPE
  /// was interrupted.
  bool begin_stall(const Stall& stall);
  /// Blocks until the stall has ended by a change; for a thread of the SPE's own.
  void sleep_until_unstalled();
  void end_stall();
  std::optional<Stall> stall() const;

  // --- run control ---

  /// The SPE starts: the event facility is as after a reset, except that full mailboxes and signals are
  /// pending.
  void start();
  /// Makes the SPU stop where it stalls or polls; `because` ends its error, or is empty. Only the first call
  /// counts.
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
  /// Makes a change visible: to polls by the status word, to who waits by an end of its stall.
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

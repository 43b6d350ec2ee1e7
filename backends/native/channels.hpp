// Channels: mailboxes, signal notification, events, decrementer and run control of one SPE of the native
// machine.
#pragma once

#include "backends/native/decrementer.hpp"
#include "backends/native/doorbell.hpp"
#include "celltrace/spe/machine.hpp"
#include "celltrace/spe/types.hpp"

#include <array>
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>

namespace celltrace::native {

/// The exception that ends a kernel that was interrupted in a stall.
struct Interrupted {};

/// The two outbound mailboxes of an SPE; writes into the second interrupt the PPE.
enum class OutMailbox : std::uint32_t { plain, interrupting };

/// Channels of one SPE with the semantics of the Cell Broadband Engine Architecture. The count of the event
/// status is 0 or 1. It rises when an enabled event occurs, and when an enabled event is still pending after
/// a write of the mask or an acknowledge; it falls only when the status is read.
///
/// Thread safety: the first group of members belongs to the SPE's thread, the second to any thread. Reading a
/// count is one atomic load, so that kernels can poll in loops.
class Channels {
public:
  /// Makes the channels. They ring `ppe` when the SPE writes into an outbound mailbox or stops.
  Channels(const SignalMode (&modes)[2], Doorbell& ppe);
  Channels(const Channels&) = delete;
  Channels& operator=(const Channels&) = delete;

  // --- the SPE's thread; stalls throw Interrupted once interrupt() was called ---

  std::uint32_t read_in_mailbox();
  std::uint32_t in_mailbox_count() const noexcept { return in_count_.load(std::memory_order_acquire); }
  void write_out_mailbox(OutMailbox which, std::uint32_t value);
  /// Returns the number of free entries, 1 or 0.
  std::uint32_t out_mailbox_count(OutMailbox which) const noexcept { return has_mail(which) ? 0 : 1; }

  std::uint32_t read_signal(Signal which);
  std::uint32_t signal_count(Signal which) const noexcept {
    return signals_[index(which)].count.load(std::memory_order_acquire);
  }

  void write_event_mask(std::uint32_t mask);
  std::uint32_t read_event_mask() const noexcept { return mask_; }
  std::uint32_t read_event_status();
  std::uint32_t event_count() {
    // If its event is not enabled, the decrementer cannot change the count, and need not be read: programs
    // that use it as a clock call this often.
    if ((mask_ & event::decrementer) != 0 && decrementer_.counts()) collect_expiry();
    return event_count_.load(std::memory_order_acquire);
  }
  void acknowledge_events(std::uint32_t mask);
  /// Raises an event that the SPE's own commands cause. Fast if the event is already pending and disabled.
  void raise_own(std::uint32_t event) {
    if ((pending_.load(std::memory_order_relaxed) & ~mask_ & event) != event) raise(event);
  }

  void write_decrementer(std::uint32_t value);
  std::uint32_t read_decrementer() const { return decrementer_.read(); }

  /// Stalls on a channel whose count can never rise again: sleeps until interrupted.
  [[noreturn]] void stall_for_ever();
  /// Stops with a signal and sleeps until the PPE calls resume().
  void stop_and_signal(std::uint32_t code);

  // --- any thread ---

  /// Writes a word without waiting: in a full mailbox it replaces the newest word.
  void put_in_mailbox(std::uint32_t value);
  /// Waits for space, then writes a word. Returns false if the mailbox is full and no kernel runs that could
  /// empty it.
  bool write_in_mailbox(std::uint32_t value);
  void write_signal(Signal which, std::uint32_t value);
  bool has_mail(OutMailbox which) const noexcept {
    return out_[index(which)].full.load(std::memory_order_acquire);
  }
  std::optional<std::uint32_t> read_out_mailbox(OutMailbox which);
  void raise(std::uint32_t events);

  /// Begins a kernel: resets its event mask and decrementer; mailboxes and signals stay as others left
  /// them.
  void begin();
  /// Ends a kernel.
  void end(std::uint32_t exit_code = 0);
  bool running() const noexcept { return state_.load(std::memory_order_acquire) == State::running; }
  bool stopped_with_signal() const noexcept {
    return state_.load(std::memory_order_acquire) == State::stopped;
  }
  /// Waits while the kernel runs. Returns how the last kernel ended, or the signal that the present kernel
  /// has stopped with; {exit, 0} if there was no kernel.
  SpeStop wait_while_running();
  /// Resumes a kernel that stopped with a signal; returns false if no kernel has stopped so.
  bool resume();
  /// Makes present and later stalls throw Interrupted, until withdraw_interrupt(). A stop with a signal
  /// counts as a stall: it ends at once.
  void interrupt() noexcept;
  void withdraw_interrupt();

private:
  enum class State : std::uint8_t { idle, running, stopped };

  struct SignalRegister {
    SignalMode mode = SignalMode::overwrite;
    std::uint32_t value = 0;
    std::atomic<std::uint32_t> count{0};
  };
  struct OutRegister {
    std::uint32_t value = 0;
    std::atomic<bool> full{false};
  };

  static constexpr std::size_t index(Signal which) { return which == Signal::one ? 0 : 1; }
  static constexpr std::size_t index(OutMailbox which) { return which == OutMailbox::plain ? 0 : 1; }

  template <class Ready> void stall_until(std::unique_lock<std::mutex>& lock, Ready ready);
  void push_in(std::uint32_t value);
  void leave_running(State state, SpeStop stop);
  void raise_locked(std::uint32_t events);
  void recount();
  void collect_expiry();

  Doorbell& ppe_;
  std::mutex mutex_;
  std::condition_variable spu_wakes_;     ///< the SPE's thread sleeps here
  std::condition_variable space_made_;    ///< the PPE sleeps here for space in the inbound mailbox
  std::condition_variable state_changed_; ///< the PPE sleeps here until the kernel stops
  std::atomic<State> state_{State::idle}; ///< written under the mutex
  SpeStop stop_;
  bool interrupted_ = false;

  std::array<std::uint32_t, kInboundMailboxEntries> in_words_{}; ///< oldest first
  std::atomic<std::uint32_t> in_count_{0};
  OutRegister out_[2];
  SignalRegister signals_[2];

  std::atomic<std::uint32_t> pending_{0};
  std::uint32_t mask_ = 0; ///< written by the SPE's thread only
  std::atomic<std::uint32_t> event_count_{0};
  Decrementer decrementer_;
};

} // namespace celltrace::native

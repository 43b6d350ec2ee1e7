#include "backends/native/channels.hpp"

#include <algorithm>

namespace celltrace::native {

namespace {

using Lock = std::unique_lock<std::mutex>;

/// Events that only the kernel's own commands cause.
constexpr std::uint32_t kOwnEvents = event::tag_status | event::list_stall | event::command_queue |
                                     event::decrementer | event::reservation_lost;

} // namespace

Channels::Channels(const SignalMode (&modes)[2], Doorbell& ppe) : ppe_(ppe) {
  signals_[0].mode = modes[0];
  signals_[1].mode = modes[1];
}

template <class Ready> void Channels::stall_until(Lock& lock, Ready ready) {
  spu_wakes_.wait(lock, [&] { return ready() || interrupted_; });
  if (!ready()) throw Interrupted{};
}

void Channels::stall_for_ever() {
  Lock lock(mutex_);
  stall_until(lock, [] { return false; });
  throw Interrupted{};
}

// --- inbound mailbox ---

std::uint32_t Channels::read_in_mailbox() {
  Lock lock(mutex_);
  stall_until(lock, [&] { return in_mailbox_count() > 0; });
  const std::uint32_t word = in_words_[0];
  std::shift_left(in_words_.begin(), in_words_.end(), 1);
  in_count_.store(in_mailbox_count() - 1, std::memory_order_release);
  space_made_.notify_one();
  return word;
}

void Channels::push_in(std::uint32_t value) {
  const std::uint32_t entry = std::min(in_mailbox_count(), kInboundMailboxEntries - 1);
  in_words_[entry] = value;
  in_count_.store(entry + 1, std::memory_order_release);
  spu_wakes_.notify_one();
  raise_locked(event::in_mailbox);
}

void Channels::put_in_mailbox(std::uint32_t value) {
  const Lock lock(mutex_);
  push_in(value);
}

bool Channels::write_in_mailbox(std::uint32_t value) {
  Lock lock(mutex_);
  const auto has_space = [&] { return in_mailbox_count() < kInboundMailboxEntries; };
  space_made_.wait(lock, [&] { return has_space() || !running() || interrupted_; });
  if (!has_space()) return false;
  push_in(value);
  return true;
}

// --- outbound mailboxes ---

void Channels::write_out_mailbox(OutMailbox which, std::uint32_t value) {
  OutRegister& mailbox = out_[index(which)];
  {
    Lock lock(mutex_);
    stall_until(lock, [&] { return !has_mail(which); });
    mailbox.value = value;
    mailbox.full.store(true, std::memory_order_release);
  }
  ppe_.ring();
}

std::optional<std::uint32_t> Channels::read_out_mailbox(OutMailbox which) {
  OutRegister& mailbox = out_[index(which)];
  const Lock lock(mutex_);
  if (!has_mail(which)) return std::nullopt;
  mailbox.full.store(false, std::memory_order_release);
  spu_wakes_.notify_one();
  raise_locked(which == OutMailbox::plain ? event::out_mailbox : event::out_intr_mailbox);
  return mailbox.value;
}

// --- signal notification ---

std::uint32_t Channels::read_signal(Signal which) {
  SignalRegister& reg = signals_[index(which)];
  Lock lock(mutex_);
  stall_until(lock, [&] { return signal_count(which) > 0; });
  reg.count.store(0, std::memory_order_release);
  const std::uint32_t value = reg.value;
  reg.value = 0;
  return value;
}

void Channels::write_signal(Signal which, std::uint32_t value) {
  SignalRegister& reg = signals_[index(which)];
  const Lock lock(mutex_);
  reg.value = reg.mode == SignalMode::logical_or ? reg.value | value : value;
  reg.count.store(1, std::memory_order_release);
  spu_wakes_.notify_one();
  raise_locked(which == Signal::one ? event::signal_1 : event::signal_2);
}

// --- events ---

void Channels::raise(std::uint32_t events) {
  const Lock lock(mutex_);
  raise_locked(events);
}

void Channels::raise_locked(std::uint32_t events) {
  pending_.store(pending_.load(std::memory_order_relaxed) | events, std::memory_order_relaxed);
  if ((events & mask_) == 0) return;
  event_count_.store(1, std::memory_order_release);
  spu_wakes_.notify_one();
}

void Channels::recount() {
  if ((pending_.load(std::memory_order_relaxed) & mask_) != 0)
    event_count_.store(1, std::memory_order_release);
}

void Channels::collect_expiry() {
  if (decrementer_.take_expiry()) raise(event::decrementer);
}

void Channels::write_event_mask(std::uint32_t mask) {
  collect_expiry();
  const Lock lock(mutex_);
  mask_ = mask;
  recount();
}

void Channels::acknowledge_events(std::uint32_t mask) {
  collect_expiry();
  // In the architecture, the decrementer stops if its event is acknowledged while it is masked.
  if ((mask & ~mask_ & event::decrementer) != 0) decrementer_.stop();
  const Lock lock(mutex_);
  pending_.store(pending_.load(std::memory_order_relaxed) & ~mask, std::memory_order_relaxed);
  recount();
}

std::uint32_t Channels::read_event_status() {
  collect_expiry();
  Lock lock(mutex_);
  const auto ready = [&] { return event_count_.load(std::memory_order_relaxed) != 0 || interrupted_; };
  while (!ready()) {
    if (!decrementer_.counts() || (mask_ & event::decrementer) == 0) {
      spu_wakes_.wait(lock, ready);
    } else {
      spu_wakes_.wait_until(lock, decrementer_.next_expiry(), ready);
      if (decrementer_.take_expiry()) raise_locked(event::decrementer);
    }
  }
  if (event_count_.load(std::memory_order_relaxed) == 0) throw Interrupted{};
  event_count_.store(0, std::memory_order_relaxed);
  return pending_.load(std::memory_order_relaxed) & mask_;
}

void Channels::write_decrementer(std::uint32_t value) {
  collect_expiry();
  decrementer_.write(value);
}

// --- run control ---

void Channels::begin() {
  const Lock lock(mutex_);
  state_.store(State::running, std::memory_order_release);
  stop_ = {};
  mask_ = 0;
  pending_.store(pending_.load(std::memory_order_relaxed) & ~kOwnEvents, std::memory_order_relaxed);
  event_count_.store(0, std::memory_order_relaxed);
  decrementer_ = Decrementer{};
}

void Channels::end(std::uint32_t exit_code) {
  {
    const Lock lock(mutex_);
    leave_running(State::idle, {SpeStop::Reason::exit, exit_code});
  }
  ppe_.ring_for_stop();
}

void Channels::stop_and_signal(std::uint32_t code) {
  Lock lock(mutex_);
  if (interrupted_) throw Interrupted{};
  leave_running(State::stopped, {SpeStop::Reason::stop_and_signal, code});
  lock.unlock();
  ppe_.ring_for_stop();
  lock.lock();
  spu_wakes_.wait(lock, [&] { return running(); });
  if (interrupted_) throw Interrupted{};
}

void Channels::leave_running(State state, SpeStop stop) {
  state_.store(state, std::memory_order_release);
  stop_ = stop;
  state_changed_.notify_all();
  space_made_.notify_all();
}

SpeStop Channels::wait_while_running() {
  Lock lock(mutex_);
  state_changed_.wait(lock, [&] { return !running(); });
  return stop_;
}

bool Channels::resume() {
  const Lock lock(mutex_);
  if (!stopped_with_signal()) return false;
  state_.store(State::running, std::memory_order_release);
  spu_wakes_.notify_one();
  return true;
}

void Channels::interrupt() noexcept {
  const Lock lock(mutex_);
  interrupted_ = true;
  // The interrupted kernel is about to end: the PPE must wait for the end, and not find the stop.
  if (stopped_with_signal()) state_.store(State::running, std::memory_order_release);
  spu_wakes_.notify_all();
  space_made_.notify_all();
}

void Channels::withdraw_interrupt() {
  const Lock lock(mutex_);
  interrupted_ = false;
}

} // namespace celltrace::native

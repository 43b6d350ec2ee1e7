#include "backends/cell_emu/problem_state.hpp"

#include "backends/cell_emu/channels.hpp"
#include "celltrace/error.hpp"

namespace celltrace::cell_emu {

ProblemState::ProblemState(unsigned spe, const SignalMode (&modes)[2], PpeBell& bell)
    : spe_(spe), bell_(bell), signal_1_(modes[0]), signal_2_(modes[1]) {
}

void ProblemState::publish() {
  std::uint32_t status = in_mailbox_.count() * kInMailboxUnit;
  if (events_.count() != 0) status |= kEvent;
  if (signal_1_.count() != 0) status |= kSignal1;
  if (signal_2_.count() != 0) status |= kSignal2;
  if (out_mailbox_.full()) status |= kOutMailboxFull;
  if (out_interrupt_mailbox_.full()) status |= kOutInterruptMailboxFull;
  if (running_) status |= kRunning;
  if (interrupted_) status |= kInterrupted;
  mask_.store(events_.mask(), std::memory_order_relaxed);
  masked_pending_.store(events_.pending() & ~events_.mask(), std::memory_order_relaxed);
  status_.store(status, std::memory_order_release);
  changed_.notify_all();
}

// --- registers ---

void ProblemState::deliver_mail(std::uint32_t value) {
  const bool was_empty = in_mailbox_.empty();
  in_mailbox_.push(value);
  if (was_empty) events_.raise(event::in_mailbox);
  publish();
}

void ProblemState::write_in_mailbox(std::uint32_t value) {
  const std::lock_guard lock(mutex_);
  deliver_mail(value);
}

void ProblemState::write_in_mailbox_when_free(std::uint32_t value) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return !in_mailbox_.full() || !running_; });
  if (in_mailbox_.full())
    throw SpeError("SPE " + std::to_string(spe_) + ": is not running, and its inbound mailbox is full");
  deliver_mail(value);
}

void ProblemState::write_signal(Signal which, std::uint32_t value) {
  const std::lock_guard lock(mutex_);
  if (signal(which).write(value)) events_.raise(signal_event(which));
  publish();
}

std::uint32_t ProblemState::peek_signal(Signal which) const {
  const std::lock_guard lock(mutex_);
  return signal(which).peek();
}

std::optional<std::uint32_t> ProblemState::take(Mailbox<1>& mailbox, std::uint32_t event) {
  const std::lock_guard lock(mutex_);
  if (mailbox.empty()) return std::nullopt;
  const std::uint32_t value = mailbox.pop();
  events_.raise(event);
  publish();
  return value;
}

std::optional<std::uint32_t> ProblemState::take_out_mailbox() {
  if (out_mailbox_space() != 0) return std::nullopt;
  return take(out_mailbox_, event::out_mailbox);
}

std::optional<std::uint32_t> ProblemState::take_out_interrupt_mailbox() {
  if (out_interrupt_mailbox_space() != 0) return std::nullopt;
  return take(out_interrupt_mailbox_, event::out_intr_mailbox);
}

void ProblemState::raise(std::uint32_t events) {
  const std::lock_guard lock(mutex_);
  events_.raise(events);
  publish();
}

// --- channels ---

void ProblemState::stop_at(Channel channel) const {
  std::string text = "SPE " + std::to_string(spe_) + ": interrupted at channel " +
                     std::to_string(static_cast<unsigned>(channel)) + " (" + name_of(channel) + ")";
  if (!because_.empty()) text += ", because another SPE failed first: " + because_;
  throw SpeError(text);
}

template <class Ready>
void ProblemState::stall(std::unique_lock<std::mutex>& lock, Channel channel, Ready ready) {
  changed_.wait(lock, [&] { return ready() || interrupted_; });
  if (!ready()) stop_at(channel);
}

std::uint32_t ProblemState::read_in_mailbox() {
  std::unique_lock lock(mutex_);
  stall(lock, Channel::rd_in_mbox, [&] { return !in_mailbox_.empty(); });
  const std::uint32_t value = in_mailbox_.pop();
  publish();
  return value;
}

std::uint32_t ProblemState::read_signal(Signal which) {
  std::unique_lock lock(mutex_);
  SignalRegister& from = signal(which);
  stall(lock, which == Signal::one ? Channel::rd_sig_notify_1 : Channel::rd_sig_notify_2,
        [&] { return from.count() != 0; });
  const std::uint32_t value = from.read();
  publish();
  return value;
}

void ProblemState::put(Mailbox<1>& mailbox, Channel channel, std::uint32_t value) {
  {
    std::unique_lock lock(mutex_);
    stall(lock, channel, [&] { return !mailbox.full(); });
    mailbox.push(value);
    publish();
  }
  bell_.ring_mail();
}

void ProblemState::write_out_mailbox(std::uint32_t value) {
  put(out_mailbox_, Channel::wr_out_mbox, value);
}

void ProblemState::write_out_interrupt_mailbox(std::uint32_t value) {
  put(out_interrupt_mailbox_, Channel::wr_out_intr_mbox, value);
}

std::uint32_t ProblemState::read_event_status() {
  std::unique_lock lock(mutex_);
  stall(lock, Channel::rd_event_stat, [&] { return events_.count() != 0; });
  const std::uint32_t value = events_.read_status();
  publish();
  return value;
}

void ProblemState::write_event_mask(std::uint32_t mask) {
  const std::lock_guard lock(mutex_);
  events_.write_mask(mask);
  publish();
}

void ProblemState::acknowledge_events(std::uint32_t events) {
  const std::lock_guard lock(mutex_);
  events_.acknowledge(events);
  publish();
}

// --- run control ---

void ProblemState::start() {
  const std::lock_guard lock(mutex_);
  std::uint32_t pending = 0;
  if (!in_mailbox_.empty()) pending |= event::in_mailbox;
  if (signal_1_.count() != 0) pending |= event::signal_1;
  if (signal_2_.count() != 0) pending |= event::signal_2;
  events_.reset(pending);
  running_ = true;
  publish();
}

void ProblemState::stop() {
  const std::lock_guard lock(mutex_);
  running_ = false;
  publish();
}

void ProblemState::interrupt(std::string because) noexcept {
  const std::lock_guard lock(mutex_);
  if (interrupted_) return;
  interrupted_ = true;
  because_ = std::move(because);
  publish();
}

void ProblemState::resume() {
  const std::lock_guard lock(mutex_);
  interrupted_ = false;
  because_.clear();
  publish();
}

} // namespace celltrace::cell_emu

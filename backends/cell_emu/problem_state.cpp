#include "backends/cell_emu/problem_state.hpp"

#include "backends/cell_emu/diagnostic_log.hpp"
#include "celltrace/spe/channels.hpp"

#include <algorithm>

namespace celltrace::cell_emu {

ProblemState::ProblemState(unsigned spe, const SignalMode (&modes)[2], StallObserver& observer, Trace* trace)
    : spe_(spe), observer_(observer), trace_(trace), signal_1_(modes[0]), signal_2_(modes[1]) {
}

void ProblemState::publish() {
  std::uint32_t status = in_mailbox_.count() * kInMailboxUnit;
  if (events_.count() != 0) status |= kEvent;
  if (signal_1_.count() != 0) status |= kSignal1;
  if (signal_2_.count() != 0) status |= kSignal2;
  if (out_mailbox_.full()) status |= kOutMailboxFull;
  if (out_interrupt_mailbox_.full()) status |= kOutInterruptMailboxFull;
  if (interrupted_) status |= kInterrupted;
  mask_.store(events_.mask(), std::memory_order_relaxed);
  masked_pending_.store(events_.pending() & ~events_.mask(), std::memory_order_relaxed);
  status_.store(status, std::memory_order_release);
  if (!stall_ || (count(stall_->channel) == 0 && !interrupted_)) return;
  stall_.reset();
  observer_.unstalled(spe_);
  unstalled_.notify_all();
}

unsigned ProblemState::count(Channel channel) const {
  switch (channel) {
  case Channel::rd_event_stat:
    return event_count();
  case Channel::rd_sig_notify_1:
    return signal_count(Signal::one);
  case Channel::rd_sig_notify_2:
    return signal_count(Signal::two);
  case Channel::rd_in_mbox:
    return in_mailbox_count();
  case Channel::wr_out_mbox:
    return out_mailbox_space();
  case Channel::wr_out_intr_mbox:
    return out_interrupt_mailbox_space();
  default:
    return 1;
  }
}

// --- registers ---

Word ProblemState::sent(const char* what, std::uint32_t value, Sender sender) const {
  return {value, trace_ == nullptr ? 0 : trace_->send(sender.spe, what, value, sender.at), sender.at};
}

std::uint32_t ProblemState::received(const char* what, Word word, unsigned by, Cycle now) const {
  if (trace_ != nullptr) trace_->receive(word.arrow, by, what, now);
  return word.value;
}

bool ProblemState::write_in_mailbox(std::uint32_t value, Sender sender) {
  const std::lock_guard lock(mutex_);
  const bool was_empty = in_mailbox_.empty();
  const bool was_full = in_mailbox_.full();
  in_mailbox_.push(sent("mailbox", value, sender));
  if (was_empty) events_.raise(event::in_mailbox);
  publish();
  return !was_full;
}

bool ProblemState::write_signal(Signal which, std::uint32_t value, Sender sender) {
  const std::lock_guard lock(mutex_);
  SignalRegister& to = signal(which);
  const bool lost = to.loses_a_value();
  const bool was_empty = to.count() == 0;
  to.write(sent(name_of_signal(which), value, sender));
  if (was_empty) events_.raise(signal_event(which));
  publish();
  return !lost;
}

std::uint32_t ProblemState::peek_signal(Signal which) const {
  const std::lock_guard lock(mutex_);
  return signal(which).peek();
}

std::optional<std::uint32_t> ProblemState::take(Mailbox<1>& mailbox, const char* what, std::uint32_t event,
                                                Cycle now) {
  const std::lock_guard lock(mutex_);
  if (mailbox.empty()) return std::nullopt;
  const Word word = mailbox.pop();
  events_.raise(event);
  publish();
  return received(what, word, Diagnostic::kPpe, now);
}

std::optional<std::uint32_t> ProblemState::read_out_mailbox(Cycle now) {
  if (out_mailbox_space() != 0) return std::nullopt;
  return take(out_mailbox_, "out mailbox", event::out_mailbox, now);
}

std::optional<std::uint32_t> ProblemState::read_out_interrupt_mailbox(Cycle now) {
  if (out_interrupt_mailbox_space() != 0) return std::nullopt;
  return take(out_interrupt_mailbox_, "out interrupt mailbox", event::out_intr_mailbox, now);
}

void ProblemState::raise(std::uint32_t events) {
  const std::lock_guard lock(mutex_);
  events_.raise(events);
  publish();
}

// --- channels ---

void ProblemState::stop_at(Channel channel) const {
  const std::lock_guard lock(mutex_);
  throw SpeError("SPE " + std::to_string(spe_) + ": interrupted at channel " +
                 std::to_string(static_cast<unsigned>(channel)) + " (" + name_of(channel) + ")" + because_);
}

void ProblemState::stop_running(const std::string& place) const {
  const std::lock_guard lock(mutex_);
  throw SpeError("SPE " + std::to_string(spe_) + ": interrupted at " + place + because_);
}

void ProblemState::stop_while_stopped(std::uint32_t code) const {
  const std::lock_guard lock(mutex_);
  throw SpeError("SPE " + std::to_string(spe_) + ": interrupted while it was stopped with code " +
                 std::to_string(code) + because_);
}

std::uint32_t ProblemState::read_in_mailbox(Cycle& now) {
  const std::lock_guard lock(mutex_);
  const Word word = in_mailbox_.pop();
  now = std::max(now, word.at);
  publish();
  return received("mailbox", word, spe_, now);
}

std::uint32_t ProblemState::read_signal(Signal which, Cycle& now) {
  const std::lock_guard lock(mutex_);
  const Word word = signal(which).read();
  now = std::max(now, word.at);
  publish();
  return received(name_of_signal(which), word, spe_, now);
}

void ProblemState::write_out_mailbox(std::uint32_t value, Cycle now) {
  const std::lock_guard lock(mutex_);
  out_mailbox_.push(sent("out mailbox", value, {spe_, now}));
  publish();
}

void ProblemState::write_out_interrupt_mailbox(std::uint32_t value, Cycle now) {
  const std::lock_guard lock(mutex_);
  out_interrupt_mailbox_.push(sent("out interrupt mailbox", value, {spe_, now}));
  publish();
}

std::uint32_t ProblemState::read_event_status() {
  const std::lock_guard lock(mutex_);
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

// --- stalls ---

bool ProblemState::begin_stall(const Stall& stall) {
  const std::lock_guard lock(mutex_);
  if (count(stall.channel) != 0 || interrupted_) return false;
  stall_ = stall;
  observer_.stalled(spe_);
  return true;
}

void ProblemState::sleep_until_unstalled() {
  std::unique_lock lock(mutex_);
  unstalled_.wait(lock, [&] { return !stall_; });
}

void ProblemState::end_stall() {
  const std::lock_guard lock(mutex_);
  stall_.reset();
}

std::optional<ProblemState::Stall> ProblemState::stall() const {
  const std::lock_guard lock(mutex_);
  return stall_;
}

// --- run control ---

void ProblemState::start() {
  const std::lock_guard lock(mutex_);
  std::uint32_t pending = 0;
  if (!in_mailbox_.empty()) pending |= event::in_mailbox;
  if (signal_1_.count() != 0) pending |= event::signal_1;
  if (signal_2_.count() != 0) pending |= event::signal_2;
  events_.reset(pending);
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

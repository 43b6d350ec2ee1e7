#include "backends/cell_emu/spu_core.hpp"

#include <algorithm>
#include <string>

namespace celltrace::cell_emu {
namespace {

constexpr std::uint64_t kSpuStream = 0x535055;

constexpr unsigned kAllParameters = 0x1F << 16;
/// Parameters that need not be written: programs that use the 32-bit intrinsics rely on an EAH of 0.
constexpr unsigned kOptionalParameters = 1u << static_cast<unsigned>(Channel::mfc_eah);

const char* wait_for(Channel channel) {
  switch (channel) {
  case Channel::rd_event_stat:
    return "wait for event";
  case Channel::rd_sig_notify_1:
  case Channel::rd_sig_notify_2:
    return "wait for signal";
  case Channel::rd_in_mbox:
    return "wait for mailbox";
  case Channel::wr_out_mbox:
  case Channel::wr_out_intr_mbox:
    return "wait for PPE";
  case Channel::mfc_cmd:
    return "queue full";
  case Channel::rd_tag_stat:
    return "wait for tag group";
  case Channel::rd_list_stall_stat:
    return "wait for list";
  case Channel::rd_atomic_stat:
    return "wait for lock line";
  default:
    return "wait";
  }
}

/// Calls `use(std::integral_constant<Channel, c>)` for the channel with this number.
template <unsigned c = 0, class Use> void with_channel(unsigned channel, Use use) {
  if constexpr (c <= static_cast<unsigned>(Channel::pm_stop_event)) {
    if (c == channel) return use(std::integral_constant<Channel, static_cast<Channel>(c)>());
    with_channel<c + 1>(channel, use);
  }
}

} // namespace

SpuCore::SpuCore(Spe& spe, const SpuContext& context)
    : spe_(spe), context_(context), mfc_(spe.mfc), state_(spe.state), counters_(spe.counters),
      random_(context.mfc.config.seed, kSpuStream + spe.id),
      decrementer_(context.mfc.config.timing.cycles_per_tick), cycles_(spe.counters.cycles.value()),
      now_(spe.now), computing_since_(spe.now), start_(spe.now) {
  const double slowest = std::max(1.0, context.mfc.config.faults.slowest_spe);
  const EmulationConfig& config = context.mfc.config;
  if (config.cycle_limit != 0 && config.cycle_limit < kNever - start_)
    cycle_end_ = start_ + config.cycle_limit;
  if (config.seconds_limit != 0)
    host_end_ =
        std::chrono::steady_clock::now() + std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                                               std::chrono::duration<double>(config.seconds_limit));
  slowness_ = kUnit + static_cast<std::uint64_t>((slowest - 1.0) * kUnit * random_.fraction());
}

void SpuCore::finish() {
  reach();
  leave();
  mfc_.finish(now_);
  const auto left = [&](Rule rule, bool broken, const char* what) {
    if (!broken) return;
    Diagnostic diagnostic;
    diagnostic.rule = rule;
    diagnostic.spe = id();
    diagnostic.cycle = now_;
    context_.mfc.log.report(diagnostic, what + std::string(text_of(rule)));
  };
  left(Rule::mailbox_unread, state_.in_mailbox_count() != 0, "");
  left(Rule::signal_unread, state_.signal_count(Signal::one) != 0, "signal 1: ");
  left(Rule::signal_unread, state_.signal_count(Signal::two) != 0, "signal 2: ");
}

void SpuCore::leave() {
  publish_cycles();
  spe_.now = now_;
  if (context_.mfc.trace != nullptr) context_.mfc.trace->compute(id(), computing_since_, now_);
}

void SpuCore::fail(Rule rule, const std::string& what) {
  Diagnostic diagnostic;
  diagnostic.rule = rule;
  diagnostic.spe = id();
  diagnostic.site = site_;
  diagnostic.cycle = now_;
  if (!context_.mfc.log.note(diagnostic, what)) diagnostic.text = "SPE " + std::to_string(id()) + ": " + what;
  throw RuleViolation(diagnostic);
}

void SpuCore::stop_with(std::uint32_t code) {
  publish_cycles();
  reach();
  if (code >= 0x2000 && code <= 0x20FF) throw SpeExit{code & 0xFF};
  waited(context_.scheduler.pause(spe_, code, now_), "stopped");
}

// --- virtual time ---

void SpuCore::spend(SpuCycles cycles) {
  if (slowness_ != kUnit) {
    cycles.stall_due_to_injection = cycles.total_cycle * slowness_ / kUnit - cycles.total_cycle;
    cycles.total_cycle += cycles.stall_due_to_injection;
  }
  now_ += cycles.total_cycle;
  cycles_ += cycles;
}

void SpuCore::check_clocks() {
  checks_left_ = kClockCheckInterval;
  const EmulationConfig& config = context_.mfc.config;
  if (now_ >= cycle_end_) report_limit(std::to_string(config.cycle_limit) + " cycles");
  if (host_end_ && std::chrono::steady_clock::now() >= *host_end_)
    report_limit(std::to_string(config.seconds_limit) + " seconds");
}

void SpuCore::report_limit(const std::string& passed) {
  Diagnostic diagnostic;
  diagnostic.rule = Rule::time_limit;
  diagnostic.spe = id();
  diagnostic.site = site_;
  diagnostic.cycle = now_;
  context_.mfc.log.report(diagnostic, "after " + passed + ": " + std::string(text_of(Rule::time_limit)));
  // A program that may go on gets one report only.
  cycle_end_ = kNever;
  host_end_.reset();
}

void SpuCore::inject_faults() {
  const Faults& faults = context_.mfc.config.faults;
  if (random_.fraction() >= faults.pause_probability) return;
  spend_on_fault(random_.below(faults.longest_pause));
}

void SpuCore::spend_on_fault(std::uint64_t cycles) {
  now_ += cycles;
  cycles_.stall_due_to_injection += cycles;
  cycles_.total_cycle += cycles;
}

void SpuCore::waited(Cycle until, const char* what) {
  if (until <= now_) return;
  if (Trace* const trace = context_.mfc.trace) {
    trace->compute(id(), computing_since_, now_);
    trace->wait(id(), what, now_, until);
    computing_since_ = until;
  }
  cycles_.channel_stall_cycle += until - now_;
  cycles_.total_cycle += until - now_;
  now_ = until;
}

void SpuCore::await_mfc(Channel channel) {
  const Cycle before = now_;
  const auto ready = [&] {
    switch (channel) {
    case Channel::mfc_cmd:
      return mfc_.free_entries() != 0;
    case Channel::rd_tag_stat:
      return mfc_.tag_status_available();
    case Channel::rd_list_stall_stat:
      return mfc_.list_stall_status_available();
    default:
      return mfc_.atomic_status_available() && mfc_.atomic_status_time() <= now_;
    }
  };
  Cycle until = before;
  while (!ready()) {
    if (state_.interrupted()) state_.stop_at(channel);
    if (channel == Channel::rd_atomic_stat && mfc_.atomic_status_available()) {
      waited(mfc_.atomic_status_time(), wait_for(channel));
      reach();
      return;
    }
    const Cycle next = mfc_.next_event();
    if (next == kNever) {
      const std::string why =
          channel == Channel::rd_tag_stat          ? mfc_.why_no_tag_status()
          : channel == Channel::rd_list_stall_stat ? "no list in the queue has a notify element"
          : channel == Channel::mfc_cmd ? "the queue is full, and all of it waits for stopped lists"
                                        : "no lock-line command has been issued";
      fail(Rule::stalls_for_ever, std::string(name_of(channel)) + " would stall for ever: " + why);
    }
    until = std::max(until, next);
    context_.scheduler.await_mfc(spe_, until);
  }
  waited(until, wait_for(channel));
}

void SpuCore::await_other(Channel channel) {
  publish_cycles();
  for (;;) {
    if (state_.interrupted()) state_.stop_at(channel);
    const Cycle deadline = channel == Channel::rd_event_stat ? decrementer_deadline() : kNever;
    waited(context_.scheduler.stall(spe_, {channel, site_, phantom_}, now_, deadline), wait_for(channel));
    if (channel == Channel::rd_event_stat) update_decrementer();
    if (state_.count(channel) != 0) return;
  }
}

// --- MFC commands ---

void SpuCore::issue_command(const MfcCommand& command) {
  reach();
  await<Channel::mfc_cmd>();
  parameters_ = command;
  written_parameters_ = 0;
  mfc_.issue(command, site_, now_);
}

void SpuCore::command_word(std::uint32_t word) {
  reach();
  await<Channel::mfc_cmd>();
  const unsigned missing = kAllParameters & ~kOptionalParameters & ~written_parameters_;
  written_parameters_ = 0;
  // The high half holds replacement class and transfer class ids, which affect performance only.
  MfcCommand issued = parameters_;
  issued.opcode = static_cast<MfcOpcode>(word & 0xFFFF);
  if (missing != 0 && kind_of(issued.opcode) != CommandKind::barrier) {
    Diagnostic diagnostic;
    diagnostic.rule = Rule::parameters_kept;
    diagnostic.spe = id();
    diagnostic.site = site_;
    diagnostic.cycle = now_;
    context_.mfc.log.report(diagnostic,
                            describe(issued) + ": " + std::string(text_of(Rule::parameters_kept)));
  }
  mfc_.issue(issued, site_, now_);
}

// --- events, interrupts and the decrementer ---

std::uint32_t SpuCore::read_in_mailbox_channel() {
  Cycle arrived = now_;
  const std::uint32_t value = state_.read_in_mailbox(arrived);
  waited(arrived, wait_for(Channel::rd_in_mbox));
  return value;
}

std::uint32_t SpuCore::read_signal_channel(Signal which) {
  Cycle arrived = now_;
  const std::uint32_t value = state_.read_signal(which, arrived);
  waited(arrived, wait_for(Channel::rd_sig_notify_1));
  return value;
}

std::uint32_t SpuCore::event_status_channel() {
  update_decrementer();
  const std::uint32_t status = state_.read_event_status();
  phantom_ = status == 0;
  return status;
}

Cycle SpuCore::decrementer_deadline() const {
  const bool expected = decrementer_.running() && (state_.event_mask() & event::decrementer) != 0;
  return expected ? decrementer_.expiry() : kNever;
}

void SpuCore::update_decrementer() {
  if (decrementer_.advance(now_)) state_.raise_own(event::decrementer);
}

std::uint32_t SpuCore::decrementer() {
  update_decrementer();
  return decrementer_.value();
}

void SpuCore::start_decrementer(std::uint32_t value) {
  update_decrementer();
  if (decrementer_.write(value, now_)) state_.raise_own(event::decrementer);
}

void SpuCore::event_mask_channel(std::uint32_t mask) {
  // If the decrementer has expired by now, its event counts under the old mask; the new mask may make it a
  // phantom event.
  update_decrementer();
  state_.write_event_mask(mask);
}

void SpuCore::event_ack_channel(std::uint32_t events) {
  update_decrementer();
  state_.acknowledge_events(events);
  // The decrementer stops if its event is acknowledged while it is masked.
  if ((events & ~state_.event_mask() & event::decrementer) != 0) decrementer_.freeze(now_);
}

// --- channels by number ---

std::uint32_t SpuCore::channel_read(unsigned channel) {
  std::uint32_t value = 0;
  bool known = false;
  with_channel(channel, [&](auto c) {
    if constexpr (is_readable(c())) {
      value = channel_read<c()>();
      known = true;
    }
  });
  if (!known)
    fail(Rule::invalid_channel,
         "read of channel " + std::to_string(channel) + ": " + std::string(text_of(Rule::invalid_channel)));
  return value;
}

void SpuCore::channel_write(unsigned channel, std::uint32_t value) {
  bool known = false;
  with_channel(channel, [&](auto c) {
    if constexpr (exists(c()) && !is_readable(c())) {
      channel_write<c()>(value);
      known = true;
    }
  });
  if (!known)
    fail(Rule::invalid_channel,
         "write of channel " + std::to_string(channel) + ": " + std::string(text_of(Rule::invalid_channel)));
}

std::uint32_t SpuCore::channel_count_of(unsigned channel) {
  std::uint32_t count = 0;
  with_channel(channel, [&](auto c) { count = channel_count_of<c()>(); });
  return count;
}

} // namespace celltrace::cell_emu

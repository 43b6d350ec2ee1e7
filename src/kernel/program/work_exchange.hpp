// Transport of the balancer on an SPE: words by mailbox, doorbells by signal 2, inside the frame's event
// domain. Kernel dialect.
#pragma once

#include "celltrace/balance/strip.hpp"
#include "celltrace/spe/one_copy.hpp"
#include "kernel/modules.hpp"
#include "records/frame.hpp"
#include "records/report.hpp"

namespace celltrace::kernel {

/// Connects a StripNode to the SPE's mailbox and signal 2, and to the PPE.
template <class Spu> class WorkExchange {
public:
  explicit WorkExchange(Spu& spu) : spu_(spu), node_(spu.id(), spu.count()) {}

  /// Enters the frame's event domain, which consists of signal 2 and the mailbox.
  void begin_frame(const FrameBlock& frame, UnitRange units) {
    spu_.enter_module(modules::kExchange);
    enter_domain(frame, units);
  }
  void end_frame() { node_.end_frame(); }

  /// Takes a unit. After the last unit the node is dry and asks for more, so that answers arrive while the
  /// SPE works.
  bool take_unit(uint32_t& unit) {
    if (!node_.take_unit(unit)) return false;
    if (node_.remaining().empty()) {
      spu_.enter_module(modules::kExchange);
      act();
    }
    return true;
  }
  void complete_unit(uint32_t unit) {
    node_.complete_unit();
    uint32_t word = make_report(ReportKind::unit, unit);
    if (units_per_report_ != kEachUnit) {
      if (units_per_report_ == 0 || --until_report_ != 0) return;
      until_report_ = units_per_report_;
      if (spu_.out_mailbox_count() == 0) return;
      word = make_report(ReportKind::progress, node_.completed());
    }
    spu_.write_out_mailbox(word);
  }

  /// Handles received words and doorbells without stalling; cheap if there are none. True: the frame is over.
  bool poll() {
    if (spu_.event_count() == 0) return false;
    spu_.enter_module(modules::kExchange);
    return handle();
  }
  /// Performs the actions of a dry node, then stalls until something arrives.
  void wait() {
    spu_.enter_module(modules::kExchange);
    wait_for_work();
  }
  /// Returns true once the PPE has declared the frame finished.
  bool over() const { return over_; }

  /// Return the exchanges that brought this node units in this frame, and the number of units.
  uint32_t exchanges() const { return exchanges_; }
  uint32_t units_received() const { return received_; }

private:
  static constexpr uint32_t kDomain = event::signal_2 | event::in_mailbox;

  CELLTRACE_ONE_COPY void enter_domain(const FrameBlock& frame, UnitRange units) {
    spu_.run_in_module(modules::kExchange);
    over_ = false;
    epoch_ = frame.epoch & (strip_word::kEpochs - 1);
    exchanges_ = 0;
    received_ = 0;
    until_report_ = units_per_report_ = frame.units_per_word;
    // Words from an earlier frame are removed; words of a neighbour that is a frame ahead are kept.
    drain_mailbox();
    node_.begin_frame(frame.epoch, units, frame.exchange_parameter);
    spu_.write_event_mask(kDomain);
    act();
  }
  CELLTRACE_ONE_COPY void wait_for_work() {
    spu_.run_in_module(modules::kExchange);
    act();
    if (node_.remaining().empty() && !over_) handle();
  }

  /// Handles events in the safe order: mask, read, acknowledge, drain, unmask. A phantom event finds nothing
  /// to drain.
  CELLTRACE_ONE_COPY bool handle() {
    spu_.run_in_module(modules::kExchange);
    const uint32_t events = spu_.read_event_status();
    spu_.write_event_mask(0);
    spu_.acknowledge_events(events);
    drain_mailbox();
    drain_doorbell();
    spu_.write_event_mask(kDomain);
    act();
    return over_;
  }
  CELLTRACE_ONE_COPY void drain_mailbox() {
    while (spu_.in_mailbox_count() != 0) {
      const uint32_t word = spu_.read_in_mailbox();
      // A doorbell that was delivered before the word has to be seen first.
      drain_doorbell();
      on_word(word);
    }
  }
  void drain_doorbell() {
    if (spu_.signal_2_count() != 0) node_.on_doorbell(spu_.read_signal_2());
  }
  void on_word(uint32_t word) {
    if (strip_word::from_ppe(word)) {
      over_ = over_ || strip_word::epoch(word) == epoch_;
      return;
    }
    const uint32_t before = node_.remaining().count;
    node_.on_word(word);
    const uint32_t after = node_.remaining().count;
    if (after <= before) return;
    ++exchanges_;
    received_ += after - before;
    spu_.note("balance exchange", after - before);
  }

  CELLTRACE_ONE_COPY void act() {
    for (;;) {
      const StripAction action = node_.next_action();
      switch (action.kind) {
      case StripAction::Kind::none:
        return;
      case StripAction::Kind::send_word:
        if (action.doorbell != 0) spu_.send_signal(action.neighbour, Signal::two, action.doorbell);
        spu_.send_mailbox(action.neighbour, action.word);
        break;
      case StripAction::Kind::ring:
        spu_.send_signal(action.neighbour, Signal::two, action.doorbell);
        break;
      case StripAction::Kind::report_idle:
        spu_.write_out_mailbox(make_report(ReportKind::idle, action.units));
        break;
      }
    }
  }

  Spu& spu_;
  StripNode node_;
  uint32_t epoch_ = 0;
  bool over_ = true;
  uint32_t exchanges_ = 0;
  uint32_t received_ = 0;
  uint32_t units_per_report_ = 0, until_report_ = 0;
};

} // namespace celltrace::kernel

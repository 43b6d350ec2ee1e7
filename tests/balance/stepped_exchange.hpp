// A program that does with the tracer's balancer what the PPE says, a step at a time, so that what comes of
// it depends on nothing but the order of the steps. Kernel dialect.
#pragma once

#include "work_report.hpp"

#include "kernel/program/work_exchange.hpp"

#include <stdint.h>

namespace celltrace::test {

/// Signal 1. Each is answered in the outbound mailbox, behind what the balancer reports.
enum class StepCommand : uint32_t {
  begin_frame = 1, ///< of the frame block as it is now
  poll,
  wait,      ///< as WorkExchange::wait(): something has to arrive
  take_unit, ///< answer: the unit + 1, or 0 if there is none
  complete_unit,
  end_frame, ///< writes the WorkReport; answer: whether the PPE has said that the frame is over
  quit,      ///< no answer
};
constexpr auto kStepDone = static_cast<kernel::ReportKind>(15);

template <class Spu> class SteppedExchange {
public:
  SteppedExchange(Spu& spu, ea_t frame_block)
      : spu_(spu), frame_block_(frame_block), frame_(*spu.template allocate<kernel::FrameBlock>()),
        strip_(*spu.template allocate<kernel::StripRecord>()), report_(*spu.template allocate<WorkReport>()),
        exchange_(spu) {}

  void run() {
    for (;;) {
      const auto command = static_cast<StepCommand>(spu_.read_signal_1());
      if (command == StepCommand::quit) break;
      spu_.write_out_mailbox(make_report(kStepDone, obey(command)));
    }
    drain(spu_);
  }

private:
  static constexpr uint32_t kTag = 0;

  uint32_t obey(StepCommand command) {
    uint32_t unit = 0;
    switch (command) {
    case StepCommand::begin_frame:
      begin_frame();
      return 0;
    case StepCommand::poll:
      exchange_.poll();
      return 0;
    case StepCommand::wait:
      exchange_.wait();
      return 0;
    case StepCommand::take_unit:
      return exchange_.take_unit(unit) ? unit + 1 : 0;
    case StepCommand::complete_unit:
      ++report_.units;
      exchange_.complete_unit(0);
      return 0;
    case StepCommand::end_frame:
      end_frame();
      return exchange_.over() ? 1 : 0;
    case StepCommand::quit:
      break;
    }
    spu_.halt(HaltCode::bad_argument);
  }
  void begin_frame() {
    fetch(&frame_, frame_block_, sizeof frame_);
    fetch(&strip_, frame_.strips + spu_.id() * sizeof strip_, sizeof strip_);
    report_ = WorkReport();
    exchange_.begin_frame(frame_, UnitRange{strip_.begin, strip_.end - strip_.begin});
  }
  void end_frame() {
    exchange_.end_frame();
    report_.exchanges = exchange_.exchanges();
    report_.units_received = exchange_.units_received();
    spu_.put(&report_, frame_.reports + spu_.id() * sizeof report_, sizeof report_, kTag);
    spu_.wait_all(1u << kTag);
  }
  void fetch(void* ls, ea_t ea, uint32_t bytes) {
    spu_.get(ls, ea, bytes, kTag);
    spu_.wait_all(1u << kTag);
  }

  Spu& spu_;
  ea_t frame_block_;
  kernel::FrameBlock& frame_;
  kernel::StripRecord& strip_;
  WorkReport& report_;
  kernel::WorkExchange<Spu> exchange_;
};

/// The program; `argument` is the ea of the FrameBlock.
template <class Spu> void stepped_exchange(Spu& spu, ea_t argument) {
  SteppedExchange<Spu>(spu, argument).run();
}

} // namespace celltrace::test

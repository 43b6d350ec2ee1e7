// A program that shares the work of frames as the tracer does, with its balancer and its mailboxes, signals
// and reports, but whose work is arithmetic: what a unit costs is a number in a table. Kernel dialect.
#pragma once

#include "work_report.hpp"

#include "celltrace/spe/spu.hpp"
#include "kernel/program/work_exchange.hpp"
#include "kernel/program/work_units.hpp"

#include <stdint.h>

namespace celltrace::test {

/// `steps` steps of work on what the work before them has left.
constexpr uint32_t worked(uint32_t state, uint32_t steps) {
  for (uint32_t i = 0; i < steps; ++i)
    state = state * 1664525u + 1013904223u;
  return state;
}

/// Obeys the tracer's commands. The bundles of a unit are steps of work, and what is written in place of its
/// cost is what worked() makes of its number.
template <class Spu> class FrameWorker {
public:
  FrameWorker(Spu& spu, ea_t frame_block)
      : spu_(spu), frame_block_(frame_block), frame_(*spu.template allocate<kernel::FrameBlock>()),
        strip_(*spu.template allocate<kernel::StripRecord>()), report_(*spu.template allocate<WorkReport>()),
        exchange_(spu), units_(spu) {}

  void run() {
    spu_.write_event_mask(event::signal_1);
    for (;;) {
      const uint32_t events = spu_.read_event_status();
      spu_.write_event_mask(0);
      spu_.acknowledge_events(events);
      if (spu_.signal_1_count() != 0) {
        const uint32_t commands = spu_.read_signal_1();
        if ((commands & kernel::command::quit) != 0) return drain(spu_);
        obey(commands);
      }
      spu_.write_event_mask(event::signal_1);
    }
  }

private:
  static constexpr uint32_t kTag = 0;
  static constexpr uint32_t kStepsBetweenPolls = 32;
  static constexpr ScalarWork kStep = {4, 0, 0, 0, 1};

  void obey(uint32_t commands) {
    fetch(&frame_, frame_block_, sizeof frame_);
    if ((commands & kernel::command::synchronize) != 0) {
      drain(spu_);
      spu_.write_out_mailbox(make_report(kernel::ReportKind::synchronised, 0));
    }
    if ((commands & kernel::command::render_frame) != 0) work();
  }

  void work() {
    fetch(&strip_, frame_.strips + spu_.id() * sizeof strip_, sizeof strip_);
    report_ = WorkReport();
    units_.begin_frame(frame_);
    exchange_.begin_frame(frame_, UnitRange{strip_.begin, strip_.end - strip_.begin});
    while (!exchange_.over()) {
      uint32_t unit = 0;
      if (exchange_.take_unit(unit)) {
        work_on(unit);
      } else {
        units_.flush(); // an SPE may report idle only when its results are in main memory
        exchange_.wait();
      }
    }
    units_.flush();
    exchange_.end_frame();
    report();
  }

  void work_on(uint32_t unit) {
    const uint32_t steps = units_.at(unit).bundles;
    uint32_t state = unit;
    for (uint32_t done = 0; done < steps; done += kStepsBetweenPolls) {
      const uint32_t left = steps - done;
      const uint32_t now = left < kStepsBetweenPolls ? left : kStepsBetweenPolls;
      state = worked(state, now);
      for (uint32_t i = 0; i < now; ++i)
        spu_.compute(kStep);
      exchange_.poll();
      if (exchange_.over()) return;
    }
    units_.write_cost(unit, state);
    exchange_.complete_unit(unit);
    ++report_.units;
    report_.steps += steps;
  }

  void report() {
    report_.exchanges = exchange_.exchanges();
    report_.units_received = exchange_.units_received();
    spu_.put(&report_, frame_.reports + spu_.id() * sizeof report_, sizeof report_, kTag);
    spu_.wait_all(1u << kTag);
    spu_.write_out_mailbox(make_report(kernel::ReportKind::finished, 0));
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
  kernel::WorkUnits<Spu> units_;
};

/// The program; `argument` is the ea of the FrameBlock.
template <class Spu> void frame_work(Spu& spu, ea_t argument) {
  FrameWorker<Spu>(spu, argument).run();
}

} // namespace celltrace::test

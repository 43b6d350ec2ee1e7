// The exchange of work between SPEs in an order that the PPE prescribes: it takes the same steps with nodes
// on the host, and everything is the same after each.
#include "frame_records.hpp"
#include "spe/machine_kinds.hpp"
#include "stepped_chain.hpp"
#include "stepped_exchange.hpp"

#include "celltrace/balance.hpp"

#include <catch2/catch.hpp>

#include <cstdint>
#include <memory>
#include <random>
#include <vector>

namespace celltrace {

SpeProgram stepped_exchange_program();

} // namespace celltrace

using namespace celltrace;
using namespace celltrace::test;
using kernel::ReportKind;

namespace {

/// The PPE, which makes SPEs and their twins on the host take the same steps.
class Conductor {
public:
  Conductor(Machine& machine, FrameRecords& records)
      : machine_(machine), records_(records), chain_(machine.spe_count()) {}

  unsigned spes() const { return machine_.spe_count(); }
  const SteppedChain& chain() const { return chain_; }
  unsigned steps() const { return steps_; }

  /// Everyone's steps in random order until the frame is complete.
  void frame(const std::vector<UnitRange>& strips, std::uint32_t lambda, std::mt19937& random) {
    records_.begin(strips, lambda);
    const std::uint32_t epoch = records_.block[0].epoch;
    StripTally tally(spes(), strips.back().first + strips.back().count);
    for (unsigned spe = 0; spe < spes(); ++spe) {
      ask(spe, StepCommand::begin_frame);
      take(tally, spe, chain_.begin_frame(spe, epoch, strips[spe], lambda));
    }
    while (!tally.frame_complete())
      step(tally, random() % spes(), random() % 4 == 0);
    for (unsigned spe = 0; spe < spes(); ++spe)
      machine_.write_in_mailbox(spe, strip_word::frame_over(epoch));
    for (unsigned spe = 0; spe < spes(); ++spe) {
      nudge_and_ask(spe, StepCommand::poll);
      take(tally, spe, chain_.poll(spe));
      CHECK(ask(spe, StepCommand::end_frame) == 1);
      chain_.end_frame(spe);
    }
    records_.end();
  }
  void quit() {
    for (unsigned spe = 0; spe < spes(); ++spe)
      machine_.write_signal(spe, Signal::one, static_cast<std::uint32_t>(StepCommand::quit));
  }

private:
  /// What the tracer would do next, or now and then a look at what has arrived.
  void step(StripTally& tally, unsigned spe, bool look) {
    if (look) {
      nudge_and_ask(spe, StepCommand::poll);
      take(tally, spe, chain_.poll(spe));
    } else if (chain_.at_work(spe)) {
      ask(spe, StepCommand::complete_unit);
      chain_.complete_unit(spe);
    } else if (chain_.is_dry(spe)) {
      nudge_and_ask(spe, StepCommand::wait);
      take(tally, spe, chain_.wait(spe));
    } else {
      std::uint32_t expected = 0;
      const std::uint32_t answer = ask(spe, StepCommand::take_unit);
      take(tally, spe, chain_.take_unit(spe, expected));
      REQUIRE(answer == expected);
    }
  }

  /// A doorbell that means nothing, so that the SPE does not wait for what no other one can send now.
  std::uint32_t nudge_and_ask(unsigned spe, StepCommand command) {
    machine_.write_signal(spe, Signal::two, 1u << spe % 32);
    return ask(spe, command);
  }
  /// The SPE's answer; what its balancer reports meanwhile is in reports_.
  std::uint32_t ask(unsigned spe, StepCommand command) {
    ++steps_;
    reports_.clear();
    machine_.write_signal(spe, Signal::one, static_cast<std::uint32_t>(command));
    for (;;) {
      const auto word = machine_.read_out_mailbox(spe);
      if (!word) {
        if (!machine_.running(spe)) machine_.wait(spe); // throws
        machine_.wait_for_mail(std::chrono::milliseconds(50));
      } else if (kernel::report_kind(*word) == kStepDone) {
        return kernel::report_count(*word);
      } else {
        REQUIRE(kernel::report_kind(*word) == ReportKind::idle);
        reports_.push_back(kernel::report_count(*word));
      }
    }
  }
  /// The SPE has reported what its twin reports.
  void take(StripTally& tally, unsigned spe, const SteppedChain::Reports& expected) {
    REQUIRE(reports_ == expected);
    for (const std::uint32_t units : reports_)
      tally.report(spe, units);
  }

  Machine& machine_;
  FrameRecords& records_;
  SteppedChain chain_;
  std::vector<std::uint32_t> reports_;
  unsigned steps_ = 0;
};

} // namespace

TEST_CASE("in a prescribed order SPEs exchange what their sequential twins exchange") {
  const auto kind = GENERATE(from_range(kinds_for(stepped_exchange_program())));
  const auto spes = GENERATE(1u, 2u, 3u, 8u);
  CAPTURE(kind, spes);
  MachineKind collecting = kind;
  collecting.config.signal_mode[1] = SignalMode::logical_or;
  const std::unique_ptr<Machine> machine = collecting.machine(spes);
  FrameRecords records(spes, {}, machine->byte_order());
  Conductor conductor(*machine, records);
  std::uint32_t exchanges = 0;
  const ProgramRun run = run_program(*machine, stepped_exchange_program(), records.block.ea(), [&](Machine&) {
    std::mt19937 random(spes);
    for (int frame = 0; frame < 4; ++frame) {
      std::vector<std::uint32_t> counts(spes);
      for (std::uint32_t& units : counts)
        units = static_cast<std::uint32_t>(random() % 3 != 0 ? 0 : random() % 20);
      counts[random() % spes] += 10;
      conductor.frame(consecutive_strips(counts), 1 + static_cast<std::uint32_t>(random() % 65535), random);
      for (unsigned spe = 0; spe < spes; ++spe) {
        CAPTURE(frame, spe);
        const WorkReport& found = records.reports[spe];
        const WorkReport& expected = conductor.chain().report(spe);
        CHECK(found.units == expected.units);
        CHECK(found.exchanges == expected.exchanges);
        CHECK(found.units_received == expected.units_received);
        exchanges += expected.exchanges;
      }
    }
    conductor.quit();
  });
  check_clean(run);
  CHECK((exchanges > 0) == (spes > 1));
  std::uint64_t answers = 0, words = 0;
  for (unsigned spe = 0; spe < spes; ++spe) {
    CAPTURE(spe);
    const SteppedChain::Sent& sent = conductor.chain().sent(spe);
    CHECK(run.spes[spe].signals_sent == sent.doorbells);
    words += run.spes[spe].mailbox_words_sent;
    answers += sent.words + sent.reports;
  }
  CHECK(words == answers + conductor.steps());
}

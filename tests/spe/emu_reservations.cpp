// What takes a reservation away on the emulated Cell, and what says so (event 0x400).
#include "celltrace/emulator.hpp"
#include "spe/run_on.hpp"

namespace celltrace::test {
namespace {

using Spu = EmulatedSpu;

struct alignas(128) Line {
  std::uint32_t word[32];
};
struct Lines {
  Line reserved{};
  Line other{};
};
struct Outcome {
  std::uint32_t events = 0;
  bool written = false;
  EmulatedRun run;
};

/// SPE 0 reserves a line, then does `act`; was the event raised, and does putllc still write?
template <class Act> Outcome after(Act act) {
  Lines lines;
  Outcome outcome;
  outcome.run = emulate(lockstep(1), [&](Spu& spu) {
    auto* line = spu.allocate<Line>();
    spu.write_event_mask(event::reservation_lost);
    spu.getllar(line, to_ea(&lines.reserved));
    act(spu, lines, line);
    outcome.events = spu.event_count() != 0 ? spu.read_event_status() : 0;
    outcome.written = spu.putllc(line, to_ea(&lines.reserved));
  });
  CHECK(outcome.run.errors[0].empty());
  return outcome;
}

TEST_CASE("nothing happens: the reservation holds") {
  const Outcome outcome = after([](Spu&, Lines&, Line*) {});
  CHECK(outcome.events == 0);
  CHECK(outcome.written);
  CHECK(outcome.run.ok());
}

TEST_CASE("an own plain put of the line loses it, with the event") {
  const Outcome outcome = after([](Spu& spu, Lines& lines, Line* line) {
    spu.put(line, to_ea(&lines.reserved) + 112, 16, 0);
    spu.wait_all(1);
  });
  CHECK(outcome.events == event::reservation_lost);
  CHECK_FALSE(outcome.written);
  CHECK(outcome.run.count(Rule::reservation_lost_to_own_put) == 1);
}

TEST_CASE("an own put next to the line leaves it") {
  const Outcome outcome = after([](Spu& spu, Lines& lines, Line* line) {
    spu.put(line, to_ea(&lines.other), 128, 0);
    spu.wait_all(1);
  });
  CHECK(outcome.events == 0);
  CHECK(outcome.written);
  CHECK(outcome.run.ok());
}

TEST_CASE("an own putlluc of the line loses it without the event") {
  const Outcome outcome =
      after([](Spu& spu, Lines& lines, Line* line) { spu.putlluc(line, to_ea(&lines.reserved)); });
  CHECK(outcome.events == 0);
  CHECK_FALSE(outcome.written);
  CHECK(outcome.run.count(Rule::reservation_lost_to_own_put) == 1);
}

TEST_CASE("own lock-line commands on another line replace it or lose it without the event") {
  const Outcome replaced =
      after([](Spu& spu, Lines& lines, Line* line) { spu.getllar(line, to_ea(&lines.other)); });
  CHECK(replaced.events == 0);
  CHECK_FALSE(replaced.written);
  CHECK(replaced.run.count(Rule::conditional_without_reservation) == 1);
  const Outcome lost =
      after([](Spu& spu, Lines& lines, Line* line) { spu.putllc(line, to_ea(&lines.other)); });
  CHECK(lost.events == 0);
  CHECK_FALSE(lost.written);
  CHECK(lost.run.count(Rule::conditional_without_reservation) == 2);
}

TEST_CASE("any write by another SPE loses it, with the event") {
  const int way = GENERATE(0, 1, 2, 3);
  const MachineConfig config = GENERATE(lockstep(2), free_running(2));
  CAPTURE(way);
  Lines lines;
  std::uint32_t events = 0;
  bool written = true;
  const EmulatedRun run = emulate(config, [&](Spu& spu) {
    const ea_t reserved = to_ea(&lines.reserved);
    auto* line = spu.allocate<Line>();
    if (spu.id() == 1) {
      spu.read_signal_1();
      if (way == 0) spu.put(line, reserved, 16, 0);
      if (way == 1) spu.putlluc(line, reserved);
      if (way == 2) spu.putqlluc(line, reserved, 0);
      if (way == 3) {
        spu.getllar(line, reserved);
        if (!spu.putllc(line, reserved)) spu.halt(HaltCode::internal_error);
      }
      spu.wait_all(1);
      return;
    }
    spu.write_event_mask(event::reservation_lost);
    spu.getllar(line, reserved);
    spu.send_signal(1, Signal::one, 1);
    events = spu.read_event_status();
    written = spu.putllc(line, reserved);
  });
  CHECK(events == event::reservation_lost);
  CHECK_FALSE(written);
  // That another SPE was first is no mistake.
  CHECK(run.report() == "");
}

TEST_CASE("a reservation ends with its kernel") {
  Lines lines;
  lines.other.word[0] = true;
  const auto machine = machine_of("cell_emu", 1);
  const auto reserve = [](auto& spu, ea_t argument) {
    spu.getllar(spu.template allocate<Line>(), to_ea(&at<Lines>(argument).reserved));
  };
  const auto write = [](auto& spu, ea_t argument) {
    Lines& data = at<Lines>(argument);
    data.other.word[0] = spu.putllc(spu.template allocate<Line>(), to_ea(&data.reserved));
  };
  run_on("cell_emu", *machine, reserve, to_ea(&lines), [](Machine&) {});
  run_on("cell_emu", *machine, write, to_ea(&lines), [](Machine&) {});
  CHECK_FALSE(lines.other.word[0]);
}

} // namespace
} // namespace celltrace::test

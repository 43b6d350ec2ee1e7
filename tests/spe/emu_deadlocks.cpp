// Deadlocks: whoever waits for whom, the emulator says so instead of hanging, on both schedules.
#include "celltrace/emulator.hpp"

#include <catch2/catch.hpp>

namespace celltrace::test {
namespace {

using namespace std::chrono_literals;
using Spu = EmulatedSpu;

struct Deadlock {
  const char* shape;
  unsigned spes;
  void (*program)(Spu&);
  void (*ppe)(Machine&); ///< may be null
  unsigned stalled;      ///< SPEs that wait in it
  std::vector<std::string> says;
  bool lockstep_only = false;
};

const Deadlock kDeadlocks[] = {
    {"an SPE waits for mail of a PPE that waits for its end",
     1,
     [](Spu& spu) { spu.read_in_mailbox(); },
     nullptr,
     1,
     {"SPE 0 waits at channel 29 (SPU_RdInMbox)", "the PPE waits for SPE 0 to stop"}},
    {"SPEs wait for each other's signals in a ring",
     3,
     [](Spu& spu) {
       spu.read_signal_1();
       spu.send_signal((spu.id() + 1) % 3, Signal::one, 1);
     },
     nullptr,
     3,
     {"SPE 0 waits at channel 3 (SPU_RdSigNotify1)", "SPE 1 waits at channel 3", "SPE 2 waits at channel 3",
      "the PPE waits for SPE 0 to stop"}},
    {"an SPE waits for one that has ended",
     2,
     [](Spu& spu) {
       if (spu.id() == 1) spu.read_signal_2();
     },
     nullptr,
     1,
     {"SPE 1 waits at channel 4 (SPU_RdSigNotify2)", "the PPE waits for SPE 1 to stop"}},
    {"an SPE has a second word for a PPE that does not read",
     1,
     [](Spu& spu) {
       spu.write_out_mailbox(1);
       spu.write_out_mailbox(2);
     },
     nullptr,
     1,
     {"SPE 0 waits at channel 28 (SPU_WrOutMbox)", "the PPE waits for SPE 0 to stop"}},
    {"an SPE waits for an event that is masked off",
     2,
     [](Spu& spu) {
       spu.write_event_mask(event::signal_2);
       if (spu.id() == 0) spu.send_mailbox(1, 1);
       spu.read_event_status();
     },
     nullptr,
     2,
     {"SPE 0 waits at channel 0 (SPU_RdEventStat)", "SPE 1 waits at channel 0 (SPU_RdEventStat)"}},
    {"the PPE has a fifth word for an SPE that waits for a signal",
     1,
     [](Spu& spu) { spu.read_signal_1(); },
     [](Machine& machine) {
       for (std::uint32_t word = 0; word < 5; ++word)
         machine.write_in_mailbox(0, word);
     },
     1,
     {"SPE 0 waits at channel 3 (SPU_RdSigNotify1)", "the PPE waits for room in the mailbox of SPE 0"}},
    {"the PPE looks for mail again and again, and the SPE for mail of the PPE",
     1,
     [](Spu& spu) { spu.write_out_mailbox(spu.read_in_mailbox()); },
     [](Machine& machine) {
       while (!machine.read_out_mailbox(0))
         machine.wait_for_mail(20ms);
     },
     1,
     {"SPE 0 waits at channel 29 (SPU_RdInMbox)", "the PPE waits for mail"}},
    {"the PPE polls without a pause",
     1,
     [](Spu& spu) { spu.write_out_mailbox(spu.read_in_mailbox()); },
     [](Machine& machine) {
       while (!machine.read_out_mailbox(0)) {
       }
     },
     1,
     {"SPE 0 waits at channel 29 (SPU_RdInMbox)", "looking for it again and again"},
     true},
    {"an SPE waits for one that waits to be resumed",
     2,
     [](Spu& spu) {
       if (spu.id() == 0) spu.stop_and_signal<1>();
       if (spu.id() == 0)
         spu.send_signal(1, Signal::one, 1);
       else
         spu.read_signal_1();
     },
     [](Machine& machine) { machine.wait(1); },
     1,
     {"SPE 1 waits at channel 3 (SPU_RdSigNotify1)", "SPE 0 has stopped with code 1 and waits to be resumed",
      "the PPE waits for SPE 1 to stop"}},
};

void check(const Deadlock& deadlock, MachineConfig config) {
  std::string ppe_error;
  EmulatedPpe ppe;
  if (deadlock.ppe != nullptr)
    ppe = [&](Machine& machine) {
      try {
        deadlock.ppe(machine);
      } catch (const SpeError& error) {
        ppe_error = error.what();
      }
    };
  const EmulatedRun run = emulate(
      config, [&](Spu& spu) { deadlock.program(spu); }, 0, ppe);
  INFO(run.report());
  // It is told once, however many wait in it.
  REQUIRE(run.count(Rule::deadlock) == 1);
  const Diagnostic& told = *run.find(Rule::deadlock);
  CHECK(told.site.line != 0);
  CHECK_THAT(told.text, Catch::StartsWith("SPE " + std::to_string(told.spe) + ": deadlock: "));
  for (const std::string& what : deadlock.says)
    CHECK_THAT(told.text, Catch::Contains(what));
  // An SPE's own error says why it ended, unless the PPE has collected it.
  std::string all = ppe_error;
  for (const std::string& error : run.errors)
    all += error;
  std::size_t interrupted = 0;
  for (std::size_t at = all.find("interrupted at channel"); at != std::string::npos;
       at = all.find("interrupted at channel", at + 1))
    ++interrupted;
  CHECK(interrupted == deadlock.stalled);
  CHECK_THAT(all, Catch::Contains("deadlock: "));
  const std::string report = run.report();
  CHECK(report.find("the PPE waits for") == report.rfind("the PPE waits for"));
  if (deadlock.ppe != nullptr) CHECK_THAT(ppe_error, Catch::Contains(deadlock.says[0]));
}

TEST_CASE("a deadlock is reported with what everyone waits for") {
  for (const Deadlock& deadlock : kDeadlocks) {
    DYNAMIC_SECTION(deadlock.shape) {
      check(deadlock, lockstep(deadlock.spes));
      for (std::uint64_t seed = 0; seed < 5; ++seed)
        check(deadlock, exploring_with_faults(deadlock.spes, seed));
      if (!deadlock.lockstep_only) check(deadlock, free_running(deadlock.spes));
    }
  }
}

TEST_CASE("who polls for ever ends at its limit, and so does who waits for it") {
  for (const bool by_cycles : {true, false}) {
    for (MachineConfig config : {lockstep(2), exploring_with_faults(2, 1), free_running(2)}) {
      config.emulation.cycle_limit = by_cycles ? 100000 : 0;
      config.emulation.seconds_limit = by_cycles ? 0 : 0.05;
      const EmulatedRun run = emulate(config, [](Spu& spu) {
        if (spu.id() == 1) spu.read_signal_1();
        while (spu.in_mailbox_count() == 0) {
        }
      });
      INFO(run.report());
      CHECK(run.count(Rule::time_limit) == 1);
      CHECK(run.diagnostics.size() == 1);
      CHECK_THAT(run.errors[0], Catch::Contains(by_cycles ? "after 100000 cycles" : "after 0.05"));
      CHECK_THAT(run.errors[1], Catch::Contains("interrupted at channel 3") && Catch::Contains("time-limit"));
    }
  }
}

TEST_CASE("a program that fails ends those that wait for it") {
  for (const MachineConfig& config : {lockstep(3), exploring_with_faults(3, 1), free_running(3)}) {
    const EmulatedRun run = emulate(config, [](Spu& spu) {
      if (spu.id() == 1) spu.halt(HaltCode::bad_argument);
      spu.read_signal_1();
    });
    INFO(run.report());
    CHECK(run.count(Rule::halted) == 1);
    CHECK(run.diagnostics.size() == 1);
    for (const unsigned spe : {0u, 2u})
      CHECK_THAT(run.errors[spe],
                 Catch::Contains("interrupted at channel 3") && Catch::Contains("SPE 1: halted"));
  }
}

} // namespace
} // namespace celltrace::test

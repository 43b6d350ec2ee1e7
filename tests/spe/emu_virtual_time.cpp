// Virtual time: what the timing model of include/celltrace/spe/timing.hpp makes of single operations, cycle
// by cycle.
#include "celltrace/emulator.hpp"

#include <catch2/catch.hpp>

namespace celltrace::test {
namespace {

using Spu = EmulatedSpu;

constexpr TimingParameters kTiming = TimingParameters::cell();
/// Six writes of channels.
constexpr std::uint64_t kCommand = 6;
/// A write of the mask, one of the request, and the read of the status.
constexpr std::uint64_t kWait = 2 + 6;
constexpr std::uint64_t kLine = 10 + 500;       ///< of main memory, from its issue
constexpr std::uint64_t kRemoteLine = 10 + 290; ///< of another local store

static_assert(kTiming.mfc_issue == 10 && kTiming.first_line_memory == 500 && kTiming.first_line_spe == 290);
static_assert(kTiming.channel_write == 1 && kTiming.channel_read == 6);

struct alignas(128) Memory {
  std::uint8_t bytes[64 * 1024] = {};
};
Memory memory;
const ea_t kEa = to_ea(&memory);

template <class Program>
EmulatedRun clean_run(unsigned spes, Program program, MachineConfig config = lockstep(1)) {
  config.spes = spes;
  const EmulatedRun run = emulate(config, program);
  INFO(run.report());
  CHECK(run.ok());
  return run;
}

/// Cycles from the end of the command's six writes to the end of a wait for it.
template <class Command> std::uint64_t time_of(Command command) {
  std::uint64_t cycles = 0;
  clean_run(2, [&](Spu& spu) {
    if (spu.id() != 0) return;
    auto* buffer = spu.allocate<std::uint8_t>(16 * 1024);
    auto* list = spu.allocate<ListElement>(8);
    const std::uint64_t begin = spu.cycles() + kCommand;
    command(spu, buffer, list);
    spu.wait_all(1);
    cycles = spu.cycles() - begin;
  });
  return cycles;
}

/// Lets all SPEs go on in the same cycle; a write of a channel takes one.
void meet_at(Spu& spu, std::uint64_t cycle) {
  while (spu.cycles() < cycle)
    spu.write_channel<Channel::wr_srr0>(0);
}

TEST_CASE("a channel write takes a cycle, a read six") {
  const EmulatedRun run = clean_run(1, [](Spu& spu) {
    const std::uint64_t begin = spu.cycles();
    spu.write_event_mask(0);
    CHECK(spu.cycles() - begin == 1);
    spu.read_event_mask();
    CHECK(spu.cycles() - begin == 1 + 6);
    spu.in_mailbox_count();
    CHECK(spu.cycles() - begin == 1 + 6 + 6);
  });
  const SpuCycles& cycles = run.spes[0].cycles;
  CHECK(cycles.total_cycle == 13);
  CHECK(cycles.spr == 3);
  CHECK(cycles.single_cycle == 3);
  CHECK(cycles.stall_due_to_dependency == 10);
  CHECK(cycles.channel_stall_cycle == 0);
  CHECK(run.cycles == 13);
}

TEST_CASE(
    "a line from memory takes 10 and 500 cycles after its issue, and is waited for as a channel stall") {
  for (const TransferTime when : {TransferTime::at_issue, TransferTime::at_wait}) {
    MachineConfig config = lockstep(1);
    config.emulation.transfers = when;
    const EmulatedRun run = clean_run(
        1,
        [](Spu& spu) {
          auto* line = spu.allocate<std::uint8_t>(128);
          const std::uint64_t begin = spu.cycles();
          spu.get(line, kEa, 128, 0);
          CHECK(spu.cycles() - begin == kCommand);
          spu.wait_all(1);
          CHECK(spu.cycles() - begin == kCommand + kLine);
        },
        config);
    const SpuCycles& cycles = run.spes[0].cycles;
    CHECK(cycles.total_cycle == kCommand + kLine);
    CHECK(cycles.channel_stall_cycle == kLine - kWait);
    CHECK(cycles.spr == 9);
    CHECK(cycles.stall_due_to_dependency == 5);
    CHECK(run.cycles == kCommand + kLine);
  }
}

TEST_CASE("work between issue and wait hides the transfer") {
  const EmulatedRun run = clean_run(1, [](Spu& spu) {
    auto* line = spu.allocate<std::uint8_t>(128);
    const std::uint64_t begin = spu.cycles();
    spu.get(line, kEa, 128, 0);
    spu.compute({.fixed = 5000});
    const std::uint64_t computed = spu.cycles();
    CHECK(computed - begin > kCommand + kLine);
    spu.wait_all(1);
    CHECK(spu.cycles() - computed == kWait);
  });
  CHECK(run.spes[0].cycles.channel_stall_cycle == 0);
  CHECK(run.spes[0].cycles.fx2 == 5000);
}

TEST_CASE("further lines of a transfer take 16 cycles each, a part of a line as much as a whole") {
  const auto get = [](std::uint32_t offset, std::uint32_t bytes) {
    return time_of(
        [=](Spu& spu, std::uint8_t* to, ListElement*) { spu.get(to + offset, kEa + offset, bytes, 0); });
  };
  CHECK(get(0, 128) == kLine);
  CHECK(get(0, 16) == kLine);
  CHECK(get(4, 4) == kLine);
  CHECK(get(64, 128) == kLine + 16);
  CHECK(get(0, 256) == kLine + 16);
  CHECK(get(0, 16384) == kLine + 127 * 16);
  CHECK(time_of([](Spu& spu, std::uint8_t* from, ListElement*) { spu.put(from, kEa, 256, 0); }) ==
        kLine + 16);
}

TEST_CASE(
    "from local store to local store a line takes 10 and 290 cycles, and so does a word for a register") {
  CHECK(time_of([](Spu& spu, std::uint8_t* to, ListElement*) {
          spu.get(to, spu.addresses(1).local_store, 128, 0);
        }) == kRemoteLine);
  CHECK(time_of([](Spu& spu, std::uint8_t* to, ListElement*) {
          spu.get(to, spu.addresses(1).local_store, 1024, 0);
        }) == kRemoteLine + 7 * 16);
  CHECK(time_of([](Spu& spu, std::uint8_t* from, ListElement*) {
          spu.get(from + 12, spu.addresses(1).signal_1, 4, 0);
        }) == kRemoteLine);
}

TEST_CASE("an element of a list takes 10 cycles before its transfer starts") {
  const auto get_list = [](std::uint32_t elements, std::uint32_t bytes) {
    return time_of([=](Spu& spu, std::uint8_t* to, ListElement* list) {
      for (std::uint32_t i = 0; i < elements; ++i)
        list[i] = ListElement::make(bytes, kEa + 1024 * i);
      spu.getl(to, kEa, list, elements, 0);
    });
  };
  CHECK(get_list(1, 128) == kLine + 10);
  // The second element is fetched while the first occupies the port.
  CHECK(get_list(2, 128) == kLine + 10 + 16);
  CHECK(get_list(8, 128) == kLine + 10 + 7 * 16);
  CHECK(get_list(4, 1024) == kLine + 10 + 31 * 16);
}

TEST_CASE("commands of an SPE share its port") {
  std::uint64_t first = 0, second = 0;
  clean_run(1, [&](Spu& spu) {
    auto* lines = spu.allocate<std::uint8_t>(256);
    const std::uint64_t begin = spu.cycles();
    spu.get(lines, kEa, 128, 0);
    spu.get(lines + 128, kEa + 128, 128, 1);
    spu.wait_all(1);
    first = spu.cycles() - begin;
    spu.wait_all(2);
    second = spu.cycles() - begin;
  });
  CHECK(first == kCommand + kLine);
  CHECK(second == kCommand + kLine + 16);
}

TEST_CASE("a fenced command starts when the one before it is complete") {
  CHECK(time_of([](Spu& spu, std::uint8_t* line, ListElement*) {
          spu.get(line, kEa, 128, 0);
          spu.putf(line, kEa + 1024, 128, 0);
        }) == kLine + 500);
}

TEST_CASE("SPEs share the memory controller, 16 cycles a line, the lower number first") {
  constexpr std::uint64_t kMeet = 20000;
  std::uint64_t done[8] = {};
  clean_run(8, [&](Spu& spu) {
    auto* line = spu.allocate<std::uint8_t>(128);
    meet_at(spu, kMeet);
    spu.get(line, kEa + 128 * spu.id(), 128, 0);
    spu.wait_all(1);
    done[spu.id()] = spu.cycles();
  });
  for (unsigned spe = 0; spe < 8; ++spe)
    CHECK(done[spe] == kMeet + kCommand + kLine + 16 * spe);
}

TEST_CASE("pairs of local stores do not disturb each other") {
  constexpr std::uint64_t kMeet = 20000;
  std::uint64_t done[8] = {};
  clean_run(8, [&](Spu& spu) {
    auto* block = spu.allocate<std::uint8_t>(4096);
    meet_at(spu, kMeet);
    if (spu.id() % 2 == 0) {
      spu.get(block, spu.addresses(spu.id() + 1).local_store, 4096, 0);
      spu.wait_all(1);
    }
    done[spu.id()] = spu.cycles();
  });
  for (unsigned spe = 0; spe < 8; spe += 2)
    CHECK(done[spe] == kMeet + kCommand + kRemoteLine + 31 * 16);
}

TEST_CASE("a lock line takes 10 and 500 cycles, or 290 if another SPE holds it") {
  std::uint64_t from_memory = 0, from_spe = 0, written = 0;
  clean_run(2, [&](Spu& spu) {
    auto* line = spu.allocate<std::uint8_t>(128);
    meet_at(spu, spu.id() == 0 ? 20000 : 40000);
    const std::uint64_t begin = spu.cycles() + kCommand;
    spu.getllar(line, kEa);
    (spu.id() == 0 ? from_memory : from_spe) = spu.cycles() - begin;
    if (spu.id() == 0) {
      meet_at(spu, 60000);
      return;
    }
    meet_at(spu, 70000);
    CHECK(spu.putllc(line, kEa));
    written = spu.cycles() - 70000 - kCommand;
  });
  CHECK(from_memory == kLine);
  CHECK(from_spe == kRemoteLine);
  CHECK(written == kLine); // the other's reservation has ended with its program
}

TEST_CASE("a signal is there 300 cycles after its issue") {
  std::uint64_t sent = 0, received = 0, stalled = 0;
  const EmulatedRun run = clean_run(2, [&](Spu& spu) {
    meet_at(spu, 20000);
    if (spu.id() == 0) {
      spu.send_signal(1, Signal::one, 1);
      sent = spu.cycles();
    } else {
      spu.read_signal_1();
      received = spu.cycles();
    }
  });
  stalled = run.spes[1].cycles.channel_stall_cycle;
  CHECK(sent == 20000 + kCommand + kRemoteLine);
  CHECK(received == 20000 + kCommand + kRemoteLine);
  CHECK(stalled == kCommand + kRemoteLine - 6);
}

TEST_CASE("the decrementer's event comes when it passes 0, 40 cycles a tick") {
  const EmulatedRun run = clean_run(1, [](Spu& spu) {
    spu.write_event_mask(event::decrementer);
    spu.write_decrementer(100);
    const std::uint64_t begin = spu.cycles();
    spu.read_event_status();
    CHECK(spu.cycles() - begin == 101 * 40);
  });
  CHECK(run.spes[0].cycles.channel_stall_cycle == 101 * 40 - 6);
}

TEST_CASE("the cycles of an SPE are the sum of their parts, with faults and without") {
  for (const MachineConfig& config : {lockstep(4), exploring(4, 3), exploring_with_faults(4, 1),
                                      exploring_with_faults(4, 2), free_running(4)}) {
    CAPTURE(config.emulation.schedule, config.emulation.explore, config.emulation.seed);
    const EmulatedRun run = clean_run(
        4,
        [](Spu& spu) {
          auto* block = spu.allocate<std::uint8_t>(4096);
          for (int i = 0; i < 50; ++i) {
            spu.get(block, kEa, 4096, 0);
            spu.compute({.fixed = 500,
                         .floating = 100,
                         .memory = 300,
                         .shuffle = 100,
                         .branches = 60,
                         .waits = 90,
                         .misses = 36});
            spu.wait_all(1);
          }
        },
        config);
    std::uint64_t injected = 0;
    for (const SpeStatistics& spe : run.spes) {
      const SpuCycles& c = spe.cycles;
      CHECK(c.total_cycle == c.single_cycle + c.dual_cycle + c.nop_cycle + c.stall_due_to_dependency +
                                 c.stall_due_to_branch_miss + c.stall_due_to_hint_target +
                                 c.stall_due_to_prefetch_miss + c.channel_stall_cycle +
                                 c.stall_due_to_injection);
      CHECK(c.instructions() == c.single_cycle + 2 * c.dual_cycle);
      CHECK(c.total_cycle <= run.cycles);
      injected += c.stall_due_to_injection;
    }
    CHECK((injected != 0) == (config.emulation.faults.slowest_spe > 1));
  }
}

TEST_CASE("other timing parameters are another machine") {
  MachineConfig config = lockstep(1);
  config.emulation.timing.mfc_issue = 7;
  config.emulation.timing.first_line_memory = 1000;
  config.emulation.timing.memory_line = 40;
  config.emulation.timing.channel_write = 2;
  const EmulatedRun run = clean_run(
      1,
      [](Spu& spu) {
        auto* lines = spu.allocate<std::uint8_t>(256);
        spu.get(lines, kEa, 256, 0);
        spu.wait_all(1);
      },
      config);
  // The memory is slower than the port now, whose one line the latency covers.
  CHECK(run.cycles == 2 * kCommand + 7 + 2 * 40 + 1000 - 16);
  CHECK(TimingParameters::playstation_3().spes == 6);
}

} // namespace
} // namespace celltrace::test

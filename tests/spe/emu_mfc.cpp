// When the emulated MFC moves data, and what its queue and tags show meanwhile.
#include "celltrace/emulator.hpp"
#include "spe/emu_peek.hpp"

#include <catch2/catch.hpp>

namespace celltrace::test {
namespace {

using Spu = EmulatedSpu;

struct alignas(128) Data {
  std::uint32_t from[4096];
  std::uint32_t to[4096] = {};
  Data() {
    for (std::uint32_t i = 0; i < 4096; ++i)
      from[i] = i + 1;
  }
};

TEST_CASE("data are not there before a wait has asked for them") {
  const Data data;
  const EmulatedRun run = emulate(lockstep(1), [&](Spu& spu) {
    auto* buffer = spu.allocate<std::uint32_t>(64);
    spu.get(buffer, to_ea(data.from), 128, 1);
    spu.get(buffer + 32, to_ea(data.from), 128, 2);
    CHECK(peek(buffer) == kPoisonWord);
    spu.wait_all(1u << 1);
    CHECK(buffer[0] == 1);
    CHECK(peek(buffer + 32) == kPoisonWord);
    spu.wait_all(1u << 2);
    CHECK(buffer[32] == 1);
  });
  CHECK(run.ok());
}

TEST_CASE("a put takes what is in local store when it moves, and the change is found") {
  Data data;
  MachineConfig config = lockstep(1);
  config.emulation.actions[Rule::put_source_changed] = Action::warn;
  const EmulatedRun run = emulate(config, [&](Spu& spu) {
    auto* buffer = spu.allocate<std::uint32_t>(32);
    buffer[0] = 100;
    spu.put(buffer, to_ea(data.to), 128, 3);
    buffer[0] = 101;
    spu.wait_all(1u << 3);
  });
  CHECK(data.to[0] == 101);
  CHECK(run.broke(Rule::put_source_changed));
}

TEST_CASE("a fence pulls earlier commands of its tag along, a queue barrier those of all tags") {
  const Data data;
  const EmulatedRun run = emulate(lockstep(1), [&](Spu& spu) {
    auto* buffer = spu.allocate<std::uint32_t>(32 * 6 + 1024);
    const auto get = [&](std::uint32_t slot, std::uint32_t tag, std::uint32_t bytes = 128) {
      spu.get(buffer + slot * 32, to_ea(data.from), bytes, tag);
    };
    // Slot 0 and 1 share a tag without order; the barrier orders slot 2 after both and before slot 3.
    get(0, 1);
    get(1, 1);
    spu.getb(buffer + 2 * 32, to_ea(data.from), 128, 1);
    get(3, 1);
    get(4, 2);
    spu.mfc_barrier(6);
    get(5, 3);
    get(6, 4, 4096);
    spu.wait_any(1u << 2);
    CHECK(buffer[4 * 32] == 1);
    CHECK(peek(buffer + 2 * 32) != 1);
    spu.wait_all(1u << 3);
    for (const std::uint32_t slot : {0u, 1u, 2u, 3u, 5u})
      CHECK(peek(buffer + slot * 32) == 1);
    CHECK(peek(buffer + 6 * 32) == kPoisonWord);
    CHECK(spu.completed(~0u) == ~(1u << 4));
    spu.wait_all(1u << 4);
  });
  CHECK(run.ok());
}

TEST_CASE("the count of the command channel is the room in the queue") {
  const Data data;
  const EmulatedRun run = emulate(lockstep(1), [&](Spu& spu) {
    auto* buffer = spu.allocate<std::uint32_t>(32 * 33);
    const auto room = [&] { return spu.channel_count<Channel::mfc_cmd>(); };
    const auto get = [&](std::uint32_t slot) { spu.get(buffer + slot * 32, to_ea(data.from), 128, 1); };
    const std::uint64_t start = spu.cycles();
    spu.write_event_mask(event::command_queue);
    CHECK(room() == 16);
    for (std::uint32_t i = 0; i < 15; ++i)
      get(i);
    CHECK(room() == 1);
    get(15);
    CHECK(room() == 0);
    CHECK(spu.event_count() == 0);
    // The seventeenth waits until the first is complete: the queue stays full, yet it had room in between.
    CHECK(spu.cycles() - start < 500);
    get(16);
    CHECK(spu.cycles() - start > 500);
    CHECK(spu.read_event_status() == event::command_queue);
    // Polls let the queue go on.
    while (room() == 0) {
    }
    spu.wait_all(2);
    CHECK(room() == 16);
  });
  CHECK(run.ok());
}

TEST_CASE("commands can be spelled channel by channel, and the parameters stay") {
  Data data;
  const EmulatedRun run = emulate(lockstep(1), [&](Spu& spu) {
    auto* buffer = spu.allocate<std::uint32_t>(64);
    const ea_t from = to_ea(data.from);
    const auto lsa = static_cast<std::uint32_t>(to_ea(buffer) - spu.addresses(spu.id()).local_store);
    spu.write_channel<Channel::mfc_lsa>(lsa);
    spu.write_channel<Channel::mfc_eah>(static_cast<std::uint32_t>(from >> 32));
    spu.write_channel<Channel::mfc_eal>(static_cast<std::uint32_t>(from));
    spu.write_channel<Channel::mfc_size>(128);
    spu.write_channel<Channel::mfc_tag_id>(9);
    spu.write_channel<Channel::mfc_cmd>(static_cast<std::uint32_t>(MfcOpcode::get));
    spu.write_channel<Channel::mfc_lsa>(lsa + 128);
    spu.write_channel<Channel::mfc_cmd>(0x05030000u | static_cast<std::uint32_t>(MfcOpcode::getf));
    CHECK(spu.wait_all(1u << 9) == 1u << 9);
    CHECK(buffer[31] == 32);
    CHECK(buffer[32] == 1);
    // put with the result bit
    spu.write_channel<Channel::mfc_eal>(static_cast<std::uint32_t>(to_ea(data.to)));
    spu.write_channel<Channel::mfc_cmd>(0x30);
    spu.write_channel<Channel::wr_tag_mask>(1u << 9);
    CHECK(spu.read_channel<Channel::rd_tag_mask>() == 1u << 9);
    CHECK(spu.channel_count<Channel::rd_tag_stat>() == 0);
    spu.write_channel<Channel::wr_tag_update>(2);
    CHECK(spu.read_channel<Channel::rd_tag_stat>() == 1u << 9);
  });
  CHECK(data.to[31] == 32);
  // They do on the hardware, but no manual promises it.
  CHECK(run.count(Rule::parameters_kept) == 2);
  CHECK(run.diagnostics.size() == 2);
  CHECK(run.errors[0].empty());
}

TEST_CASE("the tag status event is raised when a request comes true") {
  const Data data;
  const EmulatedRun run = emulate(lockstep(1), [&](Spu& spu) {
    auto* buffer = spu.allocate<std::uint32_t>(32);
    spu.write_event_mask(event::tag_status);
    spu.get(buffer, to_ea(data.from), 128, 1);
    spu.write_channel<Channel::wr_tag_mask>(2);
    spu.write_channel<Channel::wr_tag_update>(2);
    CHECK(spu.channel_count<Channel::rd_tag_stat>() == 0);
    CHECK(spu.read_event_status() == event::tag_status);
    // The event alone is no promise: the program has to read the status.
    CHECK(peek(buffer) == kPoisonWord);
    CHECK(spu.channel_count<Channel::rd_tag_stat>() == 1);
    CHECK(spu.read_channel<Channel::rd_tag_stat>() == 2);
    CHECK(buffer[0] == 1);
  });
  CHECK(run.ok());
}

TEST_CASE("what is queued is delivered while the SPE stalls or polls") {
  const bool polling = GENERATE(false, true);
  const MachineConfig config = GENERATE(lockstep(2), free_running(2));
  const EmulatedRun run = emulate(config, [&](Spu& spu) {
    auto* word = spu.allocate<std::uint32_t>(4);
    if (spu.id() == 1) spu.read_signal_1();
    // The answer comes only after the signal, which nobody waits for, has arrived.
    word[3] = 1;
    spu.mfc_command<MfcOpcode::sndsig>(word + 3, spu.addresses(1 - spu.id()).signal_1, 4, 5);
    while (spu.id() == 0 && polling && spu.signal_1_count() == 0) {
    }
    if (spu.id() == 0) spu.read_signal_1();
    spu.wait_all(1u << 5);
  });
  CHECK(run.report() == "");
}

TEST_CASE("what a program waits for in memory arrives though its tag is not waited for") {
  const MachineConfig config = GENERATE(lockstep(2), exploring(2, 1), free_running(2));
  Data data;
  data.from[0] = 0;
  const EmulatedRun run = emulate(config, [&](Spu& spu) {
    auto* line = spu.allocate<std::uint32_t>(64);
    const ea_t mine = to_ea(spu.id() == 0 ? data.from : data.to);
    const ea_t theirs = to_ea(spu.id() == 0 ? data.to : data.from);
    if (spu.id() == 1) {
      do
        spu.getllar(line + 32, theirs);
      while (line[32] == 0);
    }
    line[0] = 1;
    spu.put(line, mine, 128, 1);
    if (spu.id() == 0) {
      do
        spu.getllar(line + 32, theirs);
      while (line[32] == 0);
    }
    spu.wait_all(1u << 1);
  });
  CHECK(run.report() == "");
}

TEST_CASE("whole lines are atomic between SPEs") {
  MachineConfig config = GENERATE(free_running(6), exploring(6, 1));
  // That they race is what this is about.
  config.emulation.actions[Rule::main_storage_race] = Action::ignore;
  Data data;
  std::fill(std::begin(data.from), std::end(data.from), 0);
  const EmulatedRun run = emulate(config, [&](Spu& spu) {
    auto* line = spu.allocate<std::uint32_t>(64);
    for (std::uint32_t round = 0; round < 300; ++round) {
      spu.get(line, to_ea(data.from), 256, 1);
      spu.wait_all(2);
      for (std::uint32_t i = 1; i < 32; ++i)
        if (line[i] != line[0] || line[32 + i] != line[32]) spu.halt(HaltCode::internal_error);
      for (std::uint32_t i = 0; i < 64; ++i)
        line[i] = spu.id() * 1000 + round;
      spu.put(line, to_ea(data.from), 256, 1);
      spu.wait_all(2);
    }
  });
  CHECK(run.report() == "");
}

struct alignas(128) LocalStores {
  SpeAddresses place[6];
};

TEST_CASE("local stores may be written from all sides at once") {
  MachineConfig config = GENERATE(free_running(6), lockstep(6));
  config.signal_mode[0] = config.signal_mode[1] = SignalMode::logical_or;
  LocalStores stores{};
  const EmulatedRun run = emulate(config, [&](Spu& spu) {
    auto* inbox = spu.allocate<std::uint32_t>(32 * 6);
    auto* line = spu.allocate<std::uint32_t>(32);
    auto* mine = spu.allocate<SpeAddresses>();
    mine->local_store = to_ea(inbox);
    spu.put(mine, to_ea(&stores.place[spu.id()]), sizeof *mine, 0);
    spu.wait_all(1);
    for (std::uint32_t to = 0; to < spu.count(); ++to)
      spu.send_signal(to, Signal::one, 1u << spu.id());
    for (std::uint32_t here = 0; here != (1u << spu.count()) - 1;)
      here |= spu.read_signal_1();
    auto* theirs = spu.allocate<SpeAddresses>(6);
    spu.get(theirs, to_ea(&stores.place[0]), sizeof stores.place, 0);
    spu.wait_all(1);
    for (std::uint32_t round = 1; round <= 100; ++round) {
      for (std::uint32_t i = 0; i < 32; ++i)
        line[i] = round;
      for (std::uint32_t to = 0; to < spu.count(); ++to)
        spu.put(line, theirs[to].local_store + spu.id() * 128, 128, 1);
      spu.wait_all(2);
    }
    for (std::uint32_t to = 0; to < spu.count(); ++to)
      spu.send_signal(to, Signal::two, 1u << spu.id());
    for (std::uint32_t here = 0; here != (1u << spu.count()) - 1;)
      here |= spu.read_signal_2();
    for (std::uint32_t i = 0; i < 32 * spu.count(); ++i)
      if (inbox[i] != 100) spu.halt(HaltCode::internal_error);
  });
  CHECK(run.report() == "");
}

} // namespace
} // namespace celltrace::test

// When the emulated MFC moves data, and what its queue and tags show meanwhile.
#include "spe/run_on.hpp"

#include <chrono>

namespace celltrace::test {
namespace {

const std::string kEmulator = "cell_emu";

struct alignas(128) Data {
  std::uint32_t from[1024];
  std::uint32_t to[1024];
  std::uint32_t found[16];
};

Data numbered_data() {
  Data data{};
  for (std::uint32_t i = 0; i < 1024; ++i)
    data.from[i] = i + 1;
  return data;
}

TEST_CASE("data are not there before a wait has asked for them") {
  Data data = numbered_data();
  const auto early = [](auto& spu, ea_t argument) {
    Data& d = at<Data>(argument);
    auto* buffer = spu.template allocate<std::uint32_t>(64);
    spu.get(buffer, to_ea(d.from), 128, 1);
    spu.get(buffer + 32, to_ea(d.from), 128, 2);
    d.found[0] = buffer[0];
    spu.wait_all(1u << 1);
    d.found[1] = buffer[0];
    d.found[2] = buffer[32];
    spu.wait_all(1u << 2);
    d.found[3] = buffer[32];
    // A put takes what is in local store when it moves.
    buffer[0] = 100;
    spu.put(buffer, to_ea(d.to), 128, 3);
    buffer[0] = 101;
    spu.wait_all(1u << 3);
  };
  run_on(kEmulator, 1, early, to_ea(&data));
  CHECK(data.found[0] == 0);
  CHECK(data.found[1] == 1);
  CHECK(data.found[2] == 0);
  CHECK(data.found[3] == 1);
  CHECK(data.to[0] == 101);
}

TEST_CASE("a fence pulls earlier commands of its tag along, a queue barrier those of all tags") {
  Data data = numbered_data();
  const auto order = [](auto& spu, ea_t argument) {
    Data& d = at<Data>(argument);
    auto* buffer = spu.template allocate<std::uint32_t>(32 * 8);
    const auto get = [&](std::uint32_t slot, std::uint32_t tag) {
      spu.get(buffer + slot * 32, to_ea(d.from), 128, tag);
    };
    // Slot 0 and 1 share a tag without order; the barrier orders slot 2 after both and before slot 3.
    get(0, 1);
    get(1, 1);
    spu.getb(buffer + 2 * 32, to_ea(d.from), 128, 1);
    get(3, 1);
    get(4, 2);
    spu.mfc_barrier(6);
    get(5, 3);
    get(6, 4);
    spu.wait_any(1u << 2);
    d.found[0] = buffer[4 * 32] != 0 && buffer[0] == 0;
    spu.wait_all(1u << 3);
    d.found[1] = buffer[0] != 0 && buffer[3 * 32] != 0 && buffer[5 * 32] != 0;
    d.found[2] = buffer[6 * 32];
    d.found[3] = spu.completed(~0u);
  };
  run_on(kEmulator, 1, order, to_ea(&data));
  CHECK(data.found[0] == 1);
  CHECK(data.found[1] == 1);
  CHECK(data.found[2] == 0);
  CHECK(data.found[3] == ~(1u << 4));
}

TEST_CASE("the count of the command channel is the room in the queue") {
  Data data = numbered_data();
  const auto fill = [](auto& spu, ea_t argument) {
    Data& d = at<Data>(argument);
    auto* buffer = spu.template allocate<std::uint32_t>(32 * 20);
    const auto room = [&] { return spu.template channel_count<Channel::mfc_cmd>(); };
    spu.write_event_mask(event::command_queue);
    d.found[0] = room();
    for (std::uint32_t i = 0; i < 15; ++i)
      spu.get(buffer + i * 32, to_ea(d.from), 128, 1);
    d.found[1] = room();
    spu.get(buffer + 15 * 32, to_ea(d.from), 128, 1);
    d.found[2] = spu.event_count();
    // The seventeenth waits until the first has moved: the queue stays full, yet it had room in between.
    spu.get(buffer + 16 * 32, to_ea(d.from), 128, 1);
    d.found[3] = buffer[0];
    d.found[4] = buffer[32];
    d.found[5] = spu.read_event_status();
    d.found[6] = room();
    d.found[7] = room();
    spu.wait_all(2);
    d.found[8] = room();
  };
  run_on(kEmulator, 1, fill, to_ea(&data));
  CHECK(data.found[0] == 16);
  CHECK(data.found[1] == 1);
  CHECK(data.found[3] == 1);
  CHECK(data.found[5] == event::command_queue);
  CHECK(data.found[8] == 16);
  // Polls that find nothing let the queue go on, so that no program polls for ever.
  CHECK(data.found[2] == 0);
  CHECK(data.found[7] > data.found[6]);
}

TEST_CASE("commands can be spelled channel by channel, and the parameters stay") {
  Data data = numbered_data();
  const auto spell = [](auto& spu, ea_t argument) {
    if constexpr (!std::decay_t<decltype(spu)>::direct_memory) {
      Data& d = at<Data>(argument);
      auto* buffer = spu.template allocate<std::uint32_t>(64);
      const ea_t from = to_ea(d.from);
      const auto lsa = static_cast<std::uint32_t>(to_ea(buffer) - spu.addresses(spu.id()).local_store);
      spu.template write_channel<Channel::mfc_lsa>(lsa);
      spu.template write_channel<Channel::mfc_eah>(static_cast<std::uint32_t>(from >> 32));
      spu.template write_channel<Channel::mfc_eal>(static_cast<std::uint32_t>(from));
      spu.template write_channel<Channel::mfc_size>(128);
      spu.template write_channel<Channel::mfc_tag_id>(9);
      spu.template write_channel<Channel::mfc_cmd>(static_cast<std::uint32_t>(MfcOpcode::get));
      spu.template write_channel<Channel::mfc_lsa>(lsa + 128);
      spu.template write_channel<Channel::mfc_cmd>(0x05030000u | static_cast<std::uint32_t>(MfcOpcode::getf));
      d.found[0] = spu.wait_all(1u << 9);
      d.found[1] = buffer[31];
      d.found[2] = buffer[32];
      // put with the result bit
      spu.template write_channel<Channel::mfc_eal>(static_cast<std::uint32_t>(to_ea(d.to)));
      spu.template write_channel<Channel::mfc_cmd>(0x30);
      spu.template write_channel<Channel::wr_tag_mask>(1u << 9);
      d.found[3] = spu.template read_channel<Channel::rd_tag_mask>();
      d.found[4] = spu.template channel_count<Channel::rd_tag_stat>();
      spu.template write_channel<Channel::wr_tag_update>(2);
      d.found[5] = spu.template read_channel<Channel::rd_tag_stat>();
    }
  };
  run_on(kEmulator, 1, spell, to_ea(&data));
  CHECK(data.found[0] == 1u << 9);
  CHECK(data.found[1] == 32);
  CHECK(data.found[2] == 1);
  CHECK(data.found[3] == 1u << 9);
  CHECK(data.found[4] == 0);
  CHECK(data.found[5] == 1u << 9);
  CHECK(data.to[31] == 32);
}

TEST_CASE("the tag status event is raised when a request comes true") {
  Data data = numbered_data();
  const auto ask = [](auto& spu, ea_t argument) {
    Data& d = at<Data>(argument);
    auto* buffer = spu.template allocate<std::uint32_t>(32);
    spu.write_event_mask(event::tag_status);
    spu.get(buffer, to_ea(d.from), 128, 1);
    spu.template write_channel<Channel::wr_tag_mask>(2);
    spu.template write_channel<Channel::wr_tag_update>(2);
    d.found[0] = spu.template channel_count<Channel::rd_tag_stat>();
    d.found[1] = spu.read_event_status();
    d.found[2] = buffer[0];
    d.found[3] = spu.template channel_count<Channel::rd_tag_stat>();
    d.found[4] = spu.template read_channel<Channel::rd_tag_stat>();
  };
  run_on(kEmulator, 1, ask, to_ea(&data));
  CHECK(data.found[0] == 0);
  CHECK(data.found[1] == event::tag_status);
  CHECK(data.found[2] == 1);
  CHECK(data.found[3] == 1);
  CHECK(data.found[4] == 2);
}

TEST_CASE("what is queued is delivered before the SPE stalls or while it polls") {
  const bool poll = GENERATE(false, true);
  const auto machine = machine_of(kEmulator, 2);
  std::uint32_t polls = poll;
  const auto ask = [](auto& spu, ea_t argument) {
    const bool polling = at<std::uint32_t>(argument) != 0;
    auto* word = spu.template allocate<std::uint32_t>(4);
    if (spu.id() == 1) spu.read_signal_1();
    // The answer comes only after the signal, which nobody waits for, has arrived.
    word[3] = 1;
    spu.template mfc_command<MfcOpcode::sndsig>(word + 3, spu.addresses(1 - spu.id()).signal_1, 4, 5);
    if (spu.id() == 1) return;
    while (polling && spu.signal_1_count() == 0) {
    }
    spu.read_signal_1();
  };
  CHECK_NOTHROW(run_on(kEmulator, *machine, ask, to_ea(&polls), [](Machine&) {}));
}

TEST_CASE("what a program waits for in memory arrives though its tag is never waited for") {
  Data data{};
  const auto mirror = [](auto& spu, ea_t argument) {
    Data& d = at<Data>(argument);
    auto* line = spu.template allocate<std::uint32_t>(64);
    if (spu.id() == 0) {
      line[0] = 1;
      spu.put(line, to_ea(d.from), 128, 1);
      do {
        spu.get(line + 32, to_ea(d.to), 128, 2);
        spu.wait_all(1u << 2);
      } while (line[32] == 0);
    } else {
      do
        spu.getllar(line, to_ea(d.from));
      while (line[0] == 0);
      spu.put(line, to_ea(d.to), 128, 1);
      do
        spu.getllar(line + 32, to_ea(d.to));
      while (line[32] == 0);
    }
  };
  CHECK_NOTHROW(run_on(kEmulator, 2, mirror, to_ea(&data)));
}

TEST_CASE("whole lines are atomic between SPEs") {
  Data data{};
  const auto scribble = [](auto& spu, ea_t argument) {
    Data& d = at<Data>(argument);
    auto* line = spu.template allocate<std::uint32_t>(64);
    for (std::uint32_t round = 0; round < 300; ++round) {
      spu.get(line, to_ea(d.from), 256, 1);
      spu.wait_all(2);
      for (std::uint32_t i = 1; i < 32; ++i)
        if (line[i] != line[0] || line[32 + i] != line[32]) spu.halt(HaltCode::internal_error);
      for (std::uint32_t i = 0; i < 64; ++i)
        line[i] = spu.id() * 1000 + round;
      spu.put(line, to_ea(d.from), 256, 1);
      spu.wait_all(2);
    }
  };
  CHECK_NOTHROW(run_on(kEmulator, 6, scribble, to_ea(&data)));
}

struct alignas(128) LocalStores {
  SpeAddresses place[6];
};

TEST_CASE("local stores may be written from all sides at once") {
  LocalStores stores{};
  const auto scatter = [](auto& spu, ea_t argument) {
    auto& place = at<LocalStores>(argument).place;
    auto* inbox = spu.template allocate<std::uint32_t>(32 * 6);
    auto* line = spu.template allocate<std::uint32_t>(32);
    auto* mine = spu.template allocate<SpeAddresses>();
    mine->local_store = to_ea(inbox);
    spu.put(mine, to_ea(&place[spu.id()]), sizeof *mine, 0);
    spu.wait_all(1);
    for (std::uint32_t to = 0; to < spu.count(); ++to)
      spu.send_signal(to, Signal::one, 1u << spu.id());
    for (std::uint32_t here = 0; here != (1u << spu.count()) - 1;)
      here |= spu.read_signal_1();
    auto* theirs = spu.template allocate<SpeAddresses>(6);
    spu.get(theirs, to_ea(&place[0]), sizeof place, 0);
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
  };
  MachineConfig config;
  config.signal_mode[0] = config.signal_mode[1] = SignalMode::logical_or;
  const auto machine = machine_of(kEmulator, 6, config);
  CHECK_NOTHROW(run_on(kEmulator, *machine, scatter, to_ea(&stores), [](Machine&) {}));
}

} // namespace
} // namespace celltrace::test

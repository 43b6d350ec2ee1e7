// Channels, mailboxes, signals and events of the emulated SPU where they go beyond what all backends promise.
#include "spe/run_on.hpp"

namespace celltrace::test {
namespace {

const std::string kEmulator = "cell_emu";

struct Seen {
  std::uint32_t word[32];
};

TEST_CASE("channel counts after a reset") {
  Seen seen{};
  const auto count = [](auto& spu, ea_t argument) {
    if constexpr (!std::decay_t<decltype(spu)>::direct_memory) {
      auto& word = at<Seen>(argument).word;
      [&]<std::size_t... c>(std::index_sequence<c...>) {
        ((word[c] = spu.template channel_count<static_cast<Channel>(c)>()), ...);
      }
      (std::make_index_sequence<32>{});
    }
  };
  run_on(kEmulator, 1, count, to_ea(&seen));
  const std::uint32_t expected[32] = {0, 1, 1, 0, 0, 0,  0, 1, 1, 1, 0, 1, 1, 1, 1, 1,
                                      1, 1, 1, 1, 1, 16, 1, 1, 0, 0, 1, 0, 1, 0, 1, 0};
  for (std::uint32_t channel = 0; channel < 32; ++channel) {
    CAPTURE(channel);
    CHECK(seen.word[channel] == expected[channel]);
  }
}

TEST_CASE("the SPU's own registers") {
  Seen seen{};
  const auto own = [](auto& spu, ea_t argument) {
    if constexpr (!std::decay_t<decltype(spu)>::direct_memory) {
      auto& word = at<Seen>(argument).word;
      spu.template write_channel<Channel::wr_srr0>(0x1234);
      word[0] = spu.template read_channel<Channel::rd_srr0>();
      word[1] = spu.template read_channel<Channel::rd_mach_stat>();
      spu.write_event_mask(event::multi_source_sync);
      spu.template write_channel<Channel::wr_ms_sync_req>(1);
      word[2] = spu.read_event_status();
    }
  };
  run_on(kEmulator, 1, own, to_ea(&seen));
  CHECK(seen.word[0] == 0x1234);
  CHECK(seen.word[1] == 0);
  CHECK(seen.word[2] == event::multi_source_sync);
}

TEST_CASE("an SPE that overruns a mailbox replaces its newest word") {
  Seen seen{};
  const auto overrun = [](auto& spu, ea_t argument) {
    auto& word = at<Seen>(argument).word;
    for (std::uint32_t i = 1; i <= 5; ++i)
      spu.send_mailbox(spu.id(), i);
    word[0] = spu.in_mailbox_count();
    for (std::uint32_t i = 1; i <= 4; ++i)
      word[i] = spu.read_in_mailbox();
  };
  run_on(kEmulator, 1, overrun, to_ea(&seen));
  CHECK(seen.word[0] == 4);
  CHECK(seen.word[1] == 1);
  CHECK(seen.word[2] == 2);
  CHECK(seen.word[3] == 3);
  CHECK(seen.word[4] == 5);
}

TEST_CASE("a get of a signal register leaves it as it is") {
  Seen seen{};
  const auto peek = [](auto& spu, ea_t argument) {
    auto& word = at<Seen>(argument).word;
    auto* quadword = spu.template allocate<std::uint32_t>(4);
    spu.send_signal(spu.id(), Signal::two, 77);
    spu.get(quadword + 3, spu.addresses(spu.id()).signal_2, 4, 0);
    spu.wait_all(1);
    word[0] = quadword[3];
    word[1] = spu.signal_2_count();
    word[2] = spu.read_signal_2();
  };
  run_on(kEmulator, 1, peek, to_ea(&seen));
  CHECK(seen.word[0] == 77);
  CHECK(seen.word[1] == 1);
  CHECK(seen.word[2] == 77);
}

TEST_CASE("mail and signal events are raised when the count rises, not by every word") {
  Seen seen{};
  const auto edges = [](auto& spu, ea_t argument) {
    auto& word = at<Seen>(argument).word;
    spu.write_event_mask(event::in_mailbox | event::signal_1);
    spu.send_mailbox(spu.id(), 1);
    word[0] = spu.read_event_status();
    spu.acknowledge_events(~0u);
    spu.send_mailbox(spu.id(), 2);
    word[1] = spu.event_count();
    spu.read_in_mailbox();
    spu.read_in_mailbox();
    spu.send_mailbox(spu.id(), 3);
    word[2] = spu.event_count();
  };
  run_on(kEmulator, 1, edges, to_ea(&seen));
  CHECK(seen.word[0] == event::in_mailbox);
  CHECK(seen.word[1] == 0);
  CHECK(seen.word[2] == 1);
}

TEST_CASE("the PPE's reads of the outbound mailboxes are events") {
  Seen seen{};
  const auto machine = machine_of(kEmulator, 1);
  const auto talk = [](auto& spu, ea_t argument) {
    auto& word = at<Seen>(argument).word;
    spu.write_event_mask(event::out_mailbox);
    spu.write_out_mailbox(1);
    word[0] = spu.read_event_status();
    spu.write_event_mask(event::out_intr_mailbox);
    spu.write_out_interrupt_mailbox(2);
    word[1] = spu.read_event_status();
  };
  run_on(kEmulator, *machine, talk, to_ea(&seen), [](Machine& ppe) {
    while (!ppe.read_out_mailbox(0))
      if (!ppe.wait_for_mail(std::chrono::seconds(60))) FAIL("no mail");
    while (!ppe.read_out_interrupt_mailbox(0))
      if (!ppe.wait_for_mail(std::chrono::seconds(60))) FAIL("no mail");
  });
  CHECK(seen.word[0] == event::out_mailbox);
  CHECK(seen.word[1] == event::out_intr_mailbox);
}

TEST_CASE("events that waited for the kernel are pending when it starts, its mask is not") {
  Seen seen{};
  const auto machine = machine_of(kEmulator, 1);
  const auto look = [](auto& spu, ea_t argument) {
    auto& word = at<Seen>(argument).word;
    word[0] = spu.read_event_mask();
    spu.write_event_mask(~0u);
    word[1] = spu.read_event_status();
  };
  machine->write_in_mailbox(0, 5);
  machine->write_signal(0, Signal::two, 5);
  for (int run = 0; run < 2; ++run) {
    run_on(kEmulator, *machine, look, to_ea(&seen), [](Machine&) {});
    CHECK(seen.word[0] == 0);
    CHECK(seen.word[1] == (event::in_mailbox | event::signal_2));
  }
}

TEST_CASE("the decrementer follows virtual time and stops when masked and acknowledged") {
  Seen seen{};
  const auto count_down = [](auto& spu, ea_t argument) {
    auto& word = at<Seen>(argument).word;
    spu.write_decrementer(1000);
    word[0] = spu.read_decrementer();
    for (int i = 0; i < 100; ++i)
      spu.event_count();
    word[1] = spu.read_decrementer();
    spu.write_event_mask(0);
    spu.acknowledge_events(event::decrementer);
    word[2] = spu.read_decrementer();
    for (int i = 0; i < 100; ++i)
      spu.event_count();
    word[3] = spu.read_decrementer();
    // Polling sees it expire, too.
    spu.write_event_mask(event::decrementer);
    spu.write_decrementer(50);
    while (spu.event_count() == 0) {
    }
    word[4] = spu.read_event_status();
  };
  Seen again{};
  run_on(kEmulator, 1, count_down, to_ea(&seen));
  run_on(kEmulator, 1, count_down, to_ea(&again));
  CHECK(seen.word[0] <= 1000);
  CHECK(seen.word[1] < seen.word[0]);
  CHECK(seen.word[2] == seen.word[3]);
  CHECK(seen.word[4] == event::decrementer);
  CHECK(std::equal(std::begin(seen.word), std::end(seen.word), std::begin(again.word)));
}

TEST_CASE("an SPE that polls is interrupted like one that stalls") {
  const auto machine = machine_of(kEmulator, 3);
  const auto poll = [](auto& spu, ea_t argument) {
    auto* line = spu.template allocate<std::uint8_t>(128);
    if (spu.id() == 0) spu.get(line, argument, 3, 0);
    while (spu.id() == 1 && spu.event_count() == 0) {
    }
    while (spu.id() == 2)
      spu.getllar(line, spu.addresses(2).local_store);
  };
  const SpeProgram program = program_of(poll);
  for (unsigned spe = 0; spe < 3; ++spe)
    machine->start(spe, program, 0x100000);
  CHECK_THROWS_WITH(machine->wait(1), Catch::Contains("SPE 1: interrupted at channel 0 (SPU_RdEventStat)") &&
                                          Catch::Contains("SPE 0: get 3 bytes"));
  CHECK_THROWS_WITH(machine->wait(2), Catch::Contains("SPE 2: interrupted at channel 27"));
  CHECK_THROWS_WITH(machine->wait(0), Catch::StartsWith("SPE 0: get 3 bytes"));
}

} // namespace
} // namespace celltrace::test

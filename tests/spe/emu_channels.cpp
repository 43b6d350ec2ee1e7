// Channels, mailboxes, signals and events of the emulated SPU where they go beyond what all backends promise.
#include "celltrace/emulator.hpp"
#include "spe/run_on.hpp"

namespace celltrace::test {
namespace {

using Spu = EmulatedSpu;

TEST_CASE("channel counts after a reset") {
  std::uint32_t counts[32] = {};
  const EmulatedRun run = emulate(lockstep(1), [&](Spu& spu) {
    for (unsigned channel = 0; channel < 32; ++channel)
      counts[channel] = spu.channel_count(channel);
  });
  CHECK(run.ok());
  const std::uint32_t expected[32] = {0, 1, 1, 0, 0, 0,  0, 1, 1, 1, 0, 1, 1, 1, 1, 1,
                                      1, 1, 1, 1, 1, 16, 1, 1, 0, 0, 1, 0, 1, 0, 1, 0};
  for (unsigned channel = 0; channel < 32; ++channel) {
    CAPTURE(channel);
    CHECK(counts[channel] == expected[channel]);
  }
}

TEST_CASE("the SPU's own registers") {
  const EmulatedRun run = emulate(lockstep(1), [](Spu& spu) {
    spu.write_channel<Channel::wr_srr0>(0x1234);
    CHECK(spu.read_channel<Channel::rd_srr0>() == 0x1234);
    CHECK(spu.read_channel<Channel::rd_mach_stat>() == 0);
    spu.write_event_mask(event::multi_source_sync);
    spu.write_channel<Channel::wr_ms_sync_req>(1);
    CHECK(spu.read_event_status() == event::multi_source_sync);
  });
  CHECK(run.ok());
}

TEST_CASE("an SPE that overruns a mailbox replaces its newest word, and is told") {
  const EmulatedRun run = emulate(lockstep(1), [](Spu& spu) {
    for (std::uint32_t i = 1; i <= 5; ++i)
      spu.send_mailbox(spu.id(), i);
    CHECK(spu.in_mailbox_count() == 4);
    for (const std::uint32_t word : {1u, 2u, 3u, 5u})
      CHECK(spu.read_in_mailbox() == word);
  });
  CHECK(run.diagnostics.size() == 1);
  CHECK(run.broke(Rule::mailbox_overwritten));
  CHECK(run.errors[0].empty());
}

TEST_CASE("a get of a signal register leaves it as it is") {
  const EmulatedRun run = emulate(lockstep(1), [](Spu& spu) {
    auto* quadword = spu.allocate<std::uint32_t>(4);
    spu.send_signal(spu.id(), Signal::two, 77);
    spu.get(quadword + 3, spu.addresses(spu.id()).signal_2, 4, 0);
    spu.wait_all(1);
    CHECK(quadword[3] == 77);
    CHECK(spu.signal_2_count() == 1);
    CHECK(spu.read_signal_2() == 77);
  });
  CHECK(run.ok());
}

TEST_CASE("mail and signal events are raised when the count rises, not by every word") {
  const EmulatedRun run = emulate(lockstep(1), [](Spu& spu) {
    spu.write_event_mask(event::in_mailbox | event::signal_1);
    spu.send_mailbox(spu.id(), 1);
    CHECK(spu.read_event_status() == event::in_mailbox);
    spu.acknowledge_events(~0u);
    spu.send_mailbox(spu.id(), 2);
    CHECK(spu.event_count() == 0);
    spu.read_in_mailbox();
    spu.read_in_mailbox();
    spu.send_mailbox(spu.id(), 3);
    CHECK(spu.event_count() == 1);
    spu.read_in_mailbox();
  });
  CHECK(run.ok());
}

TEST_CASE("the PPE's reads of the outbound mailboxes are events") {
  const auto talk = [](Spu& spu) {
    spu.write_event_mask(event::out_mailbox);
    spu.write_out_mailbox(1);
    CHECK(spu.read_event_status() == event::out_mailbox);
    spu.write_event_mask(event::out_intr_mailbox);
    spu.write_out_interrupt_mailbox(2);
    CHECK(spu.read_event_status() == event::out_intr_mailbox);
  };
  const EmulatedRun run = emulate(lockstep(1), talk, 0, [](Machine& ppe) {
    while (!ppe.read_out_mailbox(0))
      if (!ppe.wait_for_mail(std::chrono::seconds(60))) FAIL("no mail");
    while (!ppe.read_out_interrupt_mailbox(0))
      if (!ppe.wait_for_mail(std::chrono::seconds(60))) FAIL("no mail");
  });
  CHECK(run.ok());
}

TEST_CASE("events that waited for the kernel are pending when it starts, its mask is not") {
  struct Seen {
    std::uint32_t mask, events;
  } seen{};
  const auto machine = machine_of("cell_emu", 1);
  const auto look = [](auto& spu, ea_t argument) {
    at<Seen>(argument).mask = spu.read_event_mask();
    spu.write_event_mask(~0u);
    at<Seen>(argument).events = spu.read_event_status();
  };
  machine->write_in_mailbox(0, 5);
  machine->write_signal(0, Signal::two, 5);
  for (int run = 0; run < 2; ++run) {
    run_on("cell_emu", *machine, look, to_ea(&seen), [](Machine&) {});
    CHECK(seen.mask == 0);
    CHECK(seen.events == (event::in_mailbox | event::signal_2));
  }
  // Each time the words were left where they are.
  const std::vector<Diagnostic> diagnostics = machine->diagnostics();
  REQUIRE(diagnostics.size() == 4);
  CHECK(diagnostics[2].rule == Rule::mailbox_unread);
  CHECK(diagnostics[3].rule == Rule::signal_unread);
}

TEST_CASE("the decrementer follows virtual time and stops when masked and acknowledged") {
  std::uint32_t seen[2][5] = {};
  for (auto& word : seen) {
    const EmulatedRun run = emulate(lockstep(1), [&](Spu& spu) {
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
    });
    CHECK(run.ok());
    CHECK(word[0] == 1000);
    // 6 cycles a poll, 40 a tick.
    CHECK(word[1] == 1000 - (100 * 6 + 2 * 6) / 40);
    CHECK(word[2] == word[3]);
    CHECK(word[4] == event::decrementer);
  }
  CHECK(std::equal(std::begin(seen[0]), std::end(seen[0]), std::begin(seen[1])));
}

TEST_CASE("an SPE that polls is interrupted like one that stalls") {
  const MachineConfig config = GENERATE(lockstep(3), free_running(3));
  const EmulatedRun run = emulate(
      config,
      [](Spu& spu, ea_t argument) {
        auto* line = spu.allocate<std::uint8_t>(128);
        if (spu.id() == 0) spu.get(line, argument, 3, 0);
        while (spu.id() == 1 && spu.event_count() == 0) {
        }
        while (spu.id() == 2)
          spu.getllar(line, spu.addresses(2).local_store);
      },
      0x100000);
  CHECK_THAT(run.errors[0], Catch::StartsWith("SPE 0: get 3 bytes"));
  CHECK_THAT(run.errors[1], Catch::Contains("SPE 1: interrupted at channel 0 (SPU_RdEventStat)") &&
                                Catch::Contains("SPE 0: get 3 bytes"));
  CHECK_THAT(run.errors[2], Catch::Contains("SPE 2: interrupted at channel 27"));
  CHECK(run.diagnostics.size() == 1);
}

} // namespace
} // namespace celltrace::test

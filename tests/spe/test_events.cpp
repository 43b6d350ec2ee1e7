#include "spe/run_on.hpp"

namespace celltrace::test {
namespace {

struct Seen {
  std::uint32_t word[12];
};

TEST_CASE("events are pending whatever the mask, and counted when it enables them") {
  const std::string key = GENERATE(from_range(spu_keys()));
  CAPTURE(key);
  Seen seen{};
  const auto look = [](auto& spu, ea_t argument) {
    auto& word = at<Seen>(argument).word;
    word[0] = spu.event_count();
    spu.send_signal(spu.id(), Signal::one, 5);
    word[1] = spu.event_count();
    spu.write_event_mask(event::signal_1 | event::in_mailbox);
    word[2] = spu.read_event_mask();
    word[3] = spu.event_count();
    word[4] = spu.read_event_status();
    word[5] = spu.event_count();
    spu.acknowledge_events(event::signal_1);
    word[6] = spu.event_count();
    word[7] = spu.read_signal_1();
    spu.send_mailbox(spu.id(), 6);
    word[8] = spu.event_count();
    word[9] = spu.read_event_status();
    // Still pending after the read: the next write of the mask counts it again.
    spu.write_event_mask(event::in_mailbox);
    word[10] = spu.event_count();
  };
  run_on(key, 1, look, to_ea(&seen));
  CHECK(seen.word[0] == 0);
  CHECK(seen.word[1] == 0);
  CHECK(seen.word[2] == (event::signal_1 | event::in_mailbox));
  CHECK(seen.word[3] == 1);
  CHECK(seen.word[4] == event::signal_1);
  CHECK(seen.word[5] == 0);
  CHECK(seen.word[6] == 0);
  CHECK(seen.word[7] == 5);
  CHECK(seen.word[8] == 1);
  CHECK(seen.word[9] == event::in_mailbox);
  CHECK(seen.word[10] == 1);
}

TEST_CASE("an event acknowledged before its status is read leaves a phantom") {
  const std::string key = GENERATE(from_range(spu_keys()));
  CAPTURE(key);
  Seen seen{};
  const auto look = [](auto& spu, ea_t argument) {
    auto& word = at<Seen>(argument).word;
    spu.write_event_mask(event::signal_2);
    spu.send_signal(spu.id(), Signal::two, 1);
    spu.acknowledge_events(event::signal_2);
    word[0] = spu.event_count();
    word[1] = spu.read_event_status();
    word[2] = spu.event_count();
  };
  run_on(key, 1, look, to_ea(&seen));
  CHECK(seen.word[0] == 1);
  CHECK(seen.word[1] == 0);
  CHECK(seen.word[2] == 0);
}

TEST_CASE("an SPE sleeps on its events until the PPE or a neighbour raises one") {
  const std::string key = GENERATE(from_range(spu_keys()));
  CAPTURE(key);
  const auto machine = machine_of(key, 2);
  Seen seen{};
  const auto serve = [](auto& spu, ea_t argument) {
    std::uint32_t handled = 0;
    spu.write_event_mask(event::in_mailbox | event::signal_1);
    while (handled < 40) {
      const std::uint32_t events = spu.read_event_status();
      spu.write_event_mask(0);
      spu.acknowledge_events(events);
      while (spu.in_mailbox_count() != 0) {
        const std::uint32_t word = spu.read_in_mailbox();
        if (spu.id() == 0) spu.send_signal(1, Signal::one, word);
        ++handled;
      }
      while (spu.signal_1_count() != 0) {
        spu.read_signal_1();
        if (spu.id() == 1) spu.write_out_mailbox(1);
        ++handled;
      }
      spu.write_event_mask(event::in_mailbox | event::signal_1);
    }
    at<Seen>(argument).word[spu.id()] = handled;
  };
  run_on(key, *machine, serve, to_ea(&seen), [](Machine& ppe) {
    for (std::uint32_t i = 0; i < 40; ++i) {
      ppe.write_in_mailbox(0, i);
      while (!ppe.read_out_mailbox(1))
        if (!ppe.wait_for_mail(std::chrono::seconds(60))) FAIL("no mail");
    }
  });
  CHECK(seen.word[0] == 40);
  CHECK(seen.word[1] == 40);
}

TEST_CASE("the decrementer raises its event once it has passed zero") {
  const std::string key = GENERATE(from_range(spu_keys()));
  CAPTURE(key);
  Seen seen{};
  const auto run_down = [](auto& spu, ea_t argument) {
    auto& word = at<Seen>(argument).word;
    spu.write_decrementer(100);
    spu.write_event_mask(event::decrementer);
    word[0] = spu.read_event_status();
    word[1] = spu.read_decrementer();
    spu.write_event_mask(0);
    spu.acknowledge_events(event::decrementer);
    spu.write_event_mask(event::decrementer);
    word[2] = spu.event_count();
  };
  run_on(key, 1, run_down, to_ea(&seen));
  CHECK(seen.word[0] == event::decrementer);
  CHECK(static_cast<std::int32_t>(seen.word[1]) < 0);
  CHECK(seen.word[2] == 0);
}

} // namespace
} // namespace celltrace::test

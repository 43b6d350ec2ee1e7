#include "backends/native/channels.hpp"

#include <catch2/catch.hpp>

#include <thread>

using namespace celltrace;
using namespace celltrace::native;

namespace {

struct OneSpe {
  explicit OneSpe(SignalMode mode = SignalMode::overwrite) : modes{mode, mode}, channels(modes, doorbell) {
    channels.begin();
  }
  SignalMode modes[2];
  Doorbell doorbell;
  Channels channels;
};

} // namespace

TEST_CASE("a register write to a full inbound mailbox replaces the newest word") {
  OneSpe spe;
  for (std::uint32_t word = 1; word <= 5; ++word)
    spe.channels.put_in_mailbox(word);
  CHECK(spe.channels.in_mailbox_count() == 4);
  for (const std::uint32_t word : {1u, 2u, 3u, 5u})
    CHECK(spe.channels.read_in_mailbox() == word);
  CHECK(spe.channels.in_mailbox_count() == 0);
}

TEST_CASE("a PPE write to a full inbound mailbox waits for space, or fails if nobody runs") {
  OneSpe spe;
  for (std::uint32_t word = 1; word <= 4; ++word)
    REQUIRE(spe.channels.write_in_mailbox(word));
  bool sent = false;
  std::thread ppe([&] { sent = spe.channels.write_in_mailbox(5); });
  for (std::uint32_t word = 1; word <= 5; ++word)
    CHECK(spe.channels.read_in_mailbox() == word);
  ppe.join();
  CHECK(sent);

  for (std::uint32_t word = 1; word <= 4; ++word)
    REQUIRE(spe.channels.write_in_mailbox(word));
  spe.channels.end();
  CHECK_FALSE(spe.channels.write_in_mailbox(5));
}

TEST_CASE("signals overwrite or accumulate, and reading clears them") {
  OneSpe overwriting(SignalMode::overwrite);
  OneSpe accumulating(SignalMode::logical_or);
  for (OneSpe* spe : {&overwriting, &accumulating}) {
    spe->channels.write_signal(Signal::two, 1);
    spe->channels.write_signal(Signal::two, 4);
    CHECK(spe->channels.signal_count(Signal::one) == 0);
    CHECK(spe->channels.signal_count(Signal::two) == 1);
  }
  CHECK(overwriting.channels.read_signal(Signal::two) == 4);
  CHECK(accumulating.channels.read_signal(Signal::two) == 5);
  CHECK(accumulating.channels.signal_count(Signal::two) == 0);
  accumulating.channels.write_signal(Signal::two, 8);
  CHECK(accumulating.channels.read_signal(Signal::two) == 8);
}

TEST_CASE("the event count follows the architecture's rules") {
  OneSpe spe;
  Channels& channels = spe.channels;
  SECTION("pending bits accumulate while masked, and count when the mask is written") {
    channels.write_signal(Signal::one, 1);
    CHECK(channels.event_count() == 0);
    channels.write_event_mask(event::signal_1);
    CHECK(channels.event_count() == 1);
    CHECK(channels.read_event_status() == event::signal_1);
  }
  SECTION("reading lowers the count and leaves the bits pending") {
    channels.write_event_mask(event::in_mailbox);
    channels.put_in_mailbox(7);
    CHECK(channels.read_event_status() == event::in_mailbox);
    CHECK(channels.event_count() == 0);
    channels.write_event_mask(event::in_mailbox);
    CHECK(channels.event_count() == 1);
  }
  SECTION("acknowledging some leaves the others to count again") {
    channels.write_event_mask(event::in_mailbox | event::signal_2);
    channels.put_in_mailbox(7);
    channels.write_signal(Signal::two, 7);
    CHECK(channels.read_event_status() == (event::in_mailbox | event::signal_2));
    channels.acknowledge_events(event::in_mailbox);
    CHECK(channels.event_count() == 1);
    CHECK(channels.read_event_status() == event::signal_2);
  }
  SECTION("an event that is acknowledged or masked after it counted is a phantom") {
    channels.write_event_mask(event::signal_2);
    channels.write_signal(Signal::two, 7);
    channels.acknowledge_events(event::signal_2);
    CHECK(channels.event_count() == 1);
    CHECK(channels.read_event_status() == 0);
    CHECK(channels.event_count() == 0);
  }
  SECTION("an outbound mailbox that is read raises its event") {
    channels.write_event_mask(event::out_mailbox);
    channels.write_out_mailbox(OutMailbox::plain, 3);
    CHECK(channels.event_count() == 0);
    CHECK(channels.read_out_mailbox(OutMailbox::plain) == 3u);
    CHECK_FALSE(channels.read_out_mailbox(OutMailbox::plain).has_value());
    CHECK(channels.read_event_status() == event::out_mailbox);
  }
}

TEST_CASE("a stalled read of the event status wakes for the decrementer") {
  OneSpe spe;
  spe.channels.write_event_mask(event::decrementer);
  spe.channels.write_decrementer(1000);
  CHECK(spe.channels.read_event_status() == event::decrementer);
  spe.channels.acknowledge_events(event::decrementer);
  CHECK(spe.channels.event_count() == 0);
  spe.channels.write_event_mask(0);
  spe.channels.acknowledge_events(event::decrementer);
  const std::uint32_t frozen = spe.channels.read_decrementer();
  CHECK(spe.channels.read_decrementer() == frozen);
}

TEST_CASE("an interruption reaches channels that stall, now or later") {
  OneSpe spe;
  bool unwound = false;
  std::thread stalled([&] {
    try {
      spe.channels.read_event_status();
    } catch (const Interrupted&) {
      unwound = true;
    }
  });
  spe.channels.interrupt();
  stalled.join();
  CHECK(unwound);
  CHECK_THROWS_AS(spe.channels.read_in_mailbox(), Interrupted);
  CHECK_THROWS_AS(spe.channels.read_signal(Signal::one), Interrupted);
  CHECK_THROWS_AS(spe.channels.stall_for_ever(), Interrupted);
  spe.channels.write_out_mailbox(OutMailbox::plain, 1);
  CHECK_THROWS_AS(spe.channels.write_out_mailbox(OutMailbox::plain, 1), Interrupted);
}

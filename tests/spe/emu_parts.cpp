// The emulator's parts on their own: no machine, no thread.
#include "backends/cell_emu/address_map.hpp"
#include "backends/cell_emu/decrementer.hpp"
#include "backends/cell_emu/events.hpp"
#include "backends/cell_emu/mailbox.hpp"
#include "backends/cell_emu/signal.hpp"
#include "backends/cell_emu/tag_groups.hpp"

#include <catch2/catch.hpp>

namespace celltrace::cell_emu {
namespace {

TEST_CASE("a full mailbox loses its newest word") {
  Mailbox<4> mailbox;
  for (std::uint32_t word = 1; word <= 5; ++word)
    mailbox.push({word, word + 100});
  CHECK(mailbox.count() == 4);
  for (const std::uint32_t value : {1u, 2u, 3u, 5u}) {
    const Word word = mailbox.pop();
    CHECK(word.value == value);
    CHECK(word.arrow == value + 100);
  }
  CHECK(mailbox.empty());
  mailbox.push({6, 0});
  CHECK(mailbox.pop().value == 6);
}

TEST_CASE("a signal register says when a write would lose a value") {
  SignalRegister overwriting(SignalMode::overwrite);
  CHECK_FALSE(overwriting.loses_a_value());
  overwriting.write({1, 0});
  CHECK(overwriting.loses_a_value());
  overwriting.write({2, 7});
  CHECK(overwriting.peek() == 2);
  CHECK(overwriting.count() == 1);
  const Word word = overwriting.read();
  CHECK(word.value == 2);
  CHECK(word.arrow == 7);
  CHECK(overwriting.count() == 0);
  CHECK(overwriting.peek() == 0);
  CHECK_FALSE(overwriting.loses_a_value());

  SignalRegister collecting(SignalMode::logical_or);
  collecting.write({1, 0});
  CHECK_FALSE(collecting.loses_a_value());
  collecting.write({2, 0});
  CHECK(collecting.read().value == 3);
  collecting.write({4, 0});
  CHECK(collecting.read().value == 4);
}

TEST_CASE(
    "the event count rises by an enabled event, by a mask, and by an acknowledge; only a read lowers it") {
  EventFacility events;
  events.raise(event::signal_1);
  CHECK(events.count() == 0);
  events.write_mask(event::signal_1 | event::signal_2);
  CHECK(events.count() == 1);
  CHECK(events.read_status() == event::signal_1);
  CHECK(events.count() == 0);
  CHECK(events.pending() == event::signal_1);

  SECTION("an acknowledge that leaves enabled events counts them") {
    events.raise(event::signal_2);
    CHECK(events.read_status() == (event::signal_1 | event::signal_2));
    events.acknowledge(event::signal_1);
    CHECK(events.count() == 1);
    CHECK(events.read_status() == event::signal_2);
  }
  SECTION("an acknowledge never lowers it: a phantom event") {
    events.raise(event::signal_2);
    events.acknowledge(event::signal_1 | event::signal_2);
    CHECK(events.count() == 1);
    CHECK(events.read_status() == 0);
  }
  SECTION("nor does a mask") {
    events.raise(event::signal_2);
    events.write_mask(0);
    CHECK(events.count() == 1);
    CHECK(events.read_status() == 0);
  }
  SECTION("an enabled event that is pending already is counted again") {
    events.raise(event::signal_1);
    CHECK(events.count() == 1);
  }
}

TEST_CASE("tag status requests wait for their condition") {
  TagGroups groups;
  groups.write_mask(0x6);
  CHECK_FALSE(groups.judge(0, 0));

  SECTION("immediate") {
    groups.request(TagUpdate::immediate);
    CHECK(groups.judge(0x2, 0));
    CHECK(groups.take() == 0x4);
    CHECK_FALSE(groups.available());
  }
  SECTION("any") {
    groups.request(TagUpdate::any);
    CHECK_FALSE(groups.judge(0x6, 0));
    CHECK(groups.waiting());
    CHECK(groups.judge(0x4, 0));
    CHECK(groups.take() == 0x2);
  }
  SECTION("all") {
    groups.request(TagUpdate::all);
    CHECK_FALSE(groups.judge(0x4, 0));
    CHECK(groups.judge(0x1, 0));
    CHECK(groups.take() == 0x6);
  }
  SECTION("all of none is true, any of none is not until the mask names one") {
    groups.write_mask(0);
    groups.request(TagUpdate::all);
    CHECK(groups.judge(~0u, 0));
    CHECK(groups.take() == 0);
    groups.request(TagUpdate::any);
    CHECK_FALSE(groups.judge(0, 0));
    groups.write_mask(0x8);
    CHECK(groups.judge(0, 0));
    CHECK(groups.take() == 0x8);
  }
  SECTION("an answer that replaces another is no event") {
    groups.request(TagUpdate::all);
    CHECK(groups.judge(0, 0));
    groups.request(TagUpdate::immediate);
    CHECK_FALSE(groups.judge(0x2, 0));
    CHECK(groups.take() == 0x4);
  }
  SECTION("a request that waits does not take the last answer away") {
    groups.request(TagUpdate::immediate);
    groups.judge(0, 0);
    groups.request(TagUpdate::all);
    CHECK_FALSE(groups.judge(0x2, 0));
    CHECK(groups.available());
    CHECK(groups.take() == 0x6);
    CHECK(groups.waiting());
  }
  SECTION("an answer speaks of the commands up to the moment of its condition") {
    groups.request(TagUpdate::all);
    groups.judge(0x2, 5);
    groups.judge(0, 7);
    groups.judge(0, 9);
    CHECK(groups.answered_up_to() == 7);
  }
}

TEST_CASE("the decrementer fires once when it passes zero") {
  constexpr std::uint32_t kTick = 40;
  Decrementer decrementer(kTick);
  CHECK_FALSE(decrementer.advance(1000));
  CHECK_FALSE(decrementer.write(10, 1000));
  CHECK(decrementer.expiry() == 1000 + 11 * kTick);
  CHECK_FALSE(decrementer.advance(1000 + 10 * kTick));
  CHECK(decrementer.value() == 0);
  CHECK_FALSE(decrementer.advance(1000 + 11 * kTick - 1));
  CHECK(decrementer.advance(1000 + 11 * kTick));
  CHECK(decrementer.value() == 0xFFFFFFFF);
  CHECK_FALSE(decrementer.advance(1000 + 1000 * kTick));
  decrementer.freeze(1000 + 1000 * kTick);
  const std::uint32_t frozen = decrementer.value();
  CHECK_FALSE(decrementer.advance(1u << 30));
  CHECK(decrementer.value() == frozen);
  // A write is a count, as far as the top bit goes.
  CHECK_FALSE(decrementer.write(0xC0000000, 0));
  CHECK_FALSE(decrementer.write(7, 0));
  CHECK(decrementer.write(0x80000000, 0));
  // From a negative value it first has to go all the way round.
  CHECK_FALSE(decrementer.advance(std::uint64_t{0x80000000} * kTick));
  CHECK(decrementer.advance(std::uint64_t{0x80000001} * kTick));
}

TEST_CASE("the address map tells storage, registers and nothing apart") {
  const AddressMap map(3);
  const SpeAddresses second = map.addresses(1);
  const auto kind = [&](ea_t ea, std::uint32_t size = 4) { return map.locate(ea, size).kind; };
  CHECK(second.local_store % kLocalStoreBytes == 0);
  CHECK(kind(second.local_store, 128) == EaKind::local_store);
  CHECK(map.locate(second.local_store + kLocalStoreBytes - 16, 16).spe == 1);
  CHECK(kind(second.local_store + kLocalStoreBytes - 16, 32) == EaKind::unmapped);
  CHECK(kind(map.addresses(0).local_store - 16, 32) == EaKind::unmapped);
  CHECK(kind(second.signal_1) == EaKind::signal_1);
  CHECK(kind(second.signal_2) == EaKind::signal_2);
  CHECK(kind(second.in_mailbox) == EaKind::in_mailbox);
  CHECK(map.locate(second.in_mailbox, 4).spe == 1);
  CHECK(kind(second.in_mailbox + 4) == EaKind::no_register);
  CHECK(kind(reinterpret_cast<std::uintptr_t>(&map)) == EaKind::main_memory);
  CHECK(kind(0) == EaKind::unmapped);
  CHECK(kind(0xFFFF) == EaKind::unmapped);
  CHECK(kind(~ea_t{15}, 32) == EaKind::unmapped);
}

} // namespace
} // namespace celltrace::cell_emu

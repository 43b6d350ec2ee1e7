#include "backends/native/mfc.hpp"

#include "backends/native/doorbell.hpp"
#include "celltrace/error.hpp"
#include "celltrace/spe/machine.hpp"

#include <catch2/catch.hpp>

#include <numeric>

using namespace celltrace;
using namespace celltrace::native;

namespace {

/// Two SPEs whose MFCs share registers and reservations.
struct TwoSpes {
  static constexpr SignalMode kModes[2] = {SignalMode::overwrite, SignalMode::overwrite};

  Doorbell doorbell;
  Channels channels[2] = {{kModes, doorbell}, {kModes, doorbell}};
  RegisterMap registers{{&channels[0], &channels[1]}};
  Reservations reservations{{&channels[0], &channels[1]}};
  Counters counters[2];
  Mfc mfc[2] = {{0, channels[0], registers, reservations, counters[0]},
                {1, channels[1], registers, reservations, counters[1]}};

  std::uint32_t completed(unsigned spe, std::uint32_t tags) {
    mfc[spe].write_tag_mask(tags);
    mfc[spe].write_tag_update(TagUpdate::immediate);
    return mfc[spe].read_tag_status();
  }
};

struct alignas(128) Line {
  std::uint32_t words[32];
};

Line counting_line(std::uint32_t first) {
  Line line;
  std::iota(std::begin(line.words), std::end(line.words), first);
  return line;
}

} // namespace

TEST_CASE("words that are put to register addresses arrive in the channels") {
  TwoSpes spes;
  using Register = RegisterMap::Register;
  alignas(16) std::uint32_t quadword[4] = {0, 0, 0, 42};
  for (const Register which : {Register::signal_1, Register::signal_2, Register::in_mailbox})
    CHECK((spes.registers.address(1, which) & 15) == 0xC);

  spes.mfc[0].command(MfcOpcode::sndsig, quadword + 3, spes.registers.address(1, Register::signal_2), 4, 31);
  CHECK(spes.channels[1].read_signal(Signal::two) == 42);
  spes.mfc[0].command(MfcOpcode::put, quadword + 3, spes.registers.address(1, Register::in_mailbox), 4, 31);
  CHECK(spes.channels[1].read_in_mailbox() == 42);
  CHECK(spes.counters[0].snapshot().signals_sent == 1);
  CHECK(spes.counters[0].snapshot().mailbox_words_sent == 1);

  const ea_t between = spes.registers.address(1, Register::in_mailbox) + 16;
  CHECK_THROWS_AS(spes.mfc[0].command(MfcOpcode::put, quadword + 3, between, 4, 31), SpeError);
  CHECK_THROWS_AS(spes.mfc[0].command(MfcOpcode::put, quadword, between - 12, 16, 31), SpeError);
}

TEST_CASE("a list gathers its elements at quadword boundaries") {
  TwoSpes spes;
  const Line main = counting_line(100);
  Line ls{};
  const ea_t ea = to_ea(&main);
  const ListElement list[] = {ListElement::make(16, ea + 32), ListElement::make(4, ea + 8),
                              ListElement::make(0, ea), ListElement::make(32, ea)};
  spes.mfc[0].list_command(MfcOpcode::getl, &ls, ea, list, sizeof list, 5);
  CHECK(spes.completed(0, 1u << 5) == 1u << 5);
  CHECK(ls.words[0] == 108);
  CHECK(ls.words[3] == 111);
  CHECK(ls.words[6] == 102); // a word keeps its place in the quadword
  CHECK(ls.words[8] == 100);
  CHECK(ls.words[15] == 107);
  CHECK(spes.counters[0].snapshot().dma_list_elements == 4);
  CHECK(spes.counters[0].snapshot().dma_bytes_read == 52);
}

TEST_CASE("a list stops at a notify element until its tag is acknowledged") {
  TwoSpes spes;
  Mfc& mfc = spes.mfc[0];
  const Line main = counting_line(0);
  Line ls{};
  Line other{};
  const ea_t ea = to_ea(&main);
  const ListElement list[] = {ListElement::make(16, ea, true), ListElement::make(16, ea + 16),
                              ListElement::make(16, ea + 32, true)};
  mfc.list_command(MfcOpcode::getl, &ls, ea, list, sizeof list, 3);
  CHECK(ls.words[3] == 3);
  CHECK(ls.words[7] == 0);
  CHECK(spes.completed(0, 0xF) == 0x7);
  CHECK(mfc.queue_space() == 15);

  SECTION("commands that are not ordered behind it run") {
    mfc.command(MfcOpcode::get, &other, ea, 128, 3);
    CHECK(other.words[31] == 31);
  }
  SECTION("fences and barriers of the tag, and queue barriers, hold commands back") {
    mfc.command(MfcOpcode::getf, &other, ea, 16, 3);
    mfc.command(MfcOpcode::getf, other.words + 4, ea, 16, 2);
    CHECK(other.words[3] == 0);
    CHECK(other.words[7] == 3);
    mfc.command(MfcOpcode::barrier, nullptr, 0, 0, 0);
    mfc.command(MfcOpcode::get, other.words + 8, ea, 16, 2);
    CHECK(other.words[11] == 0);
  }
  mfc.write_tag_mask(1u << 3);
  mfc.write_tag_update(TagUpdate::all);
  CHECK(mfc.tag_status_count() == 0);
  CHECK(mfc.read_list_stall_status() == 1u << 3);
  CHECK(mfc.list_stall_count() == 0);
  mfc.acknowledge_list_stall(3);
  CHECK(ls.words[11] == 11);
  CHECK(mfc.read_tag_status() == 1u << 3);
  CHECK(mfc.queue_space() == 16);
  CHECK(spes.completed(0, ~0u) == ~0u);
}

TEST_CASE("a reservation holds until another write of its line") {
  TwoSpes spes;
  Line main[2] = {counting_line(0), counting_line(32)};
  Line ls[2] = {};
  const ea_t ea = to_ea(&main[0]);
  const auto conditional = [&](unsigned spe) {
    spes.mfc[spe].command(MfcOpcode::putllc, &ls[spe], ea, 128, 0);
    return spes.mfc[spe].read_atomic_status();
  };
  spes.mfc[0].command(MfcOpcode::getllar, &ls[0], ea, 128, 0);
  CHECK(spes.mfc[0].read_atomic_status() == atomic_status::getllar_done);
  CHECK(ls[0].words[5] == 5);
  ls[0].words[0] = 77;
  spes.channels[0].write_event_mask(event::reservation_lost);

  SECTION("nobody writes") {
    CHECK(conditional(0) == 0);
    CHECK(main[0].words[0] == 77);
    CHECK(conditional(0) == atomic_status::putllc_failed);
  }
  SECTION("another SPE reserves the same line") {
    spes.mfc[1].command(MfcOpcode::getllar, &ls[1], ea, 128, 0);
    CHECK(conditional(0) == 0);
    CHECK(conditional(1) == atomic_status::putllc_failed);
  }
  SECTION("another SPE writes part of the line with a plain put") {
    spes.mfc[1].command(MfcOpcode::put, &ls[1].words[4], ea + 16, 16, 0);
    CHECK(spes.channels[0].read_event_status() == event::reservation_lost);
    CHECK(conditional(0) == atomic_status::putllc_failed);
    CHECK(main[0].words[0] == 0);
  }
  SECTION("another SPE writes the next line") {
    spes.mfc[1].command(MfcOpcode::put, &ls[1], ea + 128, 128, 0);
    CHECK(conditional(0) == 0);
  }
  SECTION("another SPE writes the line unconditionally") {
    spes.mfc[1].command(MfcOpcode::putlluc, &ls[1], ea, 128, 0);
    CHECK(spes.mfc[1].read_atomic_status() == atomic_status::putlluc_done);
    CHECK(spes.channels[0].event_count() == 1);
    CHECK(conditional(0) == atomic_status::putllc_failed);
  }
  SECTION("its own queued unconditional write takes it without an event") {
    spes.mfc[0].command(MfcOpcode::putqlluc, &ls[0], ea, 128, 4);
    CHECK(spes.channels[0].event_count() == 0);
    CHECK(conditional(0) == atomic_status::putllc_failed);
    CHECK(main[0].words[0] == 77);
  }
}

TEST_CASE("waiting for any of no tags and reading an idle status stall") {
  TwoSpes spes;
  spes.channels[0].interrupt();
  spes.mfc[0].write_tag_mask(0);
  spes.mfc[0].write_tag_update(TagUpdate::any);
  CHECK_THROWS_AS(spes.mfc[0].read_tag_status(), Interrupted);
  spes.mfc[0].write_tag_mask(2);
  CHECK(spes.mfc[0].read_tag_status() == 2);
  CHECK_THROWS_AS(spes.mfc[0].read_list_stall_status(), Interrupted);
  CHECK_THROWS_AS(spes.mfc[0].read_atomic_status(), Interrupted);
}

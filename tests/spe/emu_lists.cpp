// Stall-and-notify on the emulated MFC.
#include "celltrace/emulator.hpp"
#include "spe/emu_peek.hpp"

#include <catch2/catch.hpp>

namespace celltrace::test {
namespace {

using Spu = EmulatedSpu;

struct alignas(128) Data {
  std::uint32_t from[256];
  Data() {
    for (std::uint32_t i = 0; i < 256; ++i)
      from[i] = i + 1;
  }
};

TEST_CASE("while a list is stopped its tag goes on, but for barriers") {
  const Data data;
  MachineConfig config = lockstep(1);
  // What has started has moved.
  config.emulation.transfers = TransferTime::at_issue;
  const EmulatedRun run = emulate(config, [&](Spu& spu) {
    const ea_t from = to_ea(data.from);
    auto* buffer = spu.allocate<std::uint32_t>(32 * 6);
    auto* list = spu.allocate<ListElement>(2);
    list[0] = ListElement::make(16, from, true);
    list[1] = ListElement::make(16, from);
    spu.write_event_mask(event::list_stall);
    spu.getl(buffer, from, list, 2, 3);
    spu.getl(buffer + 32, from, list, 2, 3);
    const auto stalls = [&] { return spu.channel_count<Channel::rd_list_stall_stat>(); };
    CHECK(stalls() == 0);
    CHECK(spu.read_event_status() == event::list_stall);
    CHECK(stalls() == 1);
    CHECK(spu.read_list_stall_status() == 1u << 3);
    // The second list arrives at its stop a little later, and says so again.
    CHECK(spu.read_list_stall_status() == 1u << 3);
    CHECK(stalls() == 0);
    spu.get(buffer + 64, from, 16, 3);
    spu.getb(buffer + 96, from, 16, 3);
    while (spu.cycles() < 5000)
      spu.in_mailbox_count();
    CHECK(peek(buffer + 64) == 1);
    CHECK(peek(buffer + 96) == 0);
    CHECK(peek(buffer + 4) == 0);
    CHECK(spu.completed(1u << 3) == 0);
    spu.acknowledge_list_stall(3); // one acknowledge for both lists
    CHECK(spu.wait_all(1u << 3) == 1u << 3);
    CHECK(buffer[4] + buffer[36] == 2);
    CHECK(buffer[96] == 1);
  });
  CHECK(run.ok());
  CHECK(run.spes[0].dma_list_elements == 4);
}

TEST_CASE("a notify bit on the last element stops nothing") {
  const Data data;
  const EmulatedRun run = emulate(lockstep(1), [&](Spu& spu) {
    auto* buffer = spu.allocate<std::uint32_t>(32);
    auto* list = spu.allocate<ListElement>(1);
    list[0] = ListElement::make(16, to_ea(data.from), true);
    spu.getl(buffer, to_ea(data.from), list, 1, 3);
    CHECK(spu.wait_all(1u << 3) == 1u << 3);
    CHECK(spu.channel_count<Channel::rd_list_stall_stat>() == 0);
  });
  CHECK(run.ok());
}

void start_stopping_list(Spu& spu, ea_t ea) {
  auto* buffer = spu.allocate<std::uint32_t>(32);
  auto* list = spu.allocate<ListElement>(2);
  list[0] = ListElement::make(16, ea, true);
  list[1] = ListElement::make(16, ea);
  spu.getl(buffer, ea, list, 2, 3);
}

TEST_CASE("what waits for a list that nobody acknowledges is an error") {
  const Data data;
  const auto error_of = [&](auto program) {
    return emulate(lockstep(1), program, to_ea(data.from)).errors[0];
  };
  const auto still_stopped =
      Catch::Contains("its list is still stopped at a notify element [in-flight-at-exit");
  CHECK_THAT(error_of([](Spu& spu, ea_t ea) { start_stopping_list(spu, ea); }), still_stopped);
  CHECK_THAT(error_of([](Spu& spu, ea_t ea) {
               start_stopping_list(spu, ea);
               spu.read_list_stall_status();
             }),
             still_stopped);
  CHECK_THAT(error_of([](Spu& spu, ea_t ea) {
               start_stopping_list(spu, ea);
               spu.wait_all(1u << 3);
             }),
             Catch::Contains("MFC_RdTagStat would stall for ever"));
  CHECK_THAT(error_of([](Spu& spu, ea_t ea) {
               for (int i = 0; i < 17; ++i)
                 start_stopping_list(spu, ea);
             }),
             Catch::Contains("the queue is full"));
}

TEST_CASE("list elements reach registers word by word") {
  const EmulatedRun run = emulate(lockstep(1), [](Spu& spu) {
    auto* words = spu.allocate<std::uint32_t>(8);
    words[3] = 0x11;
    words[7] = 0x22;
    auto* list = spu.allocate<ListElement>(2);
    const SpeAddresses me = spu.addresses(spu.id());
    list[0] = ListElement::make(4, me.signal_1);
    list[1] = ListElement::make(4, me.in_mailbox);
    spu.putl(words, me.signal_1, list, 2, 0);
    spu.wait_all(1);
    CHECK(spu.read_signal_1() == 0x11);
    CHECK(spu.read_in_mailbox() == 0x22);
  });
  CHECK(run.ok());
}

TEST_CASE("an element of a list may not fill local store that belongs to the program's code") {
  alignas(128) static std::uint32_t data[32];
  const EmulatedRun run = emulate(lockstep(1), [&](EmulatedSpu& spu) {
    auto* list = spu.allocate<ListElement>(1);
    list[0] = ListElement::make(128, to_ea(data));
    spu.getl(spu.arena().begin - 128, to_ea(data), list, 1, 0);
    spu.wait_all(1);
  });
  REQUIRE(run.diagnostics.size() == 1);
  CHECK(run.diagnostics[0].rule == Rule::program_overwritten);
  CHECK_THAT(run.errors[0], Catch::Contains("element 0 of getl"));
}

} // namespace
} // namespace celltrace::test

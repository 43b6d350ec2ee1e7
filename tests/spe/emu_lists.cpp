// Stall-and-notify on the emulated MFC.
#include "spe/run_on.hpp"

namespace celltrace::test {
namespace {

const std::string kEmulator = "cell_emu";

struct alignas(128) Data {
  std::uint32_t from[256];
  std::uint32_t found[16];
};

Data numbered_data() {
  Data data{};
  for (std::uint32_t i = 0; i < 256; ++i)
    data.from[i] = i + 1;
  return data;
}

TEST_CASE("while a list is stopped its tag goes on, but for barriers") {
  Data data = numbered_data();
  const auto stop = [](auto& spu, ea_t argument) {
    Data& d = at<Data>(argument);
    auto* buffer = spu.template allocate<std::uint32_t>(32 * 6);
    auto* list = spu.template allocate<ListElement>(2);
    list[0] = ListElement::make(16, to_ea(d.from), true);
    list[1] = ListElement::make(16, to_ea(d.from));
    spu.write_event_mask(event::list_stall);
    spu.getl(buffer, argument, list, 2, 3);
    spu.getl(buffer + 32, argument, list, 2, 3);
    d.found[0] = spu.template channel_count<Channel::rd_list_stall_stat>();
    d.found[1] = spu.read_event_status();
    d.found[2] = spu.template channel_count<Channel::rd_list_stall_stat>();
    d.found[3] = spu.read_list_stall_status();
    d.found[4] = spu.template channel_count<Channel::rd_list_stall_stat>();
    spu.get(buffer + 64, to_ea(d.from), 16, 3);
    spu.getb(buffer + 96, to_ea(d.from), 16, 3);
    for (int poll = 0; poll < 10; ++poll)
      spu.in_mailbox_count();
    d.found[5] = buffer[64];
    d.found[6] = buffer[96];
    d.found[7] = spu.completed(1u << 3);
    spu.acknowledge_list_stall(3); // one acknowledge for both lists
    d.found[8] = spu.wait_all(1u << 3);
    d.found[9] = buffer[4] + buffer[36];
    d.found[10] = buffer[96];
  };
  run_on(kEmulator, 1, stop, to_ea(&data));
  CHECK(data.found[0] == 0);
  CHECK(data.found[1] == event::list_stall);
  CHECK(data.found[2] == 1);
  CHECK(data.found[3] == 1u << 3);
  CHECK(data.found[4] == 0);
  CHECK(data.found[5] == 1);
  CHECK(data.found[6] == 0);
  CHECK(data.found[7] == 0);
  CHECK(data.found[8] == 1u << 3);
  CHECK(data.found[9] == 2);
  CHECK(data.found[10] == 1);
}

TEST_CASE("a notify bit on the last element stops nothing") {
  Data data = numbered_data();
  const auto last = [](auto& spu, ea_t argument) {
    Data& d = at<Data>(argument);
    auto* buffer = spu.template allocate<std::uint32_t>(32);
    auto* list = spu.template allocate<ListElement>(1);
    list[0] = ListElement::make(16, to_ea(d.from), true);
    spu.getl(buffer, argument, list, 1, 3);
    d.found[0] = spu.wait_all(1u << 3);
    d.found[1] = spu.template channel_count<Channel::rd_list_stall_stat>();
  };
  run_on(kEmulator, 1, last, to_ea(&data));
  CHECK(data.found[0] == 1u << 3);
  CHECK(data.found[1] == 0);
}

template <class Kernel> std::string error_of(Kernel kernel) {
  Data data = numbered_data();
  return error_on(kEmulator, kernel, to_ea(&data));
}

TEST_CASE("what waits for a list that nobody acknowledges is an error") {
  const auto stopped_list = [](auto& spu, ea_t argument) {
    auto* buffer = spu.template allocate<std::uint32_t>(32);
    auto* list = spu.template allocate<ListElement>(2);
    list[0] = ListElement::make(16, argument, true);
    list[1] = ListElement::make(16, argument);
    spu.getl(buffer, argument, list, 2, 3);
  };
  CHECK_THAT(error_of(stopped_list), Catch::Contains("ended while a list is stopped"));
  CHECK_THAT(error_of([](auto& spu, ea_t argument) {
               decltype(stopped_list){}(spu, argument);
               spu.wait_all(1u << 3);
             }),
             Catch::Contains("MFC_RdTagStat would stall for ever"));
  CHECK_THAT(error_of([](auto& spu, ea_t argument) {
               for (int i = 0; i < 17; ++i)
                 decltype(stopped_list){}(spu, argument);
             }),
             Catch::Contains("the queue is full"));
}

TEST_CASE("list elements reach registers word by word") {
  std::uint32_t found = 0;
  const auto signal_by_list = [](auto& spu, ea_t argument) {
    auto* words = spu.template allocate<std::uint32_t>(8);
    words[3] = 0x11;
    words[7] = 0x22;
    auto* list = spu.template allocate<ListElement>(2);
    const SpeAddresses me = spu.addresses(spu.id());
    list[0] = ListElement::make(4, me.signal_1);
    list[1] = ListElement::make(4, me.in_mailbox);
    spu.putl(words, me.signal_1, list, 2, 0);
    spu.wait_all(1);
    at<std::uint32_t>(argument) = spu.read_signal_1() + spu.read_in_mailbox();
  };
  run_on(kEmulator, 1, signal_by_list, to_ea(&found));
  CHECK(found == 0x33);
}

} // namespace
} // namespace celltrace::test

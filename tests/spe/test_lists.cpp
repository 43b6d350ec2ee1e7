#include "spe/run_on.hpp"

#include <array>

namespace celltrace::test {
namespace {

struct alignas(128) Pieces {
  std::uint32_t from[256];
  std::uint32_t to[256];
  std::uint32_t found[8];
};

Pieces numbered_pieces() {
  Pieces pieces{};
  for (std::uint32_t i = 0; i < 256; ++i)
    pieces.from[i] = i + 1;
  return pieces;
}

TEST_CASE("a list gathers its elements, each at the next quadword, and scatters them") {
  const std::string key = GENERATE(from_range(spu_keys()));
  CAPTURE(key);
  Pieces pieces = numbered_pieces();
  const auto gather_scatter = [](auto& spu, ea_t argument) {
    Pieces& data = at<Pieces>(argument);
    auto* buffer = spu.template allocate<std::uint32_t>(64);
    auto* list = spu.template allocate<ListElement>(4);
    list[0] = ListElement::make(32, to_ea(&data.from[64]));
    list[1] = ListElement::make(0, to_ea(&data.from[0]));
    list[2] = ListElement::make(4, to_ea(&data.from[130]));
    list[3] = ListElement::make(16, to_ea(&data.from[200]));
    spu.getl(buffer, argument, list, 4, 1);
    spu.wait_all(2);
    data.found[0] = buffer[0];
    data.found[1] = buffer[7];
    data.found[2] = buffer[8 + 2];
    data.found[3] = buffer[12];
    list[0] = ListElement::make(16, to_ea(&data.to[8]));
    list[1] = ListElement::make(16, to_ea(&data.to[100]));
    spu.putl(buffer, argument, list, 2, 1);
    spu.wait_all(2);
  };
  const auto machine = run_on(key, 1, gather_scatter, to_ea(&pieces));
  CHECK(pieces.found[0] == 65);
  CHECK(pieces.found[1] == 72);
  CHECK(pieces.found[2] == 131);
  CHECK(pieces.found[3] == 201);
  CHECK(pieces.to[8] == 65);
  CHECK(pieces.to[100] == 69);
  CHECK(pieces.to[104] == 0);
  CHECK(machine->statistics(0).dma_commands == 2);
}

TEST_CASE("a fenced list follows what its tag did before") {
  const std::string key = GENERATE(from_range(spu_keys()));
  CAPTURE(key);
  Pieces pieces = numbered_pieces();
  const auto chain = [](auto& spu, ea_t argument) {
    Pieces& data = at<Pieces>(argument);
    auto* buffer = spu.template allocate<std::uint32_t>(32);
    auto* list = spu.template allocate<ListElement>(2);
    list[0] = ListElement::make(64, to_ea(&data.to[0]));
    list[1] = ListElement::make(64, to_ea(&data.to[16]));
    spu.get(buffer, to_ea(&data.from[0]), 128, 6);
    spu.putlf(buffer, argument, list, 2, 6);
    spu.getlb(buffer, argument, list, 2, 6);
    spu.wait_all(1u << 6);
    data.found[0] = buffer[31];
  };
  run_on(key, 1, chain, to_ea(&pieces));
  CHECK(pieces.to[0] == 1);
  CHECK(pieces.to[31] == 32);
  CHECK(pieces.found[0] == 32);
}

TEST_CASE("a list stops behind a notify element until it is acknowledged") {
  const std::string key = GENERATE(from_range(spu_keys()));
  CAPTURE(key);
  Pieces pieces = numbered_pieces();
  const auto stop_and_go = [](auto& spu, ea_t argument) {
    Pieces& data = at<Pieces>(argument);
    auto* buffer = spu.template allocate<std::uint32_t>(32);
    auto* list = spu.template allocate<ListElement>(3);
    list[0] = ListElement::make(16, to_ea(&data.from[0]), true);
    list[1] = ListElement::make(16, to_ea(&data.from[4]));
    list[2] = ListElement::make(16, to_ea(&data.from[8]));
    spu.getl(buffer, argument, list, 3, 12);
    data.found[0] = spu.read_list_stall_status();
    data.found[1] = buffer[0];
    data.found[2] = buffer[4];
    data.found[3] = spu.completed(1u << 12);
    // What is behind the stop may still be changed.
    list[2] = ListElement::make(16, to_ea(&data.from[100]));
    spu.acknowledge_list_stall(12);
    data.found[4] = spu.wait_all(1u << 12);
    data.found[5] = buffer[4];
    data.found[6] = buffer[8];
  };
  run_on(key, 1, stop_and_go, to_ea(&pieces));
  CHECK(pieces.found[0] == 1u << 12);
  CHECK(pieces.found[1] == 1);
  CHECK(pieces.found[2] == 0);
  CHECK(pieces.found[3] == 0);
  CHECK(pieces.found[4] == 1u << 12);
  CHECK(pieces.found[5] == 5);
  CHECK(pieces.found[6] == 101);
}

} // namespace
} // namespace celltrace::test

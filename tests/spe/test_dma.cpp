#include "spe/run_on.hpp"

#include <algorithm>
#include <array>
#include <numeric>

namespace celltrace::test {
namespace {

constexpr std::uint32_t kBytes = kMaxDmaBytes;

struct alignas(128) Blocks {
  std::array<std::uint8_t, kBytes> from;
  std::array<std::uint8_t, kBytes> to;
  std::uint32_t size;
  std::uint32_t found[4];
};

Blocks numbered_blocks() {
  Blocks blocks{};
  for (std::uint32_t i = 0; i < kBytes; ++i)
    blocks.from[i] = static_cast<std::uint8_t>(i * 7 + i / 256);
  return blocks;
}

TEST_CASE("get and put move exactly the bytes they name") {
  const std::string key = GENERATE(from_range(spu_keys()));
  const std::uint32_t size = GENERATE(1u, 2u, 4u, 8u, 16u, 128u, 144u, 4096u, 16384u);
  CAPTURE(key, size);
  Blocks blocks = numbered_blocks();
  blocks.size = size;
  const auto copy = [](auto& spu, ea_t argument) {
    const std::uint32_t bytes = at<Blocks>(argument).size;
    auto* buffer = spu.template allocate<std::uint8_t>(kBytes);
    spu.get(buffer, to_ea(&at<Blocks>(argument).from), bytes, 3);
    spu.wait_all(1u << 3);
    spu.put(buffer, to_ea(&at<Blocks>(argument).to), bytes, 4);
    spu.wait_all(1u << 4);
  };
  const auto machine = run_on(key, 1, copy, to_ea(&blocks));
  CHECK(std::equal(blocks.from.begin(), blocks.from.begin() + size, blocks.to.begin()));
  CHECK(std::count(blocks.to.begin() + size, blocks.to.end(), 0) == kBytes - size);
  const SpeStatistics statistics = machine->statistics(0);
  CHECK(statistics.dma_commands == 2);
  CHECK(statistics.dma_bytes_read == size);
  CHECK(statistics.dma_bytes_written == size);
  CHECK(statistics.local_store_peak >= kBytes);
}

TEST_CASE("a fence and a barrier order commands of a tag, mfc_barrier those of all tags") {
  const std::string key = GENERATE(from_range(spu_keys()));
  CAPTURE(key);
  Blocks blocks = numbered_blocks();
  const auto chain = [](auto& spu, ea_t argument) {
    Blocks& data = at<Blocks>(argument);
    auto* buffer = spu.template allocate<std::uint8_t>(4 * kLineBytes);
    spu.get(buffer, to_ea(&data.from[0]), kLineBytes, 1);
    spu.putf(buffer, to_ea(&data.to[0]), kLineBytes, 1);
    spu.get(buffer + kLineBytes, to_ea(&data.from[kLineBytes]), kLineBytes, 2);
    spu.putb(buffer + kLineBytes, to_ea(&data.to[kLineBytes]), kLineBytes, 2);
    spu.get(buffer + 2 * kLineBytes, to_ea(&data.to[kLineBytes]), kLineBytes, 2);
    spu.mfc_barrier(5);
    spu.put(buffer + 2 * kLineBytes, to_ea(&data.to[2 * kLineBytes]), kLineBytes, 7);
    spu.wait_all(1u << 7);
    spu.wait_all(~0u);
  };
  run_on(key, 1, chain, to_ea(&blocks));
  CHECK(std::equal(blocks.from.begin(), blocks.from.begin() + 2 * kLineBytes, blocks.to.begin()));
  CHECK(std::equal(blocks.from.begin() + kLineBytes, blocks.from.begin() + 2 * kLineBytes,
                   blocks.to.begin() + 2 * kLineBytes));
}

TEST_CASE("tag waits report the completed groups of the mask") {
  const std::string key = GENERATE(from_range(spu_keys()));
  CAPTURE(key);
  Blocks blocks = numbered_blocks();
  const auto wait = [](auto& spu, ea_t argument) {
    Blocks& data = at<Blocks>(argument);
    auto* buffer = spu.template allocate<std::uint8_t>(2 * kLineBytes);
    spu.get(buffer, to_ea(&data.from[0]), kLineBytes, 1);
    spu.get(buffer + kLineBytes, to_ea(&data.from[0]), kLineBytes, 2);
    data.found[0] = spu.wait_any(1u << 1 | 1u << 2);
    data.found[1] = spu.wait_all(1u << 1 | 1u << 2);
    data.found[2] = spu.wait_all(0);
    spu.get(buffer, to_ea(&data.from[0]), kLineBytes, 9);
    while (spu.completed(1u << 9) == 0) {
    }
    data.found[3] = spu.completed(1u << 9 | 1u << 10);
  };
  run_on(key, 1, wait, to_ea(&blocks));
  CHECK(blocks.found[0] != 0);
  CHECK((blocks.found[0] & ~6u) == 0);
  CHECK(blocks.found[1] == 6);
  CHECK(blocks.found[2] == 0);
  CHECK(blocks.found[3] == (1u << 9 | 1u << 10));
}

TEST_CASE("more commands than the queue has entries are all done") {
  const std::string key = GENERATE(from_range(spu_keys()));
  CAPTURE(key);
  Blocks blocks = numbered_blocks();
  const auto copy = [](auto& spu, ea_t argument) {
    Blocks& data = at<Blocks>(argument);
    auto* buffer = spu.template allocate<std::uint8_t>(kBytes);
    for (std::uint32_t at = 0; at < kBytes; at += kLineBytes)
      spu.get(buffer + at, to_ea(&data.from[at]), kLineBytes, at / kLineBytes % 8);
    spu.wait_all(0xFF);
    for (std::uint32_t at = 0; at < kBytes; at += kLineBytes)
      spu.put(buffer + at, to_ea(&data.to[at]), kLineBytes, 3);
    spu.wait_all(1u << 3);
  };
  run_on(key, 1, copy, to_ea(&blocks));
  CHECK(blocks.from == blocks.to);
}

struct alignas(128) Exchange {
  SpeAddresses buffer[8];
  std::uint32_t found[8];
};

TEST_CASE("local stores are reached through the main storage domain") {
  const std::string key = GENERATE(from_range(spu_keys()));
  CAPTURE(key);
  Exchange exchange{};
  // Every SPE tells where its buffer lies, puts a line into its right neighbour's and fetches it back from
  // there.
  const auto secondary_rays_of = [](auto& spu, ea_t argument) {
    Exchange& control = at<Exchange>(argument);
    auto* inbox = spu.template allocate<std::uint32_t>(32);
    auto* outbox = spu.template allocate<std::uint32_t>(32);
    auto* echo = spu.template allocate<std::uint32_t>(32);
    auto* mine = spu.template allocate<SpeAddresses>();
    auto* theirs = spu.template allocate<SpeAddresses>();
    const std::uint32_t right = (spu.id() + 1) % spu.count();
    const std::uint32_t left = (spu.id() + spu.count() - 1) % spu.count();
    mine->local_store = to_ea(inbox);
    spu.put(mine, to_ea(&control.buffer[spu.id()]), sizeof *mine, 0);
    spu.wait_all(1);
    spu.send_signal(left, Signal::one, 1);
    spu.read_signal_1();
    spu.get(theirs, to_ea(&control.buffer[right]), sizeof *theirs, 0);
    spu.wait_all(1);
    for (std::uint32_t i = 0; i < 32; ++i)
      outbox[i] = spu.id() * 100 + i;
    spu.put(outbox, theirs->local_store, 128, 1);
    spu.wait_all(2);
    spu.send_signal(right, Signal::two, 1);
    spu.read_signal_2();
    spu.get(echo, theirs->local_store, 128, 1);
    spu.wait_all(2);
    const bool echoed = echo[31] == spu.id() * 100 + 31;
    control.found[spu.id()] = echoed ? inbox[31] : 0;
    // Nobody leaves while a neighbour may still read its local store.
    spu.send_signal(left, Signal::one, 1);
    spu.read_signal_1();
  };
  run_on(key, 4, secondary_rays_of, to_ea(&exchange));
  for (std::uint32_t spe = 0; spe < 4; ++spe)
    CHECK(exchange.found[spe] == (spe + 3) % 4 * 100 + 31);
}

} // namespace
} // namespace celltrace::test

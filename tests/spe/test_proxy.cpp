#include "spe/run_on.hpp"

#include <algorithm>
#include <array>

namespace celltrace::test {
namespace {

using namespace std::chrono_literals;

constexpr std::uint32_t kBytes = kMaxDmaBytes;

/// Two blocks in main memory and a buffer in an SPE's local store.
struct alignas(kLineBytes) Blocks {
  std::array<std::uint8_t, kBytes> from{};
  std::array<std::uint8_t, kBytes> to{};
  std::uint32_t lsa = 0; ///< of the buffer, once the kernel has stopped with a signal

  Blocks() {
    for (std::uint32_t i = 0; i < kBytes; ++i)
      from[i] = static_cast<std::uint8_t>(i * 7 + i / 256);
  }
};

/// Tells the PPE where a buffer lies, and stops so that it can read it.
template <class Spu> void hand_over(Spu& spu, const void* buffer, std::uint32_t& lsa) {
  lsa = static_cast<std::uint32_t>(to_ea(buffer) - spu.addresses(spu.id()).local_store);
  spu.template stop_and_signal<1>();
}

/// Offers a buffer and goes on when it is told to.
constexpr auto kOffer = [](auto& spu, ea_t argument) {
  auto* buffer = spu.template allocate<std::uint8_t>(kBytes);
  hand_over(spu, buffer, at<Blocks>(argument).lsa);
};

/// A machine whose SPE 0 is stopped and offers a buffer.
std::unique_ptr<Machine> stopped_machine(const std::string& key, Blocks& blocks) {
  auto machine = machine_of(key, 1);
  machine->start(0, program_of(kOffer), to_ea(&blocks));
  REQUIRE(machine->wait(0).reason == SpeStop::Reason::stop_and_signal);
  return machine;
}

TEST_CASE("proxy commands move exactly the bytes they name while a kernel waits for a mailbox word") {
  const std::string key = GENERATE(from_range(spu_keys()));
  const std::uint32_t size = GENERATE(1u, 2u, 4u, 8u, 16u, 144u, 16384u);
  CAPTURE(key, size);
  Blocks blocks;
  const auto invert = [](auto& spu, ea_t argument) {
    auto* buffer = spu.template allocate<std::uint8_t>(kBytes);
    hand_over(spu, buffer, at<Blocks>(argument).lsa);
    const std::uint32_t bytes = spu.read_in_mailbox();
    for (std::uint32_t i = 0; i < bytes; ++i)
      buffer[i] = static_cast<std::uint8_t>(~buffer[i]);
    spu.write_out_mailbox(bytes);
    spu.read_in_mailbox();
  };
  const auto machine = machine_of(key, 1);
  run_on(key, *machine, invert, to_ea(&blocks), [&](Machine& ppe) {
    ppe.wait(0);
    ppe.resume(0);
    ppe.proxy_command(0, MfcOpcode::get, blocks.lsa, to_ea(&blocks.from), size, 3);
    CHECK(ppe.proxy_tag_status(0, 1u << 3, TagUpdate::all) == 1u << 3);
    ppe.write_in_mailbox(0, size);
    std::optional<std::uint32_t> answer;
    while (!(answer = ppe.read_out_mailbox(0)))
      REQUIRE(ppe.wait_for_mail(60s));
    CHECK(answer == size);
    ppe.proxy_command(0, MfcOpcode::put, blocks.lsa, to_ea(&blocks.to), size, 15);
    CHECK(ppe.proxy_tag_status(0, 1u << 15, TagUpdate::all) == 1u << 15);
    ppe.write_in_mailbox(0, 0);
  });
  CHECK(
      std::equal(blocks.to.begin(), blocks.to.begin() + size, blocks.from.begin(),
                 [](std::uint8_t to, std::uint8_t from) { return to == static_cast<std::uint8_t>(~from); }));
  CHECK(std::count(blocks.to.begin() + size, blocks.to.end(), 0) == kBytes - size);
}

TEST_CASE("fences and barriers order the proxy commands of a tag") {
  const std::string key = GENERATE(from_range(spu_keys()));
  CAPTURE(key);
  Blocks blocks;
  const auto machine = stopped_machine(key, blocks);
  const auto line = [](auto& block, std::uint32_t index) { return to_ea(&block[index * kLineBytes]); };
  const std::uint32_t second = blocks.lsa + kLineBytes;
  // A line through local store and back; the fences keep each behind the one before it.
  machine->proxy_command(0, MfcOpcode::get, blocks.lsa, line(blocks.from, 0), kLineBytes, 1);
  machine->proxy_command(0, MfcOpcode::putf, blocks.lsa, line(blocks.to, 0), kLineBytes, 1);
  machine->proxy_command(0, MfcOpcode::getf, blocks.lsa, line(blocks.from, 1), kLineBytes, 1);
  machine->proxy_command(0, MfcOpcode::putf, blocks.lsa, line(blocks.to, 1), kLineBytes, 1);
  // A barrier holds back what comes later, too.
  machine->proxy_command(0, MfcOpcode::get, second, line(blocks.from, 2), kLineBytes, 2);
  machine->proxy_command(0, MfcOpcode::putb, second, line(blocks.to, 2), kLineBytes, 2);
  machine->proxy_command(0, MfcOpcode::getb, second, line(blocks.to, 2), kLineBytes, 2);
  machine->proxy_command(0, MfcOpcode::put, second, line(blocks.to, 3), kLineBytes, 2);
  CHECK(machine->proxy_tag_status(0, 6, TagUpdate::all) == 6);
  CHECK(std::equal(blocks.from.begin(), blocks.from.begin() + 3 * kLineBytes, blocks.to.begin()));
  CHECK(std::equal(blocks.from.begin() + 2 * kLineBytes, blocks.from.begin() + 3 * kLineBytes,
                   blocks.to.begin() + 3 * kLineBytes));
  machine->resume(0);
  CHECK_NOTHROW(machine->wait(0));
}

TEST_CASE("the status of proxy tag groups is that of any, of all or of the moment") {
  const std::string key = GENERATE(from_range(spu_keys()));
  CAPTURE(key);
  Blocks blocks;
  const auto machine = stopped_machine(key, blocks);
  CHECK(machine->proxy_tag_status(0, 0xFFFF, TagUpdate::immediate) == 0xFFFF);
  CHECK(machine->proxy_tag_status(0, 0, TagUpdate::all) == 0);

  constexpr std::uint32_t kMask = 1u << 4 | 1u << 5;
  machine->proxy_command(0, MfcOpcode::get, blocks.lsa, to_ea(&blocks.from), 4096, 4);
  machine->proxy_command(0, MfcOpcode::get, blocks.lsa + 4096, to_ea(&blocks.from), 4096, 5);
  const std::uint32_t any = machine->proxy_tag_status(0, kMask, TagUpdate::any);
  CHECK(any != 0);
  CHECK((any & ~kMask) == 0);
  CHECK(machine->proxy_tag_status(0, kMask, TagUpdate::all) == kMask);
  CHECK(machine->proxy_tag_status(0, 1u << 5, TagUpdate::any) == 1u << 5);

  machine->proxy_command(0, MfcOpcode::put, blocks.lsa, to_ea(&blocks.to), kBytes / 2, 9);
  std::uint32_t completed = 0;
  for (int polls = 0; completed == 0 && polls < 1'000'000; ++polls)
    completed = machine->proxy_tag_status(0, 1u << 9, TagUpdate::immediate);
  CHECK(completed == 1u << 9);
  CHECK(std::equal(blocks.to.begin(), blocks.to.begin() + 4096, blocks.from.begin()));
  machine->resume(0);
  CHECK_NOTHROW(machine->wait(0));
}

TEST_CASE("more proxy commands than their queue has entries are all done, on an SPE without a kernel") {
  const std::string key = GENERATE(from_range(spu_keys()));
  CAPTURE(key);
  Blocks blocks;
  const auto machine = stopped_machine(key, blocks);
  machine->resume(0);
  machine->wait(0);
  for (std::uint32_t at = 0; at < kBytes; at += 512)
    machine->proxy_command(0, MfcOpcode::get, blocks.lsa + at, to_ea(&blocks.from[at]), 512, at / 512 % 16);
  CHECK(machine->proxy_tag_status(0, 0xFFFF, TagUpdate::all) == 0xFFFF);
  for (std::uint32_t at = 0; at < kBytes; at += 512)
    machine->proxy_command(0, MfcOpcode::put, blocks.lsa + at, to_ea(&blocks.to[at]), 512, 0);
  CHECK(machine->proxy_tag_status(0, 1, TagUpdate::all) == 1);
  CHECK(blocks.from == blocks.to);
}

TEST_CASE("a proxy put reaches the registers of another SPE") {
  const std::string key = GENERATE(from_range(spu_keys()));
  CAPTURE(key);
  struct Words {
    std::uint32_t lsa = 0;
    std::uint32_t signal = 0, mail = 0;
  } words;
  const auto secondary_rays_of = [](auto& spu, ea_t argument) {
    auto& found = at<Words>(argument);
    if (spu.id() == 0) {
      auto* quadwords = spu.template allocate<std::uint32_t>(8, 16);
      quadwords[3] = 33;
      quadwords[7] = 77;
      hand_over(spu, quadwords, found.lsa);
    } else {
      found.signal = spu.read_signal_2();
      found.mail = spu.read_in_mailbox();
    }
  };
  const auto machine = machine_of(key, 2);
  run_on(key, *machine, secondary_rays_of, to_ea(&words), [&](Machine& ppe) {
    ppe.wait(0);
    ppe.proxy_command(0, MfcOpcode::put, words.lsa + 12, ppe.addresses(1).signal_2, 4, 0);
    ppe.proxy_command(0, MfcOpcode::put, words.lsa + 28, ppe.addresses(1).in_mailbox, 4, 1);
    CHECK(ppe.proxy_tag_status(0, 3, TagUpdate::all) == 3);
    ppe.resume(0);
  });
  CHECK(words.signal == 33);
  CHECK(words.mail == 77);
}

TEST_CASE("a proxy put to a reserved line takes the reservation away") {
  const std::string key = GENERATE(from_range(spu_keys()));
  CAPTURE(key);
  struct alignas(kLineBytes) Reserved {
    std::uint32_t words[32] = {};
    std::uint32_t lsa = 0;
    bool stored[2] = {true, false};
  } reserved;
  const auto store = [](auto& spu, ea_t argument) {
    auto& shared = at<Reserved>(argument);
    auto* line = spu.template allocate<std::uint32_t>(32);
    auto* other = spu.template allocate<std::uint32_t>(4);
    other[0] = 5;
    spu.getllar(line, to_ea(shared.words));
    hand_over(spu, other, shared.lsa);
    shared.stored[0] = spu.putllc(line, to_ea(shared.words));
    spu.getllar(line, to_ea(shared.words));
    line[1] = line[0] + 1;
    shared.stored[1] = spu.putllc(line, to_ea(shared.words));
  };
  const auto machine = machine_of(key, 1);
  run_on(key, *machine, store, to_ea(&reserved), [&](Machine& ppe) {
    ppe.wait(0);
    ppe.proxy_command(0, MfcOpcode::put, reserved.lsa, to_ea(reserved.words), 16, 0);
    ppe.proxy_tag_status(0, 1, TagUpdate::all);
    ppe.resume(0);
  });
  CHECK_FALSE(reserved.stored[0]);
  CHECK(reserved.stored[1]);
  CHECK(reserved.words[0] == 5);
  CHECK(reserved.words[1] == 6);
}

TEST_CASE("proxy commands need an SPE that exists") {
  const std::string key = GENERATE(from_range(spu_keys()));
  CAPTURE(key);
  Blocks blocks;
  const auto machine = machine_of(key, 1);
  CHECK_THROWS_AS(machine->proxy_command(1, MfcOpcode::get, 0, to_ea(&blocks.from), 16, 0),
                  std::out_of_range);
  CHECK_THROWS_AS(machine->proxy_tag_status(1, 1, TagUpdate::immediate), std::out_of_range);
}

TEST_CASE("native refuses the proxy commands that it cannot do") {
  Blocks blocks;
  const auto machine = stopped_machine(native::Spu<BaselineArch>::kKey, blocks);
  const ea_t ea = to_ea(&blocks.from);
  CHECK_THROWS_AS(machine->proxy_command(0, MfcOpcode::getl, blocks.lsa, ea, 16, 0), SpeError);
  CHECK_THROWS_AS(machine->proxy_command(0, MfcOpcode::getllar, blocks.lsa, ea, kLineBytes, 0), SpeError);
  CHECK_THROWS_AS(machine->proxy_command(0, MfcOpcode::get, blocks.lsa, ea, 16, 16), SpeError);
  CHECK_THROWS_AS(machine->proxy_command(0, MfcOpcode::put, 0xFFFFFFF0u, ea, 32, 0), SpeError);
}

} // namespace
} // namespace celltrace::test

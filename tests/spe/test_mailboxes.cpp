#include "spe/run_on.hpp"

namespace celltrace::test {
namespace {

using namespace std::chrono_literals;

std::uint32_t next_mail(Machine& machine, unsigned spe) {
  for (;;) {
    if (const auto word = machine.read_out_mailbox(spe)) return *word;
    if (!machine.wait_for_mail(60s)) FAIL("no mail");
  }
}

TEST_CASE("the PPE and an SPE exchange words by mailbox") {
  const std::string key = GENERATE(from_range(spu_keys()));
  CAPTURE(key);
  const auto machine = machine_of(key, 2);
  const auto echo = [](auto& spu, ea_t) {
    for (;;) {
      const std::uint32_t word = spu.read_in_mailbox();
      if (word == 0) break;
      spu.write_out_mailbox(word * 10 + spu.id());
    }
    spu.write_out_interrupt_mailbox(99);
  };
  run_on(key, *machine, echo, 0, [](Machine& ppe) {
    for (std::uint32_t word = 1; word <= 50; ++word) {
      ppe.write_in_mailbox(0, word);
      ppe.write_in_mailbox(1, word);
      CHECK(next_mail(ppe, 0) == word * 10);
      CHECK(next_mail(ppe, 1) == word * 10 + 1);
    }
    ppe.write_in_mailbox(0, 0);
    ppe.write_in_mailbox(1, 0);
  });
  CHECK(machine->read_out_interrupt_mailbox(0) == 99u);
  CHECK(machine->read_out_interrupt_mailbox(0) == std::nullopt);
  CHECK(machine->read_out_mailbox(0) == std::nullopt);
  CHECK(machine->statistics(1).mailbox_words_sent == 51);
}

TEST_CASE("mailbox counts tell what is there and what is free") {
  const std::string key = GENERATE(from_range(spu_keys()));
  CAPTURE(key);
  const auto machine = machine_of(key, 1);
  std::uint32_t found[6] = {};
  // The words wait for the kernel before it starts.
  for (std::uint32_t word = 1; word <= 4; ++word)
    machine->write_in_mailbox(0, word);
  CHECK(machine->in_mailbox_space(0) == 0);
  CHECK_THROWS_AS(machine->write_in_mailbox(0, 5), SpeError);
  const auto count = [](auto& spu, ea_t argument) {
    auto& seen = at<std::uint32_t[6]>(argument);
    seen[0] = spu.in_mailbox_count();
    seen[1] = spu.read_in_mailbox();
    seen[2] = spu.in_mailbox_count();
    seen[3] = spu.out_mailbox_count();
    spu.write_out_mailbox(7);
    seen[4] = spu.out_mailbox_count();
    seen[5] = spu.out_interrupt_mailbox_count();
  };
  run_on(key, *machine, count, to_ea(&found), [](Machine&) {});
  CHECK(found[0] == 4);
  CHECK(found[1] == 1);
  CHECK(found[2] == 3);
  CHECK(found[3] == 1);
  CHECK(found[4] == 0);
  CHECK(found[5] == 1);
  CHECK(machine->in_mailbox_space(0) == 1);
  CHECK(machine->read_out_mailbox(0) == 7u);
}

TEST_CASE("the PPE waits while an inbound mailbox is full") {
  const std::string key = GENERATE(from_range(spu_keys()));
  CAPTURE(key);
  const auto machine = machine_of(key, 1);
  std::uint32_t sum = 0;
  const auto add_up = [](auto& spu, ea_t argument) {
    for (unsigned i = 0; i < 1000; ++i)
      at<std::uint32_t>(argument) += spu.read_in_mailbox();
  };
  run_on(key, *machine, add_up, to_ea(&sum), [](Machine& ppe) {
    for (std::uint32_t word = 1; word <= 1000; ++word)
      ppe.write_in_mailbox(0, word);
  });
  CHECK(sum == 500500);
}

TEST_CASE("SPEs write each other's inbound mailboxes") {
  const std::string key = GENERATE(from_range(spu_keys()));
  CAPTURE(key);
  std::uint32_t found[3] = {};
  // In a ring of three nobody can get more than three words ahead of its neighbour: no mailbox overflows.
  const auto ring = [](auto& spu, ea_t argument) {
    const std::uint32_t right = (spu.id() + 1) % spu.count();
    std::uint32_t sum = 0;
    for (std::uint32_t round = 0; round < 100; ++round) {
      spu.send_mailbox(right, spu.id() + round);
      sum += spu.read_in_mailbox();
    }
    at<std::uint32_t[3]>(argument)[spu.id()] = sum;
  };
  const auto machine = run_on(key, 3, ring, to_ea(&found));
  for (std::uint32_t spe = 0; spe < 3; ++spe) {
    CHECK(found[spe] == (spe + 2) % 3 * 100 + 4950);
    CHECK(machine->statistics(spe).mailbox_words_sent == 100);
  }
}

TEST_CASE("wait_for_mail wakes for a word and for the end of a kernel, and else times out") {
  const std::string key = GENERATE(from_range(spu_keys()));
  CAPTURE(key);
  const auto machine = machine_of(key, 1);
  CHECK_FALSE(machine->wait_for_mail(1ms));
  const auto speak = [](auto& spu, ea_t) {
    spu.read_in_mailbox();
    spu.write_out_mailbox(1);
    spu.read_in_mailbox();
  };
  run_on(key, *machine, speak, 0, [](Machine& ppe) {
    ppe.write_in_mailbox(0, 1);
    REQUIRE(ppe.wait_for_mail(60s));
    CHECK(ppe.read_out_mailbox(0) == 1u);
    CHECK_FALSE(ppe.wait_for_mail(1ms));
    ppe.write_in_mailbox(0, 1);
    CHECK(ppe.wait_for_mail(60s));
  });
  CHECK_FALSE(machine->wait_for_mail(1ms));
}

} // namespace
} // namespace celltrace::test

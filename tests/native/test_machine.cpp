#include "backends/native/cpus.hpp"
#include "backends/native/machine.hpp"
#include "backends/native/spu.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <chrono>
#include <vector>

using namespace celltrace;

namespace {

using TestSpu = native::Spu<BaselineArch>;

constexpr std::chrono::minutes kLong{1};

template <class Kernel> SpeProgram program(Kernel kernel) {
  SpeProgram made("test");
  made.add<TestSpu>(kernel);
  return made;
}

std::unique_ptr<Machine> machine_of(unsigned spes) {
  MachineConfig config;
  config.spes = spes;
  return native::make_machine(config);
}

std::uint32_t next_mail(Machine& machine, unsigned spe) {
  for (;;) {
    if (const auto word = machine.read_out_mailbox(spe)) return *word;
    REQUIRE(machine.wait_for_mail(kLong));
  }
}

} // namespace

TEST_CASE("PPE and SPE talk through mailboxes and signals") {
  const auto machine = machine_of(1);
  machine->start(0, program([](auto& spu, ea_t argument) {
                   spu.write_out_mailbox(static_cast<uint32_t>(argument) + spu.read_in_mailbox());
                   spu.write_out_mailbox(spu.read_signal_1());
                   spu.write_out_interrupt_mailbox(spu.count());
                 }),
                 1000);
  machine->write_in_mailbox(0, 7);
  CHECK(next_mail(*machine, 0) == 1007);
  CHECK(machine->running(0));
  machine->write_signal(0, Signal::one, 9);
  CHECK(next_mail(*machine, 0) == 9);
  machine->wait(0);
  CHECK_FALSE(machine->running(0));
  CHECK(machine->read_out_interrupt_mailbox(0) == 1u);
  CHECK(machine->in_mailbox_space(0) == 4);
  CHECK(machine->statistics(0).mailbox_words_sent == 3);
}

TEST_CASE("As many SPEs as there are CPUs have one each, others go where the system likes") {
  const std::vector<unsigned> all = native::usable_cpus();
  REQUIRE_FALSE(all.empty());
  CHECK(machine_of(0)->spe_count() == std::min<std::size_t>(all.size(), 256));
  for (const unsigned spes : {static_cast<unsigned>(all.size()), static_cast<unsigned>(all.size()) + 1}) {
    if (spes > 256) continue;
    const auto machine = machine_of(spes);
    std::vector<std::vector<unsigned>> of_spe(spes);
    const SpeProgram look = program([](auto& spu, ea_t argument) {
      auto* const found = reinterpret_cast<std::vector<unsigned>*>(static_cast<uintptr_t>(argument));
      found[spu.id()] = native::usable_cpus();
    });
    for (unsigned spe = 0; spe < spes; ++spe)
      machine->start(spe, look, to_ea(of_spe.data()));
    for (unsigned spe = 0; spe < spes; ++spe) {
      machine->wait(spe);
      INFO("SPE " << spe << " of " << spes);
#if defined(__linux__)
      if (spes == all.size()) {
        CHECK(of_spe[spe] == std::vector<unsigned>{all[spe]});
        continue;
      }
#endif
      CHECK(of_spe[spe] == all);
    }
  }
  CHECK(native::usable_cpus() == all);
}

TEST_CASE("SPEs pass a word round a ring") {
  constexpr unsigned kSpes = 5;
  const auto machine = machine_of(kSpes);
  const SpeProgram ring = program([](auto& spu, ea_t) {
    const uint32_t next = spu.id() + 1 == spu.count() ? 0 : spu.id() + 1;
    for (uint32_t round = 0; round < 100; ++round) {
      const uint32_t word = spu.read_in_mailbox() + 1;
      if (word < 100 * 5)
        spu.send_mailbox(next, word);
      else
        spu.write_out_mailbox(word);
    }
  });
  for (unsigned i = 0; i < kSpes; ++i)
    machine->start(i, ring, 0);
  machine->write_in_mailbox(0, 0);
  for (unsigned i = 0; i < kSpes; ++i)
    machine->wait(i);
  CHECK(machine->read_out_mailbox(kSpes - 1) == 500u);
  CHECK(machine->statistics(2).mailbox_words_sent == 100);
}

TEST_CASE("lock lines count under contention") {
  struct alignas(128) Line {
    std::uint32_t words[32];
  };
  static Line counter;
  counter = {};
  const auto machine = machine_of(4);
  const SpeProgram count = program([](auto& spu, ea_t argument) {
    auto* line = spu.template allocate<Line>();
    for (uint32_t i = 0; i < 1000; ++i)
      do {
        spu.getllar(line, argument);
        ++line->words[3];
      } while (!spu.putllc(line, argument));
  });
  for (unsigned i = 0; i < 4; ++i)
    machine->start(i, count, to_ea(&counter));
  for (unsigned i = 0; i < 4; ++i)
    machine->wait(i);
  CHECK(counter.words[3] == 4000);
}

TEST_CASE("a local store is reachable from other SPEs by its address") {
  const auto machine = machine_of(2);
  machine->start(1, program([](auto& spu, ea_t) {
                   uint32_t* words = spu.template allocate<uint32_t>(4);
                   words[2] = 11;
                   spu.write_out_mailbox(
                       static_cast<uint32_t>(reinterpret_cast<uint8_t*>(words) - spu.arena().begin));
                   spu.read_signal_2();
                   spu.write_out_mailbox(words[2]);
                 }),
                 0);
  const ea_t words = machine->addresses(1).local_store + next_mail(*machine, 1);
  machine->start(0, program([](auto& spu, ea_t argument) {
                   uint32_t* copy = spu.template allocate<uint32_t>(4);
                   spu.get(copy, argument, 16, 1);
                   spu.wait_all(1u << 1);
                   copy[2] *= 3;
                   spu.put(copy, argument, 16, 1);
                   spu.wait_all(1u << 1);
                   spu.send_signal(1, Signal::two, 1);
                 }),
                 words);
  machine->wait(0);
  CHECK(next_mail(*machine, 1) == 33);
  machine->wait(1);
}

TEST_CASE("the arena is fresh at every start and its peak is known") {
  const auto machine = machine_of(1);
  const SpeProgram half = program([](auto& spu, ea_t) {
    const auto mark = spu.mark();
    spu.template allocate<uint8_t>(600 * 1024);
    spu.release(mark);
  });
  for (int i = 0; i < 2; ++i) {
    machine->start(0, half, 0);
    machine->wait(0);
  }
  CHECK(machine->statistics(0).local_store_peak >= 600 * 1024);
  CHECK(machine->statistics(0).local_store_peak < 601 * 1024);
}

TEST_CASE("an SPE that fails names its error and interrupts the others") {
  const auto machine = machine_of(3);
  const SpeProgram stall = program([](auto& spu, ea_t) { spu.read_in_mailbox(); });
  machine->start(0, stall, 0);
  machine->start(1, program([](auto& spu, ea_t) { spu.template allocate<uint8_t>(2 * 1024 * 1024); }), 0);
  machine->start(2, program([](auto& spu, ea_t) { spu.wait_any(0); }), 0);
  CHECK_THROWS_WITH(machine->wait(0), "SPE 0: interrupted (SPE 1: halted: local store exhausted (code 1))");
  CHECK_THROWS_WITH(machine->wait(1), "SPE 1: halted: local store exhausted (code 1)");
  CHECK_THROWS_AS(machine->wait(2), SpeError);

  SECTION("once all were waited for the machine works again") {
    machine->start(0, stall, 0);
    machine->write_in_mailbox(0, 1);
    CHECK_NOTHROW(machine->wait(0));
  }
}

TEST_CASE("interrupt() stops what stalls, now and later") {
  const auto machine = machine_of(1);
  const SpeProgram stall = program([](auto& spu, ea_t) { spu.read_signal_2(); });
  machine->start(0, stall, 0);
  CHECK_THROWS_WITH(machine->start(0, stall, 0), "SPE 0 is running");
  machine->interrupt();
  CHECK_THROWS_WITH(machine->wait(0), "SPE 0: interrupted");
  machine->start(0, stall, 0);
  CHECK_THROWS_AS(machine->wait(0), SpeError);
}

TEST_CASE("a machine that is destroyed stops its kernels") {
  const auto machine = machine_of(2);
  for (unsigned i = 0; i < 2; ++i)
    machine->start(i, program([](auto& spu, ea_t) { spu.read_event_status(); }), 0);
}

TEST_CASE("wait_for_mail reports stops, and times out") {
  const auto machine = machine_of(1);
  CHECK_FALSE(machine->wait_for_mail(std::chrono::milliseconds(0)));
  machine->start(0, program([](auto&, ea_t) {}), 0);
  CHECK(machine->wait_for_mail(kLong));
  CHECK_FALSE(machine->running(0));
  CHECK_FALSE(machine->wait_for_mail(std::chrono::milliseconds(0)));
}

TEST_CASE("a mailbox that nobody empties is an error for the PPE") {
  const auto machine = machine_of(1);
  for (std::uint32_t i = 0; i < 4; ++i)
    machine->write_in_mailbox(0, i);
  CHECK_THROWS_AS(machine->write_in_mailbox(0, 4), SpeError);
  CHECK_THROWS_AS(machine->write_in_mailbox(1, 4), std::out_of_range);
}

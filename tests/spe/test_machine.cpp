#include "spe/run_on.hpp"

#include <algorithm>

namespace celltrace::test {
namespace {

TEST_CASE("an idle SPE can be started again, with an empty arena and its local store as it was") {
  const std::string key = GENERATE(from_range(spu_keys()));
  CAPTURE(key);
  struct Found {
    const void* place[2];
    std::uint32_t value;
  } found{};
  const auto write = [](auto& spu, ea_t argument) {
    auto* words = spu.template allocate<std::uint32_t>(32);
    at<Found>(argument).place[0] = words;
    words[5] = 4711;
  };
  const auto read = [](auto& spu, ea_t argument) {
    // Not allocate(), which would clear what the first kernel has left.
    const std::uint8_t* fill = spu.mark();
    spu.template allocate<std::uint8_t>(0);
    const auto* words = reinterpret_cast<const std::uint32_t*>(spu.mark());
    at<Found>(argument).place[1] = words;
    at<Found>(argument).value = words[5] + (fill > spu.mark() ? 1 : 0);
  };
  const auto machine = machine_of(key, 1);
  run_on(key, *machine, write, to_ea(&found), [](Machine&) {});
  run_on(key, *machine, read, to_ea(&found), [](Machine&) {});
  CHECK(found.place[0] == found.place[1]);
  CHECK(found.value == 4711);
}

TEST_CASE("an arena gives, takes back and runs out") {
  const std::string key = GENERATE(from_range(spu_keys()));
  CAPTURE(key);
  const std::string error = error_on(key, [](auto& spu, ea_t) {
    std::uint8_t* const mark = spu.mark();
    const std::uint32_t available = spu.available();
    spu.template allocate<std::uint64_t>(100);
    spu.release(mark);
    if (spu.available() != available) spu.halt(HaltCode::internal_error);
    for (;;)
      spu.template allocate<std::uint8_t>(1024);
  });
  CHECK_THAT(error, Catch::Contains("SPE 0") && Catch::Contains("local store"));
}

TEST_CASE("an SPE that fails releases the others, and the machine can be used again") {
  const std::string key = GENERATE(from_range(spu_keys()));
  CAPTURE(key);
  const auto machine = machine_of(key, 5);
  const auto fail = [](auto& spu, ea_t) {
    if (spu.id() == 3) spu.halt(HaltCode::bad_argument);
    if (spu.id() == 0) spu.read_in_mailbox();
    if (spu.id() == 1) spu.read_signal_2();
    if (spu.id() == 2) spu.read_event_status();
    for (;;)
      spu.write_out_mailbox(1);
  };
  const SpeProgram program = program_of(fail);
  for (unsigned spe = 0; spe < 5; ++spe)
    machine->start(spe, program, 0);
  for (unsigned spe = 0; spe < 5; ++spe) {
    CAPTURE(spe);
    CHECK_THROWS_WITH(machine->wait(spe), Catch::Contains("SPE " + std::to_string(spe)) &&
                                              Catch::Contains("SPE 3") && Catch::Contains("bad argument"));
    CHECK_FALSE(machine->running(spe));
  }
  const auto work = [](auto& spu, ea_t) { spu.send_signal((spu.id() + 1) % spu.count(), Signal::one, 1); };
  CHECK_NOTHROW(run_on(key, *machine, work, 0, [](Machine&) {}));
}

TEST_CASE("interrupt ends what stalls, and the destructor does so too") {
  const std::string key = GENERATE(from_range(spu_keys()));
  CAPTURE(key);
  const auto stall = [](auto& spu, ea_t) { spu.read_in_mailbox(); };
  const SpeProgram program = program_of(stall);
  const auto machine = machine_of(key, 2);
  machine->start(0, program, 0);
  machine->start(1, program, 0);
  machine->interrupt();
  CHECK_THROWS_AS(machine->wait(0), SpeError);
  CHECK_THROWS_AS(machine->wait(1), SpeError);
  // For good.
  machine->start(0, program, 0);
  CHECK_THROWS_AS(machine->wait(0), SpeError);

  const auto abandoned = machine_of(key, 2);
  abandoned->start(0, program, 0);
}

TEST_CASE("what a machine cannot do is refused") {
  const std::string key = GENERATE(from_range(spu_keys()));
  CAPTURE(key);
  const auto machine = machine_of(key, 2);
  CHECK(machine->spe_count() == 2);
  CHECK(name_of(machine->backend()) == key.substr(0, key.find('.')));
  CHECK_THROWS_AS(machine->wait(2), std::out_of_range);
  CHECK_THROWS_AS(machine->addresses(2), std::out_of_range);
  CHECK_THROWS_AS(machine->statistics(2), std::out_of_range);
  CHECK_THROWS_AS(machine->write_in_mailbox(2, 0), std::out_of_range);
  CHECK_THROWS_AS(machine->start(0, SpeProgram("empty"), 0), SpeError);
  CHECK_NOTHROW(machine->wait(0));

  const auto stall = [](auto& spu, ea_t) { spu.read_in_mailbox(); };
  const SpeProgram program = program_of(stall);
  machine->start(0, program, 0);
  CHECK(machine->running(0));
  CHECK_THROWS_AS(machine->start(0, program, 0), SpeError);
  machine->write_in_mailbox(0, 1);
  CHECK_NOTHROW(machine->wait(0));
  CHECK_FALSE(machine->running(0));
}

TEST_CASE("addresses of registers end in 0xC, and all are distinct") {
  const std::string key = GENERATE(from_range(spu_keys()));
  CAPTURE(key);
  const auto machine = machine_of(key, 3);
  std::vector<ea_t> all;
  for (unsigned spe = 0; spe < 3; ++spe) {
    const SpeAddresses addresses = machine->addresses(spe);
    CHECK(addresses.local_store % kLineBytes == 0);
    for (const ea_t ea : {addresses.signal_1, addresses.signal_2, addresses.in_mailbox}) {
      CHECK((ea & 15) == 0xC);
      CHECK(std::find(all.begin(), all.end(), ea) == all.end());
      all.push_back(ea);
    }
  }
}

} // namespace
} // namespace celltrace::test

#include "spe/run_on.hpp"

namespace celltrace::test {
namespace {

using namespace std::chrono_literals;

using Reason = SpeStop::Reason;

/// Keeps SPE 0 busy until there is a word in its inbound mailbox.
constexpr auto kWaitForWord = [](auto& spu, ea_t) { spu.read_in_mailbox(); };

/// Stops once in its middle.
constexpr auto kStopOnce = [](auto& spu, ea_t argument) {
  auto& steps = at<std::uint32_t>(argument);
  ++steps;
  spu.template stop_and_signal<0x1234>();
  ++steps;
};

TEST_CASE("a kernel exits by its return or by a stop code from 0x2000 to 0x20FF") {
  const std::string key = GENERATE(from_range(spu_keys()));
  const std::uint32_t way = GENERATE(0u, 1u, 2u, 3u);
  CAPTURE(key, way);
  struct Run {
    std::uint32_t way;
    bool behind_stop;
  } run{way, false};
  const auto leave = [](auto& spu, ea_t argument) {
    auto& [chosen, behind_stop] = at<Run>(argument);
    if (chosen == 0) return;
    if (chosen == 1) spu.template stop_and_signal<0x2000>();
    if (chosen == 2) spu.template stop_and_signal<0x2007>();
    spu.template stop_and_signal<0x20FF>();
    behind_stop = true;
  };
  const auto machine = machine_of(key, 1);
  machine->start(0, program_of(leave), to_ea(&run));
  constexpr std::uint32_t kCodes[] = {0, 0, 7, 0xFF};
  // The second call finds the same.
  for (int i = 0; i < 2; ++i) {
    const SpeStop stop = machine->wait(0);
    CHECK(stop.reason == Reason::exit);
    CHECK(stop.code == kCodes[way]);
    CHECK_FALSE(machine->running(0));
  }
  CHECK_FALSE(run.behind_stop);
}

TEST_CASE("any other code waits for the PPE, which sees it") {
  const std::string key = GENERATE(from_range(spu_keys()));
  CAPTURE(key);
  std::uint32_t steps = 0;
  const auto stop_often = [](auto& spu, ea_t argument) {
    auto& taken = at<std::uint32_t>(argument);
    ++taken;
    spu.template stop_and_signal<0>();
    ++taken;
    spu.template stop_and_signal<0x1FFF>();
    ++taken;
    spu.template stop_and_signal<0x2100>();
    ++taken;
    spu.template stop_and_signal<0x3FFE>();
    ++taken;
  };
  const auto machine = machine_of(key, 1);
  machine->start(0, program_of(stop_often), to_ea(&steps));
  std::uint32_t expected_steps = 0;
  for (const std::uint32_t code : {0u, 0x1FFFu, 0x2100u, 0x3FFEu}) {
    ++expected_steps;
    for (int i = 0; i < 2; ++i) {
      const SpeStop stop = machine->wait(0);
      CHECK(stop.reason == Reason::stop_and_signal);
      CHECK(stop.code == code);
      CHECK_FALSE(machine->running(0));
      CHECK(steps == expected_steps);
    }
    machine->resume(0);
  }
  const SpeStop end = machine->wait(0);
  CHECK(end.reason == Reason::exit);
  CHECK(end.code == 0);
  CHECK(steps == expected_steps + 1);
}

TEST_CASE("memory may change hands at a stop") {
  const std::string key = GENERATE(from_range(spu_keys()));
  CAPTURE(key);
  struct alignas(16) Word {
    std::uint32_t value = 1;
  } word;
  const auto count = [](auto& spu, ea_t argument) {
    auto* mine = spu.template allocate<Word>(1, 16);
    for (int i = 0; i < 3; ++i) {
      spu.get(mine, argument, sizeof(Word), 0);
      spu.wait_all(1);
      mine->value += 1;
      spu.put(mine, argument, sizeof(Word), 0);
      spu.wait_all(1);
      spu.template stop_and_signal<1>();
    }
  };
  const auto machine = machine_of(key, 1);
  machine->start(0, program_of(count), to_ea(&word));
  for (const std::uint32_t expected : {2u, 21u, 211u}) {
    CHECK(machine->wait(0).code == 1);
    CHECK(word.value == expected);
    word.value *= 10;
    machine->resume(0);
  }
  CHECK(machine->wait(0).reason == Reason::exit);
}

TEST_CASE("SPEs stop one by one, and are resumed in any order") {
  const std::string key = GENERATE(from_range(spu_keys()));
  CAPTURE(key);
  std::uint32_t steps[3] = {};
  const auto stop_each = [](auto& spu, ea_t argument) {
    auto& mine = at<std::uint32_t[3]>(argument)[spu.id()];
    ++mine;
    if (spu.id() == 0) spu.template stop_and_signal<0x10>();
    if (spu.id() == 1) spu.template stop_and_signal<0x11>();
    if (spu.id() == 2) spu.template stop_and_signal<0x12>();
    ++mine;
    // Its neighbour is still stopped when it is the first to be resumed.
    spu.send_signal((spu.id() + 1) % spu.count(), Signal::one, 1);
    spu.read_signal_1();
  };
  const auto machine = machine_of(key, 3);
  run_on(key, *machine, stop_each, to_ea(&steps), [&](Machine& ppe) {
    for (unsigned spe = 0; spe < 3; ++spe)
      CHECK(ppe.wait(spe).code == 0x10 + spe);
    for (const unsigned spe : {1u, 0u, 2u}) {
      CHECK(steps[spe] == 1);
      ppe.resume(spe);
    }
  });
  for (const std::uint32_t taken : steps)
    CHECK(taken == 2);
}

TEST_CASE("only a kernel that stopped with a signal can be resumed") {
  const std::string key = GENERATE(from_range(spu_keys()));
  CAPTURE(key);
  const auto machine = machine_of(key, 1);
  CHECK_THROWS_AS(machine->resume(1), std::out_of_range);
  CHECK_THROWS_AS(machine->resume(0), SpeError);
  const SpeProgram program = program_of(kWaitForWord);
  machine->start(0, program, 0);
  CHECK_THROWS_WITH(machine->resume(0), Catch::Contains("SPE 0"));
  machine->write_in_mailbox(0, 1);
  CHECK(machine->wait(0).reason == Reason::exit);
  CHECK_THROWS_AS(machine->resume(0), SpeError);
}

TEST_CASE("a program can be started where another has exited, but not where one is stopped") {
  const std::string key = GENERATE(from_range(spu_keys()));
  CAPTURE(key);
  const auto exit_5 = [](auto& spu, ea_t) { spu.template stop_and_signal<0x2005>(); };
  const auto machine = machine_of(key, 1);
  std::uint32_t steps = 0;
  for (int i = 0; i < 3; ++i) {
    machine->start(0, program_of(exit_5), 0);
    CHECK(machine->wait(0).code == 5);
    steps = 0;
    machine->start(0, program_of(kStopOnce), to_ea(&steps));
    CHECK(machine->wait(0).code == 0x1234);
    CHECK_THROWS_WITH(machine->start(0, program_of(exit_5), 0), Catch::Contains("SPE 0"));
    CHECK(machine->wait(0).code == 0x1234);
    CHECK(steps == 1);
    machine->resume(0);
    CHECK(machine->wait(0).code == 0);
    CHECK(steps == 2);
  }
}

TEST_CASE("interrupt ends a kernel that is stopped, and the destructor does so too") {
  const std::string key = GENERATE(from_range(spu_keys()));
  CAPTURE(key);
  std::uint32_t steps = 0;
  const auto machine = machine_of(key, 1);
  machine->start(0, program_of(kStopOnce), to_ea(&steps));
  CHECK(machine->wait(0).code == 0x1234);
  machine->interrupt();
  CHECK_THROWS_AS(machine->wait(0), SpeError);
  CHECK_THROWS_AS(machine->resume(0), SpeError);
  CHECK_FALSE(machine->running(0));
  // A later one does not stop either: there will be nobody to resume it.
  machine->start(0, program_of(kStopOnce), to_ea(&steps));
  CHECK_THROWS_AS(machine->wait(0), SpeError);
  CHECK(steps == 2);

  std::uint32_t abandoned_steps = 0;
  {
    const auto abandoned = machine_of(key, 1);
    abandoned->start(0, program_of(kStopOnce), to_ea(&abandoned_steps));
    abandoned->wait(0);
  }
  CHECK(abandoned_steps == 1);
}

TEST_CASE("an SPE that fails ends those that are stopped, and the machine can be used again") {
  const std::string key = GENERATE(from_range(spu_keys()));
  CAPTURE(key);
  const auto fail = [](auto& spu, ea_t) {
    if (spu.id() == 0) spu.template stop_and_signal<1>();
    spu.read_in_mailbox();
    spu.halt(HaltCode::bad_argument);
  };
  const auto machine = machine_of(key, 2);
  const SpeProgram program = program_of(fail);
  machine->start(0, program, 0);
  machine->start(1, program, 0);
  CHECK(machine->wait(0).code == 1);
  machine->write_in_mailbox(1, 1);
  CHECK_THROWS_WITH(machine->wait(1), Catch::Contains("SPE 1") && Catch::Contains("bad argument"));
  CHECK_THROWS_WITH(machine->wait(0), Catch::Contains("SPE 0") && Catch::Contains("bad argument"));
  CHECK_THROWS_AS(machine->resume(0), SpeError);
  CHECK(machine->wait(0).reason == Reason::exit);

  std::uint32_t steps = 0;
  machine->start(0, program_of(kStopOnce), to_ea(&steps));
  CHECK(machine->wait(0).code == 0x1234);
  machine->resume(0);
  CHECK(machine->wait(0).reason == Reason::exit);
  CHECK(steps == 2);
}

TEST_CASE("a stop wakes a PPE that waits for mail") {
  const std::string key = GENERATE(from_range(spu_keys()));
  CAPTURE(key);
  std::uint32_t steps = 0;
  const auto machine = machine_of(key, 1);
  machine->start(0, program_of(kStopOnce), to_ea(&steps));
  CHECK(machine->wait_for_mail(60s));
  CHECK_FALSE(machine->running(0));
  CHECK(machine->wait(0).code == 0x1234);
  CHECK_FALSE(machine->wait_for_mail(1ms));
  machine->resume(0);
  CHECK(machine->wait_for_mail(60s));
  CHECK(machine->wait(0).reason == Reason::exit);
}

TEST_CASE("a stopped SPE takes words until its mailbox is full, and reads them when it goes on") {
  const std::string key = GENERATE(from_range(spu_keys()));
  CAPTURE(key);
  std::uint32_t sum = 0;
  const auto add_up = [](auto& spu, ea_t argument) {
    spu.template stop_and_signal<1>();
    for (int i = 0; i < 5; ++i)
      at<std::uint32_t>(argument) = at<std::uint32_t>(argument) * 10 + spu.read_in_mailbox();
  };
  const auto machine = machine_of(key, 1);
  machine->start(0, program_of(add_up), to_ea(&sum));
  CHECK(machine->wait(0).code == 1);
  for (std::uint32_t word = 1; word <= 4; ++word)
    machine->write_in_mailbox(0, word);
  CHECK_THROWS_AS(machine->write_in_mailbox(0, 9), SpeError);
  machine->resume(0);
  machine->write_in_mailbox(0, 5);
  CHECK(machine->wait(0).reason == Reason::exit);
  CHECK(sum == 12345);
}

} // namespace
} // namespace celltrace::test

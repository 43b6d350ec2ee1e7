// What only a machine that executes instructions can see: code in local store, loads and stores against DMA,
// interrupts.
#include "celltrace/simulator.hpp"
#include "simulator/machine_code.hpp"

#include <catch2/catch.hpp>

#include <random>
#include <sstream>

using namespace celltrace;
using namespace celltrace::test;

namespace {

alignas(128) std::uint8_t main_memory[256];

SimulatedRun run(const Code& code, MachineConfig config = simulated(1)) {
  return simulate(config, code.elf(), to_ea(main_memory));
}

MachineConfig limited(std::uint64_t cycles) {
  MachineConfig config = simulated(1);
  config.emulation.cycle_limit = cycles;
  return config;
}

} // namespace

TEST_CASE("a program ends with the code of its stop") {
  Code code;
  code.exit(42);
  const SimulatedRun ended = run(code);
  INFO(ended.report());
  CHECK(ended.ok());
  CHECK(ended.exit_codes[0] == 42);
}

TEST_CASE("code that a program writes is executed as it then is") {
  Code code;
  // The second time through, the instruction at `target` is another one.
  const std::uint32_t data = 0x100, target = 0x80;
  code.add("il", {.rt = 6, .immediate = 0});
  code.add("bra", {.immediate = target / 4});
  code.fill_to(0x40);
  code.add("lqa", {.rt = 5, .immediate = data / 4});
  code.add("stqa", {.rt = 5, .immediate = target / 4});
  code.add("sync");
  code.add("bra", {.immediate = target / 4});
  code.fill_to(target);
  code.add("ai", {.rt = 6, .ra = 6, .immediate = 1});
  code.add("bra", {.immediate = 0x40 / 4});
  code.fill_to(data);
  code.exit(7).exit(8).exit(9).exit(10);
  const SimulatedRun ended = run(code);
  INFO(ended.report());
  CHECK(ended.ok());
  CHECK(ended.exit_codes[0] == 7);
}

TEST_CASE("to leave the code is an error that says where") {
  Code code;
  SECTION("into local store that nobody wrote") {
    code.add("bra", {.immediate = 0x20000 / 4});
    const SimulatedRun ended = run(code);
    REQUIRE(ended.broke(Rule::unwritten_code));
    CHECK_THAT(ended.errors[0], Catch::Contains("LS 0x20000"));
  }
  SECTION("into data that are no instruction") {
    code.add("br", {.immediate = 1}).word(0x00800000);
    const SimulatedRun ended = run(code);
    REQUIRE(ended.broke(Rule::invalid_instruction));
    CHECK_THAT(ended.errors[0], Catch::Contains("LS 0x00004: 0x00800000"));
  }
  SECTION("into zeros, which are stops") {
    code.add("br", {.immediate = 1}).word(0);
    CHECK_THAT(run(code).errors[0], Catch::Contains("stopped with code 0"));
  }
  SECTION("round the end of local store") {
    // What lies behind the last word is the first one.
    code.add("brnz", {.rt = 9, .immediate = 4});
    code.add("il", {.rt = 9, .immediate = 1});
    code.add("lqa", {.rt = 5, .immediate = 0x40 / 4});
    code.add("br", {.immediate = 2}).exit(5);
    code.add("stqa", {.rt = 5, .immediate = 0x3FFF0 / 4});
    code.add("bra", {.immediate = 0x3FFF0 / 4});
    code.fill_to(0x40);
    for (int i = 0; i < 4; ++i)
      code.add("lnop");
    const SimulatedRun ended = run(code);
    INFO(ended.report());
    CHECK(ended.ok());
    CHECK(ended.exit_codes[0] == 5);
  }
}

TEST_CASE("halts, endless loops and unknown channels end a program") {
  Code code;
  SECTION("halt") {
    code.add("heqi", {.ra = 0, .immediate = 0});
    CHECK(run(code).broke(Rule::halted));
  }
  SECTION("endless loop") {
    code.add("br", {.immediate = 0});
    const SimulatedRun ended = run(code, limited(200000));
    CHECK(ended.broke(Rule::time_limit));
    CHECK(ended.cycles >= 200000);
    CHECK(ended.cycles < 400000);
  }
  SECTION("channel") {
    code.add("rdch", {.rt = 3, .ra = 77});
    CHECK(run(code).broke(Rule::invalid_channel));
  }
}

TEST_CASE("a load from the target of a get in flight is an error when it is used") {
  Code code;
  code.dma(0x40, 0x1000, 128, 3);
  code.add("lqa", {.rt = 6, .immediate = 0x1010 / 4});
  bool fine = false;
  SECTION("stored") {
    code.add("stqa", {.rt = 6, .immediate = 0x2000 / 4});
  }
  SECTION("computed with and stored") {
    code.add("a", {.rt = 7, .ra = 6, .rb = 6});
    code.add("stqa", {.rt = 7, .immediate = 0x2000 / 4});
  }
  SECTION("branched on") {
    code.add("brz", {.rt = 6, .immediate = 1});
  }
  SECTION("an address") {
    code.add("lqd", {.rt = 7, .ra = 6});
  }
  SECTION("rotated into the preferred slot") {
    code.add("rotqbyi", {.rt = 7, .ra = 6, .immediate = 4});
    code.add("wrch", {.rt = 7, .ra = 28});
  }
  SECTION("dropped") {
    fine = true;
  }
  SECTION("overwritten") {
    fine = true;
    code.add("il", {.rt = 6, .immediate = 1});
    code.add("stqa", {.rt = 6, .immediate = 0x2000 / 4});
  }
  SECTION("not selected") {
    fine = true;
    code.add("il", {.rt = 8, .immediate = 0});
    code.add("selb", {.rt = 7, .ra = 9, .rb = 6, .rc = 8});
    code.add("stqa", {.rt = 7, .immediate = 0x2000 / 4});
  }
  SECTION("shuffled away") {
    fine = true;
    code.add("cwd", {.rt = 8, .ra = 0}); // word 0 of ra, the rest of rb
    code.add("shufb", {.rt = 7, .ra = 6, .rb = 9, .rc = 8});
    code.add("shufb", {.rt = 7, .ra = 9, .rb = 7, .rc = 8});
    code.add("stqa", {.rt = 7, .immediate = 0x2000 / 4});
  }
  SECTION("shifted out") {
    fine = true;
    code.add("shlqbyi", {.rt = 7, .ra = 6, .immediate = 16});
    code.add("stqa", {.rt = 7, .immediate = 0x2000 / 4});
  }
  code.wait_for_tags(1 << 3);
  code.exit();
  const SimulatedRun ended = run(code);
  INFO(ended.report());
  CHECK(ended.ok() == fine);
  CHECK(ended.broke(Rule::get_target_read) == !fine);
}

TEST_CASE("a load is early only while the get is in flight, and if all of its quadword is") {
  Code code;
  SECTION("after the wait") {
    code.dma(0x40, 0x1000, 128, 3).wait_for_tags(1 << 3);
    code.add("lqa", {.rt = 6, .immediate = 0x1000 / 4});
  }
  SECTION("beside the target") {
    code.dma(0x40, 0x1000, 128, 3);
    code.add("lqa", {.rt = 6, .immediate = 0x1080 / 4});
  }
  SECTION("for the other part of the quadword") {
    code.dma(0x40, 0x1000, 4, 3);
    code.add("lqa", {.rt = 6, .immediate = 0x1000 / 4});
  }
  code.add("stqa", {.rt = 6, .immediate = 0x2000 / 4});
  code.wait_for_tags(1 << 3);
  code.exit();
  const SimulatedRun ended = run(code);
  INFO(ended.report());
  CHECK(ended.ok());
}

TEST_CASE("a store to what DMA has in flight is found at the store") {
  Code code;
  code.add("il", {.rt = 6, .immediate = 1});
  code.add("stqa", {.rt = 6, .immediate = 0x1000 / 4});
  SECTION("target of a get") {
    code.dma(0x40, 0x1000, 128, 3);
    code.add("stqa", {.rt = 6, .immediate = 0x1070 / 4});
    CHECK(run(code).broke(Rule::get_target_touched));
  }
  SECTION("source of a put") {
    code.dma(0x20, 0x1000, 16, 3);
    code.add("il", {.rt = 7, .immediate = 2});
    code.add("stqa", {.rt = 7, .immediate = 0x1000 / 4});
    CHECK(run(code).broke(Rule::put_source_changed));
  }
  SECTION("source of a put, with what it holds") {
    code.dma(0x20, 0x1000, 16, 3);
    code.add("stqa", {.rt = 6, .immediate = 0x1000 / 4});
    code.wait_for_tags(1 << 3).exit();
    const SimulatedRun ended = run(code);
    INFO(ended.report());
    CHECK(ended.ok());
  }
  SECTION("beside the part of a quadword that a put reads") {
    code.dma(0x20, 0x1000, 4, 3);
    code.add("lqa", {.rt = 7, .immediate = 0x1000 / 4});
    code.add("cwd", {.rt = 8, .ra = 0, .immediate = 4});
    code.add("il", {.rt = 9, .immediate = 5});
    code.add("shufb", {.rt = 7, .ra = 9, .rb = 7, .rc = 8});
    code.add("stqa", {.rt = 7, .immediate = 0x1000 / 4});
    code.wait_for_tags(1 << 3).exit();
    const SimulatedRun ended = run(code);
    INFO(ended.report());
    CHECK(ended.ok());
  }
}

TEST_CASE("an event interrupts a program between two instructions") {
  Code code;
  constexpr std::uint32_t start = 0x40, handler = 0x80, waiting = 0x100;
  // Interrupts go to address 0, where the program starts too: register 30 tells the two apart.
  code.add("bra", {.immediate = start / 4});
  code.fill_to(start);
  code.add("brnz", {.rt = 30, .immediate = (handler - start) / 4});
  code.add("il", {.rt = 30, .immediate = 1});
  code.write_channel(1, 0x20); // the decrementer's event
  code.write_channel(7, 100);
  code.add("bra", {.immediate = waiting / 4});
  code.fill_to(handler);
  code.add("rdch", {.rt = 21, .ra = 0});
  code.add("wrch", {.rt = 21, .ra = 2});
  code.add("ai", {.rt = 20, .ra = 20, .immediate = 1});
  code.add("iret");
  code.fill_to(waiting);
  code.add("ila", {.rt = 40, .immediate = waiting + 8});
  code.word(encode("bi", {.ra = 40}) | 0x40000); // bie: to the next word, with interrupts
  code.add("brz", {.rt = 20, .immediate = 0});
  code.exit(3);
  const SimulatedRun ended = run(code, limited(10000000));
  INFO(ended.report());
  CHECK(ended.errors[0] == "");
  CHECK(ended.exit_codes[0] == 3);
}

TEST_CASE("runs repeat: cycles, trace and memory") {
  Code code;
  code.dma(0x40, 0x1000, 128, 3).wait_for_tags(1 << 3);
  code.dma(0x20, 0x1000, 128, 4).wait_for_tags(1 << 4).exit();
  const auto traced = [&] {
    std::ostringstream trace;
    MachineConfig config = simulated(1);
    config.emulation.trace = &trace;
    const SimulatedRun ended = run(code, config);
    REQUIRE(ended.ok());
    return std::pair(ended.cycles, trace.str());
  };
  const auto first = traced();
  CHECK(first == traced());
  CHECK(first.first > 1000); // two round trips to memory
}

TEST_CASE("programs damaged at random come to an end") {
  Code code;
  code.add("il", {.rt = 6, .immediate = 20});
  // No DMA: what is damaged might reach any memory of the host.
  code.write_channel(22, 1).write_channel(23, 0).add("rdch", {.rt = 97, .ra = 24});
  code.add("stqd", {.rt = 6, .ra = 6, .immediate = 64});
  code.add("ai", {.rt = 6, .ra = 6, .immediate = -1});
  code.add("brnz", {.rt = 6, .immediate = -static_cast<std::int32_t>((code.here() - 4) / 4)});
  code.exit();
  const Bytes whole = code.elf();
  REQUIRE(simulate(limited(1000000), whole, to_ea(main_memory)).exit_codes[0] == 0);
  std::mt19937 random(11);
  unsigned refused = 0, failed = 0;
  for (int i = 0; i < 1000; ++i) {
    Bytes image = whole;
    for (unsigned n = random() % 3 + 1; n > 0; --n)
      image[random() % image.size()] = static_cast<std::uint8_t>(random());
    try {
      failed += simulate(limited(300000), image, to_ea(main_memory)).ok() ? 0u : 1u;
    } catch (const InputError&) {
      ++refused;
    }
  }
  CHECK(refused > 10);
  CHECK(failed > 100);
}

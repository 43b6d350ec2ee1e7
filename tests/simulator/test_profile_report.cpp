// Profiles of programs whose hot spots are known.
#include "celltrace/error.hpp"
#include "celltrace/simulator.hpp"
#include "files.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace celltrace;
using namespace celltrace::test;
using Catch::Matchers::Contains;

TEST_CASE("a profile needs the program that it is of") {
  const SpuProfile profile;
  CHECK_THROWS_AS(profile_text(profile, {}), InputError);
  CHECK_THROWS_AS(profile_json(profile, {}), InputError);
}

#ifdef CELLTRACE_SIMULATOR_PROGRAMS

namespace {

struct Profiled {
  std::vector<std::uint8_t> elf;
  SpuProfile profile;
  SimulatedRun run;

  explicit Profiled(const std::string& name, MachineConfig config = simulated(1)) {
    const std::string bytes = read_bytes(CELLTRACE_SIMULATOR_PROGRAMS "/" + name + ".elf");
    elf.assign(bytes.begin(), bytes.end());
    config.simulation.profile = &profile;
    run = simulate(config, elf);
  }
  std::uint64_t sum(std::uint64_t SpuProfile::Word::*count) const {
    std::uint64_t total = 0;
    for (const SpuProfile::Word& word : profile.words())
      total += word.*count;
    return total;
  }
};

MachineConfig case_of(std::vector<std::string> arguments, unsigned spes = 1) {
  MachineConfig config = simulated(spes);
  config.simulation.arguments = std::move(arguments);
  config.simulation.arguments.insert(config.simulation.arguments.begin(), "cases");
  return config;
}

} // namespace

TEST_CASE("what a profile counts is what the statistics count") {
  const auto check = [](const Profiled& profiled) {
    SpuCycles cycles;
    for (const SpeStatistics& spe : profiled.run.spes)
      cycles += spe.cycles;
    CHECK(profiled.sum(&SpuProfile::Word::cycles) == cycles.total_cycle);
    CHECK(profiled.sum(&SpuProfile::Word::hits) == cycles.instructions() + cycles.nop);
    CHECK(profiled.sum(&SpuProfile::Word::dependency) == cycles.stall_due_to_dependency);
    CHECK(profiled.sum(&SpuProfile::Word::branch_miss) == cycles.stall_due_to_branch_miss);
    CHECK(profiled.sum(&SpuProfile::Word::prefetch_miss) == cycles.stall_due_to_prefetch_miss);
    CHECK(profiled.sum(&SpuProfile::Word::hint_target) == cycles.stall_due_to_hint_target);
    CHECK(profiled.sum(&SpuProfile::Word::fp_resource) == cycles.stall_due_to_fp_resource);
    CHECK(profiled.sum(&SpuProfile::Word::channel) == cycles.channel_stall_cycle);
    CHECK(profiled.sum(&SpuProfile::Word::dual) >= cycles.dual_cycle); // which is without no-ops
  };
  check(Profiled("hot"));
  check(Profiled("hot", simulated(3)));
  check(Profiled("cases", case_of({"echo", "a", "b"})));
  check(Profiled("cases", case_of({"messages"}, 2)));
  MachineConfig endless = case_of({"spin"});
  endless.emulation.cycle_limit = 50000;
  check(Profiled("cases", endless));
  check(Profiled("cases", case_of({"mailbox"})));
}

TEST_CASE("a profile changes nothing") {
  const Profiled profiled("hot");
  CHECK(simulate(simulated(1), profiled.elf).cycles == profiled.run.cycles);
}

TEST_CASE("the report shows where the cycles went") {
  const Profiled profiled("hot");
  const std::string text = profile_text(profiled.profile, profiled.elf);
  INFO(text);
  CHECK_THAT(text, Contains(std::to_string(profiled.run.cycles) + " cycles, "));
  const std::size_t table = text.find("  hot\n"), fill = text.find("  fill\n");
  REQUIRE(table != std::string::npos);
  REQUIRE(fill != std::string::npos);
  CHECK(table < fill);
  CHECK(text.find("never_entered") == std::string::npos);
  // The listing of the hot function, and of no other.
  CHECK_THAT(text,
             Contains("\nhot: ") && Contains("\nhot.c:10\n") && Contains("fma") && Contains("dependency"));
  CHECK(text.find("\nfill: ") == std::string::npos);
  CHECK_THAT(profile_text(profiled.profile, profiled.elf, 1), Contains("\nfill: ") && Contains("\nmain: "));
}

TEST_CASE("the JSON of a profile adds up") {
  const Profiled profiled("cases", case_of({"echo", "a"}));
  const auto json = nlohmann::json::parse(profile_json(profiled.profile, profiled.elf));
  for (const char* count : {"hits", "cycles", "dual", "dependency", "branch_miss", "prefetch_miss",
                            "hint_target", "fp_resource", "channel"}) {
    std::uint64_t functions = 0, instructions = 0;
    for (const auto& function : json["functions"]) {
      functions += function[count].get<std::uint64_t>();
      for (const auto& instruction : function["instructions"])
        instructions += instruction[count].get<std::uint64_t>();
    }
    CAPTURE(count);
    CHECK(json[count] == functions);
    CHECK(json[count] == instructions);
  }
  std::uint64_t last = ~std::uint64_t{0};
  bool has_main = false;
  for (const auto& function : json["functions"]) {
    CHECK(function["cycles"] <= last);
    last = function["cycles"];
    has_main |= function["name"] == "main";
    for (const auto& instruction : function["instructions"])
      CHECK(instruction["hits"] > 0);
  }
  CHECK(has_main);
}

TEST_CASE("a program that tells no names is profiled by address") {
  // Its section headers are all that tools look for names in; without them the same bytes are loaded.
  Profiled profiled("hot");
  std::fill_n(profiled.elf.begin() + 32, 4, std::uint8_t{0}); // e_shoff
  std::fill_n(profiled.elf.begin() + 48, 4, std::uint8_t{0}); // e_shnum, e_shstrndx
  const std::string text = profile_text(profiled.profile, profiled.elf);
  INFO(text);
  CHECK_THAT(text, Contains("  LS 0x00"));
  CHECK(text.find("hot") == std::string::npos);
}

#endif

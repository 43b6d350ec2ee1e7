// Accesses to the target of a get in flight, which host code cannot be stopped at: the address sanitizer and
// Valgrind report them, at their line. early_access.cpp is built with the one and run under the other.
#include "celltrace/emulator.hpp"
#include "spe/emu_peek.hpp"

#include <catch2/catch.hpp>

#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <regex>
#include <string>
#include <sys/wait.h>

namespace celltrace::test {
namespace {

struct Output {
  std::string text; ///< stdout and stderr
  int status;
};

[[maybe_unused]] Output run(const std::string& command) {
  // The tests' own sanitizer must not be set up for that of the program.
  const std::string line = "unset ASAN_OPTIONS; " + command + " 2>&1";
  FILE* const pipe = popen(line.c_str(), "r");
  REQUIRE(pipe != nullptr);
  Output output;
  std::array<char, 4096> part;
  while (const std::size_t bytes = std::fread(part.data(), 1, part.size(), pipe))
    output.text.append(part.data(), bytes);
  const int status = pclose(pipe);
  output.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return output;
}

/// The first frame of a report in the program's own source, and the line that the program has said it would
/// be.
[[maybe_unused]] void check_report(const std::string& name, const Output& output, const std::string& title) {
  INFO(name << "\n" << output.text);
  CHECK(output.status != 0);
  std::smatch said, reported;
  REQUIRE(std::regex_search(output.text, said, std::regex("^line ([0-9]+)", std::regex::multiline)));
  const std::size_t report = output.text.find(title);
  REQUIRE(report != std::string::npos);
  const std::string rest = output.text.substr(report);
  REQUIRE(std::regex_search(rest, reported, std::regex("early_access\\.cpp:([0-9]+)")));
  CHECK(reported[1] == said[1]);
}

[[maybe_unused]] void check_clean(const Output& output) {
  INFO(output.text);
  CHECK(output.status == 0);
  CHECK(output.text.find("ERROR") == std::string::npos);
  CHECK(output.text.find("==") == std::string::npos); // what begins the lines of both tools
  std::size_t ok = 0;
  for (std::size_t at = 0; (at = output.text.find("\nok\n", at)) != std::string::npos; ++at)
    ++ok;
  CHECK(ok + (output.text.rfind("ok\n", 0) == 0) == 5);
}

[[maybe_unused]] constexpr const char* kEarly[] = {"read",
                                                   "write",
                                                   "read of data that came at once",
                                                   "read of data that came in between",
                                                   "of another tag",
                                                   "behind a fence",
                                                   "read on a thread of its own",
                                                   "behind its put",
                                                   "of a list",
                                                   "of 8 bytes",
                                                   "ahead of its put"};

[[maybe_unused]] std::string with_case(const std::string& program, const std::string& name) {
  return program + " '" + name + "'";
}

TEST_CASE("the address sanitizer reports each access to the target of a get in flight") {
#ifdef EARLY_ACCESS_ASAN
  for (const char* name : kEarly)
    check_report(name, run(with_case(EARLY_ACCESS_ASAN, name)), "use-after-poison");
  check_clean(run(with_case(EARLY_ACCESS_ASAN, "clean")));
  // Half a unit of its shadow cannot be forbidden.
  CHECK(run(with_case(EARLY_ACCESS_ASAN, "of 4 bytes")).status == 0);
#else
  WARN("skipped: there is no address sanitizer in this build, or it is the thread sanitizer's");
#endif
}

TEST_CASE("Valgrind reports each access to the target of a get in flight") {
#ifdef EARLY_ACCESS_VALGRIND
  const std::string program = EARLY_ACCESS_VALGRIND " -q --error-exitcode=9 " EARLY_ACCESS_PLAIN;
  for (const char* name : kEarly)
    check_report(name, run(with_case(program, name)),
                 std::string(name) == "write" ? "Invalid read" : "Invalid read of size 4");
  check_report("of 4 bytes", run(with_case(program, "of 4 bytes")), "Invalid read of size 4");
  check_clean(run(with_case(program, "clean")));
#else
  WARN("skipped: there is no Valgrind, or this build has a sanitizer, or processors that Valgrind does not "
       "run");
#endif
}

struct alignas(128) Floats {
  float from[32] = {1, 2, 3};
  float to[32] = {};
};

/// What a program does that computes before its wait. `peek` is not seen by the address sanitizer.
template <class Compute> EmulatedRun early_put(Compute compute, TransferTime when = TransferTime::at_wait) {
  static Floats data;
  MachineConfig config = lockstep(1);
  config.emulation.transfers = when;
  return emulate(config, [&](EmulatedSpu& spu) {
    auto* buffer = spu.allocate<std::uint32_t>(32);
    auto* results = spu.allocate<std::uint32_t>(32);
    spu.get(buffer, to_ea(data.from), 128, 1);
    for (int i = 0; i < 32; ++i)
      results[i] = compute(peek(buffer + i));
    spu.wait_all(1u << 1);
    spu.put(results, to_ea(data.to), 128, 2);
    spu.wait_all(1u << 2);
  });
}

TEST_CASE("opaque pixels of any colour may be put") {
  static Floats data;
  const EmulatedRun run = emulate(lockstep(1), [&](EmulatedSpu& spu) {
    auto* pixels = spu.allocate<std::uint32_t>(32);
    for (int i = 0; i < 32; ++i)
      pixels[i] = i % 2 == 0 ? 0xFFB5DEADu : 0xFFF5DEADu;
    spu.put(pixels, to_ea(data.to), 128, 1);
    spu.wait_all(1u << 1);
  });
  INFO(run.report());
  CHECK(run.ok());
}

TEST_CASE("a put of what was computed from floats of a get in flight is reported without any tool") {
  const auto as_floats = [](auto function) {
    return [function](std::uint32_t word) {
      return std::bit_cast<std::uint32_t>(function(std::bit_cast<float>(word)));
    };
  };
  const std::array runs = {
      early_put([](std::uint32_t word) { return word; }),
      early_put(as_floats([](float x) { return 2 * x + 1; })),
      early_put(as_floats([](float x) { return 3 - x; })),
      early_put(as_floats([](float x) { return x / 7; })),
      early_put(as_floats([](float x) { return std::sqrt(x); })),
  };
  for (const EmulatedRun& run : runs) {
    INFO(run.report());
    REQUIRE(run.count(Rule::get_target_read) == 1);
    CHECK(run.find(Rule::get_target_read)->site.line != 0);
  }
  // Integers have no value that stays.
  CHECK(early_put([](std::uint32_t word) { return word + 1; }).ok());
  // Nor is there anything to see where the data were there by luck.
  CHECK(early_put([](std::uint32_t word) { return word; }, TransferTime::at_issue).ok());
}

TEST_CASE("arithmetic on early data in their place is a store to the target") {
  static Floats data;
  const EmulatedRun run = emulate(lockstep(1), [&](EmulatedSpu& spu) {
    auto* buffer = spu.allocate<std::uint32_t>(32);
    spu.get(buffer, to_ea(data.from), 128, 1);
    poke(buffer, std::bit_cast<std::uint32_t>(std::bit_cast<float>(peek(buffer)) + 1));
    spu.wait_all(1u << 1);
  });
  CHECK(run.broke(Rule::get_target_touched));
}

TEST_CASE("a put of what a get ahead of it brings is no early read") {
  Floats data;
  for (const auto when : {TransferTime::at_issue, TransferTime::at_wait, TransferTime::random}) {
    MachineConfig config = lockstep(1);
    config.emulation.transfers = when;
    const EmulatedRun run = emulate(config, [&](EmulatedSpu& spu) {
      auto* buffer = spu.allocate<float>(32);
      spu.get(buffer, to_ea(data.from), 128, 1);
      spu.putf(buffer, to_ea(data.to), 128, 1);
      spu.getf(buffer, to_ea(data.from), 128, 1);
      spu.putf(buffer, to_ea(data.to), 128, 1);
      spu.wait_all(1u << 1);
    });
    INFO(run.report());
    CHECK(run.ok());
    CHECK(data.to[2] == 3);
  }
}

TEST_CASE("early data show as no number where a get follows the put of its buffer") {
  Floats data;
  const EmulatedRun run = emulate(lockstep(1), [&](EmulatedSpu& spu) {
    auto* buffer = spu.allocate<std::uint32_t>(32);
    spu.put(buffer, to_ea(data.to), 128, 1);
    spu.getf(buffer, to_ea(data.from), 128, 1);
    while (peek(buffer) == 0)
      (void)spu.channel_count<Channel::mfc_cmd>();
    CHECK(peek(buffer) == kPoisonWord);
    spu.wait_all(1u << 1);
    CHECK(buffer[0] == std::bit_cast<std::uint32_t>(1.0f));
  });
  CHECK(run.ok());
}

} // namespace
} // namespace celltrace::test

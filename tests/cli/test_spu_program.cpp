// celltrace spu, run as its users run it.
#include "cli/program_run.hpp"

#include <nlohmann/json.hpp>

using namespace celltrace::test;
using Catch::Matchers::Contains;
using Catch::Matchers::EndsWith;
using Catch::Matchers::StartsWith;

namespace {

Outcome spu(const TemporaryFolder& folder, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "spu");
  return celltrace_run(folder, arguments);
}

} // namespace

TEST_CASE("spu: errors before the run are one line and exit code 125") {
  const TemporaryFolder folder;
  write_bytes(folder / "text.elf", "no program\n");
  write_bytes(folder / "empty.elf", "");
  write_bytes(folder / "cut.elf", "\177ELF\1\2\1");
  const std::vector<std::vector<std::string>> wrong = {{},
                                                       {"missing.elf"},
                                                       {"."},
                                                       {"text.elf"},
                                                       {"empty.elf"},
                                                       {"cut.elf"},
                                                       {"text.elf", "--spes", "0"},
                                                       {"text.elf", "--limit", "-1"},
                                                       {"text.elf", "--nonsense"},
                                                       {"text.elf", "--profile-all"},
                                                       {"text.elf", "--stdin", "missing.txt"},
                                                       {"text.elf", "--trace", "no/t.json"},
                                                       {"text.elf", "--allow", "missing"},
                                                       {"text.elf", "--schedule", "free", "--seed", "1"}};
  for (const auto& arguments : wrong) {
    const Outcome outcome = spu(folder, arguments);
    CAPTURE(arguments, outcome.err);
    CHECK(outcome.exit_code == 125);
    CHECK(outcome.out.empty());
    CHECK(lines(outcome.err) == 1);
    CHECK_THAT(outcome.err, StartsWith("celltrace: error: "));
  }
  CHECK_THAT(spu(folder, {"text.elf"}).err, StartsWith("celltrace: error: text.elf: "));
  CHECK_THAT(spu(folder, {"empty.elf"}).err, StartsWith("celltrace: error: empty.elf: "));
}

#ifdef CELLTRACE_SIMULATOR_PROGRAMS

namespace {

const std::string kCases = CELLTRACE_SIMULATOR_PROGRAMS "/cases.elf";
const std::string kHot = CELLTRACE_SIMULATOR_PROGRAMS "/hot.elf";
const std::string kPpeArguments = CELLTRACE_SIMULATOR_PROGRAMS "/ppe_arguments.elf";

} // namespace

TEST_CASE("spu: output, errors and the exit code are the program's") {
  const TemporaryFolder folder;
  const Outcome messages = spu(folder, {kCases, "messages"});
  CHECK(messages.exit_code == 0);
  CHECK(messages.out == "to the output\n");
  CHECK(messages.err == "to the errors\n");
  for (const int code : {0, 1, 7, 255}) {
    const Outcome outcome = spu(folder, {kCases, "exit", std::to_string(code)});
    CHECK(outcome.exit_code == code);
    CHECK(outcome.err.empty());
  }
  CHECK(spu(folder, {kCases, "exit", "3", "--spes", "4"}).exit_code == 3);
  CHECK(spu(folder, {kCases, "messages", "--spes", "2"}).out == "to the output\nto the output\n");
}

TEST_CASE("spu: arguments go to the program, also those that look like options") {
  const TemporaryFolder folder;
  const Outcome outcome = spu(folder, {kCases, "echo", "b", "--", "--limit", "-x", "render"});
  CAPTURE(outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.out == "0: " + kCases + "\n1: echo\n2: b\n3: --limit\n4: -x\n5: render\n");
  CHECK_THAT(spu(folder, {kPpeArguments, "a", "b"}).out, EndsWith("\n1: a\n2: b\n"));
  CHECK(spu(folder, {kPpeArguments}).out == "no arguments\n");
}

TEST_CASE("spu: input is the caller's or a file") {
  const TemporaryFolder folder;
  CHECK(spu(folder, {kCases, "cat"}).out.empty());
  write_bytes(folder / "other.txt", "from a file\n");
  CHECK(spu(folder, {kCases, "cat", "--stdin", "other.txt"}).out == "from a file\n");
  write_bytes(folder / "stdin.txt", std::string(100000, 'i') + "\n");
  CHECK(spu(folder, {kCases, "cat"}).out == std::string(100000, 'i') + "\n");
}

TEST_CASE("spu: files only where they are allowed") {
  const TemporaryFolder folder;
  const Outcome refused = spu(folder, {kCases, "write", (folder / "a.txt").string()});
  CHECK(refused.exit_code == 3);
  CHECK_THAT(refused.err, Contains("Permission denied"));
  CHECK_FALSE(std::filesystem::exists(folder / "a.txt"));
  CHECK(spu(folder, {kCases, "write", "a.txt", "--allow", "."}).exit_code == 0);
  CHECK(read_bytes(folder / "a.txt") == "written\n");
}

TEST_CASE("spu: what ends a run is told from what a program returns") {
  const TemporaryFolder folder;
  for (const char* name : {"dma", "invalid", "recurse", "mailbox", "stop"}) {
    const Outcome outcome = spu(folder, {kCases, name});
    CAPTURE(name, outcome.err);
    CHECK(outcome.exit_code == 125);
    CHECK(lines(outcome.err) == 1);
    CHECK_THAT(outcome.err, StartsWith("celltrace: error: SPE 0: "));
  }
  const Outcome limit = spu(folder, {kCases, "spin", "--limit", "100000"});
  CAPTURE(limit.err);
  CHECK(limit.exit_code == 124);
  CHECK(lines(limit.err) == 1);
  CHECK_THAT(limit.err, Contains("after 100000 cycles") && Contains("in main+0x"));
  // Everybody breaks the rule, but who is interrupted for another's sake only says so.
  const Outcome two = spu(folder, {kCases, "dma", "--spes", "2"});
  CHECK(two.exit_code == 125);
  CHECK_THAT(two.err, Contains("transfer-size"));
}

TEST_CASE("spu: warnings are for those who want them") {
  const TemporaryFolder folder;
  const Outcome warned = spu(folder, {kCases, "warn"});
  CHECK(warned.exit_code == 0);
  CHECK(lines(warned.err) == 1);
  CHECK_THAT(warned.err, StartsWith("celltrace: warning: SPE 0: ") && Contains("tag-status-unread"));
  CHECK(spu(folder, {kCases, "warn", "--quiet"}).err.empty());
}

TEST_CASE("spu: an interrupt ends a program that spins") {
  const TemporaryFolder folder;
  Run run(folder, {"spu", kCases, "spin", "--stats", "s.json"});
  run.interrupt();
  const Outcome outcome = run.finish();
  CAPTURE(outcome.err);
  CHECK(outcome.exit_code == 130);
  CHECK_THAT(outcome.err, StartsWith("celltrace: error: SPE 0: interrupted at "));
  CHECK(nlohmann::json::parse(read_bytes(folder / "s.json"))["spes"].size() == 1);
}

TEST_CASE("spu: every key of the statistics is documented, and they add up") {
  const TemporaryFolder folder;
  const std::string document = read_bytes(CELLTRACE_SOURCE_DIR "/docs/statistics.md");
  const Outcome outcome = spu(folder, {kCases, "warn", "--spes", "2", "--stats", "s.json", "--seed", "5"});
  CAPTURE(outcome.err);
  const auto statistics = nlohmann::json::parse(read_bytes(folder / "s.json"));
  const auto flat = statistics.flatten();
  for (const auto& [pointer, value] : flat.items()) {
    const std::string key = nlohmann::json::json_pointer(pointer).back();
    if (key.find_first_not_of("0123456789") == std::string::npos) continue; // an element of an array
    CAPTURE(pointer);
    CHECK_THAT(document, Contains("`" + key + "`"));
  }
  CHECK(statistics["backend"] == "cell_sim");
  CHECK(statistics["schedule"] == "lockstep");
  CHECK(statistics["seed"] == 5);
  CHECK(statistics["diagnostics"].size() == 2);
  for (const auto& [name, count] : statistics["cycles"].items())
    CHECK(count == statistics["spes"][0]["cycles"][name].get<std::uint64_t>() +
                       statistics["spes"][1]["cycles"][name].get<std::uint64_t>());
  // What the program does not return can be seen there, too.
  CHECK(spu(folder, {kCases, "exit", "125", "--stats", "s.json"}).exit_code == 125);
  const auto exited = nlohmann::json::parse(read_bytes(folder / "s.json"))["spes"][0];
  CHECK(exited["exit_code"] == 125);
  CHECK(exited["error"] == "");
  CHECK(spu(folder, {kCases, "dma", "--stats", "-"}).exit_code == 125);
  CHECK_THAT(nlohmann::json::parse(spu(folder, {kCases, "dma", "--stats", "-"}).out)["spes"][0]["error"]
                 .get<std::string>(),
             Contains("transfer-size"));
}

TEST_CASE("spu: two runs in lockstep leave the same reports") {
  const TemporaryFolder folder;
  const auto reports = [&](const std::string& name, const std::vector<std::string>& options) {
    std::vector<std::string> arguments = {kHot,      "--spes",        "3",         "--summary",
                                          "--stats", name + "s.json", "--profile", name + "p.txt",
                                          "--trace", name + "t.json"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome outcome = spu(folder, arguments);
    CHECK(outcome.exit_code == 0);
    auto statistics = nlohmann::json::parse(read_bytes(folder / (name + "s.json")));
    statistics.erase("seconds");
    CHECK_FALSE(nlohmann::json::parse(read_bytes(folder / (name + "t.json")))["traceEvents"].empty());
    return outcome.err + statistics.dump() + read_bytes(folder / (name + "p.txt")) +
           read_bytes(folder / (name + "t.json"));
  };
  CHECK(reports("a", {}) == reports("b", {}));
  const std::vector<std::string> drawn = {"--seed", "1", "--faults", "--transfers", "random"};
  CHECK(reports("a", drawn) == reports("b", drawn));
}

TEST_CASE("spu: summary and profiles") {
  const TemporaryFolder folder;
  const Outcome summary = spu(folder, {kHot, "--summary"});
  CHECK(summary.out.empty());
  CHECK_THAT(summary.err, StartsWith("1 SPE, ") && Contains("dual cycle"));
  const Outcome profile = spu(folder, {kHot, "--profile", "-"});
  CHECK_THAT(profile.out, Contains("\nhot: "));
  CHECK(profile.out.find("\nfill: ") == std::string::npos);
  CHECK_THAT(spu(folder, {kHot, "--profile", "-", "--profile-all"}).out, Contains("\nfill: "));
  CHECK(spu(folder, {kHot, "--profile", "p.json"}).exit_code == 0);
  CHECK(nlohmann::json::parse(read_bytes(folder / "p.json"))["functions"][0]["name"] == "hot");
}

#endif

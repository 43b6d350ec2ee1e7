// Binaries of the SPU's compiler, run by one call.
#include "celltrace/simulator.hpp"

#include "backends/cell_emu/machine.hpp"
#include "celltrace/error.hpp"
#include "files.hpp"

#include <thread>

#include <catch2/catch.hpp>

using namespace celltrace;
using namespace celltrace::test;
using Catch::Matchers::Contains;
using Catch::Matchers::EndsWith;
using Catch::Matchers::StartsWith;

TEST_CASE("what is no program for the SPU is refused") {
  const std::vector<std::uint8_t> text = {'#', '!', '/', 'b', 'i', 'n'};
  CHECK_THROWS_AS(simulate(simulated(1), text), InputError);
  CHECK_THROWS_AS(simulate(simulated(1), {}), InputError);
  CHECK_THROWS_WITH(simulate(lockstep(1), text), "machine code runs on cell_sim, not on cell_emu");
  CHECK_THROWS_AS(check_spu_program(text), InputError);
}

TEST_CASE("a program without machine code says in one line what the build lacks") {
  const std::unique_ptr<Machine> machine = cell_emu::make_machine(simulated(1));
  SpeProgram program("portable");
  program.add<EmulatedSpu>([](EmulatedSpu&, ea_t) {});
  CHECK_THROWS_AS(machine->start(0, program, 0), SpeError);
  CHECK_THROWS_WITH(
      machine->start(0, program, 0),
      "program \"portable\" has no machine code for cell_sim: was it built without spu-elf-g++?");
}

#ifdef CELLTRACE_SIMULATOR_PROGRAMS

namespace {

std::vector<std::uint8_t> program(const std::string& name) {
  const std::string bytes = read_bytes(CELLTRACE_SIMULATOR_PROGRAMS "/" + name + ".elf");
  REQUIRE_FALSE(bytes.empty());
  return {bytes.begin(), bytes.end()};
}

MachineConfig with_arguments(std::vector<std::string> arguments, unsigned spes = 1) {
  MachineConfig config = simulated(spes);
  config.simulation.arguments = std::move(arguments);
  config.simulation.arguments.insert(config.simulation.arguments.begin(), "cases");
  return config;
}

SimulatedRun run_case(std::vector<std::string> arguments) {
  return simulate(with_arguments(std::move(arguments)), program("cases"));
}

} // namespace

TEST_CASE("a main(argc, argv) finds its arguments in local store") {
  const SimulatedRun run = run_case({"echo", "a word", "", "-x"});
  INFO(run.report());
  CHECK(run.ok());
  CHECK(run.output == "0: cases\n1: echo\n2: a word\n3: \n4: -x\n");
  CHECK(run.error_output.empty());
  CHECK(run.exit_codes == std::vector<std::uint32_t>{0});
  // As many as one DMA command brings.
  const SimulatedRun long_one = run_case({"echo", std::string(16000, 'y')});
  CHECK(long_one.ok());
  CHECK(long_one.output.size() > 16000);
  CHECK_THROWS_WITH(run_case({"echo", std::string(17000, 'z')}), Contains("more than 16384"));
}

TEST_CASE("a main(speid, argp, envp) finds the argv of a PPE in main memory") {
  const SimulatedRun run = simulate(with_arguments({"one", "exactly 15 long", ""}), program("ppe_arguments"));
  INFO(run.report());
  CHECK(run.ok());
  CHECK(run.exit_codes[0] == 0);
  CHECK(run.output == "0: cases\n1: one\n2: exactly 15 long\n3: \n");
  // argv[0] alone is none of its business.
  CHECK(simulate(with_arguments({}), program("ppe_arguments")).output == "no arguments\n");
  CHECK(simulate(simulated(1), program("ppe_arguments")).output == "no arguments\n");
}

TEST_CASE("without arguments argp is what the caller gives") {
  // An argv as the program expects it, whose only string is empty.
  alignas(128) std::uint8_t argv[128] = {};
  const ea_t string = to_ea(argv + 64);
  for (unsigned byte = 0; byte < 8; ++byte)
    argv[byte] = static_cast<std::uint8_t>(string >> 8 * (7 - byte));
  CHECK(simulate(simulated(1), program("ppe_arguments"), to_ea(argv)).output == "0: \n");
}

TEST_CASE("exit codes are those of the program, by SPE") {
  CHECK(run_case({"exit", "7"}).exit_codes[0] == 7);
  CHECK(run_case({"exit", "300"}).exit_codes[0] == (300 & 0xFF));
  CHECK(run_case({"abort"}).exit_codes[0] != 0);
  const SimulatedRun three = simulate(with_arguments({"exit", "5"}, 3), program("cases"));
  CHECK(three.ok());
  CHECK(three.exit_codes == std::vector<std::uint32_t>{5, 5, 5});
  CHECK(three.spes.size() == 3);
}

TEST_CASE("output and errors are apart, and go to who wants them") {
  const SimulatedRun kept = run_case({"messages"});
  CHECK(kept.output == "to the output\n");
  CHECK(kept.error_output == "to the errors\n");
  std::string taken;
  MachineConfig config = with_arguments({"messages"});
  config.simulation.output = [&](std::string_view piece) { taken += piece; };
  const SimulatedRun run = simulate(config, program("cases"));
  CHECK(taken == "to the output\n");
  CHECK(run.output.empty());
  CHECK(run.error_output == "to the errors\n");
}

TEST_CASE("input comes from a text, and then in pieces") {
  MachineConfig config = with_arguments({"cat"});
  CHECK(simulate(config, program("cases")).output.empty());
  config.simulation.input = "first\n";
  CHECK(simulate(config, program("cases")).output == "first\n");
  int asked = 0;
  config.simulation.more_input = [&asked] {
    return ++asked == 1 ? std::string("second") : asked == 2 ? " third\n" : "";
  };
  CHECK(simulate(config, program("cases")).output == "first\nsecond third\n");
  CHECK(asked == 3);
  // Who reads nothing asks for nothing.
  asked = 0;
  config.simulation.arguments = {"cases", "messages"};
  simulate(config, program("cases"));
  CHECK(asked == 0);
}

TEST_CASE("files are those of the folders that are allowed") {
  const TemporaryFolder folder;
  const SimulatedRun refused = run_case({"write", (folder / "a.txt").string()});
  CHECK(refused.exit_codes[0] == 3);
  CHECK_THAT(refused.error_output, Contains("Permission denied"));
  CHECK_FALSE(std::filesystem::exists(folder / "a.txt"));

  MachineConfig config = with_arguments({"write", (folder / "a.txt").string()});
  config.simulation.allowed_folders = {folder.path()};
  CHECK(simulate(config, program("cases")).exit_codes[0] == 0);
  CHECK(read_bytes(folder / "a.txt") == "written\n");
  config.simulation.arguments.back() = (folder.path().parent_path() / "outside.txt").string();
  CHECK(simulate(config, program("cases")).exit_codes[0] == 3);
  config.simulation.allowed_folders = {folder / "a.txt"};
  CHECK_THROWS_AS(simulate(config, program("cases")), InputError);
}

TEST_CASE("the C library's calls for help do what a program expects of them") {
  const TemporaryFolder folder;
  MachineConfig config = simulated(1);
  config.simulation.allowed_folders = {folder.path()};
  for (const auto& [name, last_words] :
       {std::pair{"library", "all checks passed\n"}, std::pair{"main_memory", "all is well\n"}}) {
    const SimulatedRun run = simulate(config, program(name));
    CAPTURE(name);
    INFO(run.report());
    CHECK(run.ok());
    CHECK(run.exit_codes[0] == 0);
    CHECK(run.output == last_words);
    CHECK(std::filesystem::is_empty(folder.path()));
  }
}

TEST_CASE("what breaks a rule ends, with the place") {
  const auto error = [](const char* name, Rule rule) {
    const SimulatedRun run = run_case({name});
    INFO(run.report());
    CHECK(run.broke(rule));
    CHECK(run.exit_codes[0] == 0);
    return run.errors[0];
  };
  CHECK_THAT(error("dma", Rule::transfer_size), Contains("[transfer-size") && Contains("in main+0x"));
  CHECK_THAT(error("invalid", Rule::invalid_instruction), Contains("0x00800000") && Contains("cases.c:"));
  CHECK_THAT(error("recurse", Rule::stack_overflow), Contains("in recurse+0x"));
  CHECK_THAT(error("mailbox", Rule::deadlock), Contains("SPU_RdInMbox"));
  const SimulatedRun stopped = run_case({"stop"});
  CHECK_THAT(stopped.errors[0], EndsWith("stopped with code 4660 and was not resumed"));
  const SimulatedRun warned = run_case({"warn"});
  CHECK(warned.errors[0].empty());
  CHECK(warned.broke(Rule::tag_status_unread));
}

TEST_CASE("the PPE may take part") {
  const SimulatedRun mail = simulate(with_arguments({"mailbox"}), program("cases"), 0,
                                     [](Machine& machine) { machine.write_in_mailbox(0, 42); });
  CHECK(mail.ok());
  CHECK(mail.exit_codes[0] == 42);
  const SimulatedRun resumed = simulate(with_arguments({"stop"}), program("cases"), 0, [](Machine& machine) {
    CHECK(machine.wait(0).code == 0x1234);
    machine.resume(0);
  });
  CHECK(resumed.ok());
}

TEST_CASE("a program that spins ends at a limit, the same one every time") {
  MachineConfig config = with_arguments({"spin"});
  config.emulation.cycle_limit = 100000;
  const SimulatedRun run = simulate(config, program("cases"));
  CHECK(run.broke(Rule::time_limit));
  CHECK_THAT(run.errors[0], Contains("after 100000 cycles") && Contains("in main+0x"));
  CHECK(run.cycles >= 100000);
  CHECK(run.cycles < 150000); // looked at every 2048 instructions
  CHECK(simulate(config, program("cases")).cycles == run.cycles);
}

TEST_CASE("a request to stop ends a program that spins") {
  for (const Schedule schedule : {Schedule::lockstep, Schedule::free}) {
    MachineConfig config = with_arguments({"spin"}, 2);
    config.emulation.schedule = schedule;
    std::stop_source source;
    std::jthread user([&source] {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      source.request_stop();
    });
    const SimulatedRun run = simulate(config, program("cases"), 0, {}, source.get_token());
    CHECK_THAT(run.errors[0], StartsWith("SPE 0: interrupted at "));
    CHECK_THAT(run.errors[1], StartsWith("SPE 1: interrupted at "));
  }
}

TEST_CASE("counters in words add up") {
  const SimulatedRun run = simulate(simulated(2), program("hot"));
  const std::string text = counters_text(run, TimingParameters::cell());
  const std::uint64_t total = run.spes[0].cycles.total_cycle + run.spes[1].cycles.total_cycle;
  CHECK_THAT(text, StartsWith("2 SPEs, ") && Contains("at 3.200 GHz"));
  CHECK_THAT(text, Contains(std::to_string(total) + "  100.0 %"));
}

#endif

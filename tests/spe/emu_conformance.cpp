// Runs the rows of the conformance suite, and looks that none of the rules is left out.
#include "spe/emu_conformance.hpp"

#include <algorithm>
#include <cstdint>
#include <span>

namespace celltrace {

#ifdef CELLTRACE_HAS_MACHINE_CODE
std::span<const std::uint8_t> hardware_rows_elf();
#endif

namespace test {
namespace {

std::vector<const Rows*>& registry() {
  static std::vector<const Rows*> all;
  return all;
}

/// Machine code may have the operation in functions that were inlined.
void check_site(const CallSite& found, const CallSite& culprit) {
  CAPTURE(found.file, found.line, found.function);
  const auto place = [](const CallSite& site) {
    return std::string(site.file) + ":" + std::to_string(site.line) + " in ";
  };
  if (*found.function != 0) {
    REQUIRE_THAT(place(found) + found.function, Catch::Contains(place(culprit)));
    return;
  }
  REQUIRE_THAT(found.file, Catch::EndsWith(culprit.file));
  REQUIRE(found.line == culprit.line);
}

void check_diagnostic(const Row& row, const Stage& stage, const EmulatedRun& run) {
  const Diagnostic* const found = run.find(row.rule);
  REQUIRE(found != nullptr);
  REQUIRE(found->spe == row.culprit_spe);
  check_site(found->site, stage.culprit());
  const auto says = [&](const std::string& what) {
    CAPTURE(what);
    REQUIRE_THAT(found->text, Catch::Contains(what));
  };
  says(row.culprit_spe == Diagnostic::kPpe ? "PPE: " : "SPE " + std::to_string(row.culprit_spe) + ": ");
  says(std::string("[").append(name_of(row.rule)));
  const bool is_host_code = *found->site.function == 0;
  if (is_host_code && found->site.line != 0) says(std::to_string(found->site.line) + "]");
  if (found->command != 0 && row.rule != Rule::known_command) {
    says(", command " + std::to_string(found->command));
    says("tag " + std::to_string(found->tag));
    says("LS ");
    says("EA 0x");
  }
  for (const std::string& what : row.says)
    says(what);
  for (const Diagnostic& each : run.diagnostics) {
    CAPTURE(each.text);
    const bool consequence =
        std::find(row.consequences.begin(), row.consequences.end(), each.rule) != row.consequences.end();
    REQUIRE((each.rule == row.rule || consequence));
    // What a program does once it does everywhere.
    if (row.rule == Rule::drained_queue) REQUIRE(&each == found);
  }
  if (found->spe >= run.errors.size() || !row.consequences.empty()) return;
  const std::string& error = run.errors[found->spe];
  if (found->action == Action::stop)
    REQUIRE(!error.empty());
  else
    REQUIRE(error.empty());
}

EmulatedRun run_host_code(const Row& row, const MachineConfig& config, Stage& stage, const EmulatedPpe& ppe) {
  return emulate(
      config, [&](Spu& spu) { row.program(spu, stage); }, 0, ppe);
}

const SpeProgram& hardware_program() {
  static const SpeProgram program = [] {
    SpeProgram made("hardware_rows");
    made.add<Spu>([](Spu& spu, ea_t argument) { hardware_rows(spu, argument); });
#ifdef CELLTRACE_HAS_MACHINE_CODE
    made.add_image("cell_sim", hardware_rows_elf());
#endif
    return made;
  }();
  return program;
}

bool has_machine_code() {
  return !hardware_program().image("cell_sim").empty();
}

std::vector<Backend> backends_of(const Row& row) {
  if (row.kernel != HardwareRow::none && has_machine_code()) return {Backend::cell_emu, Backend::cell_sim};
  return {Backend::cell_emu};
}

/// What the kernel wrote back.
void collect_results(const Row& row, std::endian order, const std::uint32_t* results, const EmulatedRun& run,
                     Stage& stage) {
  for (unsigned spe = 0; spe < row.spe_count; ++spe) {
    const auto word = [&](std::uint32_t index) {
      return load_word(order, results + spe * block::kWords + index);
    };
    const std::string who = "SPE " + std::to_string(spe);
    if (word(block::kFailedLine) != 0)
      stage.fail(who + ", hardware_rows.hpp:" + std::to_string(word(block::kFailedLine)) + ": " +
                 std::to_string(word(block::kFound)) + ", not " + std::to_string(word(block::kExpected)));
    if (run.errors[spe].empty() && word(block::kFinished) != 1) stage.fail(who + " did not get to its end");
    if (spe == row.culprit_spe) {
      const std::uint32_t line = word(block::kCulpritLine);
      stage.set_culprit({line == 0 ? "" : "hardware_rows.hpp", line});
    }
  }
}

EmulatedRun run_kernel(const Row& row, const MachineConfig& config, Stage& stage, const EmulatedPpe& ppe) {
  const std::unique_ptr<Machine> machine = make_machine(config);
  const std::endian order = machine->byte_order();
  for (std::uint32_t i = 0; i < std::size(stage.from); ++i)
    store_word(order, stage.from + i, i + 1);
  constexpr unsigned kMostSpes = 4;
  alignas(128) std::uint32_t words[(1 + kMostSpes) * block::kWords] = {};
  const auto address = [&](std::uint32_t word, ea_t ea) {
    store_word(order, words + word, static_cast<std::uint32_t>(ea >> 32));
    store_word(order, words + word + 1, static_cast<std::uint32_t>(ea));
  };
  const Given given = row.given_part ? row.given_part(stage) : Given();
  store_word(order, words + block::kRow, static_cast<std::uint32_t>(row.kernel));
  address(block::kFrom, to_ea(stage.from));
  address(block::kTo, to_ea(stage.to));
  address(block::kGiven, given.address);
  store_word(order, words + block::kValue, given.value);
  EmulatedRun run = emulate_on(*machine, hardware_program(), to_ea(words), ppe);
  collect_results(row, order, words + block::kWords, run, stage);
  if (row.after_part) row.after_part(stage, order);
  return run;
}

void check(const Row& row, MachineConfig config) {
  config.spes = row.spe_count;
  if (row.configuration) row.configuration(config);
  Stage stage;
  EmulatedPpe ppe;
  if (row.ppe_part) ppe = [&](Machine& machine) { row.ppe_part(machine, stage); };
  const EmulatedRun run = row.kernel == HardwareRow::none ? run_host_code(row, config, stage, ppe)
                                                          : run_kernel(row, config, stage, ppe);
  INFO(run.report());
  REQUIRE(stage.failures() == "");
  const bool is_seen = !row.machine_code_breaks_it || config.backend == Backend::cell_sim;
  if (row.is_broken && is_seen)
    check_diagnostic(row, stage, run);
  else
    REQUIRE(run.ok());
}

void check_on_all_schedules(const Row& row) {
  std::vector<MachineConfig> configs = {lockstep(1), exploring_with_faults(1, 1),
                                        exploring_with_faults(1, 2)};
  if (!row.in_lockstep_only) configs.push_back(free_running(1));
  for (std::uint64_t seed = 0; seed < row.more_seeds; ++seed)
    configs.push_back(exploring(1, seed));
  for (MachineConfig& config : configs) {
    for (const TransferTime when : {TransferTime::at_issue, TransferTime::at_wait, TransferTime::random}) {
      if (when == TransferTime::at_issue && !row.at_issue_too) continue;
      config.emulation.transfers = when;
      for (const Backend backend : backends_of(row)) {
        config.backend = backend;
        CAPTURE(name_of(backend), config.emulation.schedule, config.emulation.explore, config.emulation.seed,
                when);
        check(row, config);
      }
    }
  }
}

/// Host code cannot break them; tests/simulator/test_machine_code.cpp does.
bool is_of_machine_code(Rule rule) {
  return rule == Rule::get_target_read || rule == Rule::stack_overflow || rule == Rule::invalid_instruction ||
         rule == Rule::unwritten_code;
}

} // namespace

Rows::Rows(std::initializer_list<Row> rows) : rows_(rows) {
  registry().push_back(this);
}

const std::vector<const Rows*>& all_rows() {
  return registry();
}

void run_rows(const Rows& rows) {
  for (const Row& row : rows.all())
    DYNAMIC_SECTION((row.is_broken ? "broken: " : "kept: ") << row.fact) {
      check_on_all_schedules(row);
    }
}

TEST_CASE("conformance: kernels run as machine code") {
  if (!has_machine_code()) WARN("skipped on cell_sim: machine code of the rows needs CELLTRACE_SPU_GXX");
}

TEST_CASE("conformance: every rule is kept by a row and broken by another") {
  for (unsigned number = 1; number < kRules; ++number) {
    const Rule rule = static_cast<Rule>(number);
    CAPTURE(name_of(rule));
    if (is_of_machine_code(rule)) continue;
    bool is_kept = false, is_broken = false;
    for (const Rows* rows : all_rows())
      for (const Row& row : rows->all())
        if (row.rule == rule) (row.is_broken ? is_broken : is_kept) = true;
    REQUIRE(is_kept);
    REQUIRE(is_broken);
  }
}

TEST_CASE("conformance: every rule has a name and a text of its own") {
  for (unsigned number = 0; number < kRules; ++number) {
    const Rule rule = static_cast<Rule>(number);
    REQUIRE(!name_of(rule).empty());
    REQUIRE(!text_of(rule).empty());
    for (unsigned other = 0; other < number; ++other) {
      REQUIRE(name_of(rule) != name_of(static_cast<Rule>(other)));
      REQUIRE(text_of(rule) != text_of(static_cast<Rule>(other)));
    }
  }
}

} // namespace test
} // namespace celltrace

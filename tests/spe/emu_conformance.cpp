// Runs the rows of the conformance suite, and looks that none of the rules is left out.
#include "spe/emu_conformance.hpp"

#include <algorithm>

namespace celltrace::test {
namespace {

std::vector<const Rows*>& registry() {
  static std::vector<const Rows*> all;
  return all;
}

void check_diagnostic(const Row& row, const Stage& stage, const EmulatedRun& run) {
  const Diagnostic* const found = run.find(row.rule);
  REQUIRE(found != nullptr);
  REQUIRE(found->spe == row.culprit_spe);
  REQUIRE(std::string(found->site.file) == stage.culprit().file);
  REQUIRE(found->site.line == stage.culprit().line);
  const auto says = [&](const std::string& what) {
    CAPTURE(what);
    REQUIRE_THAT(found->text, Catch::Contains(what));
  };
  says(row.culprit_spe == Diagnostic::kPpe ? "PPE: " : "SPE " + std::to_string(row.culprit_spe) + ": ");
  says(std::string("[").append(name_of(row.rule)));
  if (found->site.line != 0) says(std::to_string(found->site.line) + "]");
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
  }
  if (found->spe >= run.errors.size() || !row.consequences.empty()) return;
  const std::string& error = run.errors[found->spe];
  if (found->action == Action::stop)
    REQUIRE(!error.empty());
  else
    REQUIRE(error.empty());
}

void check(const Row& row, MachineConfig config) {
  config.spes = row.spe_count;
  if (row.configuration) row.configuration(config);
  Stage stage;
  EmulatedPpe ppe;
  if (row.ppe_part) ppe = [&](Machine& machine) { row.ppe_part(machine, stage); };
  EmulatedRun run = emulate(
      config, [&](Spu& spu) { row.program(spu, stage); }, 0, ppe);
  INFO(run.report());
  REQUIRE(stage.failures() == "");
  if (row.is_broken)
    check_diagnostic(row, stage, run);
  else
    REQUIRE(run.ok());
}

void check_on_all_schedules(const Row& row) {
  std::vector<MachineConfig> configs = {lockstep(1), exploring_with_faults(1, 1),
                                        exploring_with_faults(1, 2)};
  if (!row.in_lockstep_only) configs.push_back(free_running(1));
  for (MachineConfig& config : configs) {
    for (const TransferTime when : {TransferTime::at_issue, TransferTime::at_wait, TransferTime::random}) {
      if (when == TransferTime::at_issue && !row.at_issue_too) continue;
      config.emulation.transfers = when;
      CAPTURE(config.emulation.schedule, config.emulation.explore, config.emulation.seed, when);
      check(row, config);
    }
  }
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

TEST_CASE("conformance: every rule is kept by a row and broken by another") {
  for (unsigned number = 1; number < kRules; ++number) {
    const Rule rule = static_cast<Rule>(number);
    CAPTURE(name_of(rule));
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

} // namespace celltrace::test

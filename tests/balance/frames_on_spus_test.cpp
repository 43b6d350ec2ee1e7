// The exchange of work between SPEs, under the PPE's side of the renderer: the program in place of the tracer
// is one whose work is arithmetic.
#include "frame_records.hpp"
#include "frame_work.hpp"
#include "spe/machine_kinds.hpp"

#include "celltrace/balance.hpp"
#include "render/spe_team.hpp"
#include "render/tracer_program.hpp"

#include <catch2/catch.hpp>

#include <memory>
#include <numeric>
#include <random>
#include <vector>

namespace celltrace {

SpeProgram frame_work_program();

/// What SpeTeam starts.
SpeProgram tracer_program() {
  return frame_work_program();
}

} // namespace celltrace

using namespace celltrace;
using namespace celltrace::test;

namespace {

/// SPEs that share frames of the same units.
class Team {
public:
  Team(const MachineKind& kind, unsigned spes, std::vector<std::uint32_t> steps)
      : steps_(std::move(steps)), machine_(machine_of(kind, spes)),
        records_(spes, steps_, machine_->byte_order()), team_(*machine_, records_.block) {}

  /// False if `progress` broke it off.
  bool frame(const std::vector<UnitRange>& strips, std::uint32_t lambda, const Progress& progress = {}) {
    records_.begin(strips, lambda);
    tally_ = StripTally(machine_->spe_count(), static_cast<std::uint32_t>(steps_.size()));
    const bool complete = team_.render_frame(tally_, progress);
    records_.end();
    return complete;
  }
  const StripTally& tally() const { return tally_; }
  const WorkReport& report(unsigned spe) const { return records_.reports[spe]; }

  /// Units whose mark is not what work on them leaves.
  std::uint32_t units_not_done() const {
    std::uint32_t wrong = 0;
    for (std::uint32_t unit = 0; unit < steps_.size(); ++unit)
      wrong += records_.marks[unit] != worked(unit, steps_[unit]);
    return wrong;
  }
  WorkReport sum() const {
    WorkReport sum{};
    for (const WorkReport& each : records_.reports.all()) {
      sum.units += each.units;
      sum.exchanges += each.exchanges;
      sum.units_received += each.units_received;
      sum.steps += each.steps;
    }
    return sum;
  }
  /// Every unit is done, and none twice: no more of them than there are.
  void check_all_done() const {
    CHECK(units_not_done() == 0);
    CHECK(sum().units == steps_.size());
    CHECK(sum().steps == std::accumulate(steps_.begin(), steps_.end(), 0u));
    const std::vector<UnitRange> managed = tally_.next_strips();
    for (unsigned spe = 0; spe < managed.size(); ++spe) {
      CAPTURE(spe);
      CHECK(managed[spe].count == report(spe).units);
    }
  }
  /// The SPEs leave; no rule was broken.
  void dismiss() {
    team_.dismiss();
    for (const Diagnostic& diagnostic : machine_->diagnostics())
      FAIL_CHECK(diagnostic.text);
  }

private:
  /// As the renderer has it.
  static std::unique_ptr<Machine> machine_of(MachineKind kind, unsigned spes) {
    kind.config.signal_mode[0] = kind.config.signal_mode[1] = SignalMode::logical_or;
    return kind.machine(spes);
  }

  std::vector<std::uint32_t> steps_;
  std::unique_ptr<Machine> machine_;
  FrameRecords records_;
  SpeTeam team_;
  StripTally tally_{0, 0};
};

std::vector<MachineKind> kinds() {
  return kinds_for(frame_work_program());
}

/// Some units cost a hundred times as much as others.
std::vector<std::uint32_t> uneven_steps(std::uint32_t units, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<std::uint32_t> steps(units);
  for (std::uint32_t& each : steps)
    each = static_cast<std::uint32_t>(random() % 10 == 0 ? random() % 3000 : random() % 30);
  return steps;
}

/// All units for one of the SPEs.
std::vector<UnitRange> strips_for(unsigned spe, unsigned spes, std::uint32_t units) {
  std::vector<std::uint32_t> counts(spes);
  counts[spe] = units;
  return consecutive_strips(counts);
}

const std::uint32_t kHalf = fixed_point_parameter(0.5);

} // namespace

TEST_CASE("every unit is done once, whichever SPE begins with it") {
  const auto kind = GENERATE(from_range(kinds()));
  const auto spes = GENERATE(1u, 2u, 8u);
  const auto lambda = GENERATE(fixed_point_parameter(0.5), fixed_point_parameter(0.72));
  CAPTURE(kind, spes, lambda);
  constexpr std::uint32_t kUnits = 150;
  Team team(kind, spes, uneven_steps(kUnits, spes));
  for (const auto& strips : {strips_for(0, spes, kUnits), strips_for(spes - 1, spes, kUnits),
                             strips_for(spes / 2, spes, kUnits), even_strips(kUnits, spes)}) {
    REQUIRE(team.frame(strips, lambda));
    team.check_all_done();
  }
  REQUIRE(team.frame(team.tally().next_strips(), lambda));
  team.check_all_done();
  team.dismiss();
}

TEST_CASE("work moves to SPEs that have none") {
  const auto kind = GENERATE(from_range(kinds()));
  // Elsewhere one SPE may be done before another begins.
  const EmulationConfig& emulation = kind.config.emulation;
  if (emulation.schedule != Schedule::lockstep || emulation.explore) return;
  CAPTURE(kind);
  Team team(kind, 8, std::vector<std::uint32_t>(256, 500));
  REQUIRE(team.frame(strips_for(0, 8, 256), kHalf));
  team.check_all_done();
  for (unsigned spe = 1; spe < 8; ++spe) {
    CAPTURE(spe);
    CHECK(team.report(spe).units > 0);
    CHECK(team.report(spe).exchanges > 0);
    CHECK(team.report(spe).units_received >= team.report(spe).units);
  }
  team.dismiss();
}

TEST_CASE("with an exchange parameter of 0 every SPE does its own strip") {
  const auto kind = GENERATE(from_range(kinds()));
  const auto spes = GENERATE(2u, 8u);
  CAPTURE(kind, spes);
  constexpr std::uint32_t kUnits = 100;
  const std::vector<std::uint32_t> steps = uneven_steps(kUnits, 3);
  Team team(kind, spes, steps);
  for (const auto& strips : {strips_for(1, spes, kUnits), even_strips(kUnits, spes)}) {
    REQUIRE(team.frame(strips, 0));
    team.check_all_done();
    for (unsigned spe = 0; spe < spes; ++spe) {
      CAPTURE(spe);
      const auto first = steps.begin() + strips[spe].first;
      CHECK(team.report(spe).units == strips[spe].count);
      CHECK(team.report(spe).steps == std::accumulate(first, first + strips[spe].count, 0u));
      CHECK(team.report(spe).exchanges == 0);
      CHECK(team.report(spe).units_received == 0);
    }
  }
  team.dismiss();
}

TEST_CASE("a frame that is broken off leaves nothing to the next one") {
  auto kind = GENERATE(from_range(kinds()));
  CAPTURE(kind);
  // The PPE's word that ends the frame may be one too many, and is said again if it gets lost.
  kind.config.emulation.actions[Rule::mailbox_overwritten] = Action::ignore;
  Team team(kind, 8, uneven_steps(200, 9));
  for (int round = 0; round < 3; ++round) {
    const Progress until_asked_twice = [asked = 0](double) mutable { return ++asked < 3; };
    if (!team.frame(strips_for(0, 8, 200), kHalf, until_asked_twice)) CHECK(team.sum().units <= 200);
    REQUIRE(team.frame(even_strips(200, 8), kHalf));
    team.check_all_done();
  }
  team.dismiss();
}

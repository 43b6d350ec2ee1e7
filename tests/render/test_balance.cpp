// How the SPEs share a frame: the plan of its work, and what comes of it in virtual time.
#include "celltrace/balance/strip.hpp"
#include "render/backends.hpp"
#include "render/scenes.hpp"
#include "render/work_plan.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <tuple>
#include <vector>

using namespace celltrace;
using namespace celltrace::test;

namespace {

constexpr Balance kBalances[] = {Balance::gde, Balance::diffusion, Balance::fixed, Balance::scatter,
                                 Balance::tiles};

struct Size {
  std::uint32_t columns, rows, spes;
};

/// What the SPEs would read; they would have measured `cost(column, row)` for each bundle.
class PlannedFrame {
public:
  PlannedFrame(const WorkPlan& plan, Size size) : size_(size), units_(plan.units()) { plan.place(frame_); }

  /// How often each bundle is in a unit, and how often each unit is in a strip.
  std::vector<int> bundles() const {
    std::vector<int> times(size_.columns * size_.rows);
    for (std::uint32_t unit = 0; unit < units_; ++unit)
      for_each_bundle(unit, [&](std::uint32_t bundle) { ++times.at(bundle); });
    return times;
  }
  std::vector<int> units() const {
    std::vector<int> times(units_);
    for (std::uint32_t spe = 0; spe < size_.spes; ++spe)
      for (std::uint32_t unit = strip(spe).begin; unit < strip(spe).end; ++unit)
        ++times.at(unit);
    return times;
  }
  /// Of each strip, in order.
  template <class Cost> std::vector<std::vector<std::uint32_t>> unit_costs(Cost cost) const {
    std::vector<std::vector<std::uint32_t>> strips(size_.spes);
    for (std::uint32_t spe = 0; spe < size_.spes; ++spe)
      for (std::uint32_t unit = strip(spe).begin; unit < strip(spe).end; ++unit) {
        strips[spe].push_back(0);
        for_each_bundle(unit, [&](std::uint32_t bundle) { strips[spe].back() += cost(bundle); });
      }
    return strips;
  }
  template <class Cost> void measure(Cost cost) const {
    auto* const costs = reinterpret_cast<std::uint32_t*>(frame_.costs);
    for (std::uint32_t unit = 0; unit < units_; ++unit)
      for_each_bundle(unit, [&](std::uint32_t bundle) { costs[unit] += cost(bundle); });
  }
  /// Greatest over mean cost of a strip, minus 1.
  template <class Cost> double imbalance(Cost cost) const {
    double most = 0;
    double sum = 0;
    for (std::uint32_t spe = 0; spe < size_.spes; ++spe) {
      double load = 0;
      for (std::uint32_t unit = strip(spe).begin; unit < strip(spe).end; ++unit)
        for_each_bundle(unit, [&](std::uint32_t bundle) { load += cost(bundle); });
      most = std::max(most, load);
      sum += load;
    }
    return most * size_.spes / sum - 1;
  }

private:
  const kernel::StripRecord& strip(std::uint32_t spe) const {
    return reinterpret_cast<const kernel::StripRecord*>(frame_.strips)[spe];
  }
  template <class Visit> void for_each_bundle(std::uint32_t unit, Visit visit) const {
    const auto& run = reinterpret_cast<const kernel::UnitRecord*>(frame_.units)[unit];
    for (std::uint32_t i = 0; i < run.bundles; ++i)
      visit(run.row * size_.columns + run.column + i);
  }

  Size size_;
  std::uint32_t units_;
  kernel::FrameBlock frame_{};
};

bool all_once(const std::vector<int>& times) {
  return std::all_of(times.begin(), times.end(), [](int each) { return each == 1; });
}

/// A ray that costs nothing, and a bright spot in the upper right corner of a picture of 100 columns.
std::uint32_t uneven_cost(std::uint32_t bundle) {
  return bundle % 100 > 60 && bundle / 100 < 30 ? 500 : 10;
}

RenderOptions lockstep(unsigned spes, Balance balance) {
  RenderOptions options = TestBackend{Backend::cell_emu, SimdLevel::automatic}.options(512, 384, spes);
  options.emulation.schedule = Schedule::lockstep;
  options.balance = balance;
  return options;
}

} // namespace

TEST_CASE("Every bundle is in one unit of one strip, also after plans have learnt") {
  for (const Balance balance : kBalances) {
    for (const Size size : {Size{1, 1, 1},
                            {1, 1, 16},
                            {7, 3, 2},
                            {100, 75, 8},
                            {160, 120, 16},
                            {1, 16380, 256},
                            {16380, 2, 3},
                            {480, 270, 64}}) {
      INFO(static_cast<int>(balance) << ": " << size.columns << "x" << size.rows << " for " << size.spes);
      WorkPlan plan(balance, size.columns, size.rows, size.spes);
      for (int frame = 0; frame < 4; ++frame) {
        const PlannedFrame planned(plan, size);
        CHECK(all_once(planned.bundles()));
        CHECK(all_once(planned.units()));
        if (balance == Balance::gde) CHECK(plan.units() <= strip_word::kMaxUnits);
        planned.measure([](std::uint32_t bundle) { return bundle % 11 == 0 ? 300u : 2u; });
        plan.learn();
      }
    }
  }
}

TEST_CASE("Plans learn from what bundles cost") {
  const Size size{100, 75, 8};
  const auto imbalance_after = [&](Balance balance, int frames) {
    WorkPlan plan(balance, size.columns, size.rows, size.spes);
    for (int frame = 0; frame < frames; ++frame) {
      PlannedFrame(plan, size).measure(uneven_cost);
      plan.learn();
    }
    return PlannedFrame(plan, size).imbalance(uneven_cost);
  };
  CHECK(imbalance_after(Balance::fixed, 3) > 1);
  CHECK(imbalance_after(Balance::gde, 0) < 0.3);
  CHECK(imbalance_after(Balance::gde, 1) < 0.01);
  CHECK(imbalance_after(Balance::diffusion, 10) < imbalance_after(Balance::fixed, 10));
  CHECK(imbalance_after(Balance::diffusion, 10) > 0.1);
  CHECK(imbalance_after(Balance::diffusion, 150) < 0.1);
}

TEST_CASE("Plans have no more units than a strip's word can number, however uneven costs are") {
  const Size size{480, 270, 64};
  WorkPlan plan(Balance::gde, size.columns, size.rows, size.spes);
  const std::uint32_t all = size.columns * size.rows;
  // As many costly bundles as there may be units; the cheap ones are cut where units would become too long.
  for (const std::uint32_t costly : {all / 100, all / 9, all / 8, all / 2}) {
    INFO(costly << " of " << all << " bundles are costly");
    const PlannedFrame planned(plan, size);
    planned.measure([&](std::uint32_t bundle) { return bundle < costly ? 1000u : 1u; });
    plan.learn();
    CHECK(plan.units() <= strip_word::kMaxUnits);
    CHECK(all_once(PlannedFrame(plan, size).bundles()));
  }
}

TEST_CASE("Strips begin with what costs more than a unit should") {
  const Size size{100, 75, 8};
  const auto cost = [](std::uint32_t bundle) { return bundle % 97 == 0 ? 5000u : 2u; };
  WorkPlan plan(Balance::gde, size.columns, size.rows, size.spes);
  for (int frame = 0; frame < 4; ++frame) {
    PlannedFrame(plan, size).measure(cost);
    plan.learn();
  }
  for (const std::vector<std::uint32_t>& strip : PlannedFrame(plan, size).unit_costs(cost)) {
    REQUIRE(strip.front() >= 5000);
    CHECK(std::is_partitioned(strip.begin(), strip.end(), [](std::uint32_t unit) { return unit >= 5000; }));
  }
}

TEST_CASE("Pictures are the same however the SPEs share them") {
  const Scene scene = scene_named("glass and mirrors");
  for (const TestBackend& backend : {backends().front(), backends().back()}) {
    const RenderOptions alone = backend.options(70, 50, 1);
    const Image expected = render(scene, alone).image;
    for (const Balance balance : kBalances) {
      INFO(backend.spu() << ", " << static_cast<int>(balance));
      RenderOptions options = backend.options(70, 50, 5);
      options.balance = balance;
      Renderer renderer(options);
      for (int frame = 0; frame < 3; ++frame) {
        const RenderResult result = renderer.render(scene);
        CHECK(result.image == expected);
        if (balance != Balance::gde) CHECK(result.statistics.balance_exchanges == 0);
      }
    }
  }
}

TEST_CASE("From the second frame on, dimension exchange leaves hardly any imbalance") {
  const Scene scene = scene_named("glass and mirrors");
  for (const unsigned spes : {8u, 16u}) {
    INFO(spes << " SPEs");
    Renderer one(lockstep(1, Balance::gde));
    one.render(scene);
    const auto alone = static_cast<double>(one.render(scene).statistics.render_cycles);
    Renderer renderer(lockstep(spes, Balance::gde));
    const RenderStatistics first = renderer.render(scene).statistics;
    CHECK(alone / static_cast<double>(first.render_cycles) > 0.85 * spes);
    for (int frame = 2; frame <= 4; ++frame) {
      INFO("frame " << frame);
      const RenderStatistics s = renderer.render(scene.camera).statistics;
      CHECK(s.imbalance < 0.03);
      CHECK(alone / static_cast<double>(s.render_cycles) > 0.94 * spes);
    }
  }
}

TEST_CASE("Dimension exchange takes less than half the time of strips that stay, where work is uneven") {
  Scene scene = scene_named("glass and mirrors");
  scene.camera = camera_at({0, 3.5, -6}, {0, 3.2, 0});
  scene.max_trace_level = 20;
  const auto cycles = [&](Balance balance) {
    return render(scene, lockstep(16, balance)).statistics.render_cycles;
  };
  CHECK(cycles(Balance::gde) * 2 < cycles(Balance::fixed));
}

TEST_CASE("Tiles are dealt in no order") {
  const WorkPlan plan(Balance::tiles, 64, 64, 2);
  bool is_in_order = true;
  for (std::uint32_t unit = 1; unit < plan.units(); ++unit)
    is_in_order &= plan.unit(unit).row / 4 >= plan.unit(unit - 1).row / 4;
  CHECK_FALSE(is_in_order);
}

TEST_CASE("The first SPE's first piece is the picture's, the last SPE's second one follows its first") {
  constexpr std::uint32_t kSpes = 4;
  const WorkPlan plan(Balance::gde, 64, 64, kSpes);
  CHECK(plan.unit(0).row == 0);
  CHECK(plan.unit(0).column == 0);
  // To and fro: the last of a round is the first of the next one.
  const std::uint32_t last = plan.units() / kSpes * (kSpes - 1);
  const auto place = [&](std::uint32_t unit) { return plan.unit(unit).row * 64u + plan.unit(unit).column; };
  std::uint32_t unit = last;
  while (place(unit + 1) == place(unit) + plan.unit(unit).bundles)
    ++unit;
  CHECK(unit - last + 1 == 2 * (plan.units() / (16 * kSpes)));
}

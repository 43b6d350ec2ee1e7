#include "celltrace/balance.hpp"

#include <catch2/catch.hpp>

#include <random>

using namespace celltrace;

namespace {

std::uint32_t items(const std::vector<CostRun>& runs) {
  return std::accumulate(runs.begin(), runs.end(), 0u,
                         [](std::uint32_t sum, const CostRun& run) { return sum + run.items; });
}

double cost(const std::vector<CostRun>& runs) {
  return std::accumulate(runs.begin(), runs.end(), 0.0,
                         [](double sum, const CostRun& run) { return sum + run.cost; });
}

void check_strips(const std::vector<UnitRange>& strips, std::size_t units) {
  std::uint32_t next = 0;
  for (const UnitRange strip : strips) {
    CHECK(strip.first == next);
    next += strip.count;
  }
  CHECK(next == units);
}

std::vector<double> random_costs(std::size_t units, std::mt19937& random) {
  std::vector<double> costs(units);
  for (double& each : costs)
    each = random() % 5 == 0 ? random() % 1000 : random() % 10;
  return costs;
}

} // namespace

TEST_CASE("runs are cut where their costs are equal") {
  const std::vector<CostRun> measured{{8, 8}, {4, 16}, {8, 8}};
  const auto runs = equal_cost_runs(measured, 8, 100);
  REQUIRE(runs.size() == 8);
  for (const CostRun& run : runs)
    CHECK(run.cost == Approx(4));
  CHECK(runs[0].items == 4);
  CHECK(runs[2].items == 1);
  CHECK(runs[7].items == 4);
}

TEST_CASE("runs keep all items and all cost, and are neither too long nor too many") {
  for (unsigned seed = 0; seed < 200; ++seed) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    std::vector<CostRun> measured;
    for (const double each : random_costs(1 + random() % 60, random))
      measured.push_back({1 + static_cast<std::uint32_t>(random() % 20), each});
    const std::uint32_t wanted = 1 + random() % 50;
    const std::uint32_t longest = 1 + random() % 30;
    const auto runs = equal_cost_runs(measured, wanted, longest);
    CHECK(items(runs) == items(measured));
    CHECK(cost(runs) == Approx(cost(measured)));
    CHECK(runs.size() <= wanted + items(measured) / longest + 1);
    for (const CostRun& run : runs) {
      CHECK(run.items >= 1);
      CHECK(run.items <= longest);
    }
  }
}

TEST_CASE("work without cost is cut by length alone") {
  const auto runs = equal_cost_runs(std::vector<CostRun>{{10, 0}, {5, 0}}, 3, 4);
  CHECK(items(runs) == 15);
  for (const CostRun& run : runs)
    CHECK(run.items <= 4);
  CHECK(equal_cost_runs({}, 3, 4).empty());
}

TEST_CASE("strips of equal cost are as even as units allow") {
  for (unsigned seed = 0; seed < 200; ++seed) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    const auto costs = random_costs(random() % 300, random);
    const std::uint32_t nodes = 1 + random() % 17;
    const auto strips = strips_of_equal_cost(costs, nodes);
    REQUIRE(strips.size() == nodes);
    check_strips(strips, costs.size());
    const double share = std::accumulate(costs.begin(), costs.end(), 0.0) / nodes;
    for (const UnitRange strip : strips) {
      const auto begin = costs.begin() + strip.first;
      CHECK(std::accumulate(begin, begin + strip.count, 0.0) <= share + 1000);
    }
  }
}

TEST_CASE("diffusion between frames moves the ends of strips towards the cheaper ones, and converges") {
  const std::vector<double> costs(400, 1.0);
  std::vector<UnitRange> strips = consecutive_strips({400, 0, 0, 0});
  const double alpha = diffusion_parameter(chain_graph(4));
  strips = diffused_strips(costs, strips, alpha);
  check_strips(strips, 400);
  CHECK(strips[0].count == 267);
  CHECK(strips[1].count == 133);
  for (int frame = 0; frame < 60; ++frame)
    strips = diffused_strips(costs, strips, alpha);
  check_strips(strips, 400);
  for (const UnitRange strip : strips)
    CHECK(strip.count == Approx(100).margin(2));
}

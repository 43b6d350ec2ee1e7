#include "celltrace/balance.hpp"

#include <catch2/catch.hpp>

#include <array>
#include <random>
#include <set>
#include <string>

using namespace celltrace;

namespace {

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// No node has two edges of one colour, and every colour is used.
bool well_coloured(const SystemGraph& graph) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> node_colours;
  std::set<std::uint32_t> colours;
  for (const auto& edge : graph.edges) {
    if (!node_colours.insert({edge.a, edge.colour}).second) return false;
    if (!node_colours.insert({edge.b, edge.colour}).second) return false;
    colours.insert(edge.colour);
  }
  return colours.size() == graph.colours && (colours.empty() || *colours.rbegin() + 1 == graph.colours);
}

SystemGraph box(std::initializer_list<std::uint32_t> sides, bool torus = false) {
  const std::vector<std::uint32_t> list(sides);
  return torus ? torus_graph(list) : mesh_graph(list);
}

Pairs random_pairs(std::uint32_t nodes, double density, std::mt19937& random) {
  Pairs pairs;
  std::bernoulli_distribution chosen(density);
  for (std::uint32_t a = 0; a < nodes; ++a) {
    for (std::uint32_t b = a + 1; b < nodes; ++b) {
      if (chosen(random)) pairs.emplace_back(a, b);
    }
  }
  std::shuffle(pairs.begin(), pairs.end(), random);
  return pairs;
}

template <class Load> std::vector<Load> random_loads(std::uint32_t nodes, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Load> loads(nodes);
  for (Load& load : loads)
    load = static_cast<Load>(random() % 3 == 0 ? random() % 10'000 : random() % 10);
  return loads;
}

template <class Load> Load sum(const std::vector<Load>& loads) {
  return std::accumulate(loads.begin(), loads.end(), Load{});
}

} // namespace

TEST_CASE("graphs have the edges and colours they should") {
  struct Expected {
    std::string name;
    SystemGraph graph;
    std::size_t nodes, edges;
    unsigned degree, colours;
  };
  const Expected expected = GENERATE(
      Expected{"chain of 1", chain_graph(1), 1, 0, 0, 0}, Expected{"chain of 2", chain_graph(2), 2, 1, 1, 1},
      Expected{"chain of 8", chain_graph(8), 8, 7, 2, 2}, Expected{"ring of 2", ring_graph(2), 2, 1, 1, 1},
      Expected{"ring of 3", ring_graph(3), 3, 3, 2, 3}, Expected{"ring of 6", ring_graph(6), 6, 6, 2, 2},
      Expected{"mesh 3x4", box({3, 4}), 12, 17, 4, 4}, Expected{"mesh 2x3x2", box({2, 3, 2}), 12, 20, 4, 4},
      Expected{"torus 4x6", box({4, 6}, true), 24, 48, 4, 4},
      Expected{"torus 2x4", box({2, 4}, true), 8, 12, 3, 3},
      Expected{"torus 3x4", box({3, 4}, true), 12, 24, 4, 5},
      Expected{"complete graph of 1", complete_graph(1), 1, 0, 0, 0},
      Expected{"complete graph of 2", complete_graph(2), 2, 1, 1, 1},
      Expected{"complete graph of 7", complete_graph(7), 7, 21, 6, 7},
      Expected{"complete graph of 8", complete_graph(8), 8, 28, 7, 7},
      Expected{"hypercube 0", hypercube_graph(0), 1, 0, 0, 0},
      Expected{"hypercube 4", hypercube_graph(4), 16, 32, 4, 4});
  INFO(expected.name);
  CHECK(expected.graph.nodes == expected.nodes);
  CHECK(expected.graph.edges.size() == expected.edges);
  CHECK(expected.graph.degree() == expected.degree);
  CHECK(expected.graph.colours == expected.colours);
  CHECK(well_coloured(expected.graph));
}

TEST_CASE("a torus with odd sides needs no more than degree + 1 colours") {
  const SystemGraph graph = box({5, 3, 7}, true);
  CHECK(well_coloured(graph));
  CHECK(graph.degree() == 6);
  CHECK(graph.colours <= 7);
}

TEST_CASE("any graph is coloured with at most degree + 1 colours") {
  for (unsigned seed = 0; seed < 300; ++seed) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    const std::uint32_t nodes = 1 + random() % 24;
    const Pairs pairs = random_pairs(nodes, (1 + random() % 10) / 10.0, random);
    const SystemGraph graph = coloured_graph(nodes, pairs);
    CHECK(well_coloured(graph));
    CHECK(graph.edges.size() == pairs.size());
    CHECK(graph.colours <= graph.degree() + 1);
  }
}

TEST_CASE("graphs that are not simple, or too large, are refused") {
  CHECK_THROWS_AS(coloured_graph(2, Pairs{{0, 2}}), std::invalid_argument);
  CHECK_THROWS_AS(coloured_graph(2, Pairs{{1, 1}}), std::invalid_argument);
  CHECK_THROWS_AS(coloured_graph(2, Pairs{{0, 1}, {1, 0}}), std::invalid_argument);
  CHECK_THROWS_AS(chain_graph(0), std::invalid_argument);
  CHECK_THROWS_AS(hypercube_graph(21), std::invalid_argument);
  CHECK_THROWS_AS(hypercube_graph(64), std::invalid_argument);
  CHECK_THROWS_AS(box({65536, 65536}), std::invalid_argument);
  CHECK_THROWS_AS(box({65536, 65537}, true), std::invalid_argument);
  CHECK_THROWS_AS(complete_graph(0), std::invalid_argument);
  CHECK_THROWS_AS(complete_graph(5000), std::invalid_argument);
  CHECK_THROWS_AS(coloured_graph(0, Pairs{}), std::invalid_argument);
}

TEST_CASE("one exchange gives each side the part lambda of the other's load") {
  std::vector<double> loads{8, 4};
  gde_sweep(chain_graph(2), loads, 0.75);
  CHECK(loads[0] == Approx(0.25 * 8 + 0.75 * 4));
  CHECK(loads[1] == Approx(0.25 * 4 + 0.75 * 8));
  std::vector<std::int64_t> whole{9, 4};
  gde_sweep(chain_graph(2), whole, 0.5);
  CHECK(whole == std::vector<std::int64_t>{7, 6});
}

TEST_CASE("sweeps and diffusion steps keep the sum and no load becomes negative") {
  for (unsigned seed = 0; seed < 100; ++seed) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    const std::uint32_t nodes = 1 + random() % 20;
    const SystemGraph graph = coloured_graph(nodes, random_pairs(nodes, 0.3, random));
    const double lambda = (random() % 101) / 100.0;
    auto real = random_loads<double>(nodes, seed);
    auto whole = random_loads<std::int64_t>(nodes, seed);
    const double real_sum = sum(real);
    const std::int64_t whole_sum = sum(whole);
    for (int i = 0; i < 20; ++i) {
      gde_sweep(graph, real, lambda);
      gde_sweep(graph, whole, lambda);
      diffusion_step(graph, real, diffusion_parameter(graph));
      diffusion_step(graph, whole, diffusion_parameter(graph));
    }
    CHECK(sum(real) == Approx(real_sum));
    CHECK(sum(whole) == whole_sum);
    CHECK(*std::min_element(real.begin(), real.end()) >= 0);
    CHECK(*std::min_element(whole.begin(), whole.end()) >= 0);
  }
}

TEST_CASE("sweeps and diffusion converge to equal loads") {
  const auto graph =
      GENERATE(chain_graph(17), ring_graph(9), box({4, 5}), box({4, 6}, true), hypercube_graph(4));
  auto by_exchange = random_loads<double>(graph.nodes, 1);
  auto by_diffusion = by_exchange;
  for (int i = 0; i < 3000; ++i) {
    gde_sweep(graph, by_exchange, 0.6);
    diffusion_step(graph, by_diffusion, diffusion_parameter(graph));
  }
  CHECK(imbalance<double>(by_exchange) == Approx(0).margin(1e-6));
  CHECK(imbalance<double>(by_diffusion) == Approx(0).margin(1e-6));
}

TEST_CASE("whole loads come to rest with neighbours that cannot exchange any more") {
  const auto nodes = GENERATE(2u, 5u, 8u, 16u);
  const SystemGraph graph = chain_graph(nodes);
  auto loads = random_loads<std::int64_t>(nodes, nodes);
  for (int i = 0; i < 1000; ++i)
    gde_sweep(graph, loads, optimal_chain_parameter(nodes));
  for (const auto& edge : graph.edges)
    CHECK(std::abs(loads[edge.a] - loads[edge.b]) <= 1);
}

TEST_CASE("a hypercube is balanced in one sweep") {
  const SystemGraph graph = hypercube_graph(5);
  auto loads = random_loads<double>(graph.nodes, 2);
  gde_sweep(graph, loads, optimal_hypercube_parameter());
  CHECK(imbalance<double>(loads) == Approx(0).margin(1e-12));
}

TEST_CASE("exchange parameters out of range are refused") {
  std::vector<double> loads{1, 2, 3};
  CHECK_THROWS_AS(gde_sweep(chain_graph(3), loads, 1.01), std::invalid_argument);
  CHECK_THROWS_AS(gde_sweep(chain_graph(3), loads, -0.01), std::invalid_argument);
  CHECK_THROWS_AS(gde_sweep(chain_graph(2), loads, 0.5), std::invalid_argument);
  CHECK_THROWS_AS(diffusion_step(chain_graph(3), loads, 0.6), std::invalid_argument);
}

TEST_CASE("exchange parameters become 16-bit fractions") {
  CHECK(fixed_point_parameter(0.5) == 32768);
  CHECK(fixed_point_parameter(0) == 0);
  CHECK(fixed_point_parameter(1) == 65535);
}

TEST_CASE("imbalance is how far the largest load exceeds the mean") {
  CHECK(imbalance<std::int64_t>(std::array<std::int64_t, 4>{6, 2, 2, 2}) == Approx(1.0));
  CHECK(imbalance<double>(std::array{0.0, 0.0}) == 0);
  CHECK(imbalance<double>({}) == 0);
}

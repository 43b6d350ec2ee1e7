// Theory against measurement: exchange parameters, convergence factors and sweeps to balance.
#include "celltrace/balance.hpp"

#include <catch2/catch.hpp>

#include <array>
#include <numbers>
#include <string>

using namespace celltrace;

namespace {

using Sides = std::vector<std::uint32_t>;

struct Case {
  std::string name;
  SystemGraph graph;
  double optimum;
  double (*theory)(double lambda);
};

const std::vector<Case>& cases() {
  static const std::vector<Case> all = {
      {"chain of 3", chain_graph(3), optimal_chain_parameter(3),
       [](double lambda) { return chain_convergence_factor(3, lambda); }},
      {"chain of 8", chain_graph(8), optimal_chain_parameter(8),
       [](double lambda) { return chain_convergence_factor(8, lambda); }},
      {"chain of 9", chain_graph(9), optimal_chain_parameter(9),
       [](double lambda) { return chain_convergence_factor(9, lambda); }},
      {"chain of 16", chain_graph(16), optimal_chain_parameter(16),
       [](double lambda) { return chain_convergence_factor(16, lambda); }},
      {"ring of 8", ring_graph(8), optimal_ring_parameter(8),
       [](double lambda) { return ring_convergence_factor(8, lambda); }},
      {"ring of 12", ring_graph(12), optimal_ring_parameter(12),
       [](double lambda) { return ring_convergence_factor(12, lambda); }},
      {"mesh 3x8", mesh_graph(Sides{3, 8}), optimal_mesh_parameter(Sides{3, 8}),
       [](double lambda) {
         return mesh_convergence_factor(Sides{3, 8}, lambda);
       }},
      {"torus 4x8", torus_graph(Sides{4, 8}), optimal_torus_parameter(Sides{4, 8}),
       [](double lambda) {
         return torus_convergence_factor(Sides{4, 8}, lambda);
       }},
  };
  return all;
}

/// All the load is on node 0.
std::vector<double> heap(std::uint32_t nodes) {
  std::vector<double> loads(nodes);
  loads[0] = nodes;
  return loads;
}

} // namespace

TEST_CASE("the optimal parameters are those of Xu and Lau") {
  using std::numbers::pi;
  CHECK(optimal_chain_parameter(1) == 0.5);
  CHECK(optimal_chain_parameter(2) == Approx(0.5));
  for (const std::uint32_t nodes : {3u, 4u, 8u, 16u, 17u}) {
    INFO(nodes << " nodes");
    CHECK(optimal_chain_parameter(nodes) == Approx(1 / (1 + std::sin(pi / nodes))));
    CHECK(optimal_mesh_parameter(std::array{2u, nodes, 3u}) == Approx(optimal_chain_parameter(nodes)));
  }
  for (const std::uint32_t nodes : {4u, 6u, 8u, 16u}) {
    INFO(nodes << " nodes");
    CHECK(optimal_ring_parameter(nodes) == Approx(1 / (1 + std::sin(2 * pi / nodes))));
    CHECK(optimal_torus_parameter(std::array{nodes, 4u}) == Approx(optimal_ring_parameter(nodes)));
  }
  CHECK(optimal_ring_parameter(2) == 0.5);
  CHECK(optimal_hypercube_parameter() == 0.5);
}

TEST_CASE("graphs without a formula have no optimal parameter") {
  CHECK_THROWS_AS(optimal_ring_parameter(5), std::invalid_argument);
  CHECK_THROWS_AS(optimal_torus_parameter(Sides{4, 5, 8}), std::invalid_argument);
  CHECK_THROWS_AS(optimal_chain_parameter(0), std::invalid_argument);
  CHECK_THROWS_AS(ring_convergence_factor(7, 0.5), std::invalid_argument);
  CHECK_THROWS_AS(chain_convergence_factor(0, 0.5), std::invalid_argument);
}

TEST_CASE("measured convergence factors are those of the theory") {
  for (const Case& each : cases()) {
    INFO(each.name);
    for (const double lambda : {0.1, 0.3, 0.5, 0.6, 0.7, 0.85, 0.95, each.optimum}) {
      INFO("lambda " << lambda);
      CHECK(convergence_factor(each.graph, lambda) == Approx(each.theory(lambda)).margin(1e-6));
    }
    CHECK(each.theory(each.optimum) == Approx(2 * each.optimum - 1));
  }
}

TEST_CASE("no other parameter has a smaller convergence factor than the optimal one") {
  for (const Case& each : cases()) {
    INFO(each.name);
    const double best = convergence_factor(each.graph, each.optimum);
    for (const double away : {-0.2, -0.05, -0.01, 0.01, 0.05, 0.1})
      CHECK(best < convergence_factor(each.graph, each.optimum + away));
    CHECK(best_exchange_parameter(each.graph) == Approx(each.optimum).margin(3e-4));
  }
}

TEST_CASE("sweeps to balance are as many as the convergence factor says") {
  constexpr double kTolerance = 1e-9;
  for (const Case& each : cases()) {
    INFO(each.name);
    for (const double lambda : {0.5, 0.6, 0.8}) {
      INFO("lambda " << lambda);
      const double expected = std::log(kTolerance) / std::log(each.theory(lambda));
      const auto sweeps = sweeps_to_balance(each.graph, heap(each.graph.nodes), lambda, kTolerance);
      REQUIRE(sweeps);
      CHECK(*sweeps == Approx(expected).epsilon(0.2).margin(4));
    }
  }
}

TEST_CASE("the optimal parameter saves sweeps over equal splitting") {
  for (const Case& each : cases()) {
    INFO(each.name);
    const auto sweeps = [&](double lambda) {
      return sweeps_to_balance(each.graph, heap(each.graph.nodes), lambda, 1e-6).value();
    };
    CHECK(sweeps(each.optimum) <= sweeps(0.5));
  }
  const auto on_chain = [](double lambda) {
    return sweeps_to_balance(chain_graph(16), heap(16), lambda, 1e-6).value();
  };
  CHECK(on_chain(optimal_chain_parameter(16)) * 4 < on_chain(0.5));
}

TEST_CASE("a hypercube is balanced by one sweep, others not by any one") {
  CHECK(convergence_factor(hypercube_graph(4), 0.5) == 0);
  CHECK(best_exchange_parameter(hypercube_graph(4)) == 0.5);
  CHECK(sweeps_to_balance(hypercube_graph(4), heap(16), 0.5, 1e-12) == 1u);
  CHECK(sweeps_to_balance(chain_graph(4), heap(4), optimal_chain_parameter(4), 1e-12).value() > 1);
}

TEST_CASE("an odd ring has a best parameter too, found by search") {
  const double best = best_exchange_parameter(ring_graph(9));
  CHECK(best > 0.5);
  CHECK(convergence_factor(ring_graph(9), best) < convergence_factor(ring_graph(9), 0.5));
}

TEST_CASE("graphs that are balanced or cannot be") {
  CHECK(convergence_factor(chain_graph(1), 0.5) == 0);
  CHECK(convergence_factor(chain_graph(4), 0) == Approx(1));
  const std::vector<std::pair<std::uint32_t, std::uint32_t>> apart{{0, 1}, {2, 3}};
  CHECK(convergence_factor(coloured_graph(4, apart), 0.5) == Approx(1));
  CHECK_FALSE(sweeps_to_balance(coloured_graph(4, apart), heap(4), 0.5, 0.01, 100));
  CHECK(sweeps_to_balance(chain_graph(3), {5, 5, 5}, 0.5, 0) == 0u);
}

TEST_CASE("measured diffusion factors are those of the graph's eigenvalues") {
  using std::numbers::pi;
  for (const double alpha : {0.2, 1.0 / 3}) {
    const double slow = 1 - 2 * alpha * (1 - std::cos(pi / 8));
    const double fast = 1 - 2 * alpha * (1 - std::cos(7 * pi / 8));
    CHECK(diffusion_convergence_factor(chain_graph(8), alpha) == Approx(std::max(slow, std::abs(fast))));
  }
  CHECK(diffusion_convergence_factor(complete_graph(5), 0.2) == Approx(0).margin(1e-12));
  CHECK(diffusion_convergence_factor(hypercube_graph(3), 0.25) == Approx(0.5));
  CHECK(steps_to_balance(complete_graph(5), heap(5), 0.2, 1e-12) == 1u);
  CHECK(steps_to_balance(chain_graph(16), heap(16), 1.0 / 3, 1e-3).value() >
        sweeps_to_balance(chain_graph(16), heap(16), optimal_chain_parameter(16), 1e-3).value());
}

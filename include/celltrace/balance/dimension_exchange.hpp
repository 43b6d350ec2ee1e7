// Synchronous load balancing on a system graph: generalized dimension exchange (GDE) and first-order
// diffusion.
//
// Sources: C.-Z. Xu and F. C. M. Lau, "Analysis of the generalized dimension exchange method for dynamic load
// balancing", J. Parallel and Distributed Computing 16 (1992); G. Cybenko, "Dynamic load balancing for
// distributed memory multiprocessors", same journal 7 (1989).
//
// Loads are one number per node. All functions are pure: they touch nothing but the loads they are given.
#pragma once

#include "celltrace/balance/system_graph.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <stdexcept>
#include <vector>

namespace celltrace {

namespace detail {

inline void require_loads(const SystemGraph& graph, std::size_t loads) {
  if (loads != graph.nodes)
    throw std::invalid_argument("as many loads as the system graph has nodes are needed");
}
inline void require_parameter(double parameter, double largest) {
  if (!(parameter >= 0 && parameter <= largest))
    throw std::invalid_argument("exchange parameter out of range");
}

/// Returns the load that flows from a load `from` to a load `to`, positive or negative.
inline double flow(double from, double to, double parameter) {
  return parameter * (from - to);
}
/// Returns the whole units that flow, rounded toward 0, so that rounding cannot make loads oscillate.
inline std::int64_t flow(std::int64_t from, std::int64_t to, double parameter) {
  return static_cast<std::int64_t>(parameter * static_cast<double>(from - to));
}

template <class Load> void gde_sweep(const SystemGraph& graph, std::span<Load> loads, double lambda) {
  require_loads(graph, loads.size());
  require_parameter(lambda, 1);
  for (std::uint32_t colour = 0; colour < graph.colours; ++colour) {
    for (const SystemGraph::Edge& edge : graph.edges) {
      if (edge.colour != colour) continue;
      const Load moved = flow(loads[edge.a], loads[edge.b], lambda);
      loads[edge.a] -= moved;
      loads[edge.b] += moved;
    }
  }
}

template <class Load> void diffusion_step(const SystemGraph& graph, std::span<Load> loads, double alpha) {
  require_loads(graph, loads.size());
  require_parameter(alpha, 1.0 / std::max(graph.degree(), 1u));
  const std::vector<Load> before(loads.begin(), loads.end());
  for (const SystemGraph::Edge& edge : graph.edges) {
    const Load moved = flow(before[edge.a], before[edge.b], alpha);
    loads[edge.a] -= moved;
    loads[edge.b] += moved;
  }
}

} // namespace detail

/// Does one sweep of GDE: for each colour in turn, the neighbours on each edge of this colour exchange the
/// share `lambda` (0..1) of their loads, w_i = (1 - lambda) w_i + lambda w_j. The sum of loads stays, and
/// loads >= 0 stay >= 0. Whole loads (up to 2^53) move in whole units, rounded toward 0. Throws
/// std::invalid_argument if lambda is out of range or the number of loads is not the number of nodes.
inline void gde_sweep(const SystemGraph& graph, std::span<double> loads, double lambda) {
  celltrace::detail::gde_sweep(graph, loads, lambda);
}
inline void gde_sweep(const SystemGraph& graph, std::span<std::int64_t> loads, double lambda) {
  celltrace::detail::gde_sweep(graph, loads, lambda);
}

/// Does one step of first-order diffusion, in which each node exchanges with all neighbours at once: w_i +=
/// alpha * sum over neighbours (w_j - w_i), with alpha in 0 .. 1/degree. Otherwise as gde_sweep().
inline void diffusion_step(const SystemGraph& graph, std::span<double> loads, double alpha) {
  celltrace::detail::diffusion_step(graph, loads, alpha);
}
inline void diffusion_step(const SystemGraph& graph, std::span<std::int64_t> loads, double alpha) {
  celltrace::detail::diffusion_step(graph, loads, alpha);
}
/// Returns the usual alpha, 1 / (degree + 1), with which diffusion converges on every connected graph.
inline double diffusion_parameter(const SystemGraph& graph) {
  return 1.0 / (graph.degree() + 1.0);
}

/// Returns max / mean - 1: 0 is perfect balance. 0 if there are no loads or all are 0.
template <class Load> double imbalance(std::span<const Load> loads) {
  const double sum = std::accumulate(loads.begin(), loads.end(), 0.0);
  if (sum == 0) return 0;
  return static_cast<double>(*std::max_element(loads.begin(), loads.end())) *
             static_cast<double>(loads.size()) / sum -
         1;
}

} // namespace celltrace

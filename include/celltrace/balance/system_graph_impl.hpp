// Definitions of the functions of system_graph.hpp.
#pragma once

#include "celltrace/balance/edge_colouring.hpp"
#include "celltrace/balance/system_graph.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string>

namespace celltrace {

namespace detail {

/// An axis of a box: the numbers of neighbours along the axis differ by `stride`.
struct Axis {
  std::uint32_t side;
  std::uint32_t stride;
};

inline bool wraps(std::uint32_t side, bool torus) {
  return torus && side > 2;
}

/// Adds the edges along an axis with two colours, or three for rings of odd length.
inline void add_axis(SystemGraph& graph, Axis axis, bool torus) {
  for (std::uint32_t node = 0; node < graph.nodes; ++node) {
    const std::uint32_t position = node / axis.stride % axis.side;
    if (position + 1 < axis.side)
      graph.edges.push_back({node, node + axis.stride, graph.colours + position % 2});
    else if (wraps(axis.side, torus))
      graph.edges.push_back(
          {node, node - position * axis.stride, graph.colours + (axis.side % 2 == 0 ? 1 : 2)});
  }
  const bool odd_ring = wraps(axis.side, torus) && axis.side % 2 == 1;
  graph.colours += odd_ring ? 3 : std::min(axis.side - 1, 2u);
}

inline void require_nodes(std::uint64_t nodes, std::uint32_t most = kMaxGraphNodes) {
  if (nodes == 0) throw std::invalid_argument("a system graph without nodes");
  if (nodes > most)
    throw std::invalid_argument("a system graph of more than " + std::to_string(most) + " nodes");
}

inline SystemGraph box_graph(std::span<const std::uint32_t> sides, bool torus) {
  SystemGraph graph;
  graph.nodes = 1;
  for (const std::uint32_t side : sides) {
    require_nodes(std::uint64_t{graph.nodes} * side);
    graph.nodes *= side;
  }
  std::uint32_t stride = 1;
  for (const std::uint32_t side : sides) {
    add_axis(graph, {side, stride}, torus);
    stride *= side;
  }
  return graph;
}

inline std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs_of(const SystemGraph& graph) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (const SystemGraph::Edge& edge : graph.edges)
    pairs.emplace_back(edge.a, edge.b);
  return pairs;
}

inline void require_simple(std::uint32_t nodes,
                           std::span<const std::pair<std::uint32_t, std::uint32_t>> neighbours) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> seen;
  for (const auto& [a, b] : neighbours) {
    if (a >= nodes || b >= nodes) throw std::invalid_argument("an edge of a system graph ends nowhere");
    if (a == b) throw std::invalid_argument("a node of a system graph is its own neighbour");
    if (!seen.insert(std::minmax(a, b)).second)
      throw std::invalid_argument("an edge of a system graph is repeated");
  }
}

} // namespace detail

inline std::uint32_t SystemGraph::degree() const {
  std::vector<std::uint32_t> degrees(nodes);
  for (const Edge& edge : edges) {
    ++degrees[edge.a];
    ++degrees[edge.b];
  }
  return degrees.empty() ? 0 : *std::max_element(degrees.begin(), degrees.end());
}

inline SystemGraph chain_graph(std::uint32_t nodes) {
  return mesh_graph(std::span(&nodes, 1));
}

inline SystemGraph ring_graph(std::uint32_t nodes) {
  return torus_graph(std::span(&nodes, 1));
}

inline SystemGraph mesh_graph(std::span<const std::uint32_t> sides) {
  return celltrace::detail::box_graph(sides, false);
}

inline SystemGraph torus_graph(std::span<const std::uint32_t> sides) {
  const SystemGraph by_axis = celltrace::detail::box_graph(sides, true);
  if (by_axis.colours <= by_axis.degree() + 1) return by_axis;
  return coloured_graph(by_axis.nodes, celltrace::detail::pairs_of(by_axis));
}

inline SystemGraph hypercube_graph(std::uint32_t dimensions) {
  celltrace::detail::require_nodes(dimensions > 20 ? std::uint64_t{kMaxGraphNodes} + 1 : 1u << dimensions);
  const std::vector<std::uint32_t> sides(dimensions, 2);
  return mesh_graph(sides);
}

inline SystemGraph complete_graph(std::uint32_t nodes) {
  celltrace::detail::require_nodes(nodes, 4096);
  // The colours are the rounds of a round-robin tournament: players a and b meet in round a + b, modulo an
  // odd number of players. If the number of players is even, the last player meets, in each round, the player
  // who would have to meet himself.
  const std::uint32_t rounds = nodes - 1 + nodes % 2;
  SystemGraph graph;
  graph.nodes = nodes;
  graph.colours = nodes == 1 ? 0 : rounds;
  for (std::uint32_t b = 1; b < nodes; ++b) {
    for (std::uint32_t a = 0; a < b; ++a)
      graph.edges.push_back({a, b, (b == rounds ? 2 * a : a + b) % rounds});
  }
  return graph;
}

inline SystemGraph coloured_graph(std::uint32_t nodes,
                                  std::span<const std::pair<std::uint32_t, std::uint32_t>> neighbours) {
  celltrace::detail::require_nodes(nodes);
  celltrace::detail::require_simple(nodes, neighbours);
  SystemGraph graph;
  graph.nodes = nodes;
  for (const auto& [a, b] : neighbours)
    graph.edges.push_back({a, b, 0});
  const celltrace::detail::EdgeColouring colouring(nodes, graph.degree(), neighbours);
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    graph.edges[i].colour = colouring.colours()[i];
    graph.colours = std::max(graph.colours, graph.edges[i].colour + 1);
  }
  return graph;
}

} // namespace celltrace

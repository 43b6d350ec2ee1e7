// System graphs for load balancing: which nodes are neighbours, and in which turn neighbours exchange. The
// edges are coloured so that no two edges of a node have the same colour; the edges of one colour are a
// "dimension".
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace celltrace {

/// A simple undirected graph with coloured edges. Immutable by convention; any number of threads may read it.
struct SystemGraph {
  struct Edge {
    std::uint32_t a;
    std::uint32_t b;
    std::uint32_t colour; ///< 0 .. colours - 1
  };
  std::uint32_t nodes = 0;
  std::uint32_t colours = 0;
  std::vector<Edge> edges;

  /// The largest number of edges that a node has.
  std::uint32_t degree() const;
};

/// Builders throw std::invalid_argument for graphs without nodes and for graphs of more than this many.
inline constexpr std::uint32_t kMaxGraphNodes = 1u << 20;

/// Nodes 0 .. n-1 in a row; 2 colours, the edge above node i has colour i mod 2.
SystemGraph chain_graph(std::uint32_t nodes);
/// A chain whose ends are neighbours, from 3 nodes on; 2 colours if `nodes` is even, else 3.
SystemGraph ring_graph(std::uint32_t nodes);
/// The box of the given sides, each node a neighbour of the next along each axis. Node x + sides[0] * (y +
/// ...). The edges along one axis have colours of their own, as a chain.
SystemGraph mesh_graph(std::span<const std::uint32_t> sides);
/// A mesh whose lines of 3 nodes and more are rings.
SystemGraph torus_graph(std::span<const std::uint32_t> sides);
/// 2^dimensions nodes; neighbours differ in one bit of their number, which is the edge's colour.
SystemGraph hypercube_graph(std::uint32_t dimensions);
/// Everyone is everyone's neighbour; n - 1 colours if `nodes` is even, else n: the fewest there can be. At
/// most 4096 nodes.
SystemGraph complete_graph(std::uint32_t nodes);

/// Any graph, from pairs of neighbours; at most degree + 1 colours (Vizing), found as by J. Misra and D.
/// Gries, "A constructive proof of Vizing's theorem", Information Processing Letters 41 (1992). Throws
/// std::invalid_argument for loops, repeated edges and nodes that do not exist.
SystemGraph coloured_graph(std::uint32_t nodes,
                           std::span<const std::pair<std::uint32_t, std::uint32_t>> neighbours);

} // namespace celltrace

#include "celltrace/balance/system_graph_impl.hpp"

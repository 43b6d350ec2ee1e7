// System graphs for load balancing: edges connect neighbours, and their colours are the order in which
// neighbours exchange loads. No two edges of a node have the same colour; the edges of one colour are a
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

  /// Returns the largest number of edges that a node has.
  std::uint32_t degree() const;
};

/// Largest number of nodes. Builders throw std::invalid_argument for graphs with more nodes or none.
inline constexpr std::uint32_t kMaxGraphNodes = 1u << 20;

/// Makes a chain: nodes 0 .. n-1 in a row; 2 colours, the edge above node i has colour i mod 2.
SystemGraph chain_graph(std::uint32_t nodes);
/// Makes a ring: a chain whose ends are neighbours, from 3 nodes on; 2 colours if `nodes` is even, else 3.
SystemGraph ring_graph(std::uint32_t nodes);
/// Makes a box of the given sides, in which each node is a neighbour of the next node along each axis. Nodes
/// are numbered x + sides[0] * (y + ...). The edges along each axis have colours of their own, as in a chain.
SystemGraph mesh_graph(std::span<const std::uint32_t> sides);
/// Makes a mesh whose lines along axes are rings if they have 3 nodes or more.
SystemGraph torus_graph(std::span<const std::uint32_t> sides);
/// Makes a hypercube of 2^dimensions nodes; neighbours differ in one bit of their number, which is the edge's
/// colour.
SystemGraph hypercube_graph(std::uint32_t dimensions);
/// Makes a graph in which all nodes are neighbours; n - 1 colours if `nodes` is even, else n: the fewest
/// possible. At most 4096 nodes.
SystemGraph complete_graph(std::uint32_t nodes);

/// Makes any graph from pairs of neighbours. It has at most degree + 1 colours (Vizing), found by the
/// algorithm of J. Misra and D. Gries, "A constructive proof of Vizing's theorem", Information Processing
/// Letters 41 (1992). Throws std::invalid_argument for loops, repeated edges and nodes that do not exist.
SystemGraph coloured_graph(std::uint32_t nodes,
                           std::span<const std::pair<std::uint32_t, std::uint32_t>> neighbours);

} // namespace celltrace

#include "celltrace/balance/system_graph_impl.hpp"

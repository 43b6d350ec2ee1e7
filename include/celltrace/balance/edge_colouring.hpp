// Colours the edges of a graph with at most degree + 1 colours, by the algorithm of Misra and Gries (1992).
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace celltrace::detail {

class EdgeColouring {
public:
  using Pair = std::pair<std::uint32_t, std::uint32_t>;

  /// Colours a simple graph of the given degree. `edges` must outlive the object.
  EdgeColouring(std::uint32_t nodes, std::uint32_t degree, std::span<const Pair> edges)
      : edges_(edges), colours_(degree + 1), edge_at_(std::size_t{nodes} * colours_, kNone),
        colour_(edges.size(), kNone) {
    for (std::uint32_t edge = 0; edge < edges_.size(); ++edge)
      colour_edge(edge);
  }
  /// Returns the colour of each edge, 0 .. degree.
  const std::vector<std::uint32_t>& colours() const { return colour_; }

private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  std::uint32_t& edge_at(std::uint32_t node, std::uint32_t colour) {
    return edge_at_[std::size_t{node} * colours_ + colour];
  }
  bool is_free(std::uint32_t node, std::uint32_t colour) { return edge_at(node, colour) == kNone; }
  std::uint32_t free_colour(std::uint32_t node) {
    std::uint32_t colour = 0;
    while (!is_free(node, colour))
      ++colour;
    return colour;
  }
  std::uint32_t other_end(std::uint32_t edge, std::uint32_t node) const {
    return edges_[edge].first == node ? edges_[edge].second : edges_[edge].first;
  }

  void paint(std::uint32_t edge, std::uint32_t colour) {
    colour_[edge] = colour;
    edge_at(edges_[edge].first, colour) = edge;
    edge_at(edges_[edge].second, colour) = edge;
  }
  void strip(std::uint32_t edge) {
    edge_at(edges_[edge].first, colour_[edge]) = kNone;
    edge_at(edges_[edge].second, colour_[edge]) = kNone;
    colour_[edge] = kNone;
  }

  void colour_edge(std::uint32_t edge) {
    const std::uint32_t centre = edges_[edge].first;
    const std::vector<std::uint32_t> fan = maximal_fan(centre, edge);
    const std::uint32_t free_at_tip = free_colour(other_end(fan.back(), centre));
    swap_along_path(centre, free_at_tip, free_colour(centre));
    rotate(centre, fan, free_at_tip);
  }

  /// Returns a maximal fan: edges of `centre`, the first of them not yet coloured. The colour of each other
  /// edge is free at the far end of the edge before it.
  std::vector<std::uint32_t> maximal_fan(std::uint32_t centre, std::uint32_t first) {
    std::vector<std::uint32_t> fan{first};
    for (bool grown = true; grown;) {
      grown = false;
      const std::uint32_t tip = other_end(fan.back(), centre);
      for (std::uint32_t colour = 0; colour < colours_ && !grown; ++colour) {
        const std::uint32_t next = edge_at(centre, colour);
        if (next == kNone || !is_free(tip, colour)) continue;
        if (std::find(fan.begin(), fan.end(), next) != fan.end()) continue;
        fan.push_back(next);
        grown = true;
      }
    }
    return fan;
  }

  /// Swaps the colours `taken` and `free` on the path of edges of these colours that begins at `node`; `free`
  /// is free at `node`.
  void swap_along_path(std::uint32_t node, std::uint32_t taken, std::uint32_t free) {
    std::vector<std::uint32_t> path;
    std::uint32_t colour = taken;
    for (std::uint32_t at = node; !is_free(at, colour);) {
      path.push_back(edge_at(at, colour));
      at = other_end(path.back(), at);
      colour = colour == taken ? free : taken;
    }
    std::vector<std::uint32_t> swapped;
    for (const std::uint32_t edge : path)
      swapped.push_back(colour_[edge] == taken ? free : taken);
    for (const std::uint32_t edge : path)
      strip(edge);
    for (std::size_t i = 0; i < path.size(); ++i)
      paint(path[i], swapped[i]);
  }

  /// Shifts colours toward the first edge of the fan, up to the first edge at whose far end `colour` is free,
  /// and gives that edge `colour`. swap_along_path() may have broken the fan, but only after that edge.
  void rotate(std::uint32_t centre, const std::vector<std::uint32_t>& fan, std::uint32_t colour) {
    std::size_t last = 0;
    while (!is_free(other_end(fan[last], centre), colour))
      ++last;
    for (std::size_t i = 0; i < last; ++i) {
      const std::uint32_t shifted = colour_[fan[i + 1]];
      strip(fan[i + 1]);
      paint(fan[i], shifted);
    }
    paint(fan[last], colour);
  }

  std::span<const Pair> edges_;
  std::uint32_t colours_;
  std::vector<std::uint32_t> edge_at_; ///< index of an edge, by node and colour
  std::vector<std::uint32_t> colour_;
};

} // namespace celltrace::detail

// The bounds of a BVH whose objects have moved, on the PPE's side.
#pragma once

#include "kernel/direct/build_bvh_bounds.hpp"
#include "kernel/records.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace celltrace {

/// Knows one BVH at a time, in a scene image in the host's byte order. Thread safety: as a standard
/// container.
class BvhRefit {
public:
  /// The BVH is another one.
  void forget();
  /// Gives the nodes of the BVH in the image at `base` the bounds that their objects have now, in up to
  /// `threads` threads. What comes out does not depend on their number.
  void refit(std::byte* base, const kernel::BvhRecord& bvh, unsigned threads);
  /// How much more a ray is expected to cost than in the BVH as it was before the first refit(), by the
  /// surface area heuristic: 1 is as much.
  double decay() const;

private:
  void find_nodes(std::byte* base, const kernel::BvhRecord& bvh);
  void bound_leaves(std::byte* base, const kernel::NodeRecord& node, std::uint32_t number);
  /// The bounds of its children are known. Returns what it adds to the cost.
  double bound_node(kernel::NodeRecord& node, std::uint32_t number);

  std::vector<std::uint32_t> nodes_; ///< numbers in ascending order, so that children come after parents
  /// By number, the parent's number times four and the slot in it; nothing for gaps between nodes.
  std::vector<std::uint32_t> parents_;
  /// By number, of its four children; not padded as those in the image are.
  std::vector<kernel::bvh::Reference> bounds_;
  double first_cost_ = 0, cost_ = 0;
};

} // namespace celltrace

// The bounds of a BVH whose objects have moved, on the PPE's side.
#pragma once

#include "kernel/direct/build_bvh_bounds.hpp"
#include "records/accelerator.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
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
  /// An object in a leaf.
  struct Member {
    std::uint32_t object; ///< offset of its record
    std::uint32_t slot;   ///< which of bounds_ is the leaf's
  };

  void find_nodes(const std::byte* base, const kernel::BvhRecord& bvh);
  void add_leaf(const std::byte* base, std::uint32_t first, std::uint32_t word, std::uint32_t slot);
  /// Part `part` of `parts`; no leaf is in two of them.
  std::span<const Member> members_of(unsigned part, unsigned parts) const;
  void bound_leaves(const std::byte* base, std::span<const Member> members);
  /// Of entry `i` of nodes_; the bounds of its children are known. Returns what it adds to the cost.
  double bound_node(kernel::NodeRecord& node, std::uint32_t i);

  std::vector<std::uint32_t> nodes_;  ///< numbers in ascending order, so that children come after parents
  std::vector<std::uint32_t> places_; ///< by entry of nodes_: which of bounds_ is its own
  std::vector<Member> members_;       ///< leaf by leaf
  // Four for each entry of nodes_: of its children.
  std::vector<kernel::bvh::Reference> bounds_; ///< not padded as those in the image are
  std::vector<float> tests_; ///< what a ray that hits the child is tested against: objects, or four bounds
  double first_cost_ = 0, cost_ = 0;
};

} // namespace celltrace

// Refits a BVH whose objects have moved, on the host.
#pragma once

#include "kernel/direct/build_bvh_bounds.hpp"
#include "records/accelerator.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace celltrace {

/// Refits one BVH at a time, in a scene image in the host's byte order. Thread safety: as a standard
/// container.
class BvhRefit {
public:
  /// Forgets the BVH. Call it before refit() gets another BVH.
  void forget();
  /// Updates the bounds in the nodes of the BVH in the image at `base` to the present bounds of its objects,
  /// in up to `threads` threads. The number of threads does not change the result.
  void refit(std::byte* base, const kernel::BvhRecord& bvh, unsigned threads);
  /// Returns the expected cost of a ray, by the surface area heuristic, relative to the BVH before the first
  /// refit(): 1 if the cost is the same.
  double decay() const;

private:
  /// An object in a leaf.
  struct Member {
    std::uint32_t object; ///< offset of the object's record
    std::uint32_t slot;   ///< index in bounds_ of the leaf's bounds
  };

  void find_nodes(const std::byte* base, const kernel::BvhRecord& bvh);
  void add_leaf(const std::byte* base, std::uint32_t first, std::uint32_t word, std::uint32_t slot);
  /// Returns part `part` of `parts`; each leaf is in one part.
  std::span<const Member> members_of(unsigned part, unsigned parts) const;
  void bound_leaves(const std::byte* base, std::span<const Member> members);
  /// Computes the bounds of entry `i` of nodes_ from the bounds of its children. Returns the node's share of
  /// the cost.
  double bound_node(kernel::NodeRecord& node, std::uint32_t i);

  std::vector<std::uint32_t> nodes_;  ///< indices in ascending order, so that children come after parents
  std::vector<std::uint32_t> places_; ///< index: entry of nodes_; place in bounds_ of the entry's bounds
  std::vector<Member> members_;       ///< leaf by leaf
  // The bounds of the children, four for each entry of nodes_.
  std::vector<kernel::bvh::Reference> bounds_; ///< bounds without the padding of the image's bounds
  std::vector<float> tests_; ///< number of objects or boxes against which a ray that hits the child is tested
  double first_cost_ = 0, cost_ = 0;
};

} // namespace celltrace

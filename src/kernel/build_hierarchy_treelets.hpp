// The upper part of a large hierarchy: nodes are made above the runs of objects that lie along the image's
// curve until few enough objects are left for a treelet (after Garanzha, Pantaleoni and McAllister, Simpler
// and faster HLBVH with work queues, 2011). Kernel dialect.
#pragma once

#include "kernel/build_hierarchy_subtree.hpp"

namespace celltrace::kernel::hierarchy {

/// Part of a hierarchy that is built by itself: over the objects of the runs [begin, end).
struct Treelet {
  Place place;
  uint32_t begin, end;
  uint32_t first; ///< of its objects in the order of the list
  uint32_t count;
  uint32_t first_node; ///< counted from the first of all treelets
  uint32_t unused;
};
static_assert(sizeof(void*) != 8 || sizeof(Treelet) == 40, "part of the work memory");

/// Ends nodes over runs at treelets.
template <class S> class Treelets {
public:
  static constexpr uint32_t kMaxDepthOfCuts = 16;
  static constexpr uint32_t kObjects = kTreeletObjects;

  explicit Treelets(Treelet* treelets) : treelets_(treelets) {}

  bool end(const Range<S>& range) const { return range.weight <= kObjects || range.count() < kChildren; }
  bool end(const Range<S>&, const Range<S> (&)[kChildren]) const { return false; }
  void add(const Range<S>& range, const Place& place) {
    treelets_[count_++] = {place, range.begin, range.end, objects_, range.weight, nodes_, 0};
    objects_ += range.weight;
    nodes_ += (range.weight - 1) / 3; // of four children each, above an object or more a leaf
  }
  uint32_t count() const { return count_; }
  /// Nodes that all of them have at most.
  uint32_t nodes() const { return nodes_; }

private:
  Treelet* treelets_;
  uint32_t count_ = 0;
  uint32_t objects_ = 0;
  uint32_t nodes_ = 0;
};

} // namespace celltrace::kernel::hierarchy

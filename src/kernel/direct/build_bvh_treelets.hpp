// The top levels of a large BVH: nodes are built above the groups of objects, which follow each other along a
// Morton curve, down to treelets (after Garanzha, Pantaleoni and McAllister, Simpler and Faster HLBVH with
// Work Queues, 2011). Kernel dialect.
#pragma once

#include "kernel/direct/build_bvh_subtree.hpp"
#include "records/frame.hpp"

namespace celltrace::kernel::bvh {

/// A subtree that one SPE builds: over the objects of the groups [begin, end).
struct Treelet {
  Place place;
  uint32_t begin, end;
  uint32_t first; ///< position of its first object in the BVH's list
  uint32_t count;
  uint32_t first_node; ///< relative to the first node of all treelets; undefined for a copy
  uint32_t nodes;      ///< set when the treelet is built
};
static_assert(sizeof(void*) != 8 || sizeof(Treelet) == 40, "part of the work memory");

/// The prototypes of groups that are copies.
class Prototypes {
public:
  explicit Prototypes(const FrameBlock& frame)
      : of_group_(frame.prototype_offset == 0 ? nullptr
                                              : reinterpret_cast<const uint32_t*>(static_cast<uintptr_t>(
                                                    frame.image + frame.prototype_offset))) {}

  bool any() const { return of_group_ != nullptr; }
  /// Returns the prototype of a group, which may be the group itself, or kNoGroup.
  uint32_t of(uint32_t group) const { return any() ? of_group_[group] : kNoGroup; }
  bool is_copy(uint32_t group) const {
    const uint32_t prototype = of(group);
    return prototype != kNoGroup && prototype != group;
  }

private:
  const uint32_t* of_group_;
};

/// The treelets at which a SubtreeBuilder over groups ends. Each prototype and each copy is a treelet.
template <class S> class Treelets {
public:
  static constexpr uint32_t kMaxSplitDepth = 16;
  static constexpr uint32_t kObjects = kTreeletObjects;

  /// Makes treelets of `groups`, the references that the SubtreeBuilder reorders.
  Treelets(const Reference* groups, const Prototypes& prototypes, Treelet* treelets)
      : groups_(groups), prototypes_(prototypes), treelets_(treelets) {}

  bool end(const Range<S>& range) const {
    if (range.weight > kObjects && range.count() >= kChildren) return false;
    return range.count() == 1 || !prototypes_.any() || !has_prototypes(range);
  }
  bool end(const Range<S>&, const Range<S> (&)[kChildren]) const { return false; }
  void add(const Range<S>& range, const Place& place) {
    treelets_[count_++] = {place, range.begin, range.end, objects_, range.weight, nodes_, 0};
    objects_ += range.weight;
    if (!prototypes_.is_copy(groups_[range.begin].value)) nodes_ += most_treelet_nodes(range.weight);
  }
  uint32_t count() const { return count_; }
  /// Returns the largest number of nodes that all treelets except copies can have.
  uint32_t nodes() const { return nodes_; }

private:
  bool has_prototypes(const Range<S>& range) const {
    for (uint32_t i = range.begin; i < range.end; ++i)
      if (prototypes_.of(groups_[i].value) != kNoGroup) return true;
    return false;
  }

  const Reference* groups_;
  const Prototypes& prototypes_;
  Treelet* treelets_;
  uint32_t count_ = 0;
  uint32_t objects_ = 0;
  uint32_t nodes_ = 0;
};

} // namespace celltrace::kernel::bvh

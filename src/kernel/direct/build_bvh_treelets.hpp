// The upper part of a large BVH: nodes are made above the runs of objects that lie along the image's
// curve until few enough objects are left for a treelet (after Garanzha, Pantaleoni and McAllister, Simpler
// and faster HLBVH with work queues, 2011). Kernel dialect.
#pragma once

#include "kernel/direct/build_bvh_subtree.hpp"

namespace celltrace::kernel::bvh {

/// Part of a BVH that is built by itself: over the objects of the runs [begin, end).
struct Treelet {
  Place place;
  uint32_t begin, end;
  uint32_t first; ///< of its objects in the order of the list
  uint32_t count;
  uint32_t first_node; ///< counted from the first of all treelets; of a copy: nothing
  uint32_t nodes;      ///< when it is built
};
static_assert(sizeof(void*) != 8 || sizeof(Treelet) == 40, "part of the work memory");

/// Which runs are copies of which.
class Prototypes {
public:
  explicit Prototypes(const FrameBlock& frame)
      : of_run_(frame.prototype_offset == 0 ? nullptr
                                            : reinterpret_cast<const uint32_t*>(static_cast<uintptr_t>(
                                                  frame.image + frame.prototype_offset))) {}

  bool any() const { return of_run_ != nullptr; }
  /// The prototype of a run, which may be itself, or kNoGroup.
  uint32_t of(uint32_t run) const { return any() ? of_run_[run] : kNoGroup; }
  bool is_copy(uint32_t run) const {
    const uint32_t prototype = of(run);
    return prototype != kNoGroup && prototype != run;
  }

private:
  const uint32_t* of_run_;
};

/// Ends nodes over runs at treelets. Prototypes and their copies are treelets of their own.
template <class S> class Treelets {
public:
  static constexpr uint32_t kMaxDepthOfCuts = 16;
  static constexpr uint32_t kObjects = kTreeletObjects;

  /// Of `runs` that SubtreeBuilder orders.
  Treelets(const Reference* runs, const Prototypes& prototypes, Treelet* treelets)
      : runs_(runs), prototypes_(prototypes), treelets_(treelets) {}

  bool end(const Range<S>& range) const {
    if (range.weight > kObjects && range.count() >= kChildren) return false;
    return range.count() == 1 || !prototypes_.any() || !has_prototypes(range);
  }
  bool end(const Range<S>&, const Range<S> (&)[kChildren]) const { return false; }
  void add(const Range<S>& range, const Place& place) {
    treelets_[count_++] = {place, range.begin, range.end, objects_, range.weight, nodes_, 0};
    objects_ += range.weight;
    // Of four children each, above an object or more a leaf.
    if (!prototypes_.is_copy(runs_[range.begin].value)) nodes_ += (range.weight - 1) / 3;
  }
  uint32_t count() const { return count_; }
  /// Nodes that all but the copies have at most.
  uint32_t nodes() const { return nodes_; }

private:
  bool has_prototypes(const Range<S>& range) const {
    for (uint32_t i = range.begin; i < range.end; ++i)
      if (prototypes_.of(runs_[i].value) != kNoGroup) return true;
    return false;
  }

  const Reference* runs_;
  const Prototypes& prototypes_;
  Treelet* treelets_;
  uint32_t count_ = 0;
  uint32_t objects_ = 0;
  uint32_t nodes_ = 0;
};

} // namespace celltrace::kernel::bvh

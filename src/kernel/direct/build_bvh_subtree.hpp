// From references to nodes, top down. Kernel dialect.
#pragma once

#include "kernel/direct/build_bvh_clusters.hpp"
#include "kernel/direct/build_bvh_split.hpp"

namespace celltrace::kernel::bvh {

/// No node lies deeper, the root being at 0.
constexpr uint32_t kMaxDepth = 48;

/// Where a subtree belongs: child `slot` of `parent`, at `depth` itself. The root has no parent.
struct Place {
  NodeRecord* parent;
  uint32_t slot;
  uint32_t depth;
};

/// Enters the boxes of a node's children. Each becomes a little larger than what is in it, and is never flat,
/// so that rounding loses no ray that grazes it.
template <class S> void set_child_bounds(NodeRecord& node, const LaneAabb<S> (&children)[kChildren]) {
  using F4 = typename S::F4;
  alignas(16) float low[kChildren][4];
  alignas(16) float high[kChildren][4];
  for (uint32_t i = 0; i < kChildren; ++i) {
    children[i].min.store(low[i]);
    children[i].max.store(high[i]);
  }
  const F4 zero = F4::splat(0.0f);
  const F4 relative = F4::splat(1e-6f);
  F4 lows[3], highs[3];
  F4 extent = zero;
  for (uint32_t axis = 0; axis < 3; ++axis) {
    lows[axis] = four<S>(low[0][axis], low[1][axis], low[2][axis], low[3][axis]);
    highs[axis] = four<S>(high[0][axis], high[1][axis], high[2][axis], high[3][axis]);
    extent = extent + (highs[axis] - lows[axis]);
  }
  const F4 thickness = S::max(extent, zero) * relative + F4::splat(1e-30f);
  for (uint32_t axis = 0; axis < 3; ++axis) {
    const F4 least = lows[axis], most = highs[axis];
    (least - (S::max(least, zero - least) * relative + thickness)).store(node.bounds[2 * axis]);
    (most + (S::max(most, zero - most) * relative + thickness)).store(node.bounds[2 * axis + 1]);
  }
}

/// Builds the nodes above references. What ends the nodes is `Ends`:
///   static constexpr uint32_t kMaxDepthOfCuts          below it ranges are halved
///   bool end(const Range<S>&)                          whether a range has no node of its own
///   bool end(const Range<S>&, const Range<S> (&)[4])   the same of one whose children would be these
///   void add(const Range<S>&, const Place&)            enters such a range into its parent
/// Single references must end. Where all ranges of fewer than kChildren references do, every node has four
/// children.
template <class S, class Ends> class SubtreeBuilder {
public:
  /// A range that waits for its nodes.
  struct Task {
    Range<S> range;
    Place place;
  };
  /// Three children wait per level, at most.
  static constexpr uint32_t kStackTasks = 3 * kMaxDepth + kChildren;

  /// `spare` has room for as many references as `references` has, `stack` for kStackTasks.
  SubtreeBuilder(uint8_t* image, Reference* references, Reference* spare, Ends& ends, Task* stack)
      : image_(image), references_(references), spare_(spare), ends_(ends), stack_(stack) {}

  /// Writes the nodes of a range from `next` on, and returns the end of what it has written.
  NodeRecord* build(const Range<S>& range, const Place& place, NodeRecord* next) {
    next_ = next;
    waiting_ = 0;
    enter(range, place);
    while (waiting_ != 0) {
      const Task& task = stack_[--waiting_];
      grow(task.range, task.place);
    }
    return next_;
  }

private:
  void enter(const Range<S>& range, const Place& place) {
    if (range.count() == 0)
      place.parent->child[place.slot] = place.parent->leaf[place.slot] = 0;
    else if (ends_.end(range))
      ends_.add(range, place);
    else
      stack_[waiting_++] = {range, place};
  }

  /// Both may lie where the first child will wait.
  void grow(const Range<S>& range, const Place& place) {
    const uint32_t depth = place.depth;
    Range<S> children[kChildren];
    split(range, depth, children);
    if (place.parent) {
      if (ends_.end(range, children)) return ends_.add(range, place);
      place.parent->child[place.slot] =
          static_cast<uint32_t>(reinterpret_cast<const uint8_t*>(next_) - image_);
      place.parent->leaf[place.slot] = 0;
    }
    NodeRecord* node = next_++;
    set_child_bounds<S>(*node, {children[0].box, children[1].box, children[2].box, children[3].box});
    for (uint32_t i = 0; i < kChildren; ++i)
      enter(children[i], {node, i, depth + 1});
  }

  void split(const Range<S>& range, uint32_t depth, Range<S> (&children)[kChildren]) {
    if (range.count() <= kChildren)
      take_apart(range, children);
    else if (range.count() <= Clusters<S>::kMaxReferences)
      Clusters<S>::make(references_, range, children);
    else
      cut(range, depth, children);
  }

  /// A child for each reference, and nothing in those that are left over.
  void take_apart(const Range<S>& range, Range<S> (&children)[kChildren]) {
    for (uint32_t i = 0; i < kChildren; ++i) {
      const uint32_t begin = range.begin + i < range.end ? range.begin + i : range.end;
      children[i] = range_of<S>(references_, begin, begin < range.end ? begin + 1 : begin);
    }
  }

  /// Cuts the child that is likeliest to be hit until there are four.
  void cut(const Range<S>& range, uint32_t depth, Range<S> (&children)[kChildren]) {
    const bool halve = depth >= Ends::kMaxDepthOfCuts;
    children[0] = range;
    float size[kChildren] = {1.0f};
    for (uint32_t n = 1; n < kChildren; ++n) {
      uint32_t widest = kChildren;
      for (uint32_t i = 0; i < n; ++i)
        if (children[i].count() > 1 && (widest == kChildren || size[i] > size[widest])) widest = i;
      const Range<S> whole = children[widest];
      Range<S>& left = children[widest];
      Range<S>& right = children[n];
      if (halve)
        halve_range(references_, whole, left, right);
      else
        split_range(references_, spare_, whole, left, right);
      const uint32_t halves[2] = {widest, n};
      for (const uint32_t i : halves)
        size[i] = halve ? static_cast<float>(children[i].count()) : children[i].box.area();
    }
  }

  uint8_t* image_;
  Reference* references_;
  Reference* spare_;
  Ends& ends_;
  Task* stack_;
  uint32_t waiting_ = 0;
  NodeRecord* next_ = nullptr;
};

} // namespace celltrace::kernel::bvh

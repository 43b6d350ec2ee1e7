// Builder of a subtree's nodes above references, top down. Kernel dialect.
#pragma once

#include "kernel/direct/build_bvh_split.hpp"

namespace celltrace::kernel::bvh {

constexpr uint32_t kChildren = 4; ///< number of children of a node
/// Largest depth of a node; the root is at 0.
constexpr uint32_t kMaxDepth = 48;

/// The place of a subtree in the BVH: child `slot` of `parent`; the subtree's root is at `depth`. The root of
/// the BVH has no parent.
struct Place {
  NodeRecord* parent;
  uint32_t slot;
  uint32_t depth;
};

/// Stores the bounds of a node's children. The bounds are padded by an epsilon relative to the coordinates
/// and to the extent, and are never flat, so that rounding makes no ray that grazes an object miss its node.
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

/// Builds the nodes above references. `Ends` decides where they end:
///   static constexpr uint32_t kMaxSplitDepth           depth from which on ranges are halved
///   bool end(const Range<S>&)                          true if a range ends without a node of its own
///   bool end(const Range<S>&, const Range<S> (&)[4])   the same decision if its children would be these
///   void add(const Range<S>&, const Place&)            stores a range that ends in its parent
/// Halving bounds the depth. A single reference must end. A node has four children; if its range has fewer
/// references, each reference is a child.
template <class S, class Ends> class SubtreeBuilder {
public:
  /// A range whose nodes have not been built.
  struct Task {
    Range<S> range;
    Place place;
  };
  /// Capacity of the stack: depth first, each level leaves at most three of four children on the stack.
  static constexpr uint32_t kStackTasks = 3 * kMaxDepth + kChildren;

  /// Makes a builder. `spare` has room for as many references as `references`, `stack` for kStackTasks.
  SubtreeBuilder(uint8_t* image, Reference* references, Reference* spare, Ends& ends, Task* stack)
      : image_(image), references_(references), spare_(spare), ends_(ends), stack_(stack) {}

  /// Writes the nodes of a range from `next` on, and returns their end.
  NodeRecord* build(const Range<S>& range, const Place& place, NodeRecord* next) {
    next_ = next;
    pending_ = 0;
    add_child(range, place);
    while (pending_ != 0) {
      const Task& task = stack_[--pending_];
      build_node(task.range, task.place);
    }
    return next_;
  }

private:
  /// Stores a child that ends in its parent, or else pushes it.
  void add_child(const Range<S>& range, const Place& place) {
    if (range.count() == 0)
      place.parent->child[place.slot] = place.parent->leaf[place.slot] = 0;
    else if (ends_.end(range))
      ends_.add(range, place);
    else
      stack_[pending_++] = {range, place};
  }

  /// Builds the node of a range and adds its children. The arguments may lie in the stack entry that the
  /// first child overwrites.
  void build_node(const Range<S>& range, const Place& place) {
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
      add_child(children[i], {node, i, depth + 1});
  }

  void split(const Range<S>& range, uint32_t depth, Range<S> (&children)[kChildren]) {
    if (range.count() <= kChildren)
      one_per_child(range, children);
    else
      split_largest(range, depth, children);
  }

  /// Makes a child of each reference; other children are empty.
  void one_per_child(const Range<S>& range, Range<S> (&children)[kChildren]) {
    for (uint32_t i = 0; i < kChildren; ++i) {
      const uint32_t begin = range.begin + i < range.end ? range.begin + i : range.end;
      children[i] = range_of<S>(references_, begin, begin < range.end ? begin + 1 : begin);
    }
  }

  /// Splits the child with the largest surface area, which rays hit most often, until there are four
  /// children.
  void split_largest(const Range<S>& range, uint32_t depth, Range<S> (&children)[kChildren]) {
    const bool halve = depth >= Ends::kMaxSplitDepth;
    children[0] = range;
    float size[kChildren] = {1.0f};
    for (uint32_t n = 1; n < kChildren; ++n) {
      uint32_t largest = kChildren;
      for (uint32_t i = 0; i < n; ++i)
        if (children[i].count() > 1 && (largest == kChildren || size[i] > size[largest])) largest = i;
      const Range<S> whole = children[largest];
      Range<S>& left = children[largest];
      Range<S>& right = children[n];
      if (halve)
        halve_range(references_, whole, left, right);
      else
        split_range(references_, spare_, whole, left, right);
      const uint32_t halves[2] = {largest, n};
      for (const uint32_t i : halves)
        size[i] = halve ? static_cast<float>(children[i].count()) : children[i].box.area();
    }
  }

  uint8_t* image_;
  Reference* references_;
  Reference* spare_;
  Ends& ends_;
  Task* stack_;
  uint32_t pending_ = 0;
  NodeRecord* next_ = nullptr;
};

} // namespace celltrace::kernel::bvh

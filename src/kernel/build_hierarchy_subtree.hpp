// From references to nodes, top down. Kernel dialect.
#pragma once

#include "kernel/build_hierarchy_split.hpp"

namespace celltrace::kernel::hierarchy {

constexpr uint32_t kChildren = 4;
/// No node lies deeper, the root being at 0.
constexpr uint32_t kMaxDepth = 48;
constexpr uint32_t kMaxLeaf = 8;
/// What the test of an object takes, in visits of nodes.
constexpr float kObjectCost = 2.0f;

/// Where a subtree belongs: child `slot` of `parent`, which is at `depth`.
struct Place {
  NodeRecord* parent;
  uint32_t slot;
  uint32_t depth;
};

/// Enters a box into a node. It is a little larger than what is in it, and never flat, so that rounding loses
/// no ray that grazes it.
template <class S> void set_box(NodeRecord& node, uint32_t slot, const LaneBox<S>& box) {
  using F4 = typename S::F4;
  constexpr float kMargin = 1e-6f;
  alignas(16) float e[4];
  const F4 extent = box.max - box.min;
  extent.store(e);
  const F4 reach = S::max(box.max, F4::splat(0.0f) - box.min);
  const F4 margin = reach * F4::splat(kMargin) + F4::splat((e[0] + e[1] + e[2]) * kMargin + 1e-30f);
  alignas(16) float low[4];
  alignas(16) float high[4];
  (box.min - margin).store(low);
  (box.max + margin).store(high);
  for (uint32_t axis = 0; axis < 3; ++axis) {
    node.box[2 * axis][slot] = low[axis];
    node.box[2 * axis + 1][slot] = high[axis];
  }
}

inline void set_empty(NodeRecord& node, uint32_t slot) {
  for (uint32_t axis = 0; axis < 3; ++axis) {
    node.box[2 * axis][slot] = kHuge;
    node.box[2 * axis + 1][slot] = -kHuge;
  }
  node.child[slot] = 0;
  node.count[slot] = 0;
}

/// Builds subtrees over references to objects.
template <class S> class SubtreeBuilder {
public:
  /// `image` is the scene image, at `image + list_offset` the list of object offsets in the order of leaves.
  struct Memory {
    uint8_t* image;
    uint32_t list_offset;
    NodeRecord* next_node; ///< is advanced past the nodes in use
  };

  /// A range that waits for its nodes.
  struct Task {
    Range<S> range;
    Place place;
  };
  /// Three children wait per level, at most.
  static constexpr uint32_t kStackTasks = 3 * kMaxDepth + kChildren;

  /// `stack` has room for kStackTasks.
  SubtreeBuilder(const Memory& memory, Task* stack) : memory_(memory), stack_(stack) {}

  /// Builds the subtree over `range` of `references`, whose places are those in the list. `spare` has room
  /// for all of them.
  void build(Reference* references, Reference* spare, const Range<S>& range, const Place& place) {
    references_ = references;
    spare_ = spare;
    stack_[0] = {range, place};
    waiting_ = 1;
    while (waiting_ != 0) {
      const Task task = stack_[--waiting_];
      grow(task);
    }
  }

  NodeRecord* next_node() const { return memory_.next_node; }

  /// Makes the node above all others. Fewer than four references are a leaf of it.
  void build_root(Reference* references, Reference* spare, const Range<S>& range) {
    NodeRecord* root = memory_.next_node;
    references_ = references;
    if (range.count() >= kChildren) return build(references, spare, range, {nullptr, 0, 0});
    ++memory_.next_node;
    for (uint32_t i = 0; i < kChildren; ++i)
      set_empty(*root, i);
    if (range.count() != 0) add_leaf(range, {root, 0, 0});
  }

private:
  /// Below this depth cuts are in halves, so that kMaxDepth is not reached whatever the objects.
  static constexpr uint32_t kMaxDepthOfCuts = 32;

  void grow(const Task& task) {
    const Range<S>& range = task.range;
    if (range.count() < kChildren) return add_leaf(range, task.place);
    Range<S> children[kChildren];
    split(range, task.place.depth, children);
    if (range.count() <= kMaxLeaf && task.place.parent && leaf_is_cheaper(range, children))
      return add_leaf(range, task.place);
    NodeRecord* node = memory_.next_node++;
    if (task.place.parent) {
      set_box<S>(*task.place.parent, task.place.slot, range.box);
      task.place.parent->child[task.place.slot] = offset_of(node);
      task.place.parent->count[task.place.slot] = 0;
    }
    for (uint32_t i = 0; i < kChildren; ++i)
      stack_[waiting_++] = {children[i], {node, i, task.place.depth + 1}};
  }

  /// Cuts the child that is likeliest to be hit until there are four.
  void split(const Range<S>& range, uint32_t depth, Range<S> (&children)[kChildren]) {
    const bool halve = depth >= kMaxDepthOfCuts;
    children[0] = range;
    float size[kChildren] = {1.0f};
    for (uint32_t n = 1; n < kChildren; ++n) {
      uint32_t widest = kChildren;
      for (uint32_t i = 0; i < n; ++i)
        if (children[i].count() > 1 && (widest == kChildren || size[i] > size[widest])) widest = i;
      const Range<S> cut = children[widest];
      Range<S>& left = children[widest];
      Range<S>& right = children[n];
      if (halve)
        BinnedSplitter<S, 16>::halve(references_, cut, left, right);
      else
        BinnedSplitter<S, 16>::split(references_, spare_, cut, left, right);
      for (uint32_t i : {widest, n})
        size[i] = halve ? static_cast<float>(children[i].count()) : children[i].box.area();
    }
  }

  static bool leaf_is_cheaper(const Range<S>& range, const Range<S> (&children)[kChildren]) {
    float below = 0.0f;
    for (const Range<S>& child : children)
      below += child.box.area() * static_cast<float>(child.count());
    const float area = range.box.area();
    const float saved = area * static_cast<float>(range.count()) - below;
    return !(saved * kObjectCost > area);
  }

  void add_leaf(const Range<S>& range, const Place& place) {
    const uint32_t first = memory_.list_offset + range.begin * 4;
    uint32_t* list = reinterpret_cast<uint32_t*>(memory_.image + first);
    for (uint32_t i = 0; i < range.count(); ++i)
      list[i] = references_[range.begin + i].value;
    set_box<S>(*place.parent, place.slot, range.box);
    place.parent->child[place.slot] = first;
    place.parent->count[place.slot] = range.count();
  }

  uint32_t offset_of(const NodeRecord* node) const {
    return static_cast<uint32_t>(reinterpret_cast<const uint8_t*>(node) - memory_.image);
  }

  Memory memory_;
  Task* stack_;
  uint32_t waiting_ = 0;
  Reference* references_ = nullptr;
  Reference* spare_ = nullptr;
};

} // namespace celltrace::kernel::hierarchy

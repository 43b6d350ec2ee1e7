// Leaves: objects that are tested one by one. Kernel dialect.
#pragma once

#include "kernel/build_hierarchy_subtree.hpp"

namespace celltrace::kernel::hierarchy {

constexpr uint32_t kMaxLeaf = 8;
/// Objects that share a leaf whatever the heuristic says. It has nothing to say of fewer than a node has
/// children.
constexpr uint32_t kCertainLeaf = kChildren - 1;
/// The same where leaves are copied: a node of four leaves of one object each takes more memory than they do,
/// and rays wait longer for it than the tests take.
constexpr uint32_t kCertainCopiedLeaf = kChildren;
/// What the test of an object takes, in visits of nodes.
constexpr float kObjectCost = 2.0f;

/// Ends nodes at objects. Reference i is of the object whose offset belongs at place i of the list.
template <class S> class Leaves {
public:
  static constexpr uint32_t kMaxDepthOfCuts = 32;

  Leaves(uint8_t* image, uint32_t list_offset, const Reference* references, uint32_t certain_leaf)
      : image_(image), list_offset_(list_offset), references_(references), certain_leaf_(certain_leaf) {}

  bool end(const Range<S>& range) const { return range.count() <= certain_leaf_; }

  bool end(const Range<S>& range, const Range<S> (&children)[kChildren]) const {
    if (range.count() > kMaxLeaf) return false;
    const float area = range.box.area();
    float saved = area * static_cast<float>(range.count());
    for (const Range<S>& child : children)
      saved -= child.box.area() * static_cast<float>(child.count());
    return !(saved * kObjectCost > area);
  }

  void add(const Range<S>& range, const Place& place) {
    const uint32_t first = list_offset_ + range.begin * 4;
    uint32_t* list = reinterpret_cast<uint32_t*>(image_ + first);
    for (uint32_t i = 0; i < range.count(); ++i)
      list[i] = references_[range.begin + i].value;
    place.parent->child[place.slot] = first;
    place.parent->count[place.slot] = range.count();
  }

private:
  uint8_t* image_;
  uint32_t list_offset_;
  const Reference* references_;
  uint32_t certain_leaf_;
};

} // namespace celltrace::kernel::hierarchy

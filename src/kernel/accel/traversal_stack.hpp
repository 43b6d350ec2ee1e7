// Parts of the BVH that are still to be visited, nearest last. Kernel dialect.
#pragma once

#include <stdint.h>

namespace celltrace::kernel {

/// Part of the BVH: a node, or a leaf; as in NodeRecord.
struct NodeRef {
  uint32_t child, leaf;

  bool is_leaf() const { return leaf != 0; }
};

/// Packets of a bundle that visit a ref one by one have an entry each, at most `kMostAlone`.
template <uint32_t kMostAlone> class TraversalStack {
public:
  /// A ref that is to be visited, by which rays of a packet or packets of a bundle, and how far away it is
  /// at least. If a packet of a bundle visits it alone: which of its rays meet it.
  struct Entry {
    NodeRef ref;
    uint32_t lanes;
    float enter;
    uint32_t rays;
  };

  uint32_t size() const { return size_; }
  void shrink(uint32_t size) { size_ = size; }
  const Entry& top() const { return entries_[size_ - 1]; }
  const Entry& pop() { return entries_[--size_]; }
  /// In its place among its siblings, which begin at `first`.
  void push(uint32_t first, const Entry& entry) {
    uint32_t place = size_++;
    for (; place > first && entries_[place - 1].enter < entry.enter; --place)
      entries_[place] = entries_[place - 1];
    entries_[place] = entry;
  }

private:
  /// Of each level three children wait, at most, and other packets for the one that is visited. The builder
  /// goes no deeper.
  static constexpr uint32_t kEntries = (4 * kMostAlone - 1) * 48 + 4;

  Entry entries_[kEntries];
  uint32_t size_ = 0;
};

} // namespace celltrace::kernel

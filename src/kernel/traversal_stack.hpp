// The stack of a BVH traversal: nodes and leaves still to be traversed, the nearest on top. Kernel dialect.
#pragma once

#include <stdint.h>

namespace celltrace::kernel {

/// A reference to a node of the BVH or to a leaf, encoded as in NodeRecord.
struct NodeRef {
  uint32_t child, leaf;

  bool is_leaf() const { return leaf != 0; }
};

/// Some leaves below a node of the BVH: bit i of `leaves` is child i.
struct NodeLeaves {
  uint32_t node, leaves; ///< `node` is an offset
};

/// Finds the places of four children in descending order of distance. If distances are equal, the earlier
/// child comes first.
[[gnu::always_inline]] inline void rank_descending(const float (&key)[4], uint32_t (&place)[4]) {
  for (uint32_t i = 0; i < 4; ++i)
    place[i] = i;
  for (uint32_t i = 0; i < 4; ++i)
    for (uint32_t j = i + 1; j < 4; ++j) {
      const uint32_t later_is_farther = key[j] > key[i] ? 1 : 0;
      place[i] += later_is_farther;
      place[j] -= later_is_farther;
    }
}

/// The stack of a traversal. At most `kMaxSplitPackets` packets of a bundle traverse a node separately, each
/// with an entry of its own. `kLevels` is the largest number of levels of the BVH, which the builder limits
/// to 48.
template <uint32_t kMaxSplitPackets, uint32_t kLevels = 48> class TraversalStack {
public:
  /// A node or leaf to traverse. `lanes`: the rays of a packet, or the packets of a bundle, that hit the
  /// node. `enter`: a lower bound of the distances at which they hit it. `rays`: if one packet of a bundle
  /// traverses the node separately, the packet's rays that hit the node, otherwise 0.
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
  /// Inserts an entry by distance among its siblings, which begin at index `first`.
  void push(uint32_t first, const Entry& entry) {
    uint32_t place = size_++;
    for (; place > first && entries_[place - 1].enter < entry.enter; --place)
      entries_[place] = entries_[place - 1];
    entries_[place] = entry;
  }

private:
  /// Number of entries: a node has four children, each with an entry for every packet that splits, and one of
  /// these entries is popped before the next level is pushed.
  static constexpr uint32_t kEntries = (4 * kMaxSplitPackets - 1) * kLevels + 8;

  Entry entries_[kEntries];
  uint32_t size_ = 0;
};

} // namespace celltrace::kernel

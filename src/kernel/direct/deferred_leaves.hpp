// Leaves whose objects are prefetched before they are tested. Kernel dialect.
#pragma once

#include "kernel/traversal_stack.hpp"
#include "kernel/tuning.hpp"

namespace celltrace::kernel {

/// Leaves that rays of a packet hit, with objects that have not been tested yet.
class DeferredLeaves {
public:
  struct Leaf {
    NodeRef ref;
    uint32_t group; ///< rays of the packet that hit the leaf
  };

  uint32_t count() const { return count_; }
  const Leaf& operator[](uint32_t i) const { return leaves_[i]; }
  bool is_full() const { return count_ == tuning::kMaxDeferredLeaves; }
  /// Returns true if the leaves should be tested after the next node has been expanded.
  bool are_enough() const { return count_ >= tuning::kEnoughDeferredLeaves; }
  void add(const NodeRef& ref, uint32_t group) { leaves_[count_++] = {ref, group}; }
  void clear() { count_ = 0; }

private:
  Leaf leaves_[tuning::kMaxDeferredLeaves];
  uint32_t count_ = 0;
};

} // namespace celltrace::kernel

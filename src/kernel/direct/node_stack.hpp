// The stack of a ray tree in main memory. Kernel dialect, for direct memory.
#pragma once

#include "kernel/shading/ray_stack.hpp"

namespace celltrace::kernel {

/// A stack on which nodes are made in place: pushing copies nothing.
class NodeStack {
public:
  /// Uses memory for `nodes` at `memory`, one of which is always next().
  template <class Spu>
  NodeStack(Spu&, ea_t memory, uint32_t nodes, uint32_t, RayNode&)
      : nodes_(reinterpret_cast<RayNode*>(static_cast<uintptr_t>(memory))), capacity_(nodes - 1) {}

  bool empty() const { return size_ == 0; }
  void clear() { size_ = 0; }

  RayNode& next() { return nodes_[size_]; }
  RayNode& next_like(const RayNode& pushed) { return next() = pushed; }

  bool push() {
    if (size_ == capacity_) return false;
    ++size_;
    return true;
  }
  void pop(RayNode& node) { node = nodes_[--size_]; }

  void reset_counters() {}
  uint32_t spilled() const { return 0; }

private:
  RayNode* nodes_;
  uint32_t capacity_;
  uint32_t size_ = 0;
};

} // namespace celltrace::kernel

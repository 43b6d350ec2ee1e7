// The stack of a ray tree in local store. Kernel dialect.
#pragma once

#include "kernel/scalar_work.hpp"
#include "kernel/shading/ray_stack.hpp"

namespace celltrace::kernel {

/// A stack whose first nodes are in local store; at most `spill_nodes` deeper nodes are spilled to main
/// memory.
template <class Spu, uint32_t kResident> class SpillingStack {
public:
  SpillingStack(Spu& spu, ea_t spill, uint32_t spill_nodes, uint32_t resident, RayNode& next)
      : spu_(spu), resident_nodes_(resident),
        resident_(resident != 0 ? spu.template allocate<RayNode>(resident) : nullptr), spill_(spill),
        capacity_(resident_nodes_ + spill_nodes), next_(next) {}

  bool empty() const { return size_ == 0; }
  void clear() { size_ = 0; }

  RayNode& next() { return next_; }
  RayNode& next_like(const RayNode&) { return next_; }

  /// Pushes next(), which keeps its value. Returns false if the stack is full.
  bool push() {
    if (size_ == capacity_) return false;
    if (size_ < resident_nodes_) {
      spu_.compute(scalar_work::kNodeCopy);
      resident_[size_] = next_;
    } else {
      spu_.put(&next_, place(size_), kRayNodeBytes, kTag);
      spu_.wait_all(1u << kTag);
      ++spilled_;
    }
    ++size_;
    return true;
  }

  /// Pops into `node`, which lies in local store.
  void pop(RayNode& node) {
    --size_;
    if (size_ < resident_nodes_) {
      spu_.compute(scalar_work::kNodeCopy);
      node = resident_[size_];
      return;
    }
    spu_.get(&node, place(size_), kRayNodeBytes, kTag);
    spu_.wait_all(1u << kTag);
  }

  void reset_counters() { spilled_ = 0; }
  uint32_t spilled() const { return spilled_; }

private:
  static constexpr uint32_t kTag = 6;

  ea_t place(uint32_t index) const { return spill_ + (index - resident_nodes_) * kRayNodeBytes; }

  Spu& spu_;
  uint32_t resident_nodes_;
  RayNode* resident_;
  ea_t spill_;
  uint32_t capacity_;
  RayNode& next_;
  uint32_t size_ = 0;
  uint32_t spilled_ = 0;
};

} // namespace celltrace::kernel

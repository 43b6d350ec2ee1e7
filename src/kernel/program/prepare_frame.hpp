// PREPARE FRAME: builds the accelerator of a frame. Kernel dialect.
#pragma once

#include "kernel/accel/build_grid.hpp"
#include "kernel/accel/traversal.hpp"

namespace celltrace::kernel {

/// Builds the accelerator. One SPE builds a grid; a BVH is built as the strategy does.
template <class Spu, uint32_t kAccelerators = kAnyAccelerator>
PrepareResult prepare_frame(Spu& spu, const FrameBlock& frame) {
  const bool is_bvh =
      kAccelerators == kBvhOnly || (kAccelerators == kAnyAccelerator &&
                                    static_cast<AcceleratorKind>(frame.accelerator) == AcceleratorKind::bvh);
  if constexpr ((kAccelerators & kBvhOnly) != 0)
    if (is_bvh) return Strategy<Spu>::build_bvh(spu, frame);
  if constexpr ((kAccelerators & kGridOnly) != 0) return build_grid(spu, frame);
  return {0, true};
}

} // namespace celltrace::kernel

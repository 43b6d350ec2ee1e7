// Prepare frame: builds the accelerator that the frame asks for. Kernel dialect.
#pragma once

#include "kernel/accel/build_grid.hpp"
#include "kernel/accel/traversal.hpp"
#include "kernel/direct/build_bvh.hpp"

namespace celltrace::kernel {

namespace detail {

/// The part of this SPE in a build step by step. The first SPE knows the number of nodes from its first step
/// on.
template <class Spu> PrepareResult take_step(Spu& spu, const FrameBlock& frame) {
  uint8_t* const marked = spu.mark();
  bvh::Builder<Spu> builder(spu, frame, spu.id());
  builder.run(frame.prepare_step);
  const uint32_t nodes = spu.id() == 0 ? builder.nodes() : 0;
  spu.release(marked);
  return {nodes, true};
}

} // namespace detail

/// The grid is built by one SPE. A BVH is built by one, or step by step by any number of them; where memory
/// is not direct, the PPE's side has it built elsewhere, and nothing is left to do here.
template <class Spu, uint32_t kAccelerators = kAnyAccelerator>
PrepareResult prepare_frame(Spu& spu, const FrameBlock& frame) {
  if constexpr (kBuildsBvh<Spu> && (kAccelerators & kBvhOnly) != 0) {
    if (static_cast<AcceleratorKind>(frame.accelerator) == AcceleratorKind::bvh) {
      if (frame.prepare_spes != 0) return detail::take_step(spu, frame);
      return {build_bvh(spu, frame), true};
    }
  }
  if constexpr ((kAccelerators & kGridOnly) != 0)
    return build_grid(spu, frame);
  else
    return {0, true};
}

} // namespace celltrace::kernel

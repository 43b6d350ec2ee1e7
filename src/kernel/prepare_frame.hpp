// Prepare frame: builds the accelerator that the frame asks for. Kernel dialect.
#pragma once

#include "kernel/build_grid.hpp"
#include "kernel/build_hierarchy.hpp"

namespace celltrace::kernel {

namespace detail {

/// The part of this SPE in a build by several, in the step that they are at.
template <class Spu> PrepareResult take_step(Spu& spu, const FrameBlock& frame) {
  uint8_t* const marked = spu.mark();
  hierarchy::Builder<Spu> builder(spu, frame, spu.id());
  builder.run(frame.prepare_step);
  const bool last = frame.prepare_step + 1 == hierarchy::kSteps;
  const uint32_t nodes = last ? builder.nodes() : 0;
  spu.release(marked);
  return {nodes, true};
}

} // namespace detail

/// The grid is built by one SPE. A hierarchy is built by one, or by several that take the same step at a
/// time.
template <class Spu> PrepareResult prepare_frame(Spu& spu, const FrameBlock& frame) {
  if constexpr (Spu::direct_memory) {
    if (static_cast<AcceleratorKind>(frame.accelerator) == AcceleratorKind::hierarchy) {
      if (frame.prepare_spes > 1) return detail::take_step(spu, frame);
      return {build_hierarchy(spu, frame), true};
    }
  }
  return build_grid(spu, frame);
}

} // namespace celltrace::kernel

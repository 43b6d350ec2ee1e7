// Prepare frame: builds the accelerator that the frame asks for. Kernel dialect.
#pragma once

#include "kernel/build_grid.hpp"
#include "kernel/build_hierarchy.hpp"

namespace celltrace::kernel {

template <class Spu> PrepareResult prepare_frame(Spu& spu, const FrameBlock& frame) {
  if constexpr (Spu::direct_memory) {
    if (static_cast<AcceleratorKind>(frame.accelerator) == AcceleratorKind::hierarchy)
      return {build_hierarchy(spu, frame), true};
  }
  return build_grid(spu, frame);
}

} // namespace celltrace::kernel

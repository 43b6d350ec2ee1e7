// Pixels and accelerators in direct memory. Kernel dialect.
#pragma once

#include "kernel/accel/prepare_result.hpp"
#include "kernel/accel/traversal.hpp"
#include "kernel/direct/build_bvh.hpp"
#include "kernel/program/pixel_writer.hpp"

namespace celltrace::kernel {

struct DirectProgram {
  static constexpr uint32_t kAccelerators = kAnyAccelerator;

  /// Builds the BVH, with one SPE, or step by step with any number of them.
  template <class Spu> static PrepareResult build_bvh(Spu& spu, const FrameBlock& frame) {
    return frame.prepare_spes != 0 ? take_step(spu, frame)
                                   : PrepareResult{kernel::build_bvh(spu, frame), true};
  }

  template <class S>
  [[gnu::always_inline]] static typename S::I quantise(const FrameBlock& frame, const typename S::F& value) {
    return detail::quantise<S>(frame, value);
  }
  /// Prefetches the cache lines that `rows` of a picture will be written to: another processor may have read
  /// the last picture.
  static void claim_lines(ea_t first, uint32_t rows, uint32_t pitch) {
    const auto* row = reinterpret_cast<const uint8_t*>(static_cast<uintptr_t>(first));
    for (uint32_t y = 0; y < rows; ++y, row += pitch) {
      __builtin_prefetch(row, 1);
      __builtin_prefetch(row + kLineBytes / 2, 1); // a PC's cache lines have half the size
    }
  }

private:
  /// Performs this SPE's part of one step of a build. The first SPE knows the number of nodes from its first
  /// step on.
  template <class Spu> static PrepareResult take_step(Spu& spu, const FrameBlock& frame) {
    uint8_t* const marked = spu.mark();
    bvh::Builder<Spu> builder(spu, frame, spu.id());
    builder.run(frame.prepare_step);
    const uint32_t nodes = spu.id() == 0 ? builder.nodes() : 0;
    spu.release(marked);
    return {nodes, true};
  }
};

} // namespace celltrace::kernel

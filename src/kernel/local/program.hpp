// Pixels and accelerators in local store. Kernel dialect.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/accel/prepare_result.hpp"
#include "kernel/accel/traversal.hpp"
#include "kernel/program/pixel_writer.hpp"

namespace celltrace::kernel {

struct LocalProgram {
  /// Accelerators of a program without a grid.
  static constexpr uint32_t kAccelerators = kBvhOnly;

  /// Does nothing, as the PPE's side has built the BVH.
  template <class Spu> static PrepareResult build_bvh(Spu&, const FrameBlock&) { return {0, true}; }

  /// Quantises one channel; all channels share one copy of the code.
  template <class S>
  CELLTRACE_ONE_COPY static typename S::I quantise(const FrameBlock& frame, const typename S::F& value) {
    return detail::quantise<S>(frame, value);
  }
  static void claim_lines(ea_t, uint32_t, uint32_t) {}
};

} // namespace celltrace::kernel

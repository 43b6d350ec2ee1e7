// What a kernel computes on the emulated SPU, counted: the instructions that a real SPU would issue for the
// operations of the SIMD facade, and those that the kernel declares by compute().
#pragma once

#include "celltrace/spe/simd_host.hpp"
#include "celltrace/spe/spu.hpp"

#include <cstdint>

namespace celltrace::cell_emu {

/// Instructions by the unit that executes them.
struct UnitCounts {
  std::uint64_t fx2 = 0, fx3 = 0, fxb = 0, fp6 = 0, fp7 = 0; ///< even pipe
  std::uint64_t ls = 0, shuf = 0, br = 0;                    ///< odd pipe
};

/// What was computed since the last look; see cycles_of() in pipeline.hpp.
struct OperationCounts {
  /// Each issued once for each of the four quadwords of a packet, which do not depend on each other.
  UnitCounts packet;
  /// Each depends on the one before.
  UnitCounts chain;
  std::uint64_t moves = 0;    ///< loads and stores of quadwords that nothing waits for
  std::uint64_t branches = 0; ///< conditional ones
};

/// Of the kernel that runs on this host thread. Initial-exec and constant-initialised, and everything below
/// is inlined always: then counting is an addition to memory per unit and basic block, some 15 % of the time
/// of a kernel that only computes. Were it a function call per operation, kernels would take twice as long.
inline constinit thread_local OperationCounts operation_counts [[gnu::tls_model("initial-exec")]];

/// The counts of this thread, which start again at 0.
inline OperationCounts take_operation_counts() {
  const OperationCounts taken = operation_counts;
  operation_counts = OperationCounts();
  return taken;
}

/// The policy of HostSimd that counts. Most of the numbers are 0, which is known when this is compiled. The
/// fields are named one by one, as GCC 12's undefined-behaviour sanitizer takes a reference to part of a
/// thread-local for null.
struct CountOperations {
  [[gnu::always_inline]] static void packet(const SpuInstructions& n) {
    if (n.fx2 != 0) operation_counts.packet.fx2 += n.fx2;
    if (n.fx3 != 0) operation_counts.packet.fx3 += n.fx3;
    if (n.fxb != 0) operation_counts.packet.fxb += n.fxb;
    if (n.fp6 != 0) operation_counts.packet.fp6 += n.fp6;
    if (n.fp7 != 0) operation_counts.packet.fp7 += n.fp7;
    if (n.ls != 0) operation_counts.packet.ls += n.ls;
    if (n.shuf != 0) operation_counts.packet.shuf += n.shuf;
    if (n.br != 0) operation_counts.packet.br += n.br;
  }
  [[gnu::always_inline]] static void chain(const SpuInstructions& n) {
    if (n.fx2 != 0) operation_counts.chain.fx2 += n.fx2;
    if (n.fx3 != 0) operation_counts.chain.fx3 += n.fx3;
    if (n.fxb != 0) operation_counts.chain.fxb += n.fxb;
    if (n.fp6 != 0) operation_counts.chain.fp6 += n.fp6;
    if (n.fp7 != 0) operation_counts.chain.fp7 += n.fp7;
    if (n.ls != 0) operation_counts.chain.ls += n.ls;
    if (n.shuf != 0) operation_counts.chain.shuf += n.shuf;
    if (n.br != 0) operation_counts.chain.br += n.br;
  }
};

/// Scalar work that a kernel declares. A scalar load or store comes with a shuffle; those without one move
/// quadwords from one place to another.
[[gnu::always_inline]] inline void count(const ScalarWork& work) {
  const std::uint32_t scalars = work.memory < work.shuffle ? work.memory : work.shuffle;
  CountOperations::chain({.fx2 = work.fixed, .fx3 = work.shift, .fp6 = work.floating, .ls = scalars, .shuf = work.shuffle});
  operation_counts.moves += work.memory - scalars;
  operation_counts.branches += work.branches;
}

} // namespace celltrace::cell_emu

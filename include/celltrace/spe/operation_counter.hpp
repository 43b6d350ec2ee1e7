// Counts the work of a kernel on the emulated SPU: the instructions that a real SPU would issue for the
// operations of the SIMD facade, and the instructions that the kernel declares by compute().
#pragma once

#include "celltrace/spe/spu.hpp"

#include <cstdint>

namespace celltrace::cell_emu {

/// Instructions by the unit that executes them.
struct UnitCounts {
  // Even pipe.
  std::uint64_t fx2 = 0; ///< add, logic, compare, select, load immediate
  std::uint64_t fx3 = 0; ///< word shift
  std::uint64_t fxb = 0; ///< byte operation
  std::uint64_t fp6 = 0; ///< single precision arithmetic
  std::uint64_t fp7 = 0; ///< conversion, interpolation, integer multiply
  // Odd pipe.
  std::uint64_t ls = 0;   ///< load, store
  std::uint64_t shuf = 0; ///< shuffle, quadword rotate, estimate
  std::uint64_t br = 0;   ///< branch, orx
};

/// Instructions counted since the last take_operation_counts(); see cycles of declared scalar work:
/// ScalarWork::waits and misses_of() in pipeline.hpp.
struct OperationCounts {
  /// Instructions that are issued once for each of the four quadwords of a packet; the quadwords do not
  /// depend on each other.
  UnitCounts packet;
  /// Instructions that each depend on the instruction before.
  UnitCounts chain;
  /// Scalar work that kernels declare by compute().
  UnitCounts scalar;
  std::uint64_t waits = 0, misses = 0; ///< cycles
  std::uint64_t moves = 0;             ///< loads and stores among `scalar` that copy whole quadwords
};

/// The counts of the kernel that runs on this host thread. Because of initial-exec, constant initialisation
/// and always-inlined functions, counting takes one addition to memory per unit and basic block, some 15 % of
/// the time of a kernel that only computes. With a function call per operation, kernels would take twice as
/// long.
inline constinit thread_local OperationCounts operation_counts
    [[gnu::tls_model("initial-exec"), gnu::visibility("default")]];

/// Returns the counts of this thread and resets them to 0.
inline OperationCounts take_operation_counts() {
  const OperationCounts taken = operation_counts;
  operation_counts = OperationCounts();
  return taken;
}

// The functions below count the instructions of one operation. Most numbers are 0 at compile time, so that
// their additions vanish. Each field is named, instead of a reference to part of `operation_counts`, because
// GCC 12's undefined-behaviour sanitizer takes such a reference to a thread-local for null.

/// Counts a chain of dependent instructions that is issued for each of the four quadwords of a packet; the
/// four chains are independent of each other.
[[gnu::always_inline]] inline void count_packet(const UnitCounts& n) {
  if (n.fx2 != 0) operation_counts.packet.fx2 += n.fx2;
  if (n.fx3 != 0) operation_counts.packet.fx3 += n.fx3;
  if (n.fxb != 0) operation_counts.packet.fxb += n.fxb;
  if (n.fp6 != 0) operation_counts.packet.fp6 += n.fp6;
  if (n.fp7 != 0) operation_counts.packet.fp7 += n.fp7;
  if (n.ls != 0) operation_counts.packet.ls += n.ls;
  if (n.shuf != 0) operation_counts.packet.shuf += n.shuf;
  if (n.br != 0) operation_counts.packet.br += n.br;
}
/// Counts instructions that are issued once, and each need the result of the instruction before.
[[gnu::always_inline]] inline void count_chain(const UnitCounts& n) {
  if (n.fx2 != 0) operation_counts.chain.fx2 += n.fx2;
  if (n.fx3 != 0) operation_counts.chain.fx3 += n.fx3;
  if (n.fxb != 0) operation_counts.chain.fxb += n.fxb;
  if (n.fp6 != 0) operation_counts.chain.fp6 += n.fp6;
  if (n.fp7 != 0) operation_counts.chain.fp7 += n.fp7;
  if (n.ls != 0) operation_counts.chain.ls += n.ls;
  if (n.shuf != 0) operation_counts.chain.shuf += n.shuf;
  if (n.br != 0) operation_counts.chain.br += n.br;
}

/// Counts scalar work that a kernel declares. A scalar load or store comes with a shuffle. Loads and stores
/// beyond the number of shuffles count as copies of whole quadwords.
[[gnu::always_inline]] inline void count(const ScalarWork& work) {
  if (work.fixed != 0) operation_counts.scalar.fx2 += work.fixed;
  if (work.shift != 0) operation_counts.scalar.fx3 += work.shift;
  if (work.floating != 0) operation_counts.scalar.fp6 += work.floating;
  if (work.memory != 0) operation_counts.scalar.ls += work.memory;
  if (work.shuffle != 0) operation_counts.scalar.shuf += work.shuffle;
  if (work.branches != 0) operation_counts.scalar.br += work.branches;
  if (work.waits != 0) operation_counts.waits += work.waits;
  if (work.misses != 0) operation_counts.misses += work.misses;
  if (work.memory > work.shuffle) operation_counts.moves += work.memory - work.shuffle;
}

} // namespace celltrace::cell_emu

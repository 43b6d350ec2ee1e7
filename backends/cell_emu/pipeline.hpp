// Converts counted operations to cycles of the SPU: in-order issue to two pipes, as a statistical model.
//
// The counts are numbers of instructions by unit, with packets, which are issued four times, apart from
// chains; the order of instructions is unknown. The model (latencies and shares are in TimingParameters):
//
//   issue       The even pipe gets FX2, FX3, FXB, FP6 and FP7, the odd one LS, SHUF, BR and hints. At most
//               the smaller of the two sums can issue together with one of the other pipe; `paired_issue` of
//               it does. Every other instruction takes a cycle of its own.
//   dependency  An instruction of a chain delays the next one for its latency less one cycle. An
//               operation on a packet issues for four cycles, one per quadword, so only the latency
//               beyond these remains. `exposed_latency` of all of this finds nothing else to issue. Scalar
//               work states its own waits.
//   branches    Only scalar work branches, and states the cycles that it loses to branches without hints.
//               Each branch comes with `hints` hints, which go to the odd pipe, with `late_hint` cycles of
//               waiting for one, and with `no_ops` cycles in which only no-ops issue.
//   fetch       Where quadwords are copied, loads and stores leave the local store's port no time to
//               fetch instructions: `late_fetch` cycles each.
//
// Not modelled: contention for the local store.
//
// All sums are integers and the shares multiples of 1/65536, so that every compiler and machine gets the same
// cycles. The shares lie in [0, 16]; there may be 2^42 instructions at a time.
#pragma once

#include "celltrace/spe/operation_counter.hpp"
#include "celltrace/spe/timing.hpp"

#include <algorithm>
#include <cstdint>

namespace celltrace::cell_emu {

namespace detail {

/// Returns the share `part` of `n`, rounded to nearest.
inline std::uint64_t part_of(std::uint64_t n, double part) {
  constexpr std::uint64_t one = 65536;
  const auto multiple = static_cast<std::uint64_t>(part * static_cast<double>(one) + 0.5);
  return (n * multiple + one / 2) / one;
}

/// Returns the sum of the instructions' latencies beyond their issue, if each instruction issues `width`
/// times in a row.
inline std::uint64_t latency_beyond_issue(const UnitCounts& n, std::uint32_t width,
                                          const TimingParameters& timing) {
  const auto beyond = [&](std::uint32_t latency) -> std::uint64_t {
    return latency > width ? latency - width : 0;
  };
  return n.fx2 * beyond(timing.simple_fixed) + n.fx3 * beyond(timing.shift) +
         n.fxb * beyond(timing.byte_operation) + n.fp6 * beyond(timing.float_operation) +
         n.fp7 * beyond(timing.float_conversion) + n.ls * beyond(timing.load_store) +
         n.shuf * beyond(timing.shuffle) + n.br * beyond(timing.branch);
}

} // namespace detail

/// Returns the cycles of the counted operations by their use.
inline SpuCycles cycles_of(const OperationCounts& counts, const TimingParameters& timing) {
  constexpr std::uint32_t quadwords = 4; // in a packet
  const UnitCounts& packet = counts.packet;
  const UnitCounts& chain = counts.chain;
  SpuCycles cycles;
  const UnitCounts& scalar = counts.scalar;
  cycles.fx2 = quadwords * packet.fx2 + chain.fx2 + scalar.fx2;
  cycles.fx3 = quadwords * packet.fx3 + chain.fx3 + scalar.fx3;
  cycles.fxb = quadwords * packet.fxb + chain.fxb;
  cycles.fp6 = quadwords * packet.fp6 + chain.fp6 + scalar.fp6;
  cycles.fp7 = quadwords * packet.fp7 + chain.fp7;
  cycles.ls = quadwords * packet.ls + chain.ls + scalar.ls;
  cycles.shuf = quadwords * packet.shuf + chain.shuf + scalar.shuf;
  cycles.br = quadwords * packet.br + chain.br + scalar.br;

  const std::uint64_t even = cycles.fx2 + cycles.fx3 + cycles.fxb + cycles.fp6 + cycles.fp7;
  cycles.hbr = detail::part_of(scalar.br, timing.hints);
  const std::uint64_t odd = cycles.ls + cycles.shuf + cycles.br + cycles.hbr;
  cycles.dual_cycle = detail::part_of(std::min(even, odd), timing.paired_issue);
  cycles.single_cycle = even + odd - 2 * cycles.dual_cycle;
  cycles.stall_due_to_dependency = detail::part_of(detail::latency_beyond_issue(packet, quadwords, timing) +
                                                       detail::latency_beyond_issue(chain, 1, timing),
                                                   timing.exposed_latency) +
                                   counts.waits;
  cycles.stall_due_to_branch_miss = counts.misses;
  cycles.branch_taken_miss = timing.branch_miss != 0 ? counts.misses / timing.branch_miss : 0;
  cycles.stall_due_to_hint_target = detail::part_of(scalar.br, timing.late_hint);
  cycles.nop_cycle = detail::part_of(scalar.br, timing.no_ops);
  cycles.stall_due_to_prefetch_miss = detail::part_of(counts.moves, timing.late_fetch);
  cycles.total_cycle = cycles.single_cycle + cycles.dual_cycle + cycles.nop_cycle +
                       cycles.stall_due_to_dependency + cycles.stall_due_to_branch_miss +
                       cycles.stall_due_to_hint_target + cycles.stall_due_to_prefetch_miss;
  return cycles;
}

} // namespace celltrace::cell_emu

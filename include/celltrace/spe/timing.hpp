// The timing model of `cell_emu`: every number in one place. Results are a model's, not a machine's.
//
// Units are SPU cycles unless said otherwise. Sources: Kistler, Perrone, Petrini, "Cell Multiprocessor
// Communication Network", IEEE Micro 2006 (290 cycles for a line from SPE to SPE, 25.6 GB/s a port); IBM Cell
// SDK 3.0 programming tutorial (pipelines, branch penalty); Codeplay Offload (about 600 cycles for a cache
// miss).
#pragma once

#include <cstdint>

namespace celltrace {

struct TimingParameters {
  double clock_hz = 3.2e9;
  std::uint32_t cycles_per_tick = 40; ///< of the decrementer: 80 MHz
  unsigned spes = 8;                  ///< of a machine that is not told otherwise

  // --- channels ---
  std::uint32_t channel_write = 1;
  std::uint32_t channel_read = 6;

  // --- DMA ---
  std::uint32_t mfc_issue = 10;          ///< from the write of MFC_Cmd to the start of the command
  std::uint32_t first_line_spe = 290;    ///< latency to another local store or a register
  std::uint32_t first_line_memory = 500; ///< latency to main memory
  std::uint32_t port_line = 16;          ///< one line through an SPE's port: 8 bytes a cycle
  std::uint32_t memory_line = 16;        ///< one line through the memory controller, which all SPEs share
  std::uint32_t bus_line = 2;            ///< one line of the bus's 64 bytes a cycle
  std::uint32_t list_element = 10;
  std::uint32_t lock_line_spe = 290; ///< a lock line that another SPE's atomic unit holds
  std::uint32_t lock_line_memory = 500;
  std::uint32_t ppe_delivery = 200; ///< from the PPE's store until an SPE's register has it
  std::uint32_t ppe_access = 400;   ///< what an access to an SPE's registers costs the PPE

  // --- SPU pipelines: latencies ---
  std::uint32_t simple_fixed = 2;     ///< FX2: add, logic, compare, select
  std::uint32_t shift = 4;            ///< FX3: word rotate and shift
  std::uint32_t byte_operation = 4;   ///< FXB
  std::uint32_t float_operation = 6;  ///< FP6: single precision add, multiply, multiply-add
  std::uint32_t float_conversion = 7; ///< FP7: conversions, integer multiply, interpolate
  std::uint32_t load_store = 6;       ///< LS
  std::uint32_t shuffle = 4;          ///< SHUF: shuffle, quadword rotate, estimates, gather
  std::uint32_t branch = 4;           ///< BR
  std::uint32_t branch_miss = 18;
  /// Part of the latency beyond the issue of an operation's own four quadwords that the code cannot fill.
  double exposed_latency = 0.3;
  /// Part of the taken branches that no hint foresees.
  double missed_branches = 0.3;
  /// Part of the cycles in which both pipes have something to issue that really pair up.
  double paired_issue = 0.45;

  /// A Cell at 3.2 GHz with 8 SPEs.
  static constexpr TimingParameters cell() { return {}; }
  /// A PlayStation 3: 3.192 GHz, a timebase of 79.8 MHz, 6 SPEs for programs.
  static constexpr TimingParameters playstation_3() {
    TimingParameters timing;
    timing.clock_hz = 3.192e9;
    timing.spes = 6;
    return timing;
  }
};

/// Where the cycles of an SPE went, under the names of IBM's full-system simulator.
struct SpuCycles {
  std::uint64_t total_cycle = 0;
  std::uint64_t single_cycle = 0; ///< one instruction issued
  std::uint64_t dual_cycle = 0;   ///< two instructions issued
  std::uint64_t stall_due_to_dependency = 0;
  std::uint64_t stall_due_to_branch_miss = 0;
  std::uint64_t channel_stall_cycle = 0;    ///< waits for DMA, mailboxes, signals and events
  std::uint64_t stall_due_to_injection = 0; ///< of faults that the configuration asked for
  // Instructions by unit.
  std::uint64_t fx2 = 0, fx3 = 0, fxb = 0, fp6 = 0, fp7 = 0; ///< even pipe
  std::uint64_t ls = 0, shuf = 0, br = 0, spr = 0;           ///< odd pipe; spr: channel instructions
  std::uint64_t branch_taken_miss = 0;                       ///< mispredicted branches

  std::uint64_t instructions() const { return fx2 + fx3 + fxb + fp6 + fp7 + ls + shuf + br + spr; }
  SpuCycles& operator+=(const SpuCycles& more);
};

inline SpuCycles& SpuCycles::operator+=(const SpuCycles& more) {
  total_cycle += more.total_cycle;
  single_cycle += more.single_cycle;
  dual_cycle += more.dual_cycle;
  stall_due_to_dependency += more.stall_due_to_dependency;
  stall_due_to_branch_miss += more.stall_due_to_branch_miss;
  channel_stall_cycle += more.channel_stall_cycle;
  stall_due_to_injection += more.stall_due_to_injection;
  fx2 += more.fx2;
  fx3 += more.fx3;
  fxb += more.fxb;
  fp6 += more.fp6;
  fp7 += more.fp7;
  ls += more.ls;
  shuf += more.shuf;
  br += more.br;
  spr += more.spr;
  branch_taken_miss += more.branch_taken_miss;
  return *this;
}

} // namespace celltrace

// The parameters of the timing model of `cell_emu` and `cell_sim`. A model's times differ from a real
// machine's.
//
// Units are SPU cycles unless said otherwise. Sources: Kistler, Perrone, Petrini, "Cell Multiprocessor
// Communication Network", IEEE Micro 2006 (290 cycles for a line from SPE to SPE, 25.6 GB/s a port); IBM Cell
// SDK 3.0 programming tutorial (pipelines, branch penalty); Codeplay Offload (about 600 cycles for a cache
// miss).
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <utility>

namespace celltrace {

struct TimingParameters {
  double clock_hz = 3.2e9;            ///< 1000 to 1e12
  std::uint32_t cycles_per_tick = 40; ///< cycles of one tick of the decrementer (80 MHz); at least 1
  /// Number of SPEs of a machine unless MachineConfig::spes sets it; 1 to 256.
  unsigned spes = 8;

  // --- channels ---
  std::uint32_t channel_write = 1;
  std::uint32_t channel_read = 6;

  // --- DMA ---
  std::uint32_t mfc_issue = 10;          ///< from the write of MFC_Cmd to the start of the command
  std::uint32_t first_line_spe = 290;    ///< latency to another local store or a register
  std::uint32_t first_line_memory = 500; ///< latency to main memory
  std::uint32_t port_line = 16;          ///< time of one line through an SPE's port: 8 bytes a cycle
  /// Time of one line through the memory controller, which all SPEs share.
  std::uint32_t memory_line = 16;
  std::uint32_t bus_line = 2; ///< time of one line on the bus: 64 bytes a cycle
  std::uint32_t list_element = 10;
  /// Time of a lock-line command if another SPE's atomic unit holds the line.
  std::uint32_t lock_line_spe = 290;
  std::uint32_t lock_line_memory = 500;
  std::uint32_t ppe_delivery = 200; ///< from the PPE's store until an SPE's register has it
  std::uint32_t ppe_access = 400;   ///< cost to the PPE of an access to an SPE's registers

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

  // --- machine code: `cell_sim` ---
  std::uint32_t double_operation = 13; ///< FPD; both pipes issue nothing during its first cycles
  std::uint32_t double_issue_block = 6;
  std::uint32_t hint_latency =
      15; ///< from a hint until instructions at its target can be issued; an earlier branch waits
  /// Least number of instructions from a hint to its branch; a closer branch is not hinted.
  std::uint32_t hint_distance = 8;
  std::uint32_t fetch_miss = 9; ///< stall if the next 32 instructions were not fetched in time
  /// A call that the PPE executes for the program: two system calls and a context switch.
  std::uint32_t ppe_call = 20000;

  // --- counted operations: `cell_emu`; 0 to 1 each ---
  // Calibrated by cell_sim with tools/calibrate-charges.sh.
  /// Share of an operation's latency, beyond the issue of its own four quadwords, that other code cannot
  /// fill.
  double exposed_latency = 0.613;
  /// Share of cycles with dual issue among cycles in which both pipes have an instruction to issue.
  double paired_issue = 0.376;
  /// Hint instructions per branch.
  double hints = 0.936;
  /// Cycles per branch spent waiting for a hint that comes too late.
  double late_hint = 0.23;
  /// Cycles per branch in which only no-ops are issued.
  double no_ops = 0.102;
  /// Cycles per copied quadword spent waiting for instructions to be fetched.
  double late_fetch = 0.039;

  /// Returns the parameters of a Cell at 3.2 GHz with 8 SPEs.
  static constexpr TimingParameters cell() { return {}; }
  /// Returns the parameters of a PlayStation 3: 3.192 GHz, a timebase of 79.8 MHz, 6 SPEs for programs.
  static constexpr TimingParameters playstation_3() {
    TimingParameters timing;
    timing.clock_hz = 3.192e9;
    timing.spes = 6;
    return timing;
  }
};

/// The cycles of an SPE by their use, under the names of IBM's full-system simulator. Members that `cell_emu`
/// cannot observe are always 0 there.
struct SpuCycles {
  /// Sum of the cycles and stalls below, up to stall_due_to_injection.
  std::uint64_t total_cycle = 0;
  std::uint64_t single_cycle = 0; ///< cycles in which one instruction was issued
  std::uint64_t dual_cycle = 0;   ///< cycles in which two instructions were issued
  std::uint64_t nop_cycle = 0;    ///< cycles in which only no-ops were issued
  std::uint64_t stall_due_to_dependency = 0;
  std::uint64_t stall_due_to_branch_miss = 0;
  std::uint64_t stall_due_to_prefetch_miss = 0; ///< instructions were not fetched in time
  std::uint64_t stall_due_to_hint_target = 0;   ///< a hint came too late to be of full use
  std::uint64_t stall_due_to_fp_resource = 0;   ///< a double precision operation kept both pipes
  std::uint64_t stall_due_to_ls_contention = 0; ///< loads and stores waited for DMA's accesses to local store
  std::uint64_t channel_stall_cycle = 0;        ///< waits for DMA, mailboxes, signals and events
  std::uint64_t stall_due_to_injection = 0;     ///< delays from configured faults
  // Numbers of issued instructions, by unit.
  std::uint64_t fx2 = 0, fx3 = 0, fxb = 0, fp6 = 0, fp7 = 0, fpd = 0; ///< even pipe
  std::uint64_t ls = 0, shuf = 0, br = 0, hbr = 0, spr = 0;           ///< odd pipe; spr: channel instructions
  std::uint64_t nop = 0;                                              ///< no-ops of both pipes
  // Parts of stall_due_to_dependency, by the unit whose result was waited for.
  std::uint64_t dependency_fx2 = 0, dependency_fx3 = 0, dependency_fxb = 0, dependency_fp6 = 0,
                dependency_fp7 = 0, dependency_fpd = 0, dependency_ls = 0, dependency_shuf = 0,
                dependency_br = 0, dependency_spr = 0;
  std::uint64_t branch_taken = 0;      ///< branches that were taken
  std::uint64_t branch_taken_miss = 0; ///< branches that were not predicted by a hint or by falling through
  std::uint64_t hint_hit = 0;          ///< branches to the address that a hint predicted

  /// Returns the number of instructions without no-ops.
  std::uint64_t instructions() const {
    return fx2 + fx3 + fxb + fp6 + fp7 + fpd + ls + shuf + br + hbr + spr;
  }
  SpuCycles& operator+=(const SpuCycles& more);
};

/// The members of SpuCycles with their names.
inline constexpr std::pair<const char*, std::uint64_t SpuCycles::*> kSpuCycleCounts[] = {
    {"total_cycle", &SpuCycles::total_cycle},
    {"single_cycle", &SpuCycles::single_cycle},
    {"dual_cycle", &SpuCycles::dual_cycle},
    {"nop_cycle", &SpuCycles::nop_cycle},
    {"stall_due_to_dependency", &SpuCycles::stall_due_to_dependency},
    {"stall_due_to_branch_miss", &SpuCycles::stall_due_to_branch_miss},
    {"stall_due_to_prefetch_miss", &SpuCycles::stall_due_to_prefetch_miss},
    {"stall_due_to_hint_target", &SpuCycles::stall_due_to_hint_target},
    {"stall_due_to_fp_resource", &SpuCycles::stall_due_to_fp_resource},
    {"stall_due_to_ls_contention", &SpuCycles::stall_due_to_ls_contention},
    {"channel_stall_cycle", &SpuCycles::channel_stall_cycle},
    {"stall_due_to_injection", &SpuCycles::stall_due_to_injection},
    {"fx2", &SpuCycles::fx2},
    {"fx3", &SpuCycles::fx3},
    {"fxb", &SpuCycles::fxb},
    {"fp6", &SpuCycles::fp6},
    {"fp7", &SpuCycles::fp7},
    {"fpd", &SpuCycles::fpd},
    {"ls", &SpuCycles::ls},
    {"shuf", &SpuCycles::shuf},
    {"br", &SpuCycles::br},
    {"hbr", &SpuCycles::hbr},
    {"spr", &SpuCycles::spr},
    {"nop", &SpuCycles::nop},
    {"dependency_fx2", &SpuCycles::dependency_fx2},
    {"dependency_fx3", &SpuCycles::dependency_fx3},
    {"dependency_fxb", &SpuCycles::dependency_fxb},
    {"dependency_fp6", &SpuCycles::dependency_fp6},
    {"dependency_fp7", &SpuCycles::dependency_fp7},
    {"dependency_fpd", &SpuCycles::dependency_fpd},
    {"dependency_ls", &SpuCycles::dependency_ls},
    {"dependency_shuf", &SpuCycles::dependency_shuf},
    {"dependency_br", &SpuCycles::dependency_br},
    {"dependency_spr", &SpuCycles::dependency_spr},
    {"branch_taken", &SpuCycles::branch_taken},
    {"branch_taken_miss", &SpuCycles::branch_taken_miss},
    {"hint_hit", &SpuCycles::hint_hit},
};
static_assert(sizeof(SpuCycles) == std::size(kSpuCycleCounts) * sizeof(std::uint64_t), "a count has no name");

inline SpuCycles& SpuCycles::operator+=(const SpuCycles& more) {
  // Adds arrays, which the compiler vectorises.
  using Counts = std::array<std::uint64_t, std::size(kSpuCycleCounts)>;
  Counts sums = std::bit_cast<Counts>(*this);
  const Counts terms = std::bit_cast<Counts>(more);
  for (std::size_t i = 0; i < sums.size(); ++i)
    sums[i] += terms[i];
  return *this = std::bit_cast<SpuCycles>(sums);
}

} // namespace celltrace

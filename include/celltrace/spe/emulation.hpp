// Options of `cell_emu` and `cell_sim`: the schedule of a machine, when data move, which faults are injected
// and which rules are checked.
#pragma once

#include "celltrace/spe/diagnostic.hpp"
#include "celltrace/spe/recorder.hpp"
#include "celltrace/spe/timing.hpp"

#include <cstdint>
#include <iosfwd>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace celltrace {

/// The order in which SPEs run.
enum class Schedule : unsigned char {
  /// One host thread per SPE; the host decides.
  free,
  /// One SPE at a time on the PPE's own thread, so that a run can be repeated bit for bit, on any machine.
  lockstep,
};

/// The time when the data of a queued DMA command move. The hardware permits all of them; a program that
/// depends on one of them is wrong.
enum class TransferTime : unsigned char {
  at_issue, ///< as early as fences and barriers allow
  at_wait,  ///< for gets, when the program observes their completion; for other commands, when the timing
            ///< model completes them
  random,   ///< at a seeded random time in between; unordered commands complete in seeded random order
};

/// Delays that the architecture allows, drawn at random from the seed. All zero: no delays.
struct Faults {
  /// Largest factor by which an SPE's work is slowed down; each SPE draws one from 1 up. 1 to 1000.
  double slowest_spe = 1;
  /// Probability, 0 to 1, that an SPE stands still at a channel access, for up to `longest_pause`
  /// cycles.
  double pause_probability = 0;
  std::uint32_t longest_pause = 0;
  /// Most cycles by which DMA commands, and signals and mailbox words of SPEs, are delayed.
  std::uint32_t dma_delay = 0;
  /// Most cycles by which a word from the PPE is delayed. Words to one SPE stay in order.
  std::uint32_t delivery_delay = 0;

  /// Returns a moderate mix of all delays.
  static constexpr Faults mixed() { return {4.0, 0.002, 20000, 5000, 5000}; }
};

/// An object in main memory: a command that touches it must stay within it.
struct MemoryObject {
  ea_t ea = 0;
  std::uint64_t bytes = 0; ///< at least 1
  std::string name;        ///< name for diagnostics; may be empty
};

/// Options of a machine. make_machine() throws InputError for values out of the ranges that are stated here
/// and in timing.hpp, for NaN, and for enumerators that do not exist.
struct EmulationConfig {
  Schedule schedule = Schedule::free;
  /// Seed of all random numbers.
  std::uint64_t seed = 0;
  /// Lockstep: true draws the next SPE from the seed; false takes the SPE that is behind in virtual time.
  bool explore = false;
  TransferTime transfers = TransferTime::at_wait;
  Faults faults;
  TimingParameters timing;
  /// Reactions to broken rules, in place of default_action().
  std::map<Rule, Action> actions;
  /// Virtual cycles, waits included, after which a running program breaks Rule::time_limit; 0: no limit.
  std::uint64_t cycle_limit = 0;
  /// Seconds of the host, 0 to 1e9, after which a program breaks Rule::time_limit; 0: no limit. The time
  /// passes for all programs at once, also while others run.
  double seconds_limit = 0;
  /// Objects that are registered from the start; see Machine::register_object(). No two may overlap.
  std::vector<MemoryObject> objects;
  /// `cell_emu`: true leaves 128 bytes free behind each allocation of a program. The arena grows by as many
  /// bytes, into the memory reserved for the stack, while there is room. Stores into the free bytes, and
  /// right behind the last allocation, break Rule::allocation_overrun.
  bool red_zones = false;
  /// Lockstep: receives the trace, as Chrome trace JSON; must outlive the machine. Null: no trace.
  std::ostream* trace = nullptr;
  /// `cell_emu`: receives the words that kernels record; must outlive the machine. Null: nothing is recorded.
  SpeRecorder* recorder = nullptr;
};

} // namespace celltrace

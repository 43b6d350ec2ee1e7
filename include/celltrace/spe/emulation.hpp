// Options of the emulated machines `cell_emu` and `cell_sim`: schedule, times of DMA transfers, injected
// faults and checked rules.
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
  /// One SPE at a time, on the PPE's own thread: a run can be repeated bit for bit, on any host.
  lockstep,
};

/// The time at which the data of a queued DMA command move. All these times occur on hardware; a program that
/// depends on one of these times is wrong.
enum class TransferTime : unsigned char {
  at_issue, ///< as early as fences and barriers allow
  at_wait,  ///< gets when the program observes their completion, other commands when the timing model
            ///< completes them
  random,   ///< at a time between at_issue and at_wait, random from the seed, as is the order of unordered
            ///< commands
};

/// Delays that the architecture allows, drawn at random from the seed. By default there are none.
struct Faults {
  /// Largest factor by which an SPE's work is slowed down, 1 to 1000; each SPE draws its factor between 1 and
  /// this.
  double slowest_spe = 1;
  /// Probability, 0 to 1, that an SPE stands still at a channel access, for up to `longest_pause`
  /// cycles.
  double pause_probability = 0;
  std::uint32_t longest_pause = 0;
  /// Largest delay of DMA commands, and of signals and mailbox words that SPEs send, in cycles.
  std::uint32_t dma_delay = 0;
  /// Largest delay of a word from the PPE, in cycles. Words to one SPE stay in order.
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
  /// Lockstep: true chooses the SPE that runs next at random, from the seed; false chooses the SPE whose
  /// virtual time is least.
  bool explore = false;
  TransferTime transfers = TransferTime::at_wait;
  Faults faults;
  TimingParameters timing;
  /// Reactions to broken rules, in place of default_action().
  std::map<Rule, Action> actions;
  /// Virtual cycles, waits included, after which a program breaks Rule::time_limit; 0: no limit.
  std::uint64_t cycle_limit = 0;
  /// Seconds of the host's time, 0 to 1e9, after which a program breaks Rule::time_limit; 0: no limit. The
  /// time also passes while other programs run.
  double seconds_limit = 0;
  /// Objects that are registered from the start; see Machine::register_object(). No two may overlap.
  std::vector<MemoryObject> objects;
  /// `cell_emu`: true leaves 128 bytes free behind each allocation of a program. Stores into these bytes, and
  /// right behind the last allocation, break Rule::allocation_overrun. The arena grows by the free bytes into
  /// the memory reserved for the stack, while there is room.
  bool red_zones = false;
  /// Lockstep: receives the trace, as Chrome trace JSON; must outlive the machine. Null: no trace.
  std::ostream* trace = nullptr;
  /// `cell_emu`: receives the words that kernels record; must outlive the machine. Null: nothing is recorded.
  SpeRecorder* recorder = nullptr;
};

} // namespace celltrace

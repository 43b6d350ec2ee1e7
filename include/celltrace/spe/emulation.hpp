// How `cell_emu` and `cell_sim` run a machine: its schedule, when data moves, what goes wrong on purpose,
// what is checked.
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

/// Who runs when.
enum class Schedule : unsigned char {
  /// A host thread per SPE; they run as they like.
  free,
  /// One SPE at a time on the PPE's own thread, so that a run can be repeated bit for bit, on any machine.
  lockstep,
};

/// When the data of a queued DMA command move. All are legal on the hardware; a program that depends on one
/// of them is wrong.
enum class TransferTime : unsigned char {
  at_issue, ///< as early as fences and barriers allow
  at_wait,  ///< gets when their completion is observed, everything else when the model says that it is done
  random,   ///< at a seeded random point in between; unordered commands complete in seeded random order
};

/// What the architecture allows to be slow, drawn at random from the seed. All zero: nothing is.
struct Faults {
  /// Every SPE's work takes 1 to this many times as long; 1 to 1000.
  double slowest_spe = 1;
  /// At a channel access, with this probability (0 to 1), an SPE stands still for up to `longest_pause`
  /// cycles.
  double pause_probability = 0;
  std::uint32_t longest_pause = 0;
  /// A DMA command takes up to this many cycles longer; so do the signals and mailbox words that SPEs send.
  std::uint32_t dma_delay = 0;
  /// A word from the PPE takes up to this many cycles longer. Words to one SPE stay in order.
  std::uint32_t delivery_delay = 0;

  /// A bit of everything.
  static constexpr Faults mixed() { return {4.0, 0.002, 20000, 5000, 5000}; }
};

/// An object in main memory, of which a command that touches it must not leave it.
struct MemoryObject {
  ea_t ea = 0;
  std::uint64_t bytes = 0; ///< at least 1
  std::string name;        ///< for diagnostics; may be empty
};

/// How to run a machine. make_machine() throws InputError for values out of the ranges that are stated here
/// and in timing.hpp, for what is no number, and for enumerators that do not exist.
struct EmulationConfig {
  Schedule schedule = Schedule::free;
  /// Everything that is drawn at random derives from it.
  std::uint64_t seed = 0;
  /// Lockstep: the next SPE is drawn from the seed instead of being the one that is behind in virtual time.
  bool explore = false;
  TransferTime transfers = TransferTime::at_wait;
  Faults faults;
  TimingParameters timing;
  /// Where default_action() does not suit.
  std::map<Rule, Action> actions;
  /// A program that runs for so many virtual cycles, waits included, breaks Rule::time_limit; 0: none.
  std::uint64_t cycle_limit = 0;
  /// The same for seconds of the host, 0 to 1e9. They pass for all programs at once, also while others run.
  double seconds_limit = 0;
  /// Objects that are registered from the start; see Machine::register_object(). None may overlap another.
  std::vector<MemoryObject> objects;
  /// `cell_emu`: 128 bytes are left free behind each allocation of a program; the arena grows by as many,
  /// into what is kept for the stack, while there is room. Stores into them, and right behind the last
  /// allocation, break Rule::allocation_overrun.
  bool red_zones = false;
  /// Lockstep: where the trace goes, as Chrome trace JSON; it must outlive the machine. Null: nowhere.
  std::ostream* trace = nullptr;
  /// `cell_emu`: takes what the kernels record; it must outlive the machine. Null: nothing is recorded.
  SpeRecorder* recorder = nullptr;
};

} // namespace celltrace

// One SPE of the machine: its registers, its MFC, its counters, and the state of its program.
#pragma once

#include "backends/cell_emu/counters.hpp"
#include "backends/cell_emu/mfc.hpp"
#include "backends/cell_emu/problem_state.hpp"

#include <atomic>
#include <memory>
#include <string>
#include <vector>

namespace celltrace::cell_emu {

struct Spe {
  Spe(unsigned spe, const SignalMode (&modes)[2], StallObserver& observer, const MfcContext& context,
      DmaTiming& timing)
      : id(spe), state(spe, modes, observer, context.trace), mfc(spe, context, timing, state, counters) {}

  const unsigned id;
  ProblemState state;
  Counters counters;
  Mfc mfc;
  Cycle now = 0; ///< the SPU's virtual time; valid while its program does not run

  // The scheduler writes `running` and `signal`.
  static constexpr std::uint32_t kNoSignal = ~0u;
  std::atomic<bool> running{false};
  /// Stop code of a program that stopped with a signal and waits to be resumed; else kNoSignal.
  std::atomic<std::uint32_t> signal{kNoSignal};

  /// Returns true if the program can be resumed. A program that was interrupted in its stop cannot: it is
  /// about to end.
  bool paused() const { return signal != kNoSignal && !state.interrupted(); }

  // Written by the program, read when it does not run.
  std::uint32_t exit_code = 0;
  std::string error; ///< error of the last run; empty: none
};

using Spes = std::vector<std::unique_ptr<Spe>>;

} // namespace celltrace::cell_emu

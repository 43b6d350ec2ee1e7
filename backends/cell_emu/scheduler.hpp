// Schedulers decide in which order SPEs and the PPE run.
//
// SPEs announce the virtual time of every action that others can notice, and where they wait;
// the PPE calls enter() with every access to the machine. The schedule decides about everything in between.
#pragma once

#include "backends/cell_emu/spe.hpp"

#include <atomic>
#include <chrono>
#include <functional>

namespace celltrace::cell_emu {

/// Accesses of the PPE to a machine in which nothing can happen before they count as a deadlock.
constexpr std::uint64_t kIdleEntries = 1000000;

class Scheduler : public StallObserver {
public:
  /// The run of a kernel on an SPE, from its start to its end. Must not throw.
  using Program = std::function<void()>;
  using Ready = std::function<bool()>;

  // --- SPU side, called by the program of `spe` ---

  /// Returns when it is this SPE's turn to act at `now`; earlier actions of its own MFC have happened then.
  /// May throw RuleViolation for a command of its MFC.
  virtual void reach(Spe& spe, Cycle now) = 0;
  /// Returns when the next action of the SPE's MFC, at `at`, or another event for the SPE has
  /// happened.
  virtual void await_mfc(Spe& spe, Cycle at) = 0;
  /// Waits until `stall.channel` has a count, until `deadline`, or until an interrupt; at least once. Returns
  /// the time of the end.
  virtual Cycle stall(Spe& spe, const ProblemState::Stall& stall, Cycle now, Cycle deadline) = 0;
  /// Notifies the PPE of a word in an outbound mailbox.
  virtual void ring() = 0;
  /// Waits until a program that stopped with a signal is resumed. Throws SpeError if it is interrupted.
  virtual Cycle pause(Spe& spe, std::uint32_t code, Cycle now) = 0;

  // --- PPE side ---

  /// Lets the program run from now on.
  virtual void start(Spe& spe, Program program) = 0;
  /// Resumes a program that waits in pause().
  virtual void resume(Spe& spe) = 0;
  /// Announces that the PPE is about to read or change the machine. Returns the PPE's time.
  virtual Cycle enter() = 0;
  /// As enter(), for a word that the PPE sends. Returns the time of its arrival.
  virtual Cycle post() = 0;
  /// As post(), without giving others a turn first.
  virtual Cycle post_at_once() = 0;
  /// Blocks the PPE until `ready()`, which may change when an SPE stops or its registers change. Returns
  /// false if `timeout` passes. Throws SpeError if nothing can ever make it ready.
  virtual bool wait(const Ready& ready, std::optional<std::chrono::milliseconds> timeout,
                    const std::string& what) = 0;
  /// Ends every program that stalls, polls or is stopped, now and from now on; their errors end with
  /// `because`.
  virtual void break_off(const std::string& because) = 0;
  /// As break_off({}), from any thread.
  virtual void interrupt() noexcept = 0;
  /// Waits until no program runs any more, after interrupt().
  virtual void shut_down() = 0;
  /// Releases the host resources of a program that has ended.
  virtual void collect(Spe& spe) = 0;
  /// Returns how often programs have ended or stopped with a signal. From any thread.
  unsigned stops() const { return stops_.load(); }

protected:
  void count_stop() { ++stops_; }

private:
  std::atomic<unsigned> stops_{0};
};

/// Reports a deadlock for each SPE that stalls. Returns the text of the error.
std::string report_deadlock(Spes& spes, DiagnosticLog& log, const std::string& ppe_waits_for);

} // namespace celltrace::cell_emu

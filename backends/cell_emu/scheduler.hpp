// Schedulers decide in which order SPEs and the PPE run.
//
// An SPE calls a scheduler before every action that other processors can notice, with the action's virtual
// time, and whenever it waits. The PPE calls enter() before every access to the machine. The scheduler
// decides which SPEs run in between.
#pragma once

#include "backends/cell_emu/spe.hpp"

#include <atomic>
#include <chrono>
#include <functional>

namespace celltrace::cell_emu {

/// Number of accesses by the PPE to a machine in which nothing can happen that counts as a deadlock.
constexpr std::uint64_t kIdleEntries = 1000000;

class Scheduler : public StallObserver {
public:
  /// The run of a kernel on an SPE, from its start to its end. Must not throw.
  using Program = std::function<void()>;
  using Ready = std::function<bool()>;

  // --- SPU side, called by the program of `spe` ---

  /// Waits until it is this SPE's turn to act at `now`; by then earlier actions of its own MFC have happened.
  /// May throw RuleViolation because of a command in the MFC.
  virtual void reach(Spe& spe, Cycle now) = 0;
  /// Waits until the next action of the SPE's MFC, at `at`, or another event for the SPE has happened.
  virtual void await_mfc(Spe& spe, Cycle at) = 0;
  /// Waits until the count of `stall.channel` is not 0, until `deadline`, or until an interrupt; may also
  /// return earlier. Returns the virtual time of the end.
  virtual Cycle stall(Spe& spe, const ProblemState::Stall& stall, Cycle now, Cycle deadline) = 0;
  /// Notifies the PPE of a word in an outbound mailbox.
  virtual void ring() = 0;
  /// Waits until a program that stopped with a signal is resumed. Throws SpeError if it is interrupted.
  virtual Cycle pause(Spe& spe, std::uint32_t code, Cycle now) = 0;

  // --- PPE side ---

  /// Starts a program.
  virtual void start(Spe& spe, Program program) = 0;
  /// Resumes a program that waits in pause().
  virtual void resume(Spe& spe) = 0;
  /// Announces that the PPE is about to read or change the machine. Returns the PPE's time.
  virtual Cycle enter() = 0;
  /// As enter(), for a word that the PPE sends. Returns the virtual time at which the word arrives.
  virtual Cycle post() = 0;
  /// As post(), but gives no SPE a turn before.
  virtual Cycle post_at_once() = 0;
  /// Blocks the PPE until `ready()` is true, which is checked when an SPE stops or its registers change.
  /// Returns false if `timeout` passes. Throws SpeError if `ready()` can never become true.
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
  /// Returns the number of times that programs have ended or stopped with a signal. From any thread.
  unsigned stops() const { return stops_.load(); }

protected:
  void count_stop() { ++stops_; }

private:
  std::atomic<unsigned> stops_{0};
};

/// Reports a deadlock for each SPE that stalls. Returns the error's text.
std::string report_deadlock(Spes& spes, DiagnosticLog& log, const std::string& ppe_waits_for);

} // namespace celltrace::cell_emu

// Who runs when: SPEs against each other and against the PPE.
//
// SPEs say before every action that others can notice at what virtual time it happens, and where they wait;
// the PPE enters with every access to the machine. What lies in between is the schedule's.
#pragma once

#include "backends/cell_emu/spe.hpp"

#include <atomic>
#include <chrono>
#include <functional>

namespace celltrace::cell_emu {

/// Looks of the PPE at a machine in which nothing can happen, before that counts as a deadlock.
constexpr std::uint64_t kIdleEntries = 1000000;

class Scheduler : public StallObserver {
public:
  /// What an SPE runs: the kernel from its start to its end. Lets no exception out.
  using Program = std::function<void()>;
  using Ready = std::function<bool()>;

  // --- SPU side, called by the program of `spe` ---

  /// Returns when it is this SPE's turn to act at `now`; what its own MFC does until then has happened. May
  /// throw RuleViolation for a command of its MFC.
  virtual void reach(Spe& spe, Cycle now) = 0;
  /// Returns when what the SPE's MFC does next, at `at`, or something else that concerns the SPE has
  /// happened.
  virtual void await_mfc(Spe& spe, Cycle at) = 0;
  /// Waits until `stall.channel` has a count, until `deadline`, or until an interrupt; at least once. Returns
  /// the time at which that was.
  virtual Cycle stall(Spe& spe, const ProblemState::Stall& stall, Cycle now, Cycle deadline) = 0;
  /// An outbound mailbox has a word for the PPE.
  virtual void ring() = 0;
  /// The program has stopped with a signal: returns when it is resumed. Throws SpeError if it is interrupted.
  virtual Cycle pause(Spe& spe, std::uint32_t code, Cycle now) = 0;

  // --- PPE side ---

  /// Lets the program run, from now on.
  virtual void start(Spe& spe, Program program) = 0;
  /// Sets going again what pause()s.
  virtual void resume(Spe& spe) = 0;
  /// The PPE is about to look at the machine or to change it. Returns its time.
  virtual Cycle enter() = 0;
  /// As enter(), for a word that the PPE sends off. Returns the time at which it arrives.
  virtual Cycle post() = 0;
  /// The same without giving way to anybody first.
  virtual Cycle post_at_once() = 0;
  /// Blocks the PPE until `ready()`, which may change when an SPE stops or its registers change. False if
  /// `timeout` passes. Throws SpeError if nothing can ever make it ready.
  virtual bool wait(const Ready& ready, std::optional<std::chrono::milliseconds> timeout,
                    const std::string& what) = 0;
  /// Ends every program that stalls, polls or is stopped, now and from now on; `because` ends their errors.
  virtual void break_off(const std::string& because) = 0;
  /// As break_off({}), from any thread.
  virtual void interrupt() noexcept = 0;
  /// Waits until no program runs any more, after interrupt().
  virtual void shut_down() = 0;
  /// The host resources of a program that has ended are given back.
  virtual void collect(Spe& spe) = 0;
  /// How often programs have ended or stopped with a signal. From any thread.
  unsigned stops() const { return stops_.load(); }

protected:
  void count_stop() { ++stops_; }

private:
  std::atomic<unsigned> stops_{0};
};

/// Everybody waits: reports it of each SPE that stalls. Returns the text of the error.
std::string report_deadlock(Spes& spes, DiagnosticLog& log, const std::string& ppe_waits_for);

} // namespace celltrace::cell_emu

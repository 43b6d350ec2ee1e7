// The free schedule: one host thread for each SPE; the host decides when they run.
//
// The SPEs' virtual clocks are independent. An SPE's MFC makes progress when the SPE accesses a channel.
// Stalls and waits of the SPEs and the PPE are counted, so that a deadlock is detected when the last running
// thread begins to wait.
#pragma once

#include "backends/cell_emu/scheduler.hpp"

#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

namespace celltrace::cell_emu {

/// The scheduler of the free schedule. Thread safety: as stated for Scheduler.
class FreeScheduler final : public Scheduler {
public:
  FreeScheduler(Spes& spes, unsigned count, DiagnosticLog& log) : spes_(spes), log_(log), threads_(count) {}

  void stalled(unsigned spe) override;
  void unstalled(unsigned spe) override;
  void reach(Spe& spe, Cycle now) override { spe.mfc.run_until(now); }
  void await_mfc(Spe& spe, Cycle at) override { spe.mfc.run_until(at); }
  Cycle stall(Spe& spe, const ProblemState::Stall& stall, Cycle now, Cycle deadline) override;
  void ring() override;
  Cycle pause(Spe& spe, std::uint32_t code, Cycle now) override;
  void start(Spe& spe, Program program) override;
  void resume(Spe& spe) override;
  Cycle enter() override;
  Cycle post() override { return 0; }
  Cycle post_at_once() override { return 0; }
  bool wait(const Ready& ready, std::optional<std::chrono::milliseconds> timeout,
            const std::string& what) override;
  void break_off(const std::string& because) override;
  void interrupt() noexcept override { break_off({}); }
  void shut_down() override;
  void collect(Spe& spe) override;

private:
  /// Returns true if all running programs stall: no program can end the stall of another.
  bool all_stalled() const;

  Spes& spes_;
  DiagnosticLog& log_;
  std::vector<std::thread> threads_;
  std::mutex mutex_;
  std::mutex breaking_off_;         ///< held while break_off() interrupts all SPEs; taken before mutex_
  std::condition_variable ppe_;     ///< signals changes that the PPE may wait for
  std::condition_variable resumed_; ///< signals that an SPE was resumed or interrupted
  unsigned active_ = 0;             ///< number of programs that have neither ended nor paused
  unsigned stalled_ = 0;            ///< number of active programs that stall
  unsigned idle_timeouts_ = 0;      ///< consecutive timeouts of the PPE while all programs stalled
  std::atomic<bool> broken_off_{false};
  std::uint64_t idle_entries_ = 0; ///< number of calls of enter() since programs were broken off
};

} // namespace celltrace::cell_emu

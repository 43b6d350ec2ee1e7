// The free schedule: a host thread per SPE, which run as the host lets them.
//
// Every SPE's virtual clock is its own, and its MFC makes progress when the SPE touches a channel. What the
// PPE and the SPEs wait for is counted, so that a deadlock is noticed when the last of them begins to wait.
#pragma once

#include "backends/cell_emu/scheduler.hpp"

#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

namespace celltrace::cell_emu {

/// Thread safety: as the comments of Scheduler say.
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
  /// Nobody runs who could change what others wait for.
  bool all_stalled() const;

  Spes& spes_;
  DiagnosticLog& log_;
  std::vector<std::thread> threads_;
  std::mutex mutex_;
  std::mutex breaking_off_;         ///< held while all SPEs are told a reason; taken before mutex_
  std::condition_variable ppe_;     ///< something that the PPE may wait for
  std::condition_variable resumed_; ///< an SPE was resumed or interrupted
  unsigned active_ = 0;             ///< programs that neither ended nor paused
  unsigned stalled_ = 0;            ///< of these, how many stall
  unsigned idle_timeouts_ = 0;      ///< of the PPE, one after the other, while all stalled
  std::atomic<bool> broken_off_{false};
  std::uint64_t idle_entries_ = 0; ///< of the PPE since then
};

} // namespace celltrace::cell_emu

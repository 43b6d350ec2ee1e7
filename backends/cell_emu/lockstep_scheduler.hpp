// The lockstep schedule: one SPE at a time, as coroutines on the PPE's thread, so that a run is the same on
// every machine.
//
// The agents are the SPEs' programs, their MFCs and the PPE. By virtual time, the agent with the least time
// acts next; of agents with equal times, MFCs and lower-numbered SPEs go first. When exploring, the next
// agent is drawn from the seed, and virtual time does not decide. SPEs run while the PPE is inside a call;
// the PPE's own work between its calls takes no time.
#pragma once

#include "backends/cell_emu/coroutine.hpp"
#include "backends/cell_emu/scheduler.hpp"

#include <atomic>
#include <exception>
#include <vector>

namespace celltrace::cell_emu {

/// The scheduler of the lockstep schedule. Thread safety: one thread, but interrupt() from any.
class LockstepScheduler final : public Scheduler {
public:
  LockstepScheduler(Spes& spes, unsigned count, DiagnosticLog& log, const EmulationConfig& config);

  void stalled(unsigned) override {}
  void unstalled(unsigned spe) override;
  void reach(Spe& spe, Cycle now) override;
  void await_mfc(Spe& spe, Cycle at) override;
  Cycle stall(Spe& spe, const ProblemState::Stall& stall, Cycle now, Cycle deadline) override;
  void ring() override {}
  Cycle pause(Spe& spe, std::uint32_t code, Cycle now) override;
  void start(Spe& spe, Program program) override;
  void resume(Spe& spe) override;
  Cycle enter() override;
  Cycle post() override {
    enter();
    return post_at_once();
  }
  Cycle post_at_once() override { return current_ = ppe_now_ + config_.timing.ppe_delivery; }
  bool wait(const Ready& ready, std::optional<std::chrono::milliseconds> timeout,
            const std::string& what) override;
  void break_off(const std::string& because) override;
  void interrupt() noexcept override { interrupt_requested_.store(true); }
  void shut_down() override;
  void collect(Spe& spe) override;

private:
  static constexpr unsigned kNobody = ~0u;
  enum class State : unsigned char { idle, ready, stalled, paused };
  struct Agent {
    State state = State::idle;
    Cycle now = 0;           ///< time of the program's next action
    Cycle deadline = kNever; ///< end of a stall
    std::unique_ptr<Coroutine> program;
    std::exception_ptr failure; ///< thrown in the program's next turn
  };
  struct Turn {
    Cycle at = kNever;
    unsigned spe = 0;
    bool mfc = false;
  };

  /// Returns the next turn by virtual time, without the SPE `apart`.
  Turn next_turn(unsigned apart = kNobody) const;
  Turn drawn_turn();
  /// Gives one turn to the next agent. Returns false if no agent can act until `limit`.
  bool step(Cycle limit);
  void run_mfc(unsigned spe);
  void fail(unsigned spe, std::exception_ptr failure);
  void run_program(unsigned spe, Cycle until);
  void suspend(Agent& agent);
  void check_foreign_stores(unsigned spe);
  void begin_ppe_turn();
  void end_ppe_turn();
  void wake(unsigned spe, Cycle at);
  void obey_interrupt();

  Spes& spes_;
  DiagnosticLog& log_;
  const EmulationConfig& config_;
  SeededRandom random_;
  /// Average number of an SPE's actions between two switches to other agents, when exploring.
  std::uint32_t patience_;
  std::vector<Agent> agents_;
  ForeignStoreWatch watch_;
  const bool watches_;
  bool ppe_turn_ = true;
  Cycle ppe_now_ = 0;
  Cycle current_ = 0;      ///< time of the present action
  Cycle horizon_ = kNever; ///< time from which the running program has to let other agents act first
  Cycle latest_ = 0;       ///< latest time of any action
  unsigned idle_timeouts_ = 0;
  std::uint64_t idle_entries_ = 0;
  std::atomic<bool> interrupt_requested_{false};
};

} // namespace celltrace::cell_emu

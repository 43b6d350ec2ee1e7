#include "backends/cell_emu/lockstep_scheduler.hpp"

#include <algorithm>
#include <utility>

namespace celltrace::cell_emu {
namespace {

constexpr std::uint64_t kSchedulerStream = 0x5343484544;

} // namespace

LockstepScheduler::LockstepScheduler(Spes& spes, unsigned count, DiagnosticLog& log,
                                     const EmulationConfig& config)
    : spes_(spes), log_(log), config_(config), random_(config.seed, kSchedulerStream), agents_(count),
      watch_(count), watches_(count > 1 && log.checks(Rule::foreign_store)) {
  // With some seeds SPEs switch all the time, with others an SPE runs far ahead.
  constexpr std::uint32_t kPatience[] = {2, 4, 16, 128};
  patience_ = kPatience[random_.below(4)];
}

// --- SPU side ---

void LockstepScheduler::suspend(Agent& agent) {
  const auto spe = static_cast<unsigned>(&agent - agents_.data());
  if (watches_) watch_.end_turn(spe, spes_[spe]->mfc.local_store_in_use());
  agent.program->suspend();
  if (watches_) check_foreign_stores(spe);
  if (agent.failure) std::rethrow_exception(std::exchange(agent.failure, nullptr));
}

void LockstepScheduler::reach(Spe& spe, Cycle now) {
  // An SPE whose time is always the least keeps its turn for ever, so it has to look for interrupts itself.
  obey_interrupt();
  Agent& agent = agents_[spe.id];
  agent.now = now;
  if (config_.explore) {
    if (random_.once_in(patience_)) suspend(agent);
    current_ = now;
    return;
  }
  for (;;) {
    if (now > horizon_) {
      suspend(agent);
      continue;
    }
    const Cycle event = spe.mfc.next_event();
    if (event > now) break;
    current_ = event;
    spe.mfc.run_next();
  }
  current_ = now;
}

void LockstepScheduler::await_mfc(Spe& spe, Cycle at) {
  Agent& agent = agents_[spe.id];
  if (!config_.explore) return reach(spe, at);
  agent.now = at;
  suspend(agent);
  current_ = at;
}

Cycle LockstepScheduler::stall(Spe& spe, const ProblemState::Stall& stall, Cycle now, Cycle deadline) {
  Agent& agent = agents_[spe.id];
  agent.now = now;
  agent.deadline = deadline;
  if (spe.state.begin_stall(stall)) {
    spe.now = now;
    agent.state = State::stalled;
    suspend(agent);
    spe.state.end_stall();
  }
  agent.deadline = kNever;
  current_ = agent.now;
  return agent.now;
}

Cycle LockstepScheduler::pause(Spe& spe, std::uint32_t code, Cycle now) {
  Agent& agent = agents_[spe.id];
  agent.now = now;
  spe.signal = code;
  spe.now = now;
  if (!spe.state.interrupted()) {
    agent.state = State::paused;
    count_stop();
    suspend(agent);
  }
  if (spe.signal != Spe::kNoSignal) {
    spe.signal = Spe::kNoSignal;
    spe.state.stop_while_stopped(code);
  }
  current_ = agent.now;
  return agent.now;
}

// --- changes ---

void LockstepScheduler::wake(unsigned spe, Cycle at) {
  Agent& agent = agents_[spe];
  agent.state = State::ready;
  agent.now = std::max(agent.now, at);
  horizon_ = std::min(horizon_, agent.now);
}

void LockstepScheduler::unstalled(unsigned spe) {
  idle_timeouts_ = 0;
  if (agents_[spe].state == State::stalled) wake(spe, current_);
}

// --- stores into other local stores ---

void LockstepScheduler::check_foreign_stores(unsigned spe) {
  const auto change = watch_.take_change(spe, spes_[spe]->mfc.local_store_in_use());
  if (!change) return;
  const bool certain = change->suspects.size() == 1;
  const unsigned writer = change->suspects.front();
  Diagnostic diagnostic;
  diagnostic.rule = Rule::foreign_store;
  diagnostic.spe = certain ? writer : spe;
  diagnostic.other_spe = spe;
  diagnostic.lsa = spes_[spe]->mfc.arena_begin() + change->offset;
  diagnostic.cycle = agents_[spe].now;
  std::string what = "local store of SPE " + std::to_string(spe) + ", LS address " +
                     std::to_string(diagnostic.lsa) + ": " + std::string(text_of(diagnostic.rule));
  if (!certain) {
    what += "; had turns:";
    for (const unsigned suspect : change->suspects)
      what += " SPE " + std::to_string(suspect);
  }
  if (!log_.note(diagnostic, what) || diagnostic.action != Action::stop) return;
  // The writer's program fails. If it has ended, or is not known, the program whose data are spoilt fails.
  const bool writer_runs = certain && agents_[writer].state != State::idle;
  fail(writer_runs ? writer : spe, std::make_exception_ptr(RuleViolation(diagnostic)));
}

/// Begins the PPE's turn. Looks first for stores of other SPEs, which could later be taken for the PPE's.
void LockstepScheduler::begin_ppe_turn() {
  if (!watches_ || std::exchange(ppe_turn_, true)) return;
  for (const auto& spe : spes_)
    check_foreign_stores(spe->id);
}

/// Ends the PPE's turn. Accepts its changes, because the PPE may store into any mapped local store.
void LockstepScheduler::end_ppe_turn() {
  if (!watches_ || !std::exchange(ppe_turn_, false)) return;
  for (const auto& spe : spes_)
    watch_.accept_changes(spe->id, spe->mfc.local_store_in_use());
}

// --- turns ---

LockstepScheduler::Turn LockstepScheduler::next_turn(unsigned apart) const {
  Turn first;
  for (unsigned spe = 0; spe < agents_.size(); ++spe) {
    if (spe == apart) continue;
    const Agent& agent = agents_[spe];
    const Cycle event = spes_[spe]->mfc.next_event();
    if (event < first.at) first = {event, spe, true};
    const Cycle program = agent.state == State::ready     ? agent.now
                          : agent.state == State::stalled ? agent.deadline
                                                          : kNever;
    if (program < first.at) first = {program, spe, false};
  }
  return first;
}

LockstepScheduler::Turn LockstepScheduler::drawn_turn() {
  Turn drawn;
  std::uint64_t candidates = 0;
  const auto consider = [&](const Turn& turn) {
    if (turn.at != kNever && random_.once_in(++candidates)) drawn = turn;
  };
  for (unsigned spe = 0; spe < agents_.size(); ++spe) {
    const Agent& agent = agents_[spe];
    consider({spes_[spe]->mfc.next_event(), spe, true});
    if (agent.state == State::ready) consider({agent.now, spe, false});
  }
  // If no agent can act, time passes until a stall ends.
  return candidates != 0 ? drawn : next_turn();
}

void LockstepScheduler::run_mfc(unsigned spe) {
  try {
    spes_[spe]->mfc.run_next();
  } catch (...) {
    fail(spe, std::current_exception());
  }
}

/// Notes a failure that is thrown in the program's next turn.
void LockstepScheduler::fail(unsigned spe, std::exception_ptr failure) {
  agents_[spe].failure = std::move(failure);
  spes_[spe]->mfc.abandon();
  if (agents_[spe].state == State::stalled || agents_[spe].state == State::paused) wake(spe, current_);
}

void LockstepScheduler::run_program(unsigned spe, Cycle until) {
  end_ppe_turn();
  Agent& agent = agents_[spe];
  horizon_ = std::min(until, next_turn(spe).at);
  agent.state = State::ready;
  agent.program->resume();
  horizon_ = kNever;
  if (agent.program->ended()) {
    agent.state = State::idle;
    agent.program.reset();
    watch_.end(spe);
    spes_[spe]->running = false;
    count_stop();
  }
}

bool LockstepScheduler::step(Cycle limit) {
  obey_interrupt();
  const Turn turn = config_.explore ? drawn_turn() : next_turn();
  if (turn.at == kNever || (!config_.explore && turn.at > limit)) return false;
  current_ = turn.at;
  latest_ = std::max(latest_, turn.at);
  if (turn.mfc) {
    run_mfc(turn.spe);
    return true;
  }
  Agent& agent = agents_[turn.spe];
  if (agent.state == State::stalled) agent.now = agent.deadline;
  run_program(turn.spe, limit);
  latest_ = std::max(latest_, agent.now);
  return true;
}

void LockstepScheduler::break_off(const std::string& because) {
  for (const auto& spe : spes_) {
    spe->state.interrupt(because);
    if (agents_[spe->id].state == State::paused) wake(spe->id, current_);
  }
}

void LockstepScheduler::obey_interrupt() {
  if (!interrupt_requested_.load(std::memory_order_relaxed)) return;
  break_off({});
}

// --- PPE side ---

void LockstepScheduler::start(Spe& spe, Program program) {
  Agent& agent = agents_[spe.id];
  agent.now = std::max(spe.now, ppe_now_);
  spe.now = agent.now;
  agent.program = std::make_unique<Coroutine>(std::move(program));
  agent.state = State::ready;
  agent.failure = nullptr;
  watch_.begin(spe.id);
  spe.running = true;
  spe.signal = Spe::kNoSignal;
}

void LockstepScheduler::resume(Spe& spe) {
  spe.signal = Spe::kNoSignal;
  wake(spe.id, ppe_now_);
}

Cycle LockstepScheduler::enter() {
  ppe_now_ += config_.timing.ppe_access + random_.below(config_.faults.delivery_delay);
  bool any = false;
  if (config_.explore) {
    while (!random_.once_in(4) && step(kNever))
      any = true;
    ppe_now_ = std::max(ppe_now_, latest_);
  } else {
    while (step(ppe_now_))
      any = true;
  }
  obey_interrupt();
  idle_entries_ = any ? 0 : idle_entries_ + 1;
  if (idle_entries_ > kIdleEntries && next_turn().at == kNever) {
    idle_entries_ = 0;
    const std::string text = report_deadlock(spes_, log_, "an answer, looking for it again and again");
    break_off(": " + text);
    throw SpeError(text);
  }
  current_ = ppe_now_;
  begin_ppe_turn();
  return ppe_now_;
}

bool LockstepScheduler::wait(const Ready& ready, std::optional<std::chrono::milliseconds> timeout,
                             const std::string& what) {
  enter();
  Cycle limit = kNever;
  if (timeout)
    limit =
        ppe_now_ + static_cast<Cycle>(timeout->count()) * static_cast<Cycle>(config_.timing.clock_hz / 1000);
  while (!ready()) {
    if (step(limit)) continue;
    if (ready()) break;
    if (timeout) {
      ppe_now_ = limit;
      const bool nothing_left = next_turn().at == kNever;
      idle_timeouts_ = nothing_left ? idle_timeouts_ + 1 : 0;
      // A PPE that waits with timeouts may send something in between, but hardly after two in vain.
      if (idle_timeouts_ < 2) {
        begin_ppe_turn();
        return false;
      }
    }
    idle_timeouts_ = 0;
    const std::string text = report_deadlock(spes_, log_, what);
    break_off(": " + text);
    throw SpeError(text);
  }
  idle_timeouts_ = 0;
  ppe_now_ = std::max(ppe_now_, current_);
  current_ = ppe_now_;
  begin_ppe_turn();
  return true;
}

void LockstepScheduler::shut_down() {
  interrupt();
  while (step(kNever)) {
  }
}

void LockstepScheduler::collect(Spe&) {
}

} // namespace celltrace::cell_emu

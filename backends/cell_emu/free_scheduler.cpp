#include "backends/cell_emu/free_scheduler.hpp"

#include <algorithm>

namespace celltrace::cell_emu {

bool FreeScheduler::all_stalled() const {
  if (active_ != 0) return stalled_ == active_;
  // A paused SPE that was interrupted counts as running: it is about to go on.
  return std::none_of(spes_.begin(), spes_.end(),
                      [](const auto& spe) { return spe->running && !spe->paused(); });
}

void FreeScheduler::stalled(unsigned) {
  const std::lock_guard lock(mutex_);
  ++stalled_;
  if (all_stalled()) ppe_.notify_all();
}

void FreeScheduler::unstalled(unsigned) {
  // The SPE that ended this stall does not stall itself, so stalled_ never wrongly reached the number of all
  // programs.
  const std::lock_guard lock(mutex_);
  --stalled_;
  idle_timeouts_ = 0;
}

Cycle FreeScheduler::stall(Spe& spe, const ProblemState::Stall& stall, Cycle now, Cycle deadline) {
  // Virtual time passes until the MFC has nothing more to do: execute all its events.
  while (spe.mfc.next_event() != kNever) {
    now = std::max(now, spe.mfc.run_next());
    if (spe.state.count(stall.channel) != 0) return now;
  }
  if (deadline != kNever) return std::max(now, deadline);
  spe.now = now;
  if (spe.state.begin_stall(stall)) spe.state.sleep_until_unstalled();
  return now;
}

Cycle FreeScheduler::pause(Spe& spe, std::uint32_t code, Cycle now) {
  while (spe.mfc.next_event() != kNever)
    now = std::max(now, spe.mfc.run_next());
  std::unique_lock lock(mutex_);
  spe.signal = code;
  spe.now = now;
  --active_;
  count_stop();
  ppe_.notify_all();
  resumed_.wait(lock, [&] { return spe.signal == Spe::kNoSignal || spe.state.interrupted(); });
  if (spe.signal != Spe::kNoSignal) {
    ++active_;
    spe.signal = Spe::kNoSignal;
    spe.state.stop_while_stopped(code);
  }
  return now;
}

Cycle FreeScheduler::enter() {
  // A PPE that polls for an answer of failed programs would poll for ever.
  if (!broken_off_.load(std::memory_order_relaxed) || ++idle_entries_ < kIdleEntries) return 0;
  idle_entries_ = 0;
  const std::lock_guard lock(mutex_);
  if (all_stalled())
    throw SpeError(report_deadlock(
        spes_, log_, "an answer, looking for it again and again when no program runs any more"));
  return 0;
}

void FreeScheduler::start(Spe& spe, Program program) {
  broken_off_ = false;
  idle_entries_ = 0;
  {
    const std::lock_guard lock(mutex_);
    spe.running = true;
    spe.signal = Spe::kNoSignal;
    ++active_;
  }
  const auto ended = [this, &spe] {
    const std::lock_guard lock(mutex_);
    spe.running = false;
    --active_;
    count_stop();
    ppe_.notify_all();
  };
  try {
    threads_[spe.id] = std::thread([program = std::move(program), ended] {
      program();
      ended();
    });
  } catch (...) {
    ended();
    throw;
  }
}

void FreeScheduler::resume(Spe& spe) {
  const std::lock_guard lock(mutex_);
  spe.signal = Spe::kNoSignal;
  ++active_;
  resumed_.notify_all();
}

void FreeScheduler::ring() {
  { const std::lock_guard lock(mutex_); }
  ppe_.notify_all();
}

bool FreeScheduler::wait(const Ready& ready, std::optional<std::chrono::milliseconds> timeout,
                         const std::string& what) {
  std::unique_lock lock(mutex_);
  const auto over = [&] { return ready() || (!timeout && all_stalled()); };
  bool rang = true;
  if (timeout)
    rang = ppe_.wait_for(lock, *timeout, over);
  else
    ppe_.wait(lock, over);
  if (rang && ready()) {
    idle_timeouts_ = 0;
    return true;
  }
  // A PPE that waits with timeouts may send something after a timeout, but hardly after two timeouts in a
  // row.
  idle_timeouts_ = all_stalled() ? idle_timeouts_ + 1 : 0;
  if (timeout && idle_timeouts_ < 2) return false;
  lock.unlock();
  const std::string text = report_deadlock(spes_, log_, what);
  break_off(": " + text);
  throw SpeError(text);
}

void FreeScheduler::break_off(const std::string& because) {
  {
    // An SPE keeps the first reason that it gets. An SPE that is woken here breaks off the others as well;
    // the lock makes it wait until all have this reason.
    const std::lock_guard whole(breaking_off_);
    for (const auto& spe : spes_)
      spe->state.interrupt(because);
  }
  broken_off_ = true;
  const std::lock_guard lock(mutex_);
  resumed_.notify_all();
}

void FreeScheduler::shut_down() {
  for (const auto& spe : spes_)
    collect(*spe);
}

void FreeScheduler::collect(Spe& spe) {
  if (threads_[spe.id].joinable()) threads_[spe.id].join();
}

} // namespace celltrace::cell_emu

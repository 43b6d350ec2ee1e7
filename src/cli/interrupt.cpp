#include "cli/interrupt.hpp"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <ctime>
#include <optional>

#include <signal.h>

namespace celltrace::cli {

namespace {

/// The time within which signals count as one: timeout(1) sends its signal to the program and to its group.
constexpr std::int64_t kTogether = 300'000'000; // in ns

std::optional<std::chrono::steady_clock::time_point> deadline;
std::atomic<std::int64_t> first{0}; ///< time of the first signal in ns; 0 if there was none
static_assert(std::atomic<std::int64_t>::is_always_lock_free, "a signal handler must not take a lock");

extern "C" void on_signal(int number) {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  const std::int64_t now = time.tv_sec * std::int64_t{1'000'000'000} + time.tv_nsec + 1;
  std::int64_t before = 0;
  if (first.compare_exchange_strong(before, now) || now - before < kTogether) return;
  signal(number, SIG_DFL);
  raise(number); // takes effect when this handler returns
}

} // namespace

void catch_interrupts() {
  struct sigaction action = {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

void interrupt_after(double seconds) {
  deadline.reset();
  if (seconds == 0) return;
  deadline =
      std::chrono::steady_clock::now() +
      std::chrono::duration_cast<std::chrono::steady_clock::duration>(std::chrono::duration<double>(seconds));
}

bool interrupted() noexcept {
  return first != 0 || (deadline && std::chrono::steady_clock::now() >= *deadline);
}

const char* interruption() noexcept {
  return first != 0 ? "interrupted" : "out of time (--max render-seconds)";
}

} // namespace celltrace::cli

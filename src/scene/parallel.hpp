// Runs work in parts, in threads of the host.
#pragma once

#include "scene/progress_monitor.hpp"

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace celltrace {

/// Part number `part` of [0, count), which is divided into `parts` parts.
struct HostPart {
  std::uint32_t begin, end;

  HostPart(std::uint32_t count, unsigned part, unsigned parts)
      : begin(static_cast<std::uint32_t>(std::uint64_t{count} * part / parts)),
        end(static_cast<std::uint32_t>(std::uint64_t{count} * (part + 1) / parts)) {}
};

/// Calls work(part) for each part, each in a thread of its own, and returns when all calls have ended. Passes
/// through the exception of the first part that threw. All threads share this thread's ProgressMonitor, which
/// is asked as long as a thread is at work.
template <class Work> void for_each_part(unsigned parts, Work work) {
  constexpr std::chrono::milliseconds kPollInterval(5);
  std::vector<std::exception_ptr> failures(parts);
  ProgressMonitor* const monitor = ProgressMonitor::current();
  std::mutex mutex;
  std::condition_variable ended;
  unsigned at_work = parts;
  const auto run = [&](unsigned part) noexcept {
    try {
      work(part);
    } catch (...) {
      failures[part] = std::current_exception();
    }
    const std::lock_guard lock(mutex);
    --at_work;
    ended.notify_one();
  };
  const auto check = [&]() noexcept {
    try {
      ProgressMonitor::check_cancelled();
    } catch (...) {
      if (!failures[0]) failures[0] = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> others;
    for (unsigned part = 1; part < parts; ++part)
      others.emplace_back([&, part] {
        ProgressMonitor::adopt(monitor);
        run(part);
      });
    run(0);
    std::unique_lock lock(mutex);
    while (!ended.wait_for(lock, kPollInterval, [&] { return at_work == 0; })) {
      lock.unlock();
      check();
      lock.lock();
    }
  }
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
}

} // namespace celltrace

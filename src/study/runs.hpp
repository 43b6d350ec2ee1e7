// Frames of a study: rendered on the emulated or the simulated Cell in lockstep, several at a time, each
// always the same.
#pragma once

#include "celltrace/render.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace celltrace::study {

struct Job {
  const Scene* scene = nullptr;
  RenderOptions options; ///< backend and schedule are set by the Runner
  int frames = 1;
};

/// The statistics of a job's frames, and what its last picture holds, as a number.
struct Outcome {
  std::vector<RenderStatistics> frames;
  std::uint64_t picture = 0;

  const RenderStatistics& first() const { return frames.front(); }
  const RenderStatistics& last() const { return frames.back(); }
};

/// Runs jobs on the threads of the host. Thread safety: one thread at a time.
class Runner {
public:
  /// `backend` is where jobs run. 0 threads: as many as the host has. `heard` is told of every job that is
  /// done, by any thread but one at a time.
  Runner(Backend backend, unsigned threads, std::function<void()> heard)
      : backend_(backend), threads_(threads), heard_(std::move(heard)) {}

  Backend backend() const { return backend_; }
  /// In lockstep. In the order of the jobs. The first error of any is thrown.
  std::vector<Outcome> run(const std::vector<Job>& jobs) const { return run(jobs, backend_); }
  std::vector<Outcome> run(const std::vector<Job>& jobs, Backend backend) const;
  /// Calls `work(0)` to `work(count - 1)`.
  void each(std::size_t count, const std::function<void(std::size_t)>& work) const;

private:
  Backend backend_;
  unsigned threads_;
  std::function<void()> heard_;
};

/// Whether this build's programs can run on cell_sim.
bool has_machine_code();

/// Seconds that a native machine of one SPE takes to trace a frame: the median of `frames`.
double native_seconds(const Scene& scene, RenderOptions options, int frames);

} // namespace celltrace::study

// Frames of a study: rendered on the emulated or the simulated Cell in lockstep, several at a time, with the
// same results in every run.
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

/// The statistics of a job's frames, and a hash of its last picture.
struct Outcome {
  std::vector<RenderStatistics> frames;
  std::uint64_t picture = 0;

  const RenderStatistics& first() const { return frames.front(); }
  const RenderStatistics& last() const { return frames.back(); }
};

/// Runs jobs on the threads of the host. Thread safety: one thread at a time.
class Runner {
public:
  /// Makes a runner of jobs on `backend`. 0 threads: as many as the host has. `on_finished` is called for
  /// every finished job, by any thread but one at a time.
  Runner(Backend backend, unsigned threads, std::function<void()> on_finished)
      : backend_(backend), threads_(threads), on_finished_(std::move(on_finished)) {}

  Backend backend() const { return backend_; }
  /// Runs the jobs in lockstep. Returns the outcomes in the order of the jobs. Throws the first error of any
  /// job.
  std::vector<Outcome> run(const std::vector<Job>& jobs) const { return run(jobs, backend_); }
  std::vector<Outcome> run(const std::vector<Job>& jobs, Backend backend) const;
  /// Calls `work(0)` to `work(count - 1)`.
  void each(std::size_t count, const std::function<void(std::size_t)>& work) const;

private:
  Backend backend_;
  unsigned threads_;
  std::function<void()> on_finished_;
};

/// Returns whether this build's programs can run on cell_sim.
bool has_machine_code();

/// Returns the seconds that a native machine of one SPE takes to trace a frame: the median of `frames`.
double native_seconds(const Scene& scene, RenderOptions options, int frames);

} // namespace celltrace::study

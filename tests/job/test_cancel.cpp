// Jobs that are cancelled at any time, started again, and run beside others.
#include "celltrace/job.hpp"

#include <catch2/catch.hpp>

#include "job/scenes.hpp"

#include <atomic>
#include <chrono>
#include <random>
#include <thread>
#include <vector>

using namespace celltrace;
using test::small_options;

namespace {

/// Cancels a job as soon as it says `phase` for the `call`-th time; returns what take() throws or returns.
enum class End { cancelled, incomplete, complete };
End end_of(RenderJob& job) {
  try {
    return job.take().complete ? End::complete : End::incomplete;
  } catch (const Cancelled&) {
    return End::cancelled;
  }
}

End cancelled_in(JobPhase phase) {
  std::atomic<bool> reached = false, go_on = false;
  JobOptions options = small_options();
  options.progress = [&](const JobProgress& progress) {
    if (progress.phase != phase || reached.exchange(true)) return;
    while (!go_on)
      std::this_thread::yield();
  };
  RenderJob job(SceneText{test::kScene}, options);
  while (!reached)
    std::this_thread::yield();
  job.cancel();
  go_on = true;
  return end_of(job);
}

/// Jobs that live side by side: one is cancelled and started again, `times` times, while others render the
/// same scene undisturbed.
void cancel_and_restart(int times, unsigned seed) {
  const JobOptions options = small_options();
  RenderJob first(SceneText{test::kScene}, options);
  const RenderResult expected = first.take();
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> microseconds(0, 4000);
  std::vector<RenderJob> others;
  int cancelled = 0;
  for (int i = 0; i < times; ++i) {
    if (others.size() < 2) others.emplace_back(first.scene(), options);
    JobOptions watched = options;
    std::atomic<int> ends = 0;
    watched.finished = [&](RenderJob& job) { ends += job.is_over(); };
    RenderJob job(SceneText{test::kScene}, watched);
    std::thread canceller([&, wait = microseconds(random)] {
      std::this_thread::sleep_for(std::chrono::microseconds(wait));
      job.cancel();
    });
    const End end = end_of(job);
    cancelled += end != End::complete;
    canceller.join();
    if (i % 2 == 0) others.pop_back(); // in the middle of it, or at its end
    RenderJob again(SceneText{test::kScene}, options);
    REQUIRE(again.take().image == expected.image);
    job = std::move(again);
    REQUIRE(ends == 1);
  }
  for (RenderJob& other : others)
    REQUIRE(other.take().image == expected.image);
  CHECK(cancelled > 0);
}

} // namespace

TEST_CASE("a job is cancelled in each of its phases") {
  CHECK(cancelled_in(JobPhase::reading) == End::cancelled);
  CHECK(cancelled_in(JobPhase::building) == End::cancelled);
  CHECK(cancelled_in(JobPhase::rendering) == End::incomplete);
}

TEST_CASE("cancelling a job that is over changes nothing") {
  RenderJob job(SceneText{test::kScene}, small_options());
  job.wait();
  job.cancel();
  CHECK(job.take().complete);
}

TEST_CASE("jobs are cancelled, started again and run beside others") {
  cancel_and_restart(25, 1);
}

// The long form: test_job "[.long]".
TEST_CASE("jobs are cancelled, started again and run beside others a thousand times", "[.long]") {
  cancel_and_restart(1000, 2);
}

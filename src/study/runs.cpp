#include "study/runs.hpp"

#include "render/tracer_program.hpp"
#include "scene/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <thread>

namespace celltrace::study {

namespace {

/// Returns a hash of the picture (FNV-1a).
std::uint64_t digest(const Image& image) {
  std::uint64_t hash = 14695981039346656037u;
  for (const std::uint8_t byte : image.rgba)
    hash = (hash ^ byte) * 1099511628211u;
  return hash;
}

Outcome run_one(const Job& job, Backend backend) {
  RenderOptions options = job.options;
  options.backend = backend;
  options.emulation.schedule = Schedule::lockstep;
  Renderer renderer(options);
  Outcome outcome;
  for (int frame = 0; frame < job.frames; ++frame) {
    RenderResult result = frame == 0 ? renderer.render(*job.scene) : renderer.render(job.scene->camera);
    if (frame + 1 == job.frames) outcome.picture = digest(result.image);
    outcome.frames.push_back(std::move(result.statistics));
  }
  return outcome;
}

} // namespace

std::vector<Outcome> Runner::run(const std::vector<Job>& jobs, Backend backend) const {
  std::vector<Outcome> outcomes(jobs.size());
  each(jobs.size(), [&](std::size_t i) { outcomes[i] = run_one(jobs[i], backend); });
  return outcomes;
}

void Runner::each(std::size_t count, const std::function<void(std::size_t)>& work) const {
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  const unsigned wanted = threads_ != 0 ? threads_ : std::max(1u, std::thread::hardware_concurrency());
  const auto helpers = static_cast<unsigned>(std::clamp<std::size_t>(count, 1, wanted));
  for_each_part(helpers, [&](unsigned) {
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        work(i);
      } catch (...) {
        next = count; // no thread begins another job
        throw;
      }
      const std::lock_guard lock(mutex);
      on_finished_();
    }
  });
}

bool has_machine_code() {
  return !tracer_program().image("cell_sim").empty();
}

double native_seconds(const Scene& scene, RenderOptions options, int frames) {
  options.backend = Backend::native;
  options.spes = 1;
  Renderer renderer(options);
  std::vector<double> seconds;
  renderer.render(scene);
  for (int frame = 0; frame < frames; ++frame)
    seconds.push_back(renderer.render(scene.camera).statistics.render_seconds);
  std::nth_element(seconds.begin(), seconds.begin() + frames / 2, seconds.end());
  return seconds[static_cast<std::size_t>(frames / 2)];
}

} // namespace celltrace::study

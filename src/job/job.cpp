#include "celltrace/job.hpp"

#include "celltrace/load.hpp"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <new>
#include <optional>
#include <thread>
#include <utility>

namespace celltrace {

namespace {

/// Shares of the phases in a job that reads a scene.
constexpr double kReadingShare = 0.2, kBuildingShare = 0.2;
constexpr std::size_t kMostFindings = 1000;

} // namespace

class RenderJob::Impl : public std::enable_shared_from_this<Impl> {
public:
  Impl(JobScene scene, JobOptions options) : given_(std::move(scene)), options_(std::move(options)) {}
  ~Impl() {
    // The thread is still joinable if a function of the options, which runs on it, has dropped the job.
    if (thread_.joinable()) thread_.detach();
  }

  void start() {
    // If the executor drops the work without having run it, the job is cancelled.
    auto work = std::make_shared<Work>(shared_from_this());
    if (options_.executor)
      options_.executor([work = std::move(work)] { work->job->run(); });
    else
      thread_ = std::thread([work = std::move(work)] { work->job->run(); });
  }

  void cancel() noexcept {
    cancelled_.store(true, std::memory_order_relaxed);
    if (claim()) end_unbegun();
  }

  /// Waits until no function of the options is called any more, unless such a function calls this one.
  void wait_for_silence() {
    {
      std::unique_lock lock(mutex_);
      if (worker_ == std::this_thread::get_id()) return;
      changed_.wait(lock, [&] { return is_silent_; });
    }
    if (thread_.joinable()) thread_.join();
  }

  JobProgress progress() const {
    const std::lock_guard lock(mutex_);
    return progress_;
  }
  template <class Wait> bool wait(Wait wait) const {
    std::unique_lock lock(mutex_);
    return wait(changed_, lock, [&] { return is_over(); });
  }
  RenderResult take() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return is_over(); });
    if (failure_) std::rethrow_exception(failure_);
    if (!result_) throw InputError("the job's picture has been taken already");
    RenderResult result = std::move(*result_);
    result_.reset();
    return result;
  }
  std::vector<Finding> findings() const {
    const std::lock_guard lock(mutex_);
    return findings_;
  }
  std::shared_ptr<const Scene> scene() const {
    const std::lock_guard lock(mutex_);
    return scene_;
  }

private:
  struct Work {
    explicit Work(std::shared_ptr<Impl> of) : job(std::move(of)) {}
    Work(const Work&) = delete;
    Work& operator=(const Work&) = delete;
    ~Work() { job->cancel_if_waiting(); }
    std::shared_ptr<Impl> job;
  };

  bool is_over() const { return progress_.phase == JobPhase::over; }

  /// Makes this thread the worker. Returns false if another thread is or was the worker.
  bool claim() {
    const std::lock_guard lock(mutex_);
    if (std::exchange(is_claimed_, true)) return false;
    worker_ = std::this_thread::get_id();
    return true;
  }
  void cancel_if_waiting() noexcept {
    if (claim()) end_unbegun();
  }
  void end_unbegun() noexcept {
    publish(std::make_exception_ptr(Cancelled()));
    fall_silent();
  }

  void run() noexcept {
    if (!claim()) return;
    try {
      render();
    } catch (const std::bad_alloc&) {
      publish(std::make_exception_ptr(OutOfMemory()));
    } catch (...) {
      publish(std::current_exception());
    }
    fall_silent();
  }

  void render() {
    const bool reads = !std::holds_alternative<Scene>(given_) &&
                       !std::holds_alternative<std::shared_ptr<const Scene>>(given_);
    const double read = reads ? kReadingShare : 0;
    const double built = read + kBuildingShare;
    const std::shared_ptr<const Scene> scene = take_scene();
    {
      const std::lock_guard lock(mutex_);
      scene_ = scene;
    }
    RenderOptions options = options_.render;
    bool is_built = false;
    options.build_progress = [&](double fraction) {
      is_built = fraction >= 1;
      return (!options_.render.build_progress || options_.render.build_progress(fraction)) &&
             report(JobPhase::building, fraction, read, built);
    };
    Renderer renderer(options);
    RenderResult result = renderer.render(*scene, [&](double fraction) {
      return !is_built || report(JobPhase::rendering, fraction, built, 1);
    });
    if (!is_built) throw Cancelled();
    // Publish first: waiting threads need not wait until the renderer has released its memory.
    publish(std::move(result));
  }

  std::shared_ptr<const Scene> take_scene() {
    if (auto* scene = std::get_if<Scene>(&given_)) return std::make_shared<const Scene>(std::move(*scene));
    if (auto* scene = std::get_if<std::shared_ptr<const Scene>>(&given_)) {
      if (!*scene) throw InputError("the job has no scene");
      return std::move(*scene);
    }
    ParseOptions options = options_.parse;
    options.width = options_.render.width;
    options.height = options_.render.height;
    options.quality = options_.render.quality;
    options.progress = [&](std::uint64_t bytes, std::uint64_t total) {
      const double fraction = total == 0 ? 0 : static_cast<double>(bytes) / static_cast<double>(total);
      return (!options_.parse.progress || options_.parse.progress(bytes, total)) &&
             report(JobPhase::reading, fraction, 0, kReadingShare);
    };
    options.finding = [&](const Finding& finding) {
      keep(finding);
      if (options_.parse.finding) options_.parse.finding(finding);
    };
    if (const auto* text = std::get_if<SceneText>(&given_))
      return std::make_shared<const Scene>(parse_string(text->text, options, text->name));
    return std::make_shared<const Scene>(load_scene(std::get<std::filesystem::path>(given_), options));
  }

  void keep(const Finding& finding) {
    const std::lock_guard lock(mutex_);
    if (findings_.size() < kMostFindings) findings_.push_back(finding);
  }

  /// Reports the progress of a phase that takes the part [begin, end] of the job. Returns false to cancel.
  bool report(JobPhase phase, double fraction, double begin, double end) {
    if (is_cancelled_in(phase)) return false;
    JobProgress now;
    {
      const std::lock_guard lock(mutex_);
      const double whole = std::max(progress_.fraction, begin + fraction * (end - begin));
      now = progress_ = {phase, fraction, whole};
    }
    if (options_.progress) options_.progress(now);
    return !is_cancelled_in(phase);
  }
  bool is_cancelled_in(JobPhase phase) {
    if (!cancelled_.load(std::memory_order_relaxed)) return false;
    // There will certainly be no picture, so that waiting threads need not wait until all memory is released.
    if (phase != JobPhase::rendering) publish(std::make_exception_ptr(Cancelled()));
    return true;
  }

  // Set the result; only the first call has an effect.
  void publish(RenderResult result) {
    const std::lock_guard lock(mutex_);
    if (is_over()) return;
    progress_ = {JobPhase::over, 1, result.complete ? 1 : progress_.fraction};
    result_ = std::move(result);
    changed_.notify_all();
  }
  void publish(std::exception_ptr failure) noexcept {
    const std::lock_guard lock(mutex_);
    if (is_over()) return;
    progress_ = {JobPhase::over, 1, progress_.fraction};
    failure_ = std::move(failure);
    changed_.notify_all();
  }
  /// Calls `finished`, the last of the options' functions, and lets wait_for_silence() return.
  void fall_silent() noexcept {
    if (options_.finished) {
      RenderJob job(shared_from_this(), false);
      options_.finished(job);
    }
    const std::lock_guard lock(mutex_);
    is_silent_ = true;
    worker_ = {};
    changed_.notify_all();
  }

  JobScene given_; ///< used by the worker only
  const JobOptions options_;
  std::atomic<bool> cancelled_ = false;
  mutable std::mutex mutex_; ///< guards the members below
  mutable std::condition_variable changed_;
  bool is_claimed_ = false, is_silent_ = false;
  std::thread::id worker_;
  JobProgress progress_;
  std::vector<Finding> findings_;
  std::shared_ptr<const Scene> scene_;
  std::optional<RenderResult> result_;
  std::exception_ptr failure_;
  std::thread thread_;
};

RenderJob::RenderJob(JobScene scene, JobOptions options)
    : impl_(std::make_shared<Impl>(std::move(scene), std::move(options))) {
  impl_->start();
}
RenderJob::RenderJob(std::shared_ptr<Impl> impl, bool is_owner)
    : impl_(std::move(impl)), is_owner_(is_owner) {
}
RenderJob::~RenderJob() {
  leave();
}
RenderJob::RenderJob(RenderJob&&) noexcept = default;
RenderJob& RenderJob::operator=(RenderJob&& from) noexcept {
  if (this == &from) return *this;
  leave();
  impl_ = std::move(from.impl_);
  is_owner_ = from.is_owner_;
  return *this;
}

void RenderJob::leave() noexcept {
  if (!impl_ || !is_owner_) return;
  impl_->cancel();
  impl_->wait_for_silence();
}

void RenderJob::cancel() noexcept {
  impl_->cancel();
}
JobProgress RenderJob::progress() const {
  return impl_->progress();
}
bool RenderJob::is_over() const {
  return progress().phase == JobPhase::over;
}
void RenderJob::wait() const {
  impl_->wait([](auto& changed, auto& lock, auto is_over) {
    changed.wait(lock, is_over);
    return true;
  });
}
bool RenderJob::wait_for(std::chrono::milliseconds timeout) const {
  return impl_->wait(
      [&](auto& changed, auto& lock, auto is_over) { return changed.wait_for(lock, timeout, is_over); });
}
RenderResult RenderJob::take() {
  return impl_->take();
}
std::vector<Finding> RenderJob::findings() const {
  return impl_->findings();
}
std::shared_ptr<const Scene> RenderJob::scene() const {
  return impl_->scene();
}

} // namespace celltrace

// Rendering in the background: a scene's file, its text or a Scene in, a picture out, while the application
// does something else.
//
//   RenderJob job("scene.pov", options);
//   job.cancel();                         // from any thread, at any time
//   RenderResult result = job.take();     // waits
//
// Thread safety: every member of RenderJob but construction, assignment and destruction may be called from
// any thread at any time. Jobs are independent of each other: any number may run at once.
#pragma once

#include "celltrace/error.hpp"
#include "celltrace/export.hpp"
#include "celltrace/pov.hpp"
#include "celltrace/render.hpp"
#include "celltrace/scene.hpp"

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace celltrace {

/// A scene in POV-Ray's language, in memory. `name` stands in messages.
struct SceneText {
  std::string text;
  std::string name = "<string>";
};

/// What a job renders: a scene's file, its text, or one that is there already, which must not change.
using JobScene = std::variant<std::filesystem::path, SceneText, Scene, std::shared_ptr<const Scene>>;

/// What a job does at the moment.
enum class JobPhase {
  waiting,  ///< for a thread
  reading,  ///< the scene's text
  building, ///< the scene image and the accelerator
  rendering,
  over
};

struct JobProgress {
  JobPhase phase = JobPhase::waiting;
  double phase_fraction = 0; ///< of the phase, 0..1; where loops or included files are read it stands still
  double fraction = 0;       ///< of the whole job, 0..1; never falls
};

class RenderJob;

/// Functions of `parse` and `render` are called as well, by the thread that works; one that cancels cancels
/// the job.
struct JobOptions {
  /// Of a scene's text. Its width, height and quality are those of `render`.
  ParseOptions parse;
  RenderOptions render;
  /// The host's way to run `work`, once, in some thread, now or later; a thread pool's for example. It must
  /// not run it before it returns where the caller does not want to wait. A job whose `work` is dropped is
  /// cancelled. Empty: each job has a thread of its own. What renders besides are the SPEs' threads
  /// (RenderOptions::spes).
  std::function<void(std::function<void()> work)> executor;
  /// Hears of the job every few milliseconds, by the thread that works. What it throws ends the job, and is
  /// what take() throws.
  std::function<void(const JobProgress& progress)> progress;
  /// Called once, when the job is over and take() would not wait: by the thread that worked, or by that which
  /// cancelled a job that still waited for one. Must not throw. `job` is the job, also if its owner has moved
  /// or not even finished constructing it, and is good during the call.
  std::function<void(RenderJob& job)> finished;
};

/// A job that runs, or has run. Movable; what has been moved from can be destroyed and assigned to only.
class CELLTRACE_EXPORT RenderJob {
public:
  /// Starts. Errors, also of options, are take()'s; what an executor throws passes through.
  explicit RenderJob(JobScene scene, JobOptions options = {});
  /// Cancels, and waits until no function of the options is called any more, unless one of these is who
  /// destroys it.
  ~RenderJob();
  RenderJob(RenderJob&&) noexcept;
  RenderJob& operator=(RenderJob&&) noexcept;

  /// Ends the job soon, whatever it does at the moment; if it is over, nothing happens.
  void cancel() noexcept;

  JobProgress progress() const;
  bool is_over() const;
  /// Until the job is over.
  void wait() const;
  /// As wait(); false if it takes longer.
  bool wait_for(std::chrono::milliseconds timeout) const;

  /// Waits, and returns the picture, once. Of a job that was cancelled while it rendered it is what was
  /// finished (RenderResult::complete). Throws Cancelled if it was cancelled before; else what parse_file()
  /// or render() threw; InputError the second time.
  RenderResult take();

  /// What has been found in the scene's text until now: the first thousand.
  std::vector<Finding> findings() const;
  /// The scene once it has been read, null before.
  std::shared_ptr<const Scene> scene() const;

private:
  class Impl;
  RenderJob(std::shared_ptr<Impl> impl, bool is_owner);
  void leave() noexcept;

  std::shared_ptr<Impl> impl_;
  bool is_owner_ = true; ///< not what `finished` gets
};

} // namespace celltrace

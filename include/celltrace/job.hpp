// Rendering in the background: a job makes a picture of a scene's file, its text or a Scene, while the
// application does something else.
//
//   RenderJob job("scene.pov", options);
//   job.cancel();                         // from any thread, at any time
//   RenderResult result = job.take();     // waits
//
// Thread safety: any thread may call any member of RenderJob at any time, except construction, assignment and
// destruction. Jobs are independent of each other: any number may run at once.
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

/// A scene in POV-Ray's language, in memory. Messages call it `name`.
struct SceneText {
  std::string text;
  std::string name = "<string>";
};

/// The scene of a job: a file, a text, or an existing Scene, which must not change while the job runs.
using JobScene = std::variant<std::filesystem::path, SceneText, Scene, std::shared_ptr<const Scene>>;

/// The work that a job does at the moment.
enum class JobPhase {
  waiting,  ///< the job waits for a thread
  reading,  ///< the scene's text is read
  building, ///< the scene image and the accelerator are built
  rendering,
  over
};

struct JobProgress {
  JobPhase phase = JobPhase::waiting;
  /// Share of the phase that is done, 0..1; stands still while loops or included files are read.
  double phase_fraction = 0;
  double fraction = 0; ///< share of the whole job that is done, 0..1; never falls
};

class RenderJob;

/// Options of a job. The functions in `parse` and `render` are called by the thread that works; if such a
/// function cancels, the whole job is cancelled.
struct JobOptions {
  /// Options for a scene that is read; width, height and quality are taken from `render`.
  ParseOptions parse;
  RenderOptions render;
  /// Runs `work` once in a thread of the application, such as a thread of a pool, now or later. If the
  /// executor runs `work` before it returns, the caller waits for the job. If `work` is dropped, the job is
  /// cancelled. Empty: each job has a thread of its own. The SPEs have further threads (RenderOptions::spes).
  std::function<void(std::function<void()> work)> executor;
  /// Called every few milliseconds by the thread that works. An exception of this function ends the job, and
  /// take() throws it.
  std::function<void(const JobProgress& progress)> progress;
  /// Called once, when the job is over and take() would not wait: by the thread that worked, or, if the job
  /// was cancelled while it waited for a thread, by the thread that cancelled it. Must not throw. `job`
  /// refers to the job even if its owner has moved it or has not finished constructing it, and is valid
  /// during the call.
  std::function<void(RenderJob& job)> finished;
};

/// A job that runs, or has run. Movable; a job that has been moved from can only be destroyed and assigned
/// to.
class CELLTRACE_EXPORT RenderJob {
public:
  /// Starts the job. take() throws all errors, including those of options; exceptions of an executor pass
  /// through.
  explicit RenderJob(JobScene scene, JobOptions options = {});
  /// Cancels the job. Waits until no function of the options is called any more, unless such a function
  /// destroys the job.
  ~RenderJob();
  RenderJob(RenderJob&&) noexcept;
  RenderJob& operator=(RenderJob&&) noexcept;

  /// Ends the job soon, whatever it does at the moment; does nothing if the job is over.
  void cancel() noexcept;

  JobProgress progress() const;
  bool is_over() const;
  /// Waits until the job is over.
  void wait() const;
  /// As wait(), for no longer than `timeout`. Returns whether the job is over.
  bool wait_for(std::chrono::milliseconds timeout) const;

  /// Waits, and returns the picture, once. If the job was cancelled while it rendered, the picture has the
  /// finished pixels (RenderResult::complete is false). Throws Cancelled if the job was cancelled before it
  /// rendered, else the exceptions of load_scene() or render(). Throws InputError when it is called again.
  RenderResult take();

  /// Returns the first thousand findings in the scene's text until now.
  std::vector<Finding> findings() const;
  /// Returns the scene once it has been read, null before.
  std::shared_ptr<const Scene> scene() const;

private:
  class Impl;
  RenderJob(std::shared_ptr<Impl> impl, bool is_owner);
  void leave() noexcept;

  std::shared_ptr<Impl> impl_;
  bool is_owner_ = true; ///< false for the RenderJob that is passed to JobOptions::finished
};

} // namespace celltrace

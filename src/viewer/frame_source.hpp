// Renders in a thread of its own what a window wants to show: coarsely first, then finely.
#pragma once

#include "celltrace/render.hpp"
#include "viewer/pace.hpp"

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace celltrace {
class Session;
}

namespace celltrace::viewer {

/// What is to be seen.
struct Wanted {
  std::shared_ptr<const Scene> scene; ///< null: nothing yet
  Camera camera;
  /// Machine, size and antialiasing, which only pictures at rest have.
  RenderOptions options;
  bool work_map = false;
  /// Grows whenever options change but for size, antialiasing and work_map: another machine is needed.
  std::uint64_t machine = 0;
  std::uint64_t number = 0; ///< of the input that asked for it; grows with each
};

/// What there is to be seen.
struct Frame {
  Image image; ///< smaller than the window by `scale`
  int scale = 1;
  bool is_complete = true; ///< false: it goes on growing
  bool is_final = false;   ///< nothing better comes until something else is wanted
  bool is_antialiased = false;
  std::uint64_t number = 0;    ///< Wanted::number
  RenderStatistics statistics; ///< of the last complete frame
  std::vector<WorkRecord> work;
  std::string error; ///< what went wrong instead; the image is empty then
};

/// What a point of the picture shows.
struct Picked {
  std::shared_ptr<const Scene> scene; ///< that was asked
  bool is_middle = false;             ///< ask_middle() asked
  std::uint64_t number = 0;           ///< Wanted::number of the picture
  std::optional<Index> object;        ///< its index in Scene::objects; nothing where there is none
  Vec3 point{0, 0, 0};                ///< on it
  double distance = 0;                ///< from where the camera's ray starts
  std::string error;                  ///< what went wrong instead
};

/// Thread safety: for one thread, which is not the one that renders.
class FrameSource {
public:
  /// `notify` is called by the rendering thread whenever take() has something.
  explicit FrameSource(std::function<void()> notify);
  /// Breaks off what is under way.
  ~FrameSource();
  FrameSource(const FrameSource&) = delete;
  FrameSource& operator=(const FrameSource&) = delete;

  /// Does not wait. What is under way for something else is broken off, unless it is about to be done.
  void want(const Wanted& wanted);
  /// The newest that has come since the last call.
  std::optional<Frame> take();

  /// Asks what the last picture shows `x` of its width from the left and `y` of its height from above. Does
  /// not wait: the answer comes when nothing is rendered.
  void pick(double x, double y);
  /// Asks the same about the middle of the picture.
  void ask_middle();
  std::optional<Picked> take_picked();

private:
  using Clock = std::chrono::steady_clock;

  struct Place {
    double x, y;
    bool is_middle;
  };

  void run();
  Picked look_at(const Place& place);
  void show(const Wanted& wanted);
  void take_machine(const Wanted& wanted);
  /// False: broken off, or there is nothing better to come.
  bool render(const Wanted& wanted, int scale, bool is_first, bool antialiased);
  bool goes_on(const Wanted& wanted, bool is_first, Clock::time_point start);
  void grow(const PictureBlock& block);
  void publish(Frame frame);

  const std::function<void()> notify_;
  std::mutex mutex_; ///< of the next seven
  std::condition_variable changed_;
  Wanted wanted_;
  std::optional<Frame> frame_;
  std::optional<Place> place_;
  std::optional<Picked> picked_;
  bool quits_ = false;

  // The rendering thread's own.
  std::unique_ptr<Session> session_;
  std::uint64_t machine_ = 0;
  std::shared_ptr<const Scene> scene_;
  Camera camera_; ///< of the last picture
  std::uint64_t number_ = 0;
  Pace pace_;
  /// A picture that grows while it is rendered; none if that is quick.
  std::optional<Frame> growing_;
  Clock::time_point grown_;
  RenderStatistics statistics_; ///< of the last complete frame
  Image last_;                  ///< its picture
  std::thread thread_;
};

} // namespace celltrace::viewer

// Renders pictures for a window in a thread of its own: coarsely first, then finely.
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

/// The picture that the window requests.
struct FrameRequest {
  std::shared_ptr<const Scene> scene; ///< null: none yet
  Camera camera;
  /// Machine, size and antialiasing; only pictures at rest are antialiased.
  RenderOptions options;
  bool work_map = false;
  /// Number that grows when options other than size, antialiasing and work_map change, which need another
  /// machine.
  std::uint64_t machine = 0;
  std::uint64_t number = 0; ///< number of the input that asked for the picture; grows with each input
};

/// A picture to show.
struct Frame {
  Image image; ///< smaller than the window by the factor `scale`
  int scale = 1;
  bool is_complete = true; ///< false: the picture is still growing
  bool is_final = false;   ///< true: nothing better comes until something else is wanted
  bool is_antialiased = false;
  std::uint64_t number = 0;    ///< FrameRequest::number
  RenderStatistics statistics; ///< statistics of the last complete frame
  std::vector<WorkRecord> work;
  std::string error; ///< message of an error; the image is empty then
};

/// The object at a point of the picture.
struct Picked {
  std::shared_ptr<const Scene> scene; ///< the scene that was queried
  bool is_middle = false;             ///< true for answers to pick_middle()
  std::uint64_t number = 0;           ///< FrameRequest::number of the picture
  std::optional<Index> object;        ///< index in Scene::objects; nothing if there is no object
  Vec3 point{0, 0, 0};                ///< point on the object
  double distance = 0;                ///< distance from the origin of the camera's ray
  std::string error;                  ///< message of an error
};

/// Renders for a window. Thread safety: for one thread, which is not the one that renders.
class FrameSource {
public:
  /// Starts the thread, which calls `notify` whenever take() has something.
  explicit FrameSource(std::function<void()> notify);
  /// Cancels the picture under way.
  ~FrameSource();
  FrameSource(const FrameSource&) = delete;
  FrameSource& operator=(const FrameSource&) = delete;

  /// Requests a picture, without waiting. A picture under way for something else is cancelled, unless it is
  /// nearly done.
  void request(const FrameRequest& request);
  /// Returns the newest frame since the last call.
  std::optional<Frame> take();

  /// Asks for the object in the last picture at `x` of its width from the left and `y` of its height from the
  /// top. Does not wait: the answer comes when nothing is rendered.
  void pick(double x, double y);
  /// Asks for the object in the middle of the picture.
  void pick_middle();
  std::optional<Picked> take_picked();

private:
  using Clock = std::chrono::steady_clock;

  struct Place {
    double x, y;
    bool is_middle;
  };

  void run();
  Picked pick(const Place& place);
  void show(const FrameRequest& request);
  void take_machine(const FrameRequest& request);
  /// Renders a picture. Returns false if it was cancelled, or if something else is request by
  /// now.
  bool render(const FrameRequest& request, int scale, bool is_first, bool antialiased);
  bool should_continue(const FrameRequest& request, bool is_first, Clock::time_point start);
  void grow(const PictureBlock& block);
  void publish(Frame frame);

  const std::function<void()> notify_;
  std::mutex mutex_; ///< guards the next seven members
  std::condition_variable changed_;
  FrameRequest request_;
  std::optional<Frame> frame_;
  std::optional<Place> place_;
  std::optional<Picked> picked_;
  bool quits_ = false;

  // The members below belong to the rendering thread.
  std::unique_ptr<Session> session_;
  std::uint64_t machine_ = 0;
  std::shared_ptr<const Scene> scene_;
  Camera camera_; ///< camera of the last picture
  std::uint64_t number_ = 0;
  Pace pace_;
  /// The picture that is shown while it is being rendered; none if rendering is quick.
  std::optional<Frame> growing_;
  Clock::time_point grown_;
  RenderStatistics statistics_; ///< statistics of the last complete frame
  Image last_;                  ///< picture of that frame
  std::thread thread_;
};

} // namespace celltrace::viewer

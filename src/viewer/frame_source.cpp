#include "viewer/frame_source.hpp"

#include "celltrace/camera_ray.hpp"
#include "celltrace/error.hpp"
#include "celltrace/session.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

namespace celltrace::viewer {

namespace {

/// Seconds from which on a picture is shown while it grows.
constexpr double kSlow = 0.2;
/// Time between two such updates.
constexpr std::chrono::milliseconds kGrowth(60);
/// Age from which a new input cancels the first picture; a younger one is finished.
constexpr std::chrono::milliseconds kLate(40);

int scaled(int size, int scale) {
  return std::max((size + scale - 1) / scale, 1);
}

double pixels_of(const RenderOptions& options) {
  return static_cast<double>(options.width) * options.height;
}

/// Resizes a picture by the nearest pixel.
Image resized(const Image& from, int width, int height) {
  Image to(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const auto column = static_cast<int>(std::int64_t{x} * from.width / width);
      const auto row = static_cast<int>(std::int64_t{y} * from.height / height);
      std::memcpy(to.pixel(x, y), from.pixel(column, row), 4);
    }
  return to;
}

} // namespace

FrameSource::FrameSource(std::function<void()> notify)
    : notify_(std::move(notify)), thread_([this] { run(); }) {
}

FrameSource::~FrameSource() {
  {
    const std::lock_guard lock(mutex_);
    quits_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

void FrameSource::request(const FrameRequest& request) {
  {
    const std::lock_guard lock(mutex_);
    request_ = request;
  }
  changed_.notify_one();
}

std::optional<Frame> FrameSource::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(frame_, std::nullopt);
}

void FrameSource::pick(double x, double y) {
  {
    const std::lock_guard lock(mutex_);
    place_ = {x, y, false};
  }
  changed_.notify_one();
}

void FrameSource::pick_middle() {
  {
    const std::lock_guard lock(mutex_);
    if (!place_) place_ = {0.5, 0.5, true};
  }
  changed_.notify_one();
}

std::optional<Picked> FrameSource::take_picked() {
  const std::lock_guard lock(mutex_);
  return std::exchange(picked_, std::nullopt);
}

void FrameSource::run() {
  std::uint64_t shown = 0;
  for (;;) {
    FrameRequest request;
    std::optional<Place> place;
    {
      std::unique_lock lock(mutex_);
      const auto is_new = [&] { return request_.number != shown && request_.scene; };
      changed_.wait(lock, [&] { return quits_ || is_new() || (place_ && session_); });
      if (quits_) return;
      if (!is_new()) place = std::exchange(place_, std::nullopt);
      request = request_;
    }
    if (place) {
      Picked picked = pick(*place);
      {
        const std::lock_guard lock(mutex_);
        picked_ = std::move(picked);
      }
      notify_();
      continue;
    }
    shown = request.number;
    try {
      show(request);
    } catch (const std::exception& error) {
      // The machine may be in any state.
      session_.reset();
      Frame frame;
      frame.error = error.what();
      frame.number = request.number;
      frame.is_final = true;
      publish(std::move(frame));
    }
  }
}

Picked FrameSource::pick(const Place& place) {
  Picked picked;
  picked.scene = scene_;
  picked.is_middle = place.is_middle;
  picked.number = number_;
  try {
    constexpr int kFine = 4096; // picture size for camera_ray(), in which places are measured
    const auto ray = camera_ray(camera_, kFine, kFine, place.x * kFine, place.y * kFine);
    if (!ray) return picked;
    const RayHit hit = session_->ray_queries().closest_hit(*ray);
    if (!hit) return picked;
    picked.object = hit.object;
    picked.distance = hit.distance;
    for (int axis = 0; axis < 3; ++axis)
      picked.point[axis] = ray->origin[axis] + double(hit.distance) * ray->direction[axis];
  } catch (const Error& error) {
    picked.error = error.what();
  }
  return picked;
}

void FrameSource::show(const FrameRequest& request) {
  take_machine(request);
  session_->set_camera(request.camera);
  camera_ = request.camera;
  number_ = request.number;
  const double pixels = pixels_of(request.options);
  int scale = pace_.first_scale(pixels);
  if (!render(request, scale, true, false)) return;
  while (scale > 1) {
    scale = pace_.next_scale(pixels, scale);
    if (!render(request, scale, false, false)) return;
  }
  if (request.options.antialiasing) render(request, 1, false, true);
}

void FrameSource::take_machine(const FrameRequest& request) {
  if (session_ && machine_ == request.machine && scene_ == request.scene) return;
  if (!session_ || machine_ != request.machine) {
    session_.reset();
    session_ = std::make_unique<Session>(*request.scene, request.options);
    machine_ = request.machine;
  } else {
    session_->replace(*request.scene);
  }
  scene_ = request.scene;
  pace_.forget();
}

bool FrameSource::render(const FrameRequest& request, int scale, bool is_first, bool antialiased) {
  RenderOptions options = request.options;
  options.width = scaled(options.width, scale);
  options.height = scaled(options.height, scale);
  if (!antialiased) options.antialiasing.reset();
  options.work_map = request.work_map;
  options.finished_block = nullptr;
  growing_.reset();
  if (pace_.expected(pixels_of(request.options), scale) > kSlow) {
    options.finished_block = [this](const PictureBlock& block) { grow(block); };
    growing_.emplace();
    growing_->image = last_.rgba.empty() ? Image(options.width, options.height)
                                         : resized(last_, options.width, options.height);
    growing_->scale = scale;
    growing_->number = request.number;
    growing_->is_complete = false;
    growing_->is_antialiased = antialiased;
    growing_->statistics = statistics_;
    grown_ = Clock::now();
  }
  session_->set_picture(options);

  const Clock::time_point start = Clock::now();
  double done = 0;
  RenderResult result = session_->render([&](double fraction) {
    done = fraction;
    return should_continue(request, is_first, start);
  });
  // Building a BVH does not count for the estimate of the next frame.
  const RenderStatistics& statistics = result.statistics;
  const std::chrono::duration<double> elapsed = Clock::now() - start;
  const double seconds = elapsed.count() - statistics.build_seconds - statistics.prepare_seconds;
  const double pixels = pixels_of(options);
  if (!antialiased) pace_.learn(seconds, result.complete ? pixels : done * pixels);
  if (!result.complete) return false;
  statistics_ = statistics;
  last_ = result.image;

  Frame frame;
  frame.image = std::move(result.image);
  frame.scale = scale;
  frame.is_final = scale == 1 && (antialiased || !request.options.antialiasing);
  frame.is_antialiased = antialiased;
  frame.number = request.number;
  frame.statistics = statistics;
  frame.work = std::move(result.work);
  publish(std::move(frame));
  return should_continue(request, false, start);
}

/// Returns whether the present picture is still worth finishing.
bool FrameSource::should_continue(const FrameRequest& request, bool is_first, Clock::time_point start) {
  const std::lock_guard lock(mutex_);
  if (quits_) return false;
  if (request_.number == request.number) return true;
  const bool is_other = request_.machine != request.machine || request_.scene != request.scene;
  return is_first && !is_other && Clock::now() - start < kLate;
}

void FrameSource::grow(const PictureBlock& block) {
  if (!growing_) return;
  const std::uint8_t* from = block.first;
  const auto bytes = static_cast<std::size_t>(block.region.right - block.region.left) * 4;
  for (int y = block.region.top; y < block.region.bottom; ++y, from += block.pitch)
    std::memcpy(growing_->image.pixel(block.region.left, y), from, bytes);
  const Clock::time_point now = Clock::now();
  if (now - grown_ < kGrowth) return;
  grown_ = now;
  publish(*growing_);
}

void FrameSource::publish(Frame frame) {
  {
    const std::lock_guard lock(mutex_);
    frame_ = std::move(frame);
  }
  notify_();
}

} // namespace celltrace::viewer

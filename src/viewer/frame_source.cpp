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

void FrameSource::want(const Wanted& wanted) {
  {
    const std::lock_guard lock(mutex_);
    wanted_ = wanted;
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

void FrameSource::ask_middle() {
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
    Wanted wanted;
    std::optional<Place> place;
    {
      std::unique_lock lock(mutex_);
      const auto is_new = [&] { return wanted_.number != shown && wanted_.scene; };
      changed_.wait(lock, [&] { return quits_ || is_new() || (place_ && session_); });
      if (quits_) return;
      if (!is_new()) place = std::exchange(place_, std::nullopt);
      wanted = wanted_;
    }
    if (place) {
      Picked picked = look_at(*place);
      {
        const std::lock_guard lock(mutex_);
        picked_ = std::move(picked);
      }
      notify_();
      continue;
    }
    shown = wanted.number;
    try {
      show(wanted);
    } catch (const std::exception& error) {
      // The machine may be in any state.
      session_.reset();
      Frame frame;
      frame.error = error.what();
      frame.number = wanted.number;
      frame.is_final = true;
      publish(std::move(frame));
    }
  }
}

Picked FrameSource::look_at(const Place& place) {
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

void FrameSource::show(const Wanted& wanted) {
  take_machine(wanted);
  session_->set_camera(wanted.camera);
  camera_ = wanted.camera;
  number_ = wanted.number;
  const double pixels = pixels_of(wanted.options);
  int scale = pace_.first_scale(pixels);
  if (!render(wanted, scale, true, false)) return;
  while (scale > 1) {
    scale = pace_.next_scale(pixels, scale);
    if (!render(wanted, scale, false, false)) return;
  }
  if (wanted.options.antialiasing) render(wanted, 1, false, true);
}

void FrameSource::take_machine(const Wanted& wanted) {
  if (session_ && machine_ == wanted.machine && scene_ == wanted.scene) return;
  if (!session_ || machine_ != wanted.machine) {
    session_.reset();
    session_ = std::make_unique<Session>(*wanted.scene, wanted.options);
    machine_ = wanted.machine;
  } else {
    session_->replace(*wanted.scene);
  }
  scene_ = wanted.scene;
  pace_.forget();
}

bool FrameSource::render(const Wanted& wanted, int scale, bool is_first, bool antialiased) {
  RenderOptions options = wanted.options;
  options.width = scaled(options.width, scale);
  options.height = scaled(options.height, scale);
  if (!antialiased) options.antialiasing.reset();
  options.work_map = wanted.work_map;
  options.finished_block = nullptr;
  growing_.reset();
  if (pace_.expected(pixels_of(wanted.options), scale) > kSlow) {
    options.finished_block = [this](const PictureBlock& block) { grow(block); };
    growing_.emplace();
    growing_->image = last_.rgba.empty() ? Image(options.width, options.height)
                                         : resized(last_, options.width, options.height);
    growing_->scale = scale;
    growing_->number = wanted.number;
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
    return goes_on(wanted, is_first, start);
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
  frame.is_final = scale == 1 && (antialiased || !wanted.options.antialiasing);
  frame.is_antialiased = antialiased;
  frame.number = wanted.number;
  frame.statistics = statistics;
  frame.work = std::move(result.work);
  publish(std::move(frame));
  return goes_on(wanted, false, start);
}

/// Returns whether the present picture is still worth finishing.
bool FrameSource::goes_on(const Wanted& wanted, bool is_first, Clock::time_point start) {
  const std::lock_guard lock(mutex_);
  if (quits_) return false;
  if (wanted_.number == wanted.number) return true;
  const bool is_other = wanted_.machine != wanted.machine || wanted_.scene != wanted.scene;
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

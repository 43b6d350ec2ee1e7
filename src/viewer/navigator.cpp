#include "viewer/navigator.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace celltrace::viewer {

namespace {

/// Length of a step, as a share of the scene's diagonal.
constexpr double kStep = 0.02;
constexpr double kDegreesPerStep = 5;
/// Smallest angle, in degrees, between the view of a camera that orbits a point and straight up or down.
constexpr double kNearestPole = 2;

Vec3 unit(const Vec3& v) {
  return v / std::max(glm::length(v), 1e-300);
}

struct View {
  const char* name;
  Vec3 direction, up;
};
/// Views besides the scene's own.
const View kViews[] = {{"front", {0, 0, 1}, {0, 1, 0}},  {"right", {-1, 0, 0}, {0, 1, 0}},
                       {"back", {0, 0, -1}, {0, 1, 0}},  {"left", {1, 0, 0}, {0, 1, 0}},
                       {"above", {0, -1, 0}, {0, 0, 1}}, {"corner", {1, -0.7, 1}, {0, 1, 0}}};

} // namespace

Navigator::Navigator(const Camera& camera, const Vec3& low, const Vec3& high)
    : camera_(camera), own_(camera), low_(low), high_(high) {
  size_ = glm::length(high - low);
  if (!(size_ > 0) || !std::isfinite(size_)) size_ = std::max(glm::length(camera.location), 1.0);
  names_.push_back("the scene's own");
  for (const View& view : kViews)
    names_.push_back(view.name);
  forget_pivot();
}

void Navigator::set_mode(Mode mode) {
  mode_ = mode;
}

Vec3 Navigator::up() const {
  return unit(camera_.up);
}

/// Returns the point on the camera's axis, in front of the camera, that is nearest to the middle of the
/// scene.
Vec3 Navigator::view_centre() const {
  const Vec3 axis = unit(camera_.direction);
  const double along = glm::dot(0.5 * (low_ + high_) - camera_.location, axis);
  return camera_.location + axis * std::max(along, 5 * kStep * size_);
}

void Navigator::forget_pivot() {
  has_pivot_ = false;
  pivot_ = view_centre();
  step_ = kStep * std::min(size_, 2 * glm::length(pivot_ - camera_.location));
}

/// Notes that the point in the middle has changed. Steps keep their length until set_pivot() is called, so
/// that going back leads back.
void Navigator::recentre_pivot() {
  has_pivot_ = false;
  pivot_ = view_centre();
}

void Navigator::set_pivot(double distance) {
  pivot_ = camera_.location + unit(camera_.direction) * distance;
  has_pivot_ = true;
  step_ = kStep * std::min(size_, 2 * distance);
}

void Navigator::rotate(const Vec3& axis, double degrees, const Vec3& around) {
  const double angle = degrees * std::numbers::pi / 180;
  const Vec3 a = unit(axis);
  const auto rotated = [&](const Vec3& v) { // Rodrigues' formula
    return v * std::cos(angle) + glm::cross(a, v) * std::sin(angle) +
           a * (glm::dot(a, v) * (1 - std::cos(angle)));
  };
  camera_.location = around + rotated(camera_.location - around);
  camera_.direction = rotated(camera_.direction);
  camera_.right = rotated(camera_.right);
  camera_.up = rotated(camera_.up);
}

void Navigator::orbit(double right, double up) {
  // Rotate around the vertical, then up or down, but not over a pole.
  rotate({0, 1, 0}, -right, pivot_);
  const Vec3 away = unit(camera_.location - pivot_);
  const double elevation = std::asin(std::clamp(away.y, -1.0, 1.0)) * 180 / std::numbers::pi;
  const double most = 90 - kNearestPole;
  const double by = std::clamp(up, std::min(-most - elevation, 0.0), std::max(most - elevation, 0.0));
  rotate(camera_.right, by, pivot_);
}

void Navigator::go(double right, double forward) {
  if (mode_ == Mode::radial)
    orbit(right * kDegreesPerStep, forward * kDegreesPerStep);
  else
    walk(right, forward);
}

void Navigator::walk(double right, double forward) {
  Vec3 ahead = camera_.direction;
  ahead.y = 0;
  if (glm::length(ahead) < 1e-6 * glm::length(camera_.direction)) ahead = {camera_.up.x, 0, camera_.up.z};
  camera_.location += step_ * (right * unit(camera_.right) + forward * unit(ahead));
  recentre_pivot();
}

void Navigator::rise(double steps) {
  if (mode_ == Mode::planar) {
    camera_.location.y += step_ * steps;
    recentre_pivot();
    return;
  }
  const Vec3 away = camera_.location - pivot_;
  const double distance = glm::length(away);
  camera_.location = pivot_ + away * (std::max(distance + step_ * steps, step_) / std::max(distance, 1e-300));
}

void Navigator::turn(double right, double up) {
  rotate({0, 1, 0}, right, camera_.location);
  rotate(camera_.right, -up, camera_.location);
  recentre_pivot();
}

void Navigator::zoom(double factor) {
  if (mode_ == Mode::radial) {
    camera_.location = pivot_ + (camera_.location - pivot_) / factor;
    return;
  }
  switch (camera_.kind) {
  case Camera::Kind::perspective:
    camera_.direction *= factor;
    return;
  case Camera::Kind::orthographic:
    camera_.right /= factor;
    camera_.up /= factor;
    return;
  default:
    camera_.location += unit(camera_.direction) * (step_ * 5 * std::log(factor));
    recentre_pivot();
  }
}

Camera Navigator::camera_towards(const Vec3& direction, const Vec3& up) const {
  Camera camera = own_;
  camera.kind = Camera::Kind::perspective;
  const Vec3 ahead = unit(direction);
  const double aspect = glm::length(own_.right) / std::max(glm::length(own_.up), 1e-300);
  const Vec3 right = unit(glm::cross(up, ahead));
  camera.right = right * aspect;
  camera.up = glm::cross(ahead, right);
  camera.direction = ahead;
  // A sphere around the scene is to be seen completely.
  const double radius = std::max(0.5 * glm::length(high_ - low_), step_);
  camera.location = 0.5 * (low_ + high_) - ahead * (2.2 * radius);
  return camera;
}

void Navigator::show_view(std::size_t view) {
  view_ = view % names_.size();
  camera_ = view_ == 0 ? own_ : camera_towards(kViews[view_ - 1].direction, kViews[view_ - 1].up);
  forget_pivot();
}

} // namespace celltrace::viewer

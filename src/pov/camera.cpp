#include "pov/camera.hpp"

#include <cmath>

#include <glm/geometric.hpp>

#include "celltrace/error.hpp"

namespace celltrace::pov {

namespace {

constexpr Vec3 kDefaultRight{1.33, 0, 0};
constexpr Vec3 kDefaultUp{0, 1, 0};
constexpr Vec3 kDefaultLookAt{0, 0, 1};
constexpr double kRadiansPerDegree = 3.14159265358979323846 / 180;
constexpr double kTiny = 1e-10;

void set_angle(Camera& camera, double degrees) {
  const double length = glm::length(camera.direction);
  const double width = glm::length(camera.right);
  if (length == 0) throw InputError("the camera has no direction");
  camera.direction *= width / (2 * std::tan(degrees * kRadiansPerDegree / 2)) / length;
}

/// Turns the camera towards a point; the sky says which way is up, and lengths and handedness stay as they
/// were.
void turn(Camera& camera, const Vec3& look_at, const Vec3& sky) {
  const Vec3 line_of_sight = look_at - camera.location;
  const double distance = glm::length(line_of_sight);
  if (distance < kTiny) return;
  const double sign = glm::dot(glm::cross(camera.up, camera.direction), camera.right) > 0 ? 1 : -1;
  const double depth = glm::length(camera.direction);
  const double height = glm::length(camera.up);
  const double width = glm::length(camera.right);

  const Vec3 forward = line_of_sight / distance;
  Vec3 sideways = glm::cross(sky, forward);
  if (glm::length(sideways) < kTiny) sideways = width > 0 ? camera.right : kDefaultRight;
  sideways = glm::normalize(sideways);
  camera.direction = forward * depth;
  camera.up = glm::cross(forward, sideways) * height;
  camera.right = sideways * (sign * width);
}

constexpr double kVersionOfOrthographicScale = 3.5; // before, right and up are its picture's size

/// An orthographic camera whose picture has no size of its own takes that of a perspective one at the
/// looked-at point.
void scale_orthographic(Camera& camera, double distance) {
  const double depth = glm::length(camera.direction);
  if (depth == 0) throw InputError("the camera has no direction");
  camera.right *= distance / depth;
  camera.up *= distance / depth;
}

bool is_finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

} // namespace

Camera CameraDefinition::finish(double version) const {
  Camera camera;
  camera.kind = kind;
  camera.right = right.value_or(kDefaultRight);
  camera.direction = direction;
  const bool has_angle = angle && *angle != 0;
  if (has_angle) {
    if (*angle < 0 || *angle >= 180) throw InputError("a camera's angle must lie between 0 and 180 degrees");
    set_angle(camera, *angle);
  }
  camera.up = up.value_or(kDefaultUp);
  camera.location = location;
  if (look_at) turn(camera, *look_at, sky);
  if (kind == Camera::Kind::orthographic && version >= kVersionOfOrthographicScale &&
      ((!right && !up) || angle))
    scale_orthographic(camera, glm::length(look_at.value_or(kDefaultLookAt) - location));

  camera.location = transform.point(camera.location);
  camera.direction = transform.direction(camera.direction);
  camera.right = transform.direction(camera.right);
  camera.up = transform.direction(camera.up);
  if (!is_finite(camera.location) || !is_finite(camera.direction) || !is_finite(camera.right) ||
      !is_finite(camera.up) || glm::length(camera.direction) == 0)
    throw InputError("the camera has no direction");
  return camera;
}

} // namespace celltrace::pov

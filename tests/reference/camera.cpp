#include "reference/camera.hpp"

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace celltrace::reference {

namespace {

constexpr double kPi = std::numbers::pi;

/// About a unit axis.
Vec3 turned(const Vec3& v, const Vec3& axis, double angle) {
  const Vec3 along = axis * glm::dot(axis, v);
  return along + (v - along) * std::cos(angle) + glm::cross(axis, v) * std::sin(angle);
}

/// The direction so far off forward, on the side of a point of the picture.
Vec3 off_forward(const Vec3& right, const Vec3& up, const Vec3& forward, double x, double y, double angle) {
  const double side = std::atan2(y, x);
  return (right * std::cos(side) + up * std::sin(side)) * std::sin(angle) + forward * std::cos(angle);
}

/// The point of a circle of radius 1 that is at (x, y) of an Omnimax picture, both from -1 to 1.
Vec3 omnimax_place(double aspect, double x, double y) {
  constexpr double kFull = 1.283458;
  if (aspect > kFull) return {x * aspect / kFull, (y - 1) / kFull + 1, 0};
  if (aspect > 1) return {x, (y - 1) / aspect + 1, 0};
  return {x, y / aspect, 0};
}

std::optional<Vec3> omnimax(const Vec3& right, const Vec3& up, const Vec3& forward, const Vec3& place) {
  const double r = glm::length(place);
  if (r > 1) return std::nullopt;
  const double angle = 1.411269 * r - 0.09439 * std::pow(r, 3) + 0.25674 * std::pow(r, 5);
  const double height = place.y == 0 ? 0 : std::sin(angle) * place.y / r;
  if (height < -std::cos(angle)) return std::nullopt;
  return off_forward(right, up, forward, place.x, place.y, angle);
}

} // namespace

std::optional<Ray> camera_ray(const Camera& camera, double x, double y) {
  const double u = x - 0.5, v = 0.5 - y;
  const double width = glm::length(camera.right), height = glm::length(camera.up);
  const Vec3 right = camera.right / width, up = camera.up / height;
  const Vec3 forward = glm::normalize(camera.direction);
  const double angle = camera.angle * kPi / 180, vertical = camera.vertical_angle * kPi / 180;
  const double across = angle * u, along = angle * v;
  const Vec3& eye = camera.location;
  std::optional<Vec3> direction;
  switch (camera.kind) {
  case Camera::Kind::perspective:
    direction = camera.direction + camera.right * u + camera.up * v;
    break;
  case Camera::Kind::orthographic:
    return Ray{eye + camera.right * u + camera.up * v, forward};
  case Camera::Kind::spherical:
    direction = turned(turned(forward, right, -vertical * v), up, across);
    break;
  case Camera::Kind::ultra_wide_angle: {
    const double steep = along * height / width;
    direction =
        right * std::sin(across) + up * std::sin(steep) + forward * (std::cos(across) * std::cos(steep));
    break;
  }
  case Camera::Kind::omnimax:
    direction = omnimax(right, up, forward, omnimax_place(width / height, 2 * u, 2 * v));
    break;
  case Camera::Kind::panoramic:
    direction = camera.direction * std::cos(kPi * u) + camera.right * std::sin(kPi * u) +
                camera.up * std::tan(kPi * v);
    break;
  case Camera::Kind::cylinder_1:
    direction = right * std::sin(across) + forward * std::cos(across) + camera.up * v;
    break;
  case Camera::Kind::cylinder_2:
    direction = up * std::sin(along) + forward * std::cos(along) + camera.right * u;
    break;
  case Camera::Kind::cylinder_3:
    return Ray{eye + camera.up * v, glm::normalize(right * std::sin(across) + forward * std::cos(across))};
  case Camera::Kind::cylinder_4:
    return Ray{eye + camera.right * u, glm::normalize(up * std::sin(along) + forward * std::cos(along))};
  case Camera::Kind::fisheye: {
    const double right_of = 2 * u * width, above = 2 * v * height;
    const double radius = std::hypot(right_of, above);
    if (radius <= 1) direction = off_forward(right, up, forward, right_of, above, radius * angle / 2);
    break;
  }
  }
  if (!direction) return std::nullopt;
  return Ray{eye, glm::normalize(*direction)};
}

} // namespace celltrace::reference

#include "prepare/eye.hpp"

#include "prepare/scene_origin.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace celltrace {

namespace {

constexpr double kNear = 256; ///< ratio of radius to distance from the surface

bool is_near(const Sphere& sphere, const Vec3& location) {
  const double radius = std::abs(sphere.radius);
  const double distance = glm::length(location - sphere.centre);
  return radius > kNear * std::abs(distance - radius) && distance > 0;
}

} // namespace

Eye::Eye(const Camera& camera, const Scene& scene, Moves moves) : Eye(camera, moves) {
  move_to(camera, scene);
}

void Eye::move_to(const Camera& camera, const Scene& scene) {
  start_ = location_ = camera.location;
  if (const double largest = largest_coordinate_from_afar(scene, location_); largest > 0)
    start_ = location_ * (2 * largest / glm::length(location_));
}

bool Eye::is_near_surface(const Sphere& sphere, const Transform& transform) const {
  if (transform.is_identity()) {
    if (is_near(sphere, location_)) return is_used_ = true;
    if (may_move_) spheres_.push_back(sphere);
    return false;
  }
  const Transform to_sphere = transform.inverse();
  if (is_near(sphere, to_sphere.point(location_))) return is_used_ = true;
  if (may_move_) placed_spheres_.push_back({sphere, to_sphere});
  return false;
}

bool Eye::prepares_alike_but_boundaries(const Vec3& location) const {
  if (is_used_ || !may_move_) return false;
  return std::none_of(spheres_.begin(), spheres_.end(),
                      [&](const Sphere& sphere) { return is_near(sphere, location); }) &&
         std::none_of(placed_spheres_.begin(), placed_spheres_.end(), [&](const PlacedSphere& placed) {
           return is_near(placed.sphere, placed.to_sphere.point(location));
         });
}

} // namespace celltrace

#include "celltrace/scene.hpp"

#include "celltrace/error.hpp"

#include <cmath>
#include <initializer_list>
#include <numbers>

#include <glm/geometric.hpp>

namespace celltrace {

Camera Camera::look_at(const Vec3& from, const Vec3& to, double angle, std::optional<double> aspect,
                       const Vec3& sky) {
  for (const Vec3& given : {from, to, sky})
    if (!std::isfinite(given.x + given.y + given.z))
      throw InputError("the camera has a number that is not finite");
  if (!(angle > 0 && angle < 180)) throw InputError("the camera's angle has to be above 0 and below 180");
  if (aspect && (!(*aspect > 0) || !std::isfinite(*aspect)))
    throw InputError("the camera's aspect ratio has to be above 0");
  const Vec3 way = to - from;
  const Vec3 across = glm::cross(sky, way);
  if (!(glm::dot(across, across) > 0))
    throw InputError(way == Vec3(0)
                         ? "look_at: the camera is where it looks to"
                         : "look_at: the camera looks along `sky`, or `sky` is 0: pass another `sky`");
  Camera camera;
  camera.location = from;
  const double half_angle = angle * std::numbers::pi / 360;
  camera.direction = glm::normalize(way);
  camera.right = 2 * std::tan(half_angle) * glm::normalize(across);
  camera.framing = aspect ? Framing::fixed : Framing::width;
  camera.up = glm::length(camera.right) / aspect.value_or(4.0 / 3) *
              glm::normalize(glm::cross(camera.direction, across));
  return camera;
}

Index Scene::add(const Material& material) {
  materials.push_back(material);
  return static_cast<Index>(materials.size() - 1);
}

Index Scene::add(const Interior& interior) {
  interiors.push_back(interior);
  return static_cast<Index>(interiors.size() - 1);
}

} // namespace celltrace

#include "query_side.hpp"

#include <cmath>
#include <random>

#include <glm/geometric.hpp>

namespace celltrace::compare {

namespace {

Ray ray_of(const Vec3& origin, const Vec3& direction) {
  const Vec3 unit = glm::normalize(direction);
  Ray ray;
  for (int axis = 0; axis < 3; ++axis) {
    ray.origin[axis] = static_cast<float>(origin[axis]);
    ray.direction[axis] = static_cast<float>(unit[axis]);
  }
  return ray;
}

} // namespace

std::vector<Ray> primary_rays(const Model& model, int size) {
  constexpr int kPacket = 4, kBundle = 16;
  const Camera& camera = model.camera;
  std::vector<Ray> rays;
  rays.reserve(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
  const auto add = [&](int column, int row) {
    if (column >= size || row >= size) return;
    const double x = (column + 0.5) / size - 0.5, y = 0.5 - (row + 0.5) / size;
    rays.push_back(ray_of(camera.location, camera.direction + x * camera.right + y * camera.up));
  };
  for (int top = 0; top < size; top += kBundle)
    for (int left = 0; left < size; left += kBundle)
      for (int packet = 0; packet < kBundle; ++packet)
        for (int lane = 0; lane < kBundle; ++lane)
          add(left + packet % kPacket * kPacket + lane % kPacket,
              top + packet / kPacket * kPacket + lane / kPacket);
  return rays;
}

std::vector<Ray> scattered_rays(std::span<const Ray> rays, std::span<const float> distances) {
  std::mt19937 random(1);
  std::normal_distribution<double> component;
  std::vector<Ray> scattered;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (!std::isfinite(distances[i])) continue;
    const Vec3 along(rays[i].direction[0], rays[i].direction[1], rays[i].direction[2]);
    const Vec3 origin =
        Vec3(rays[i].origin[0], rays[i].origin[1], rays[i].origin[2]) + along * double{distances[i]};
    Vec3 direction(component(random), component(random), component(random));
    if (glm::dot(direction, along) > 0) direction = -direction;
    scattered.push_back(ray_of(origin - along * 1e-3, direction));
  }
  return scattered;
}

} // namespace celltrace::compare

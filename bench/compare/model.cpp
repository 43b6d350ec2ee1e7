#include "model.hpp"

#include "celltrace/error.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

#include <glm/geometric.hpp>

namespace celltrace::compare {

namespace {

constexpr double kHalfAngleTangent = 0.36397; // 20 degrees

template <class Visit> void for_each_point(Model& model, Visit visit) {
  for (Vec3f& vertex : model.vertices)
    visit(vertex, 0.0f);
  for (glm::vec4& sphere : model.spheres) {
    Vec3f centre(sphere);
    visit(centre, sphere.w);
    sphere = glm::vec4(centre, sphere.w);
  }
}

/// Moves and scales everything; returns the new radius about the origin.
void normalise_size(Model& model) {
  Vec3f low(std::numeric_limits<float>::max());
  Vec3f high(-std::numeric_limits<float>::max());
  for_each_point(model, [&](Vec3f& point, float radius) {
    low = glm::min(low, point - radius);
    high = glm::max(high, point + radius);
  });
  const Vec3f centre = (low + high) / 2.0f;
  const float scale = 2 * kModelRadius / glm::length(high - low);
  for_each_point(model, [&](Vec3f& point, float) { point = (point - centre) * scale; });
  for (glm::vec4& sphere : model.spheres)
    sphere.w *= scale;
}

} // namespace

void present(Model& model, const Vec3& direction) {
  normalise_size(model);
  const Vec3 forward = glm::normalize(direction);
  const Vec3 right = glm::normalize(glm::cross(Vec3(0, 1, 0), forward));
  const Vec3 up = glm::cross(forward, right);
  double distance = 0;
  for_each_point(model, [&](Vec3f& point, float radius) {
    const Vec3 p(point);
    const double off_axis = std::max(std::abs(glm::dot(p, right)), std::abs(glm::dot(p, up)));
    distance = std::max(distance, (off_axis + 1.1 * radius) / kHalfAngleTangent - glm::dot(p, forward));
  });
  model.camera.location = -1.02 * distance * forward;
  model.camera.direction = forward;
  model.camera.right = 2 * kHalfAngleTangent * right;
  model.camera.up = 2 * kHalfAngleTangent * up;
  model.light = model.camera.location + Vec3(kModelRadius) * (right + 1.5 * up);
}

Model load_model(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::int32_t count = 0;
  file.read(reinterpret_cast<char*>(&count), sizeof count);
  if (!file || count < 1 || count > 100'000'000)
    throw InputError("'" + path.string() + "' is not a triangle soup");
  std::vector<glm::vec4> padded(3 * static_cast<std::size_t>(count));
  file.read(reinterpret_cast<char*>(padded.data()),
            static_cast<std::streamsize>(padded.size() * sizeof padded[0]));
  if (!file) throw InputError("'" + path.string() + "' is too short for its triangles");

  Model model;
  model.name = path.stem().string();
  model.vertices.assign(padded.begin(), padded.end());
  for (std::uint32_t i = 0; i < model.vertices.size(); i += 3)
    model.triangles.push_back({i, i + 1, i + 2});
  present(model, {-0.5, -0.3, 1});
  return model;
}

Model moved(const Model& model, int step) {
  Model result = model;
  const float phase = static_cast<float>(step);
  for_each_point(result, [&](Vec3f& point, float) {
    const Vec3f wave(std::sin(0.5f * point.y + phase), std::sin(0.5f * point.z + phase),
                     std::sin(0.5f * point.x + phase));
    point += 0.02f * kModelRadius * wave;
  });
  return result;
}

} // namespace celltrace::compare

#include "generated.hpp"

#include <cmath>
#include <random>

#include <glm/geometric.hpp>

namespace celltrace::compare {

namespace {

/// Uniform on the unit sphere. Not std::uniform_real_distribution, which differs from library to library.
class RandomDirection {
public:
  Vec3f operator()() {
    for (;;) {
      const Vec3f point(coordinate(), coordinate(), coordinate());
      const float square = glm::dot(point, point);
      if (square > 1e-4f && square <= 1.0f) return point / std::sqrt(square);
    }
  }
  float coordinate() { return static_cast<float>(generator_()) * (2.0f / 4294967295.0f) - 1.0f; }

private:
  std::mt19937 generator_{1};
};

std::string numbered(const char* name, std::size_t count) {
  return name + std::string("-") + std::to_string(count);
}

} // namespace

Model hills(std::size_t triangles) {
  const auto side = static_cast<std::uint32_t>(std::ceil(std::sqrt(static_cast<double>(triangles) / 2)));
  Model model;
  model.name = numbered("hills", triangles);
  for (std::uint32_t z = 0; z <= side; ++z)
    for (std::uint32_t x = 0; x <= side; ++x) {
      const float u = static_cast<float>(x) / static_cast<float>(side);
      const float v = static_cast<float>(z) / static_cast<float>(side);
      const float height = 0.06f * std::sin(9 * u + 4 * v) * std::cos(7 * v) +
                           0.01f * std::sin(61 * u) * std::sin(53 * v - 8 * u);
      model.vertices.push_back({u, height, v});
    }
  for (std::uint32_t z = 0; z < side; ++z)
    for (std::uint32_t x = 0; x < side; ++x) {
      const std::uint32_t corner = z * (side + 1) + x;
      model.triangles.push_back({corner, corner + 1, corner + side + 1});
      model.triangles.push_back({corner + 1, corner + side + 2, corner + side + 1});
    }
  present(model, {-0.3, -0.7, 1});
  return model;
}

Model random_triangles(std::size_t triangles) {
  const float edge = 1.5f / std::cbrt(static_cast<float>(triangles));
  RandomDirection random;
  Model model;
  model.name = numbered("random", triangles);
  for (std::size_t i = 0; i < triangles; ++i) {
    const Vec3f centre(random.coordinate(), random.coordinate(), random.coordinate());
    const auto first = static_cast<std::uint32_t>(model.vertices.size());
    for (int corner = 0; corner < 3; ++corner)
      model.vertices.push_back(centre + edge * random());
    model.triangles.push_back({first, first + 1, first + 2});
  }
  present(model, {-0.5, -0.3, 1});
  return model;
}

Model sphere_flake(std::size_t spheres) {
  constexpr int kChildren = 9;
  RandomDirection random;
  Model model;
  model.name = numbered("flake", spheres);
  model.spheres.push_back({0, 0, 0, 1});
  for (std::size_t parent = 0; model.spheres.size() < spheres; ++parent)
    for (int child = 0; child < kChildren && model.spheres.size() < spheres; ++child) {
      const glm::vec4 on = model.spheres[parent];
      const float radius = on.w / 3;
      model.spheres.push_back(glm::vec4(Vec3f(on) + (on.w + radius) * random(), radius));
    }
  present(model, {-0.5, -0.3, 1});
  return model;
}

} // namespace celltrace::compare

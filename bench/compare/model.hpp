// What both ray tracers are given: triangles or spheres, a camera that sees all of them, one light.
#pragma once

#include "celltrace/scene.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <glm/vec4.hpp>

namespace celltrace::compare {

/// Triangles, or spheres: one of the lists is empty.
struct Model {
  std::string name;
  std::vector<Vec3f> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<glm::vec4> spheres; ///< centre and radius
  Camera camera;                  ///< for square pictures
  Vec3 light{0, 0, 0};

  std::size_t primitives() const { return triangles.size() + spheres.size(); }
};

/// Grey on a background that no grey surface can be mistaken for.
inline constexpr float kPigment = 0.8f;
inline constexpr float kDiffuse = 0.7f;
inline constexpr float kAmbient = 0.1f;
inline constexpr float kBackground[3] = {0, 0, 1};

/// Scales the model to a bounding radius of kModelRadius about the origin, and sets camera and light: the
/// camera looks along `direction` from as near as shows every vertex.
void present(Model& model, const Vec3& direction);
inline constexpr float kModelRadius = 10;

/// Reads a triangle soup of ../shared/models: int32 n, then 3n vertices of four float32. Throws InputError.
Model load_model(const std::filesystem::path& path);

/// The model with every vertex or centre moved, differently for different `step`s.
Model moved(const Model& model, int step);

} // namespace celltrace::compare

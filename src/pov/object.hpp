// Objects as declared: shapes, unions and light sources with their modifiers.
#pragma once

#include <array>
#include <memory>
#include <variant>
#include <vector>

#include "celltrace/scene.hpp"
#include "pov/location.hpp"
#include "pov/texture.hpp"

namespace celltrace::pov {

struct ObjectDefinition;
using ObjectPtr = std::shared_ptr<const ObjectDefinition>;
using Children = std::shared_ptr<const std::vector<ObjectPtr>>;

/// A mesh whose triangles refer to its own textures; it becomes the scene's when it is first placed.
struct MeshDefinition {
  Mesh mesh;
  std::vector<TexturePtr> textures;
};

/// One triangle as written in a mesh or alone. Without normals it is flat.
struct TriangleDefinition {
  std::array<Vec3, 3> vertices{};
  std::array<Vec3, 3> normals{};
  bool is_smooth = false;
  TexturePtr texture; ///< null: the mesh's

  /// As POV-Ray moves a triangle that stands alone: its normals, too, corner by corner.
  TriangleDefinition transformed(const Transform& transform) const;
};

struct ObjectDefinition {
  std::variant<Sphere, std::shared_ptr<MeshDefinition>, std::shared_ptr<TriangleDefinition>, Children, Light>
      shape;
  Transform transform;
  TexturePtr texture; ///< null: the parent's, then the default
  InteriorPtr interior;
  bool no_shadow = false;
  UnsupportedPtr unsupported;
  int depth = 0; ///< of unions inside one another

  void apply(const Transform& next) { transform = transform.then(next); }
};

} // namespace celltrace::pov

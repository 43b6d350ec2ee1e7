// Objects as declared: shapes, unions and light sources with their modifiers.
#pragma once

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

struct ObjectDefinition {
  std::variant<Sphere, std::shared_ptr<MeshDefinition>, Children, Light> shape;
  Transform transform;
  TexturePtr texture; ///< null: the parent's, then the default
  InteriorPtr interior;
  bool no_shadow = false;
  UnsupportedPtr unsupported;
  int depth = 0; ///< of unions inside one another

  void apply(const Transform& next) { transform = transform.then(next); }
};

} // namespace celltrace::pov

// Scenes in Python, whose meshes may have colours.
#pragma once

#include "celltrace/scene.hpp"

#include <memory>
#include <vector>

namespace celltrace {

/// A mesh with colours whose materials are already in a scene.
struct PlacedColours {
  std::shared_ptr<const Mesh> of; ///< the mesh as the user passed it
  Material material;              ///< the material that its colours were combined with
  std::shared_ptr<const Mesh> mesh;
  Index index; ///< material index for objects with this mesh
};

struct PythonScene : Scene {
  PythonScene() = default;
  PythonScene(Scene scene) : Scene(std::move(scene)) {}

  std::vector<PlacedColours> placed_colours; ///< shared by instances
};

} // namespace celltrace

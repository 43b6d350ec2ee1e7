// Scenes as Python has them: meshes may have colours.
#pragma once

#include "celltrace/scene.hpp"

#include <memory>
#include <vector>

namespace celltrace {

/// A mesh with colours whose materials are in a scene already.
struct PlacedColours {
  std::shared_ptr<const Mesh> of; ///< the mesh as it was given
  Material material;              ///< that they were made of
  std::shared_ptr<const Mesh> mesh;
  Index index; ///< of the material that an object has with it
};

struct PythonScene : Scene {
  PythonScene() = default;
  PythonScene(Scene scene) : Scene(std::move(scene)) {}

  std::vector<PlacedColours> placed_colours; ///< instances share them
};

} // namespace celltrace

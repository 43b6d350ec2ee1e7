// Meshes as Python has them: with colours, which become materials where a scene gets such a mesh.
#pragma once

#include "celltrace/scene.hpp"

#include <memory>
#include <vector>

namespace celltrace {

/// One of the two lists has entries.
struct MeshColours {
  /// Linear colours; the mesh's own indices of materials are those of this list.
  std::vector<Vec3> palette;
  /// Linear colours, blended over the mesh's surface coordinate u from kFirstOfMap to kLastOfMap.
  std::vector<Vec3> map;
};
// Patterns repeat after one unit: both ends have to be well inside of it.
inline constexpr double kFirstOfMap = 0.25, kLastOfMap = 0.75;

struct PythonMesh {
  std::shared_ptr<const Mesh> mesh;
  std::shared_ptr<const MeshColours> colours = nullptr;
};

/// What an object has in place of a mesh with colours: they are in its materials.
struct ColouredObject {
  std::shared_ptr<const Mesh> mesh;
  Index material;
};
/// Adds materials with the finish of `material` to the scene. Throws ValueError if that is more than a finish
/// and one pigment.
ColouredObject add_colours(Scene& scene, const PythonMesh& mesh, const Material& material);

} // namespace celltrace

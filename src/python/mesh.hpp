// Meshes in Python: they may have colours, which become materials when a mesh is added to a scene.
#pragma once

#include "celltrace/scene.hpp"

#include <memory>
#include <vector>

namespace celltrace {

/// The colours of a mesh. Only one of the two lists has entries.
struct MeshColours {
  /// Linear colours; the mesh's own material indices refer to this list.
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

/// The parts of an object that replace a mesh with colours, which are in the materials.
struct ColouredObject {
  std::shared_ptr<const Mesh> mesh;
  Index material;
};
/// Adds materials with the finish of `material` to the scene. Throws ValueError if `material` has more than a
/// finish and one pigment.
ColouredObject add_colours(Scene& scene, const PythonMesh& mesh, const Material& material);

} // namespace celltrace

// Takes CSG apart: finds the shapes with visible surfaces, and for each shape the condition that tells at
// which points its surface exists. The kernel tests these conditions with the tables defined here.
#pragma once

#include "celltrace/scene.hpp"
#include "records/csg.hpp"
#include "scene_image/crossed_meshes.hpp"
#include "scene_image/shape_data_table.hpp"
#include "scene_image/mesh_insides.hpp"
#include "scene_image/shapes.hpp"
#include "scene_image/solid_boundary.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace celltrace {

/// The surface of a shape that CSG limits.
struct CsgPart {
  Object object;           ///< object that is no CSG, placed in the world
  PlacedShape shape;       ///< unset if the object is a mesh
  std::uint32_t condition; ///< index in CsgParts::conditions, or kNoCondition
  kernel::Aabb bounds;     ///< bounds of the part of the surface that may exist
  bool is_bounded;         ///< false if `bounds` are infinite
  std::size_t whole = 0;   ///< index in the scene of the object that the part belongs to

  /// Returns whether the part's record refers to a condition; parts of plain unions are ordinary objects.
  bool is_limited() const;
};
constexpr std::uint32_t kNoCondition = 0xFFFFFFFF;
inline bool CsgPart::is_limited() const {
  return condition != kNoCondition;
}

/// A shape whose faces are shown by a part with another shape.
struct CsgSurface {
  PlacedShape shape;
  kernel::Aabb bounds;   ///< bounds of the faces
  std::size_t whole = 0; ///< index in the scene of the object that the surface belongs to
};

/// The parts of all CSGs of a scene. The tables refer to each other by indices, which TableWriter turns into
/// offsets in the scene image.
struct CsgParts {
  std::vector<CsgPart> parts;
  std::vector<CsgSurface> replaced;
  /// Conditions, in which `next` and `steps` are indices of a condition and of a step.
  std::vector<kernel::CsgRecord> conditions;
  /// Steps of the programs, in which `solid` is an index in `solids`.
  std::vector<kernel::CsgStep> steps;
  /// Solids. In a mesh, `extra` is an index in meshes.grids() or in crossed_meshes.records().
  std::vector<kernel::SolidRecord> solids;
  std::vector<SolidBoundary> boundaries; ///< solids whose records depend on the eye
  MeshInsides meshes;
  ShapeDataTable shape_data; ///< records of solids, and of the scene's other shapes once they are added
  CrossedMeshes crossed_meshes;

  CsgParts() = default;
  /// Takes apart every object of the scene that is a CSG or clipped. The first conditions, one for each of
  /// `patterns`, describe the insides of these objects, which have no meshes. Among the first `convex`
  /// objects, solids between planes become boxes or meshes if the flags of their materials allow it. Throws
  /// InputError if a CSG nests too deeply or a transformation is singular.
  CsgParts(const Scene& scene, const Eye& eye,
           const std::vector<std::shared_ptr<const Object>>& patterns = {}, std::size_t convex = 0,
           const std::vector<std::uint32_t>& material_flags = {});

  /// Returns whether an object is taken apart: true if it is a CSG or clipped.
  static bool contains(const Object& object);
};

} // namespace celltrace

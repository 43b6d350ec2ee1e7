// CSG taken apart: the shapes whose surfaces it shows, each with the condition under which a point of the
// surface is there, and the tables that say so to the kernel.
#pragma once

#include "celltrace/scene.hpp"
#include "records/csg.hpp"
#include "scene_image/crossed_meshes.hpp"
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
  Object object;           ///< no CSG; placed in the world
  PlacedShape shape;       ///< of no mesh
  std::uint32_t condition; ///< index in CsgParts::conditions, or kNoCondition
  kernel::Aabb bounds;     ///< of what may be there of it
  bool is_bounded;         ///< false: `bounds` reach to infinity
  std::size_t whole = 0;   ///< index of the object of the scene that it is a part of

  /// Whether its record needs the CSG: parts of plain unions are objects like others.
  bool is_limited() const;
};
constexpr std::uint32_t kNoCondition = 0xFFFFFFFF;
inline bool CsgPart::is_limited() const {
  return condition != kNoCondition;
}

/// A shape whose faces are shown as those of a part of another shape.
struct CsgSurface {
  PlacedShape shape;
  kernel::Aabb bounds;   ///< around those faces
  std::size_t whole = 0; ///< as of a part
};

/// Of all CSGs of a scene. Indices become offsets in the scene image.
struct CsgParts {
  std::vector<CsgPart> parts;
  std::vector<CsgSurface> replaced;
  /// `next` and `steps` are indices.
  std::vector<kernel::CsgRecord> conditions;
  /// `solid` is an index.
  std::vector<kernel::CsgStep> steps;
  /// `extra` of a mesh is an index in meshes.grids(), or in crossed_meshes.records().
  std::vector<kernel::SolidRecord> solids;
  std::vector<SolidBoundary> boundaries; ///< of solids, written for the eye
  MeshInsides meshes;
  CrossedMeshes crossed_meshes;

  CsgParts() = default;
  /// Takes every object of the scene apart that is a CSG or clipped. The first conditions say what is inside
  /// of `patterns`, objects without meshes, one each. Of the first `convex` objects, solids between planes
  /// become boxes or meshes, where the flags of their materials allow it. Throws InputError if one nests too
  /// deeply or a transformation is singular.
  CsgParts(const Scene& scene, const Eye& eye,
           const std::vector<std::shared_ptr<const Object>>& patterns = {}, std::size_t convex = 0,
           const std::vector<std::uint32_t>& material_flags = {});

  /// Whether an object is among them.
  static bool contains(const Object& object);
};

} // namespace celltrace

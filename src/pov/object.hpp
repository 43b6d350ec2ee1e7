// Objects as declared: shapes, CSG and light sources with their modifiers.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "celltrace/scene.hpp"
#include "geometry/triangle_tree.hpp"
#include "pov/heap_value.hpp"
#include "pov/location.hpp"
#include "pov/memory.hpp"
#include "pov/texture.hpp"
#include "pov/token.hpp"

namespace celltrace::pov {

struct ObjectDefinition;
using ObjectPtr = std::shared_ptr<const ObjectDefinition>;

/// A shape of the Scene, but never a mesh or CSG: these become shapes of the Scene when they are placed.
using Shape = decltype(Object::shape);

/// Returns whether the result of an operation contains all points of each part.
inline bool joins(Csg::Operation operation) {
  return operation == Csg::Operation::union_ || operation == Csg::Operation::merge;
}

/// CSG as written: a union or another operation on objects.
struct Compound {
  Csg::Operation operation = Csg::Operation::union_;
  std::vector<ObjectPtr> parts;
  TexturePtr cut_texture; ///< default texture of parts, in the CSG's own space; null: the ordinary default
  bool is_light_group = false; ///< true: light sources among its parts shine on the other parts alone
  bool global_lights = false;  ///< for a light group: all other lights shine on it, too
};

/// An object whose inside limits another one.
struct Limit {
  ObjectPtr object;
  Transform transform; ///< applied after the object's own
};
void transform_limits(std::vector<Limit>& limits, const Transform& next);

/// A mesh whose triangles refer to its own textures; it becomes the scene's when it is first placed.
struct BicubicPatch;
struct HeightField;
struct MeshDefinition {
  Mesh mesh;
  std::shared_ptr<const BicubicPatch>
      patch;                  ///< patch whose triangles depend on where it is placed; null: none
  std::shared_ptr<const HeightField> height_field; ///< that the mesh is made of; null: none
  bool ignores_clips = false; ///< `clipped_by` has no effect, as for POV-Ray's patches
  std::vector<TexturePtr> textures;
  std::unique_ptr<geometry::TriangleTree> tree; ///< built when the scene first queries the mesh
};

/// A triangle as written in a mesh or alone. Without normals it is flat.
struct TriangleDefinition {
  std::array<Vec3, 3> vertices{};
  std::array<Vec3, 3> normals{};
  bool is_smooth = false;
  std::array<Vec2f, 3> coordinates{}; ///< surface coordinates of the corners
  bool is_mapped = false;             ///< has surface coordinates
  std::array<TexturePtr, 3> textures; ///< textures at the corners; null: the mesh's

  bool is_finite() const;
  /// Returns whether POV-Ray shows the triangle if it stands alone: all normals must be nonzero and finite,
  /// and on one side of it.
  bool is_shown_alone() const;
  /// Returns the triangle as POV-Ray moves one that stands alone: normals are transformed, too, corner by
  /// corner.
  TriangleDefinition transformed(const Transform& transform) const;
};

/// A light source, with the objects attached to it.
struct LightDefinition {
  Light light;
  ObjectPtr looks_like; ///< placed at the light; null: none
  LightArea area;       ///< properties given before or after the area itself
  bool has_area = false;
  bool shines_from_places = false;       ///< area_illumination: every place of the area emits light
  ObjectPtr projected_through = nullptr; ///< placed at the light; null: none
  bool media_attenuation = false, media_interaction = true;
};

struct ObjectDefinition {
  std::variant<Shape, std::shared_ptr<MeshDefinition>, std::shared_ptr<TriangleDefinition>,
               std::shared_ptr<const Compound>, HeapValue<LightDefinition>>
      shape;
  Location where;        ///< place in the text where it is written, or referred to within other objects
  NameId name = kNoName; ///< name that it was declared with, if an application needs it (origins.hpp)
  Transform transform;
  TexturePtr inside;                 ///< texture of its inside; null: that of its outside, or the parent's
  TexturePtr texture;                ///< null: the parent's, then the default
  RareTransform texture_transform;   ///< transformations since the object got its texture
  bool uv_mapping = false;           ///< true: textures are on its surface coordinates
  RareTransform transform_before_uv; ///< transformations before `uv_mapping`, which alone move textures
  InteriorPtr interior;
  bool reaches_out_of_bounds = false; ///< reaches out of its `bounded_by`
  bool no_shadow = false;
  bool no_image = false;
  bool no_reflection = false;
  bool is_lit_through = false;
  std::optional<bool> hollow; ///< not given: that of the object around it
  bool inverse = false;
  std::vector<Limit> clipped_by;
  std::vector<Limit> bounded_by; ///< no effect, until something is clipped by it
  UnsupportedPtr unsupported;
  UnsupportedPtr missing;        ///< stands for a shape that this program lacks
  bool is_photon_target = false; ///< never set for lights
  /// The relation of an object to the light source that is being read.
  enum class Role { none, look, projector };
  Role role = Role::none;
  bool is_declared = false; ///< has a name: a copy is placed
  int depth = 0;            ///< levels of nested objects
  std::uint64_t size = 1; ///< number of objects that are placed with it, itself included, at most kMostParts
  static constexpr std::uint64_t kMostParts = std::uint64_t{1} << 62;
  [[no_unique_address]] Counted<ObjectDefinition> counted;

  /// Returns the light source, or null if the object is none.
  const LightDefinition* light() const {
    const auto* light = std::get_if<HeapValue<LightDefinition>>(&shape);
    return light ? &**light : nullptr;
  }
  /// Transforms the object with its texture and its limits.
  void apply(const Transform& next);
};

} // namespace celltrace::pov

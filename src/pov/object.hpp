// Objects as declared: shapes, CSG and light sources with their modifiers.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "celltrace/scene.hpp"
#include "pov/heap_value.hpp"
#include "pov/location.hpp"
#include "pov/memory.hpp"
#include "pov/texture.hpp"
#include "pov/token.hpp"
#include "scene/triangle_tree.hpp"

namespace celltrace::pov {

struct ObjectDefinition;
using ObjectPtr = std::shared_ptr<const ObjectDefinition>;

/// A shape as the Scene has it. Never a mesh or CSG here: those become the Scene's when they are placed.
using Shape = decltype(Object::shape);

/// Whether it is where any of its parts is.
inline bool joins(Csg::Operation operation) {
  return operation == Csg::Operation::union_ || operation == Csg::Operation::merge;
}

/// CSG as written: a union and its like, over other objects.
struct Compound {
  Csg::Operation operation = Csg::Operation::union_;
  std::vector<ObjectPtr> parts;
  TexturePtr cut_texture;      ///< instead of the default one of parts, in its own space; null: the same
  bool is_light_group = false; ///< light sources among its parts shine on the others alone
  bool global_lights = false;  ///< of a light group: all others shine on them, too
};

/// An object whose inside limits another one.
struct Limit {
  ObjectPtr object;
  Transform transform; ///< after the object's own
};
void transform_limits(std::vector<Limit>& limits, const Transform& next);

/// A mesh whose triangles refer to its own textures; it becomes the scene's when it is first placed.
struct MeshDefinition {
  Mesh mesh;
  std::vector<TexturePtr> textures;
  std::unique_ptr<geometry::TriangleTree> tree; ///< from when the scene asks about the mesh
};

/// One triangle as written in a mesh or alone. Without normals it is flat.
struct TriangleDefinition {
  std::array<Vec3, 3> vertices{};
  std::array<Vec3, 3> normals{};
  bool is_smooth = false;
  std::array<Vec2f, 3> coordinates{}; ///< of the surface
  bool is_mapped = false;             ///< it has such
  std::array<TexturePtr, 3> textures; ///< at its corners; null: the mesh's

  bool is_finite() const;
  /// POV-Ray leaves a triangle that stands alone out if one of its normals is zero or not finite, or if they
  /// are not all on one side of it.
  bool is_shown_alone() const;
  /// As POV-Ray moves a triangle that stands alone: its normals, too, corner by corner.
  TriangleDefinition transformed(const Transform& transform) const;
};

/// A light source, with what can be seen in its place.
struct LightDefinition {
  Light light;
  ObjectPtr looks_like; ///< placed where the light is; null: nothing
  LightArea area;       ///< what is said of it, before or after it is there
  bool has_area = false;
  bool shines_from_places = false;       ///< area_illumination: from each place of the area
  ObjectPtr projected_through = nullptr; ///< placed where it is; null: nothing
  bool media_attenuation = false, media_interaction = true;
};

struct ObjectDefinition {
  std::variant<Shape, std::shared_ptr<MeshDefinition>, std::shared_ptr<TriangleDefinition>,
               std::shared_ptr<const Compound>, HeapValue<LightDefinition>>
      shape;
  Location where;        ///< where it is written, or referred to within other objects
  NameId name = kNoName; ///< that it was declared with, if somebody asks for such (origins.hpp)
  Transform transform;
  TexturePtr inside;                 ///< what it looks like from inside; null: the same, or the parent's
  TexturePtr texture;                ///< null: the parent's, then the default
  RareTransform texture_transform;   ///< what the object went through since it has the texture
  bool uv_mapping = false;           ///< its textures are on its surface coordinates,
  RareTransform transform_before_uv; ///< and only what it went through before moves them
  InteriorPtr interior;
  bool reaches_out_of_bounds = false; ///< of what bounds it
  bool no_shadow = false;
  bool no_image = false;
  bool no_reflection = false;
  bool is_lit_through = false;
  std::optional<bool> hollow; ///< not given: as what it is part of
  bool inverse = false;
  std::vector<Limit> clipped_by;
  std::vector<Limit> bounded_by; ///< without effect, until something is clipped by it
  UnsupportedPtr unsupported;
  UnsupportedPtr missing;        ///< instead of a shape, one that this program lacks
  bool is_photon_target = false; ///< not of lights
  /// What an object is to the light source that is being read.
  enum class Role { none, look, projector };
  Role role = Role::none;
  bool is_declared = false; ///< has a name: what is placed is a copy
  int depth = 0;            ///< of objects inside one another
  std::uint64_t size = 1;   ///< how many objects are placed with it, itself included, or kMostParts
  static constexpr std::uint64_t kMostParts = std::uint64_t{1} << 62;
  [[no_unique_address]] Counted<ObjectDefinition> counted;

  /// Null: it is no light source.
  const LightDefinition* light() const {
    const auto* light = std::get_if<HeapValue<LightDefinition>>(&shape);
    return light ? &**light : nullptr;
  }
  /// Moves its texture and what limits it, too.
  void apply(const Transform& next);
};

} // namespace celltrace::pov

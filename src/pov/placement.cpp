// SceneBuilder: turns declared objects into objects of the Scene.
#include "pov/scene_builder.hpp"
#include "pov/token_stream.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "celltrace/error.hpp"
#include "geometry/shape_geometry.hpp"
#include "pov/finite.hpp"
#include "pov/light.hpp"
#include "pov/mesh.hpp"
#include "pov/scene_room.hpp"
#include "pov/shapes.hpp"
#include "scene_image/single_precision.hpp"

namespace celltrace::pov {

namespace {

using Operation = Csg::Operation;

const Compound* compound(const ObjectDefinition& object) {
  const auto* compound = std::get_if<std::shared_ptr<const Compound>>(&object.shape);
  return compound ? compound->get() : nullptr;
}

/// Returns whether an object is a union that is neither inverse nor clipped.
bool is_plain_union(const ObjectDefinition& object) {
  const Compound* parts = compound(object);
  return parts && parts->operation == Operation::union_ && !object.inverse && object.clipped_by.empty();
}

/// Returns whether a part is a light that illuminates only the other parts.
bool is_group_light(const Compound& compound, const ObjectDefinition& part) {
  return compound.is_light_group && part.light();
}

const char* name_of(const ObjectDefinition& csg) {
  switch (compound(csg)->operation) {
  case Operation::merge:
    return "a merge";
  case Operation::intersection:
    return "an intersection";
  case Operation::difference:
    return "a difference";
  case Operation::union_:
    break;
  }
  return csg.inverse ? "an inverse union" : "a clipped union";
}

bool has_mesh(const Object& object) {
  if (std::holds_alternative<std::shared_ptr<const Mesh>>(object.shape)) return true;
  if (object.clipped_by && std::any_of(object.clipped_by->begin(), object.clipped_by->end(), has_mesh))
    return true;
  const auto* csg = std::get_if<std::shared_ptr<const Csg>>(&object.shape);
  return csg && std::any_of((*csg)->parts.begin(), (*csg)->parts.end(), has_mesh);
}

bool has_shapes(const Object& object) {
  const auto* csg = std::get_if<std::shared_ptr<const Csg>>(&object.shape);
  return !csg || std::any_of((*csg)->parts.begin(), (*csg)->parts.end(), has_shapes);
}

/// Returns the radius of a disc, or a smaller one beyond which no ray goes.
double seen_radius(const Disc& disc, const Transform& transform) {
  constexpr double kFarthest = 1e15;
  const double scale = std::max(
      {glm::length(transform.rows[0]), glm::length(transform.rows[1]), glm::length(transform.rows[2])});
  return disc.radius * scale > kFarthest ? kFarthest / scale : disc.radius;
}

} // namespace

void SceneBuilder::place(const ObjectPtr& object, const Location& where) {
  // The limit is checked before any of the objects is placed.
  if (object->size > limits_.objects - std::min(parts_placed_, limits_.objects)) exceed_objects(where);
  place(*object, Inherited{}, where);
}

void SceneBuilder::place(const ObjectDefinition& object, const Inherited& around, const Location& where) {
  if (!diagnostics_.supports(object.missing, where)) return;
  if (is_plain_union(object)) {
    Inherited own = inherit(object, around, where);
    const Compound& parts = *compound(object);
    if (parts.is_light_group) enter_light_group(parts, own, where);
    for (const ObjectPtr& part : parts.parts)
      if (!is_group_light(parts, *part)) place(*part, own, where);
  } else if (std::optional<Object> placed = make(object, around, where)) {
    if (!has_shapes(*placed)) return;
    make_room(scene_.objects, tokens_);
    scene_.objects.push_back(std::move(*placed));
    if (origins_.are_wanted())
      origins_.tell(static_cast<Index>(scene_.objects.size() - 1), object, around.name, where);
  }
}

void SceneBuilder::exceed_objects(const Location& where) const {
  diagnostics_.exceed(where, &ParseLimits::objects, "the scene has", "objects");
}

/// Returns the properties that the object's parts inherit.
SceneBuilder::Inherited SceneBuilder::inherit(const ObjectDefinition& object, const Inherited& around,
                                              const Location& where) {
  diagnostics_.supports(object.unsupported, where);
  if (object.reaches_out_of_bounds)
    diagnostics_.warn_once(object.where,
                           "this object reaches out of its 'bounded_by': POV-Ray cuts it off there, this "
                           "program does not");
  has_photon_targets_ = has_photon_targets_ || object.is_photon_target;
  tokens_.spend(1); // so that placing an object of many parts can be cancelled
  if (++parts_placed_ > limits_.objects) exceed_objects(where);
  Inherited own = around;
  own.transform = object.transform.then(around.transform);
  own.no_shadow = object.no_shadow || around.no_shadow;
  own.no_image = object.no_image || around.no_image;
  own.no_reflection = object.no_reflection || around.no_reflection;
  own.is_lit_through = object.is_lit_through || around.is_lit_through;
  own.hollow = object.hollow.value_or(around.hollow);
  own.is_copy = object.is_declared || around.is_copy;
  if (object.name != kNoName) own.name = object.name;
  if (object.texture) {
    own.texture = object.texture;
    own.has_cut_texture = false;
    own.texture_transform = *object.texture_transform;
    if (!object.uv_mapping) own.texture_transform = own.texture_transform.then(around.transform);
  } else if (!own.texture) {
    own.texture = default_texture;
    own.texture_transform = Transform();
  }
  if (object.inside) {
    own.inner_texture = object.inside;
    own.inner_transform = object.uv_mapping ? Transform() : around.transform;
  }
  own.uv_mapping = object.uv_mapping || around.uv_mapping;
  if (!around.clips && !object.light())
    own.interior = interior_index(object, around.interior, *own.texture, where);
  return own;
}

/// Returns an object of the Scene; nothing if the object is a light, is left out, or cannot be hit by any
/// ray.
std::optional<Object> SceneBuilder::make(const ObjectDefinition& object, const Inherited& around,
                                         const Location& where) {
  if (!diagnostics_.supports(object.missing, where)) return std::nullopt;
  Inherited own = inherit(object, around, where);
  if (const LightDefinition* light = object.light()) {
    if (own.clips) return std::nullopt;
    add_light(*light, own, where);
    place_look(*light, std::move(own), where);
    return std::nullopt;
  }
  const bool is_somewhere = is_finite(own.transform);
  if (!is_somewhere) {
    diagnostics_.warn_once(object.where, "this object is at no finite place: it is left out");
    if (!own.inside) return std::nullopt;
  }
  Object made;
  made.transform = around.is_part ? object.transform : own.transform;
  made.no_shadow = own.no_shadow;
  made.no_image = own.no_image;
  made.no_reflection = own.no_reflection;
  made.inverse = object.inverse;
  made.is_lit_through = own.is_lit_through;
  made.light_group = own.light_group;
  if (!is_somewhere) {
    made.transform = Transform();
    made.shape = Sphere{{0, 0, 0}, 0};
    if (around.clips) return made;
    made.material = material_index(default_texture, {}, where);
    made.interior = interior_of(own);
    return made;
  }
  if (const Compound* parts = compound(object)) {
    if (!own.inside || parts->operation != Operation::union_) own.inside = name_of(object);
    const auto csg = make_csg(*parts, std::move(own), where);
    if (!csg) return std::nullopt;
    made.shape = csg;
  } else {
    if (is_singular(own.transform))
      diagnostics_.fail(where, "this object's transformation is singular: it has no inverse");
    if (!around.clips) {
      made.material = own.uv_mapping
                          ? material_index(mapped_texture(own.texture, own.texture_transform), {}, where)
                          : material_index(own.texture, own.texture_transform, where);
      if (own.inner_texture) {
        Material material = scene_.materials[made.material];
        material.inside = shared_material(
            own.uv_mapping                     ? mapped_texture(own.inner_texture, own.inner_transform)
            : own.inner_texture->is_constant() ? own.inner_texture
                                               : transformed(own.inner_texture, own.inner_transform),
            where);
        made.material = scene_.add(material);
      }
    }
    if (!make_shape(object, own, made, where)) return std::nullopt;
    if (!around.clips) made.interior = interior_of(own);
  }
  made.clipped_by = make_clips(object, around, where);
  return made;
}

/// Returns the interior of a shape: the one that it or an object around it has, the one that all parts of its
/// CSG share, or a new one.
Index SceneBuilder::interior_of(const Inherited& own) {
  Index index = own.interior != kNoIndex ? own.interior : own.csg_interior;
  if (index == kNoIndex) index = add_interior();
  scene_.interiors[index].hollow = own.hollow;
  return index;
}

Index SceneBuilder::add_interior() {
  make_room(scene_.interiors, tokens_);
  return scene_.add(Interior{});
}

/// Returns a CSG of the Scene; null if the first part of a difference is left out.
std::shared_ptr<const Csg> SceneBuilder::make_csg(const Compound& compound, Inherited own,
                                                  const Location& where) {
  enter_solid(own, where);
  if (own.csg_interior == kNoIndex && own.interior == kNoIndex && !own.clips)
    own.csg_interior = add_interior();
  own.is_part = true;
  if (compound.cut_texture && own.texture == default_texture) {
    own.texture = compound.cut_texture;
    own.texture_transform = own.transform;
    own.has_cut_texture = true;
    own.is_subtracted = false;
  }
  if (compound.is_light_group) enter_light_group(compound, own, where);
  auto csg = std::make_shared<Csg>();
  csg->parts.reserve(compound.parts.size());
  csg->operation = compound.operation;
  const bool is_subtracted = own.is_subtracted;
  // As in POV-Ray, shapes in unions have the default texture, unless they are subtracted.
  const TexturePtr cut = own.texture;
  const bool has_default = own.has_cut_texture && joins(compound.operation) != is_subtracted;
  for (const ObjectPtr& part : compound.parts) {
    const bool is_less = compound.operation == Operation::difference && part != compound.parts.front();
    own.is_subtracted = is_subtracted != is_less;
    if (has_default) own.texture = pov::compound(*part) ? cut : default_texture;
    if (is_group_light(compound, *part))
      continue;
    else if (std::optional<Object> made = make(*part, own, where))
      csg->parts.push_back(std::move(*made));
    else if (compound.operation == Operation::difference && !is_less) {
      if (part->light()) refuse("a light source that others are taken from", *part, where);
      return nullptr;
    }
  }
  return csg;
}

std::shared_ptr<const std::vector<Object>>
SceneBuilder::make_clips(const ObjectDefinition& object, const Inherited& around, const Location& where) {
  if (object.clipped_by.empty()) return nullptr;
  Inherited own = around;
  enter_solid(own, where);
  own.clips = true;
  own.inside = "'clipped_by'";
  auto clips = std::make_shared<std::vector<Object>>();
  for (const Limit& limit : object.clipped_by) {
    ObjectDefinition moved = *limit.object;
    moved.apply(limit.transform);
    if (std::optional<Object> made = make(moved, own, where)) clips->push_back(std::move(*made));
  }
  return clips;
}

void SceneBuilder::enter_solid(Inherited& own, const Location& where) const {
  if (++own.depth > kDeepestCsg)
    diagnostics_.fail(where, "CSG is nested more than " + std::to_string(kDeepestCsg) + " deep");
}

/// Finds the lights of a light group's parts, by the rules of POV-Ray 3.7. Lights that belong to the group
/// itself, and not to a union in it, illuminate only its objects. Objects of nested groups are lit by the
/// innermost group that has lights; if that group or something around it has a name, so that POV-Ray copies
/// it, also by the outer groups. The outermost group decides whether global lights illuminate them. The
/// looks_like of a light in the group is lit by global lights and this group's lights in any case. All
/// objects cast shadows in all lights.
void SceneBuilder::enter_light_group(const Compound& group, Inherited& own, const Location& where) {
  if (own.clips) return;
  LightGroup entered;
  const LightGroup* outer = own.light_group == kNoIndex ? nullptr : &scene_.light_groups[own.light_group];
  entered.global_lights = outer ? outer->global_lights : group.global_lights;
  std::vector<std::pair<const LightDefinition*, Inherited>> lights;
  for (const ObjectPtr& part : group.parts) {
    if (!is_group_light(group, *part)) continue;
    const LightDefinition* light = part->light();
    lights.emplace_back(light, inherit(*part, own, where));
    for (const Index index : add_light(*light, lights.back().second, where)) {
      scene_.lights[index].is_global = false;
      entered.lights.push_back(index);
    }
  }
  const std::vector<Index> own_lights = entered.lights;
  if (outer && (own.is_copy || lights.empty()))
    entered.lights.insert(entered.lights.end(), outer->lights.begin(), outer->lights.end());
  own.light_group = add_light_group(entered, where);
  const bool has_looks = std::any_of(lights.begin(), lights.end(),
                                     [](const auto& light) { return light.first->looks_like != nullptr; });
  if (!has_looks) return;
  const Index of_looks = add_light_group({own_lights, true}, where);
  for (auto& [light, inherited] : lights) {
    inherited.light_group = of_looks;
    place_look(*light, inherited, where);
  }
}

Index SceneBuilder::add_light_group(const LightGroup& group, const Location& where) {
  if (scene_.light_groups.size() >= kMostLightGroups)
    diagnostics_.fail(where, "the scene has more than " + std::to_string(kMostLightGroups) + " light groups");
  scene_.light_groups.push_back(group);
  return static_cast<Index>(scene_.light_groups.size() - 1);
}

std::vector<Index> SceneBuilder::add_light(const LightDefinition& definition, const Inherited& own,
                                           const Location& where) {
  Light light = definition.light;
  if (definition.has_area) light.area = definition.area;
  light = moved(light, own.transform);
  if (light.area && light.area->circular && (light.area->columns == 1 || light.area->rows == 1))
    diagnostics_.fail(where, "a circular area light has more than one place along each side");
  if (!is_finite(light.location) || !is_finite(light.point_at)) {
    diagnostics_.warn_once(where, "this light is not at a finite place, or does not shine at one: it is left "
                                  "out");
    return {};
  }
  light.is_dimmed_by_fog = definition.media_attenuation && definition.media_interaction;
  if (definition.projected_through)
    light.projected_through = make_projector(*definition.projected_through, own, where);
  std::vector<Light> lights = {light};
  if (definition.shines_from_places && light.area) {
    if (light.area->orient) {
      const std::string what = "'area_illumination' of a light with 'orient'";
      diagnostics_.supports(std::make_shared<Unsupported>(Unsupported{what, where}), where);
    } else {
      lights = lights_at_places(light);
    }
  }
  std::vector<Index> indices;
  for (const Light& each : lights) {
    indices.push_back(static_cast<Index>(scene_.lights.size()));
    scene_.lights.push_back(each);
  }
  return indices;
}

std::shared_ptr<const Object> SceneBuilder::make_projector(const ObjectDefinition& projector,
                                                           Inherited around, const Location& where) {
  around.clips = true; // only its inside matters
  around.is_part = false;
  auto parts = std::make_shared<Csg>();
  collect(projector, around, where, parts->parts);
  auto object = std::make_shared<Object>();
  object->shape = std::shared_ptr<const Csg>(std::move(parts));
  return object;
}

/// Adds an object; takes plain unions apart.
void SceneBuilder::collect(const ObjectDefinition& object, const Inherited& around, const Location& where,
                           std::vector<Object>& objects) {
  if (!diagnostics_.supports(object.missing, where)) return;
  if (is_plain_union(object)) {
    const Inherited own = inherit(object, around, where);
    for (const ObjectPtr& part : compound(object)->parts)
      collect(*part, own, where, objects);
  } else if (std::optional<Object> made = make(object, around, where)) {
    if (has_mesh(*made) && (made->clipped_by || !std::get_if<std::shared_ptr<const Mesh>>(&made->shape)))
      refuse("a mesh in CSG that a light is projected through", object, where);
    else
      objects.push_back(std::move(*made));
  }
}

std::shared_ptr<const Object> SceneBuilder::make_solid(const ObjectDefinition& object,
                                                       const Location& where) {
  Inherited around;
  around.clips = true; // only its inside matters
  around.inside = "the pattern of an object";
  std::optional<Object> made = make(object, around, where);
  if (made && has_mesh(*made)) {
    refuse("a mesh in the pattern of an object", object, where);
    made.reset();
  }
  if (!made || !has_shapes(*made)) {
    // A sphere of radius 0 contains nothing.
    made.emplace();
    made->shape = Sphere{{0, 0, 0}, 0};
  }
  return std::make_shared<const Object>(std::move(*made));
}

/// Places a light's looks_like, which casts no shadows and, as in POV-Ray, is left out if the light is in
/// CSG.
void SceneBuilder::place_look(const LightDefinition& definition, Inherited own, const Location& where) {
  if (!definition.looks_like || own.is_part) return;
  own.no_shadow = true;
  place(*definition.looks_like, own, where);
}

/// Returns false if no ray can hit the object, or it is left out.
bool SceneBuilder::make_shape(const ObjectDefinition& object, const Inherited& own, Object& made,
                              const Location& where) {
  if (const Shape* shape = std::get_if<Shape>(&object.shape)) {
    made.shape = *shape;
    if (std::holds_alternative<std::shared_ptr<const Polygon>>(*shape)) made.inverse = false;
    if (auto* disc = std::get_if<Disc>(&made.shape)) disc->radius = seen_radius(*disc, own.transform);
    if (!geometry::fits_single_precision(made.shape, own.transform)) {
      warn_of_size(object);
      if (!own.inside) return false;
      // No ray reaches the shape's surface: the whole scene is either inside or outside of the shape.
      const Vec3 at = own.transform.inverse().point(Vec3(0));
      if (geometry::is_inside(*shape, at)) made.inverse = !made.inverse;
      made.shape = Sphere{{0, 0, 0}, 0};
      return true;
    }
    return own.inside || !is_invisible(*shape);
  }
  const auto* triangle = std::get_if<std::shared_ptr<TriangleDefinition>>(&object.shape);
  std::shared_ptr<const Mesh> mesh;
  if (triangle) {
    Vec3 base(0);
    mesh = placed_triangle(**triangle, own, where, base);
    made.transform = base != Vec3(0) ? Transform::translate(base) : Transform();
    // Moves a part of a CSG back from the scene to the CSG's space.
    if (own.is_part) made.transform = made.transform.then(own.transform.inverse().then(object.transform));
  } else {
    mesh =
        placed_mesh(std::get<std::shared_ptr<MeshDefinition>>(object.shape),
                    object.uv_mapping ? *object.transform_before_uv : own.transform, own.uv_mapping, where);
    if (own.inner_texture && !own.clips)
      mesh = with_inside(mesh, scene_.materials[made.material].inside, where);
  }
  if (!mesh->has_inside()) {
    // POV-Ray rejects this too, since nothing would be left of the clipped object.
    if (own.inside && own.clips) {
      refuse((triangle ? "a triangle in " : "a mesh without 'inside_vector' in ") + std::string(own.inside),
             object, where);
      return false;
    }
    made.inverse = false;
  }
  if (!geometry::fits_single_precision(mesh, triangle ? made.transform : own.transform)) {
    warn_of_size(object);
    return false;
  }
  const bool is_visible = !mesh->triangles.empty();
  made.shape = std::move(mesh);
  return own.inside || is_visible;
}

void SceneBuilder::warn_of_size(const ObjectDefinition& object) {
  diagnostics_.warn_once(object.where, "this object is too large, too thin or too far away to be seen: it is "
                                       "left out");
}

void SceneBuilder::refuse(const std::string& what, const ObjectDefinition& object, const Location& where) {
  diagnostics_.supports(std::make_shared<Unsupported>(Unsupported{what, object.where}), where);
}

} // namespace celltrace::pov

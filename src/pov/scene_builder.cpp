#include "pov/scene_builder.hpp"

#include <cmath>

#include "celltrace/error.hpp"
#include "pov/mesh.hpp"

namespace celltrace::pov {

namespace {

/// What a scene without any #version counts as (3.2 of POV-Ray's gamma rules).
constexpr double kVersionIfNoneGiven = 3.62;
constexpr double kVersionOfGamma = 3.7; // and of transparent backgrounds

/// Writes scene-wide indices over a mesh's own.
void replace_materials(Mesh& mesh, const std::vector<Index>& materials) {
  for (Mesh::Triangle& triangle : mesh.triangles)
    for (Index& material : triangle.material)
      if (material != kNoIndex) material = materials[material];
}

bool is_singular(const Transform& transform) {
  const double determinant = transform.determinant();
  return determinant == 0 || !std::isfinite(determinant) || !std::isfinite(1 / determinant);
}

} // namespace

void SceneBuilder::place(const ObjectPtr& object, const Location& where) {
  place(*object, Inherited{}, where);
}

void SceneBuilder::place(const ObjectDefinition& object, const Inherited& inherited, const Location& where) {
  diagnostics_.require_supported(object.unsupported, where);
  if (++parts_placed_ > limits_.objects)
    diagnostics_.fail(where, "the scene has more than " + std::to_string(limits_.objects) + " objects");

  Inherited own = inherited;
  own.transform = object.transform.then(inherited.transform);
  own.no_shadow = object.no_shadow || inherited.no_shadow;
  if (object.texture) own.texture = object.texture;
  if (!own.texture) own.texture = default_texture;
  if (const Light* light = std::get_if<Light>(&object.shape)) {
    place_light(*light, own.transform, where);
  } else if (const Children* children = std::get_if<Children>(&object.shape)) {
    own.interior = interior_index(object, inherited.interior, *own.texture, where);
    for (const ObjectPtr& child : **children)
      place(*child, own, where);
  } else {
    own.interior = interior_index(object, inherited.interior, *own.texture, where);
    place_shape(object, own, where);
  }
}

void SceneBuilder::place_light(Light light, const Transform& transform, const Location& where) {
  light.location = transform.point(light.location);
  if (!Quantity::vector(light.location).is_finite())
    diagnostics_.fail(where, "this light is not at a finite place");
  scene_.lights.push_back(light);
}

void SceneBuilder::place_shape(const ObjectDefinition& object, const Inherited& own, const Location& where) {
  if (is_singular(own.transform))
    diagnostics_.fail(where, "this object's transformation is singular: it has no inverse");
  Object placed;
  placed.transform = own.transform;
  placed.no_shadow = own.no_shadow;
  placed.material = material_index(own.texture, where);
  if (const Sphere* sphere = std::get_if<Sphere>(&object.shape)) {
    if (sphere->radius <= 0) return; // POV-Ray's bounding box of it is empty
    placed.shape = *sphere;
  } else {
    std::shared_ptr<const Mesh> mesh;
    if (const auto* triangle = std::get_if<std::shared_ptr<TriangleDefinition>>(&object.shape)) {
      mesh = placed_triangle(**triangle, own.transform, where);
      placed.transform = Transform();
    } else {
      mesh = placed_mesh(std::get<std::shared_ptr<MeshDefinition>>(object.shape), where);
    }
    if (mesh->triangles.empty()) return;
    placed.shape = std::move(mesh);
  }
  placed.interior = own.interior != kNoIndex ? own.interior : scene_.add(Interior{});
  scene_.objects.push_back(std::move(placed));
}

std::shared_ptr<const Mesh> SceneBuilder::placed_triangle(const TriangleDefinition& triangle,
                                                          const Transform& transform, const Location& where) {
  MeshBuilder builder;
  try {
    builder.add(triangle.transformed(transform));
  } catch (const InputError& error) {
    diagnostics_.fail(where, error.what());
  }
  return std::make_shared<const Mesh>(std::move(builder.finish()->mesh));
}

/// The object's own interior, else the inherited one. POV-Ray 3.1's ior of a finish makes one where there is
/// none and changes the one there is, even if it is inherited.
Index SceneBuilder::interior_index(const ObjectDefinition& object, Index inherited,
                                   const TextureDefinition& texture, const Location& where) {
  const std::optional<double>& ior = texture.finish.ior;
  Index index = inherited;
  if (object.interior) {
    const InteriorDefinition& interior = *object.interior;
    diagnostics_.require_supported(interior.unsupported, where);
    if (interior.fade_distance != 0 && interior.fade_power != 0)
      diagnostics_.fail(where, "'fade_distance' of an interior is not supported yet");
    index = scene_.add(Interior{interior.ior});
  } else if (index == kNoIndex && ior) {
    index = scene_.add(Interior{});
  }
  if (ior) scene_.interiors[index].ior = *ior;
  return index;
}

Index SceneBuilder::material_index(const TexturePtr& texture, const Location& where) {
  if (const auto known = material_indices_.find(texture); known != material_indices_.end())
    return known->second;
  diagnostics_.require_supported(texture->first_unsupported(), where);
  const Index index = scene_.add(Material{texture->pigment.value, texture->finish.value});
  material_indices_.emplace(texture, index);
  return index;
}

std::shared_ptr<const Mesh> SceneBuilder::placed_mesh(const std::shared_ptr<MeshDefinition>& definition,
                                                      const Location& where) {
  std::shared_ptr<const Mesh>& placed = meshes_[definition];
  if (!placed) {
    std::vector<Index> materials;
    for (const TexturePtr& texture : definition->textures)
      materials.push_back(material_index(texture, where));
    auto mesh = std::make_shared<Mesh>(std::move(definition->mesh));
    replace_materials(*mesh, materials);
    placed = std::move(mesh);
  }
  return placed;
}

void SceneBuilder::count_triangles(std::size_t count, const Location& where) {
  triangles_ += count;
  if (triangles_ > limits_.triangles)
    diagnostics_.fail(where, "the scene has more than " + std::to_string(limits_.triangles) + " triangles");
}

void SceneBuilder::set_background(const Pigment& colour) {
  const bool has_alpha = version_.value_or(kVersionIfNoneGiven) >= kVersionOfGamma;
  scene_.background = has_alpha ? colour.rgb * (1 - colour.transmit) : colour.rgb;
}

void SceneBuilder::set_assumed_gamma(std::optional<double> gamma) {
  gamma_given_ = true;
  scene_.gamma_mode = gamma ? GammaMode::assumed : GammaMode::srgb;
  scene_.assumed_gamma = gamma.value_or(1);
}

void SceneBuilder::settle_gamma() {
  scene_.version = version_.value_or(kVersionIfNoneGiven);
  if (!gamma_given_)
    scene_.gamma_mode = scene_.version < kVersionOfGamma ? GammaMode::none : GammaMode::assumed;
}

Scene SceneBuilder::finish(const std::string& name) {
  scene_.name = name;
  settle_gamma();
  const CameraDefinition& camera = camera_ ? *camera_ : default_camera;
  diagnostics_.require_supported(camera.unsupported, camera.where);
  try {
    scene_.camera = camera.finish(scene_.version);
  } catch (const InputError& error) {
    diagnostics_.fail(camera.where, error.what());
  }
  return std::move(scene_);
}

} // namespace celltrace::pov

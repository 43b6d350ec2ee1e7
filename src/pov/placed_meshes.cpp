// SceneBuilder: turns declared meshes and triangles into meshes of the Scene.
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "celltrace/error.hpp"
#include "pov/mesh.hpp"
#include "pov/patches.hpp"
#include "pov/scene_builder.hpp"
#include "pov/token_stream.hpp"

namespace celltrace::pov {

namespace {

/// Replaces a mesh's indices of its own materials by indices into the scene's materials.
void replace_materials(Mesh& mesh, const std::vector<Index>& materials, TokenStream& tokens) {
  if (materials.empty()) return; // no triangle has a material of its own
  for (Mesh::Triangle& triangle : mesh.triangles) {
    tokens.spend(1);
    for (Index& material : triangle.material)
      if (material != kNoIndex) material = materials[material];
  }
}

/// Returns a point near a triangle that is so far from the origin, for its size, that single precision is not
/// enough for its vertices; else 0.
Vec3 far_base_of(const TriangleDefinition& triangle) {
  constexpr double kNear = 2048, kFar = 256;
  const auto& [a, b, c] = triangle.vertices;
  const auto largest = [](const Vec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); };
  const double size = std::max(largest(b - a), largest(c - a)), distance = largest(a);
  if (!triangle.is_finite() || !(size > 0) || distance <= std::max(kNear, kFar * size)) return Vec3(0);
  // The point has few digits, so that vertices relative to it lose none of theirs.
  const double step = std::exp2(std::floor(std::log2(size)));
  return glm::round(a / step) * step;
}

/// Orders the corners of a triangle so that its outside, as that of a Mesh, is POV-Ray's: where the normals
/// point or, for a flat triangle, to -x, +y or -z, whichever axis the triangle faces most.
void turn_outside(TriangleDefinition& triangle) {
  const auto& v = triangle.vertices;
  const Vec3 normal = glm::cross(v[1] - v[0], v[2] - v[0]);
  const Vec3 size = glm::abs(normal);
  bool is_turned;
  if (triangle.is_smooth)
    is_turned = glm::dot(normal, triangle.normals[0] + triangle.normals[1] + triangle.normals[2]) > 0;
  else if (size.x >= size.y && size.x >= size.z)
    is_turned = normal.x < 0;
  else
    is_turned = size.y >= size.z ? normal.y > 0 : normal.z < 0;
  if (!is_turned) return;
  std::swap(triangle.vertices[1], triangle.vertices[2]);
  std::swap(triangle.normals[1], triangle.normals[2]);
  std::swap(triangle.coordinates[1], triangle.coordinates[2]);
}

} // namespace

/// Returns a mesh of one triangle. Its single precision vertices are relative to `base`, which is set: in
/// POV-Ray only the vertices of meshes are single precision.
std::shared_ptr<const Mesh> SceneBuilder::placed_triangle(const TriangleDefinition& triangle,
                                                          const Inherited& own, const Location& where,
                                                          Vec3& base) {
  MeshBuilder builder;
  TriangleDefinition placed = triangle.transformed(own.transform);
  if (!triangle.is_finite())
    diagnostics_.warn_once(where, "this triangle is left out: a number of it is not finite");
  if (own.inner_texture) turn_outside(placed);
  // Surface coordinates are x and y, as for all shapes without coordinates of their own.
  if (own.texture && (own.uv_mapping || own.texture->depends_on_surface())) {
    placed.is_mapped = true;
    for (std::size_t i = 0; i < 3; ++i)
      placed.coordinates[i] = Vec2f(placed.vertices[i]);
  }
  base = far_base_of(placed);
  for (Vec3& vertex : placed.vertices)
    vertex -= base;
  try {
    if (triangle.is_shown_alone())
      builder.add(placed);
    else
      diagnostics_.warn_once(where,
                             "a smooth_triangle is left out whose normals are on both sides of it, or zero");
  } catch (const InputError& error) {
    diagnostics_.fail(where, error.what());
  }
  return std::make_shared<const Mesh>(std::move(builder.finish()->mesh));
}

/// Returns the triangles of a patch that are flat enough at its place.
std::shared_ptr<const Mesh> SceneBuilder::placed_patch(const BicubicPatch& patch, const Transform& transform,
                                                       const Location& where) {
  const auto mesh = make_mesh(patch, transform, [&](std::size_t count) {
    tokens_.spend(count);
    count_triangles(count, where);
  });
  return std::make_shared<const Mesh>(std::move(mesh->mesh));
}

/// Returns the mesh of a definition at its place. Instances share one mesh, unless the mesh has textures of
/// its own that depend on its place.
std::shared_ptr<const Mesh> SceneBuilder::placed_mesh(const std::shared_ptr<MeshDefinition>& definition,
                                                      const Transform& transform, bool uv_mapping,
                                                      const Location& where) {
  if (definition->patch) return placed_patch(*definition->patch, transform, where);
  const std::vector<TexturePtr>& textures = definition->textures;
  const bool is_constant = std::all_of(textures.begin(), textures.end(),
                                       [](const TexturePtr& texture) { return texture->is_constant(); });
  if (is_constant)
    if (const auto known = meshes_.find(definition); known != meshes_.end()) return known->second;
  std::vector<Index> materials;
  for (const TexturePtr& texture : textures)
    materials.push_back(uv_mapping && !is_constant
                            ? material_index(mapped_texture(texture, transform), {}, where)
                            : material_index(texture, transform, where));
  if (!is_constant) count_triangles(definition->mesh.triangles.size(), where);
  auto mesh = is_constant ? std::make_shared<Mesh>(std::move(definition->mesh))
                          : std::make_shared<Mesh>(definition->mesh);
  replace_materials(*mesh, materials, tokens_);
  if (is_constant) meshes_[definition] = mesh;
  return mesh;
}

/// Returns a mesh in which the object's interior_texture is also that of triangles with textures of their
/// own. `inside` is passed by value: it may belong to one of the scene's materials, which move when more are
/// added.
std::shared_ptr<const Mesh> SceneBuilder::with_inside(const std::shared_ptr<const Mesh>& mesh,
                                                      std::shared_ptr<const Material> inside,
                                                      const Location& where) {
  const auto has_material = [](const Mesh::Triangle& triangle) { return triangle.material[0] != kNoIndex; };
  if (std::none_of(mesh->triangles.begin(), mesh->triangles.end(), has_material)) return mesh;
  std::shared_ptr<const Mesh>& known = meshes_with_insides_[{mesh, inside}];
  if (known) return known;
  count_triangles(mesh->triangles.size(), where);
  const auto copy = std::make_shared<Mesh>(*mesh);
  std::unordered_map<Index, Index> changed;
  for (Mesh::Triangle& triangle : copy->triangles) {
    tokens_.spend(1);
    for (Index& index : triangle.material) {
      if (index == kNoIndex) continue;
      const auto [entry, is_new] = changed.try_emplace(index, kNoIndex);
      if (is_new) {
        Material material = scene_.materials[index];
        material.inside = inside;
        entry->second = scene_.add(material);
      }
      index = entry->second;
    }
  }
  return known = copy;
}

} // namespace celltrace::pov

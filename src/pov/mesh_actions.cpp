// Triangles and the lists of meshes.
#include <algorithm>
#include <cmath>

#include "celltrace/error.hpp"
#include "pov/actions.hpp"
#include "pov/finite.hpp"

namespace celltrace::pov {

namespace {

/// The number that leads a list.
double list_count(Session& session, const std::vector<ListEntry>& list, const Location& where) {
  const ListEntry& count = list.front();
  if (!count.is_float) session.fail(where, "expected a float, found a vector");
  if (!is_finite(count.v)) session.fail(where, "this number is not finite");
  return count.v.x;
}

/// Exporters write meshes whose triangles are all degenerate.
void warn_if_empty(Session& session, const Mesh& mesh, const Location& where) {
  if (mesh.triangles.empty())
    session.diagnostics.warn_once(where,
                                  "this mesh has no triangle with an area: there is nothing to see of it");
}

std::shared_ptr<ObjectDefinition> make_object(std::shared_ptr<MeshDefinition> mesh) {
  auto object = std::make_shared<ObjectDefinition>();
  object->shape = std::move(mesh);
  return object;
}

} // namespace

std::shared_ptr<ObjectDefinition>
lone_triangle(Session& session, std::shared_ptr<TriangleDefinition> triangle, const Location& where) {
  session.builder.count_triangles(1, where);
  auto object = std::make_shared<ObjectDefinition>();
  object->shape = std::move(triangle);
  return object;
}

void add_triangle(Session& session, MeshBuilder& builder, const TriangleDefinition& triangle,
                  const Location& where) {
  session.builder.count_triangles(1, where);
  if (!triangle.is_finite())
    session.diagnostics.warn_once(where, "this triangle is flat or left out: a number of it is not finite");
  try {
    builder.add(triangle);
  } catch (const InputError& error) {
    session.fail(where, error.what());
  }
}

std::shared_ptr<TriangleDefinition> flat_triangle(const Quantity& a, const Quantity& b, const Quantity& c) {
  auto triangle = std::make_shared<TriangleDefinition>();
  triangle->vertices = {a.vec3(), b.vec3(), c.vec3()};
  return triangle;
}

std::shared_ptr<TriangleDefinition> smooth_triangle(const std::array<Quantity, 3>& corners,
                                                    const std::array<Quantity, 3>& normals) {
  auto triangle = flat_triangle(corners[0], corners[1], corners[2]);
  triangle->normals = {normals[0].vec3(), normals[1].vec3(), normals[2].vec3()};
  triangle->is_smooth = true;
  return triangle;
}

void set_textures(Session& session, Mesh2Definition& mesh, double count, std::vector<TexturePtr> textures,
                  const Location& where) {
  check_count(session, count, textures.size(), where);
  mesh.textures = std::move(textures);
}

void set_textures(Session& session, TriangleDefinition& triangle, const std::vector<TexturePtr>& textures,
                  const Location& where) {
  if (textures.size() != triangle.textures.size())
    session.fail(where, "the texture_list of a triangle has three textures, one for each corner");
  std::copy(textures.begin(), textures.end(), triangle.textures.begin());
}

void set_coordinates(Session& session, TriangleDefinition& triangle, const std::array<Vec3, 3>& uv,
                     const Location& where) {
  triangle.is_mapped = true;
  for (std::size_t i = 0; i < 3; ++i) {
    triangle.coordinates[i] = Vec2f(uv[i]);
    if (std::isfinite(triangle.coordinates[i].x) && std::isfinite(triangle.coordinates[i].y)) continue;
    session.diagnostics.warn_once(where, "surface coordinates that are not finite count as 0");
    triangle.coordinates[i] = Vec2f(0);
  }
}

Vec3 inside_vector(Session& session, const Quantity& vector, const Location& where) {
  if (vector.is_finite()) return vector.vec3();
  session.diagnostics.warn_once(where, "an inside_vector that is not finite is ignored");
  return Vec3(0);
}

std::shared_ptr<ObjectDefinition> mesh(Session& session, MeshBuilder& builder, const Location& where) {
  if (builder.is_unused()) session.fail(where, "this mesh has no triangles");
  auto definition = builder.finish();
  warn_if_empty(session, definition->mesh, where);
  return make_object(std::move(definition));
}

std::shared_ptr<ObjectDefinition> mesh2(Session& session, Mesh2Definition& definition,
                                        const Location& where) {
  if (definition.face_indices.empty()) session.fail(where, "this mesh has no triangles");
  std::shared_ptr<MeshDefinition> mesh;
  try {
    mesh = make_mesh(std::move(definition), session.tokens);
  } catch (const SceneError&) {
    throw; // has its place
  } catch (const InputError& error) {
    session.fail(where, error.what());
  }
  warn_if_empty(session, mesh->mesh, where);
  session.builder.count_triangles(mesh->mesh.triangles.size(), where);
  return make_object(std::move(mesh));
}

void check_count(Session& session, double announced, std::size_t found, const Location& where) {
  if (std::floor(announced) != static_cast<double>(found))
    session.fail(where, "this list announces " +
                            std::to_string(static_cast<long long>(std::clamp(announced, -1e15, 1e15))) +
                            " entries, but has " + std::to_string(found));
}

CountedList counted(Session& session, std::vector<ListEntry>& list, const Location& where) {
  check_count(session, list_count(session, list, where), list.size() - 1, where);
  return CountedList(std::move(list));
}

CountedList faces(Session& session, std::vector<ListEntry>& list, const Location& where) {
  const double announced = list_count(session, list, where);
  CountedList faces(std::move(list));
  check_count(session, announced, count_faces(faces, session.tokens), where);
  return faces;
}

CountedList vectors(Session& session, std::vector<ListEntry>& list, const Location& where) {
  CountedList result = counted(session, list, where);
  for (const ListEntry& entry : result) {
    session.tokens.spend(1);
    if (!is_finite(entry.v))
      session.diagnostics.warn_once(where, "a vector of this mesh is not finite: triangles that have its "
                                           "place are left out, those that have its normal are flat");
  }
  return result;
}

} // namespace celltrace::pov

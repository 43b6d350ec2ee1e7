#include "pov/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <glm/geometric.hpp>

#include "celltrace/error.hpp"
#include "memory/huge_pages.hpp"
#include "pov/finite.hpp"
#include "pov/token_stream.hpp"

namespace celltrace::pov {

namespace {

/// A face of mesh2 as indices: its vertices and its textures, 0, 1 or 3 of them.
struct Face {
  Index vertex[3];
  Index texture[3];
  int texture_count = 0;
};

Vec3f to_single(const Vec3& v) {
  const Vec3f single(v);
  if (!std::isfinite(single.x) || !std::isfinite(single.y) || !std::isfinite(single.z))
    throw InputError("a mesh has a coordinate that is too large");
  return single;
}

/// Returns whether a triangle has no area, or a corner that is not finite.
bool is_degenerate(const Vec3& a, const Vec3& b, const Vec3& c) {
  if (!is_finite(a) || !is_finite(b) || !is_finite(c)) return true;
  const Vec3 normal = glm::cross(b - a, c - a);
  return normal.x == 0 && normal.y == 0 && normal.z == 0;
}

constexpr double kNoNormal = 1e-10; ///< a normal with all components below this counts as zero

bool is_zero(const Vec3& normal) {
  const Vec3 size = glm::abs(normal);
  return std::max({size.x, size.y, size.z}) < kNoNormal;
}

/// Returns a vertex normal of length one, as POV-Ray makes it before it interpolates; a zero normal becomes
/// that along x.
Vec3 unit(const Vec3& normal) {
  return is_zero(normal) ? Vec3(1, 0, 0) : glm::normalize(normal);
}

/// Returns whether three unit normals make a triangle smooth.
bool are_smooth(const Vec3& a, const Vec3& b, const Vec3& c) {
  return !(a == b && b == c) && is_finite(a) && is_finite(b) && is_finite(c);
}

/// Returns all digits of a number if there are not too many.
std::string whole_text(double number) {
  constexpr double kMost = 1e15;
  return std::fabs(number) < kMost ? std::to_string(static_cast<long long>(number)) : short_text(number);
}

Index to_index(double value, std::size_t count, const char* what) {
  const double whole = std::trunc(value);
  if (!(whole >= 0 && whole < static_cast<double>(count)))
    throw InputError(std::string("mesh2 has no ") + what + ' ' + whole_text(whole) + ", there are " +
                     std::to_string(count));
  return static_cast<Index>(whole);
}

void to_indices(const ListEntry& entry, std::size_t count, const char* what, Index (&indices)[3]) {
  if (!is_finite(entry.v)) throw InputError("mesh2 has an index that is not finite");
  for (int i = 0; i < 3; ++i)
    indices[i] = to_index(entry.v[i], count, what);
}

/// Reads the face at `entry`, and moves `entry` past the face and its textures.
Face take_face(const Mesh2Definition& definition, const ListEntry*& entry) {
  if (entry->is_float) throw InputError("mesh2 has a texture index without a face");
  Face face;
  to_indices(*entry++, definition.vertex_vectors.size(), "vertex", face.vertex);
  for (; entry != definition.face_indices.end() && entry->is_float && face.texture_count < 3; ++entry) {
    Index texture[3];
    to_indices(*entry, definition.textures.size(), "texture", texture);
    face.texture[face.texture_count++] = texture[0];
  }
  if (face.texture_count == 2)
    throw InputError("mesh2 has a face with two texture indices: one or three can be given");
  return face;
}

/// Appends the surface coordinates of face number `face` by its uv_indices or, if the mesh has none, by the
/// indices of its vertices.
void add_coordinates(const Mesh2Definition& definition, std::size_t face, const Face& of, Mesh& mesh) {
  if (definition.uv_vectors.empty()) return;
  Index indices[3];
  if (definition.uv_indices.empty())
    std::copy(of.vertex, of.vertex + 3, indices);
  else
    to_indices(definition.uv_indices[face], definition.uv_vectors.size(), "uv vector", indices);
  Mesh::Coordinates& coordinates = mesh.coordinates.emplace_back();
  for (int corner = 0; corner < 3; ++corner) {
    const Vec3& uv = definition.uv_vectors[indices[corner]].v;
    const Vec3f single = is_finite(uv) ? to_single(uv) : Vec3f(0);
    coordinates.corner[corner] = {single.x, single.y};
  }
}

/// Checks the number of uv_indices: POV-Ray has one for each face, or none if each vertex has its own
/// coordinates.
void check_coordinates(const Mesh2Definition& definition, std::size_t faces) {
  if (definition.uv_vectors.empty()) return;
  if (definition.uv_indices.empty() && definition.uv_vectors.size() != definition.vertex_vectors.size())
    throw InputError("mesh2 needs uv_indices, as it has not as many uv_vectors as vertices");
  if (!definition.uv_indices.empty() && definition.uv_indices.size() != faces)
    throw InputError("mesh2 has " + std::to_string(definition.uv_indices.size()) + " uv_indices for " +
                     std::to_string(faces) + " faces");
}

/// Finds the normals of face number `face` by its normal_indices or, if the mesh has none, by the indices of
/// its vertices. Returns false if the face is flat.
bool find_normals(const Mesh2Definition& definition, std::size_t face, const Face& of, Index (&normal)[3]) {
  if (definition.normal_vectors.empty()) return false;
  if (definition.normal_indices.empty()) {
    if (definition.normal_vectors.size() != definition.vertex_vectors.size()) return false;
    std::copy(of.vertex, of.vertex + 3, normal);
  } else {
    if (face >= definition.normal_indices.size()) return false;
    to_indices(definition.normal_indices[face], definition.normal_vectors.size(), "normal", normal);
  }
  return are_smooth(definition.normal_vectors[normal[0]].v, definition.normal_vectors[normal[1]].v,
                    definition.normal_vectors[normal[2]].v);
}

/// Reserves room for so many elements that fresh memory is needed.
template <class T> void reserve(std::vector<T>& elements, std::size_t count) {
  elements.reserve(count);
  use_huge_pages(elements.data(), count * sizeof(T));
}

} // namespace

std::size_t count_faces(const CountedList& faces, TokenStream& tokens) {
  std::size_t count = 0;
  for (const ListEntry& entry : faces) {
    tokens.spend(1);
    count += !entry.is_float;
  }
  return count;
}

TriangleDefinition TriangleDefinition::transformed(const Transform& transform) const {
  TriangleDefinition result = *this;
  for (Vec3& vertex : result.vertices)
    vertex = transform.point(vertex);
  for (Vec3& normal : result.normals)
    normal = transform.normal(normal);
  return result;
}

bool TriangleDefinition::is_finite() const {
  const auto are_finite = [](const std::array<Vec3, 3>& vectors) {
    return std::all_of(vectors.begin(), vectors.end(), [](const Vec3& v) { return pov::is_finite(v); });
  };
  return are_finite(vertices) && are_finite(normals);
}

bool TriangleDefinition::is_shown_alone() const {
  if (!is_finite()) return false;
  if (!is_smooth) return true;
  const Vec3 across = glm::cross(vertices[1] - vertices[0], vertices[2] - vertices[0]);
  int sides = 0;
  for (const Vec3& normal : normals) {
    const double side = glm::dot(across, normal);
    if (is_zero(normal) || side == 0) return false;
    sides += side > 0 ? 1 : -1;
  }
  return std::abs(sides) == 3;
}

void MeshBuilder::add(const TriangleDefinition& triangle) {
  is_unused_ = false;
  const auto& corners = triangle.vertices;
  if (is_degenerate(corners[0], corners[1], corners[2])) return;
  const std::array<Vec3, 3> normals{unit(triangle.normals[0]), unit(triangle.normals[1]),
                                    unit(triangle.normals[2])};
  const bool is_smooth = triangle.is_smooth && are_smooth(normals[0], normals[1], normals[2]);
  Mesh& mesh = mesh_->mesh;
  Mesh::Triangle result;
  for (std::size_t i = 0; i < 3; ++i) {
    result.vertex[i] = static_cast<Index>(mesh.vertices.size());
    mesh.vertices.push_back(to_single(corners[i]));
    if (is_smooth) {
      result.normal[i] = static_cast<Index>(mesh.normals.size());
      mesh.normals.push_back(to_single(normals[i]));
    }
    if (triangle.textures[i]) result.material[i] = texture_index(triangle.textures[i]);
  }
  mesh.triangles.push_back(result);
  if (!triangle.is_mapped && mesh.coordinates.empty()) return;
  mesh.coordinates.resize(mesh.triangles.size()); // earlier triangles get 0, as in POV-Ray
  std::copy(triangle.coordinates.begin(), triangle.coordinates.end(), mesh.coordinates.back().corner);
}

Index MeshBuilder::texture_index(const TexturePtr& texture) {
  const auto [entry, is_new] =
      texture_indices_.try_emplace(texture.get(), static_cast<Index>(mesh_->textures.size()));
  if (is_new) mesh_->textures.push_back(texture);
  return entry->second;
}

std::shared_ptr<MeshDefinition> make_mesh(Mesh2Definition definition, TokenStream& tokens) {
  const CountedList& vertices = definition.vertex_vectors;
  for (std::size_t i = 0; i < definition.normal_vectors.size(); ++i) {
    tokens.spend(1);
    definition.normal_vectors[i].v = unit(definition.normal_vectors[i].v);
  }
  auto result = std::make_shared<MeshDefinition>();
  Mesh& mesh = result->mesh;
  mesh.inside_vector = definition.inside_vector;
  const CountedList& faces = definition.face_indices;
  const std::size_t face_count = count_faces(faces, tokens);
  check_coordinates(definition, face_count);
  reserve(mesh.triangles, face_count);
  const ListEntry* entry = faces.begin();
  for (std::size_t i = 0; entry != faces.end(); ++i) {
    tokens.spend(1);
    const Face face = take_face(definition, entry);
    if (is_degenerate(vertices[face.vertex[0]].v, vertices[face.vertex[1]].v, vertices[face.vertex[2]].v))
      continue;
    Mesh::Triangle triangle;
    std::copy(face.vertex, face.vertex + 3, triangle.vertex);
    Index normal[3];
    if (find_normals(definition, i, face, normal)) std::copy(normal, normal + 3, triangle.normal);
    for (int corner = 0; corner < 3 && face.texture_count > 0; ++corner)
      triangle.material[corner] = face.texture[face.texture_count == 3 ? corner : 0];
    mesh.triangles.push_back(triangle);
    add_coordinates(definition, i, face, mesh);
  }
  // Frees each list once it has been used, instead of all of them at the end.
  definition.face_indices = {};
  tokens.check_limits();
  reserve(mesh.vertices, vertices.size());
  for (const ListEntry& vertex : vertices) {
    tokens.spend(1);
    mesh.vertices.push_back(is_finite(vertex.v) ? to_single(vertex.v) : Vec3f(0));
  }
  definition.vertex_vectors = {};
  tokens.check_limits();
  reserve(mesh.normals, definition.normal_vectors.size());
  for (const ListEntry& normal : definition.normal_vectors) {
    tokens.spend(1);
    mesh.normals.push_back(is_finite(normal.v) ? to_single(normal.v) : Vec3f(1, 0, 0));
  }
  result->textures = std::move(definition.textures);
  return result;
}

} // namespace celltrace::pov

// From triangles and mesh2's lists to a Mesh.
#pragma once

#include <memory>
#include <unordered_map>
#include <vector>

#include "pov/literals.hpp"
#include "pov/object.hpp"

namespace celltrace::pov {

class TokenStream;

/// Takes triangles one by one. Degenerate ones are dropped; normals that are equal or zero count for nothing.
class MeshBuilder {
public:
  void add(const TriangleDefinition& triangle);
  void set_inside_vector(const Vec3& direction) { mesh_->mesh.inside_vector = direction; }
  std::shared_ptr<MeshDefinition> finish() { return std::move(mesh_); }

private:
  Index texture_index(const TexturePtr& texture);

  std::shared_ptr<MeshDefinition> mesh_ = std::make_shared<MeshDefinition>();
  std::unordered_map<const TextureDefinition*, Index> texture_indices_;
};

/// The lists of a mesh2, each as written behind its count.
struct Mesh2Definition {
  std::vector<ListEntry> vertex_vectors;
  std::vector<ListEntry> normal_vectors;
  std::vector<TexturePtr> textures;
  std::vector<ListEntry> face_indices; ///< a vector for a face, floats for its textures behind it
  std::vector<ListEntry> normal_indices;
  std::vector<ListEntry> uv_vectors;
  std::vector<ListEntry> uv_indices;
  Vec3 inside_vector{0, 0, 0};
};

/// Throws InputError, without a position, for indices that are out of range or do not belong to a face.
/// `tokens` counts the work.
std::shared_ptr<MeshDefinition> make_mesh(Mesh2Definition definition, TokenStream& tokens);

} // namespace celltrace::pov

// Builds a Mesh from triangles and from mesh2's lists.
#pragma once

#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>

#include "pov/literals.hpp"
#include "pov/object.hpp"

namespace celltrace::pov {

class TokenStream;

/// Takes triangles one by one. Drops degenerate ones, and normals that are all equal or zero.
class MeshBuilder {
public:
  void add(const TriangleDefinition& triangle);
  void set_inside_vector(const Vec3& direction) { mesh_->mesh.inside_vector = direction; }
  /// Returns whether no triangle has been added.
  bool is_unused() const { return is_unused_; }
  std::shared_ptr<MeshDefinition> finish() { return std::move(mesh_); }

private:
  Index texture_index(const TexturePtr& texture);

  std::shared_ptr<MeshDefinition> mesh_ = std::make_shared<MeshDefinition>();
  std::unordered_map<const TextureDefinition*, Index> texture_indices_;
  bool is_unused_ = true;
};

/// The entries of a list with a count at its head. The count stays where it was read: to remove it would move
/// all entries, which may take a hundred megabytes.
class CountedList {
public:
  CountedList() = default;
  /// Takes a list that begins with its count.
  explicit CountedList(std::vector<ListEntry> written) : written_(std::move(written)) {}

  std::size_t size() const { return written_.empty() ? 0 : written_.size() - 1; }
  bool empty() const { return size() == 0; }
  const ListEntry& operator[](std::size_t i) const { return written_[i + 1]; }
  ListEntry& operator[](std::size_t i) { return written_[i + 1]; }
  const ListEntry* begin() const { return end() - size(); }
  const ListEntry* end() const { return written_.data() + written_.size(); }

private:
  std::vector<ListEntry> written_;
};

struct Mesh2Definition {
  CountedList vertex_vectors;
  CountedList normal_vectors;
  std::vector<TexturePtr> textures;
  CountedList face_indices; ///< per face a vector, followed by floats for its textures
  CountedList normal_indices;
  CountedList uv_vectors;
  CountedList uv_indices;
  Vec3 inside_vector{0, 0, 0};
};

/// Returns the number of faces, without the textures' indices. `tokens` counts the work.
std::size_t count_faces(const CountedList& faces, TokenStream& tokens);

/// Makes the mesh. Throws InputError, without a position, for indices that are out of range or do not belong
/// to a face. `tokens` counts the work.
std::shared_ptr<MeshDefinition> make_mesh(Mesh2Definition definition, TokenStream& tokens);

} // namespace celltrace::pov

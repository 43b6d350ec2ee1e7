// The objects of a Scene one by one, and their records: meshes taken apart into triangles, everything
// transformed to the world, in single precision.
#pragma once

#include "celltrace/scene.hpp"
#include "kernel/overlap.hpp"
#include "kernel/records.hpp"
#include "scene/object_order.hpp"

#include <span>
#include <vector>

namespace celltrace {

/// What there is in a range of objects.
struct ObjectCensus {
  std::uint32_t objects = 0; ///< that can be hit
  std::uint32_t smooth = 0, blended = 0;
  kernel::Box around = {{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};

  static constexpr float kFar = 3e38f;
  void add(const ObjectCensus& other);
};

/// Where records go that objects refer to, and where the tables lie in the image.
struct RecordTables {
  std::uint32_t material_offset, interior_offset, normals_offset, blend_offset;
  kernel::NormalsRecord* normals; ///< table
  kernel::BlendRecord* blends;    ///< table
};

class SceneObjects {
public:
  /// `scene` stays as it is as long as this lives. Throws InputError if there are too many objects.
  SceneObjects(const Scene& scene, unsigned threads);

  /// All of them, those that cannot be hit included: spheres without a radius and triangles without an area.
  std::uint32_t count() const { return count_; }

  /// Writes those of [begin, end) that can be hit to `to`, in order. Throws InputError if an object's
  /// coordinates leave what single precision can hold.
  ObjectCensus place(std::uint32_t begin, std::uint32_t end, PlacedObject* to) const;
  /// Those that are smooth and blended, of `objects`.
  ObjectCensus count_tables(std::span<const PlacedObject> objects) const;

  /// Makes the records of `objects`. `before` says how many there are in the tables before theirs.
  void write(std::span<const PlacedObject> objects, const RecordTables& tables, const ObjectCensus& before,
             kernel::ObjectRecord* to) const;

private:
  /// Spheres in a row, or one mesh.
  struct Piece {
    std::uint32_t first;             ///< number of its first object
    const Object* object;            ///< first of the spheres, or of the mesh
    const Mesh* mesh;                ///< null: spheres
    std::span<const Vec3f> vertices; ///< in the world
    std::span<const Vec3f> normals;
  };
  class Writer;

  void add_spheres(const Object& object);
  void add_mesh(const Object& object, const Mesh& mesh, unsigned threads);
  void grow(std::size_t objects);
  std::uint32_t end_of(const Piece& piece) const;
  /// `near`: a piece that is likely to be it, or null.
  const Piece& piece_of(std::uint32_t number, const Piece* near) const;
  bool is_blended(const Piece& piece, const Mesh::Triangle& triangle) const;

  const Scene& scene_;
  std::vector<bool> opaque_; ///< by material
  std::vector<Piece> pieces_;
  std::vector<std::vector<Vec3f>> transformed_;
  std::uint32_t count_ = 0;
};

} // namespace celltrace

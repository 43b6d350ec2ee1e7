// The objects of a Scene that are no instances, one by one, and their records: meshes taken apart into
// triangles, everything transformed to the world, in single precision.
#pragma once

#include "celltrace/scene.hpp"
#include "kernel/records.hpp"
#include "scene/mesh_instances.hpp"
#include "scene/object_order.hpp"
#include "scene/object_records.hpp"

#include <span>
#include <vector>

namespace celltrace {

class SceneObjects {
public:
  /// Those that are not among `instances`. `scene` stays as it is as long as this lives. Throws InputError if
  /// there are too many objects.
  SceneObjects(const Scene& scene, const MeshInstances& instances, unsigned threads);

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

  /// The same for those of [begin, end) of the scene, where there are no tables: `places` says by object
  /// where in `to` it belongs, or kNoPlace.
  void write_apart(std::uint32_t begin, std::uint32_t end, const std::uint32_t* places,
                   const RecordTables& tables, kernel::ObjectRecord* to) const;
  static constexpr std::uint32_t kNoPlace = 0xFFFFFFFF;

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

  void place_spheres(const Piece& piece, std::uint32_t begin, std::uint32_t end, ObjectCensus& census,
                     PlacedObject* to) const;
  void place_triangles(const Piece& piece, std::uint32_t begin, std::uint32_t end, ObjectCensus& census,
                       PlacedObject* to) const;
  void add_sphere(const Object& object);
  void add_mesh(const Object& object, const Mesh& mesh, unsigned threads);
  void grow(std::size_t objects);
  std::uint32_t end_of(const Piece& piece) const;
  /// `near`: a piece that is likely to be it, or null.
  const Piece& piece_of(std::uint32_t number, const Piece* near) const;
  bool is_blended(const Piece& piece, const Mesh::Triangle& triangle) const;

  std::vector<Piece> pieces_;
  std::vector<std::vector<Vec3f>> transformed_;
  std::uint32_t count_ = 0;
};

} // namespace celltrace

// The objects of a Scene that are no instances, one by one, and their records: meshes and plain polygons
// taken apart into triangles and CSGs into their parts, everything transformed to the world, in single
// precision.
#pragma once

#include "celltrace/scene.hpp"
#include "prepare/pass.hpp"
#include "records/object.hpp"
#include "scene_image/csg_parts.hpp"
#include "scene_image/instanced_meshes.hpp"
#include "scene_image/mesh_instances.hpp"
#include "scene_image/object_order.hpp"
#include "scene_image/object_records.hpp"

#include <deque>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace celltrace {

class SceneObjects {
public:
  /// Takes the objects of `scene` apart, except `instances`. Each object of `instanced` counts as one object.
  /// Adds the insides of `patterns` to the conditions of CSG. The objects from index `projectors` on are
  /// lights' projectors. `scene` and `material_flags`, the object flags of each material, must not change
  /// while this object lives. Sets in `limits` which limits the scene passes. Throws InputError if there are
  /// too many objects.
  SceneObjects(const Scene& scene, const Eye& eye, std::size_t projectors,
               const std::vector<std::shared_ptr<const Object>>& patterns,
               const std::vector<std::uint32_t>& material_flags, const InstancedMeshes& instanced,
               const MeshInstances& instances, unsigned threads, PassedLimits& limits);

  /// Returns the number of objects with bounds. It includes objects that cannot be hit: spheres without a
  /// radius and triangles without an area.
  std::uint32_t count() const { return count_; }
  /// Returns the number of objects without bounds: planes, unless CSG bounds them.
  std::uint32_t unbounded_count() const { return static_cast<std::uint32_t>(unbounded_.size()); }
  /// Return the indices in the scene of the objects that count() counts, and of the unbounded objects. A part
  /// of a CSG has the index of the CSG.
  std::vector<Index> owners() const;
  std::vector<Index> unbounded_owners() const;
  /// Returns the number of objects that lights are projected through, with or without bounds.
  std::uint32_t projector_count() const { return static_cast<std::uint32_t>(projectors_.size()); }
  /// Returns for each projector the number of consecutive objects that it consists of.
  const std::vector<std::uint32_t>& projector_sizes() const { return projector_sizes_; }
  /// Returns the number of ExtraRecords of projectors and of unbounded objects.
  std::uint32_t unbounded_extras() const;
  /// Returns whether primary rays see all objects.
  bool are_all_seen() const { return are_all_seen_; }
  /// Returns the order in which the scene's objects are numbered; empty if their positions do not matter to
  /// it.
  const std::vector<std::size_t>& order() const { return order_; }
  const CsgParts& csg() const { return csg_; }
  std::vector<SolidBoundary> take_boundaries() { return std::move(csg_.boundaries); }
  const ShapeDataTable& shape_data() const { return csg_.shape_data; }

  /// Writes to `to`, in order, the objects of [begin, end) that can be hit. Throws InputError if an object's
  /// coordinates exceed the range of single precision.
  ObjectCounts place(std::uint32_t begin, std::uint32_t end, PlacedObject* to) const;
  /// Returns the counts that place() returns, if `places` has the place of each object; nothing if an object
  /// that can be hit has no place.
  std::optional<ObjectCounts> count_placed(std::uint32_t begin, std::uint32_t end,
                                           std::span<const std::uint32_t> places) const;
  /// Returns how many of `objects` have records in other tables.
  ObjectCounts count_tables(std::span<const PlacedObject> objects) const;

  /// Writes the records of `objects`. `before` counts the entries of other tables in front of their entries.
  void write(std::span<const PlacedObject> objects, const RecordTables& tables, const ObjectCounts& before,
             kernel::ObjectRecord* to) const;

  /// Returns whether all objects are triangles that no CSG limits, and single precision holds all their
  /// coordinates.
  bool are_plain_triangles() const;
  /// Counts as count_placed() does, and writes the records of objects that need no other tables; `places`
  /// tells where in `to` each record belongs. Needs are_plain_triangles().
  std::optional<ObjectCounts> write_placed(std::uint32_t begin, std::uint32_t end,
                                           std::span<const std::uint32_t> places, const RecordTables& tables,
                                           kernel::ObjectRecord* to) const;
  /// Writes the records of the objects of [begin, end) to their places, as write() does. The objects must
  /// need no other tables; skips objects without a place.
  void write_apart(std::uint32_t begin, std::uint32_t end, std::span<const std::uint32_t> places,
                   const RecordTables& tables, kernel::ObjectRecord* to) const;
  static constexpr std::uint32_t kNoPlace = 0xFFFFFFFF;

  /// Writes the records of projectors, then of unbounded objects; `before` is as for write().
  void write_unbounded(const RecordTables& tables, const ObjectCounts& before,
                       kernel::ObjectRecord* to) const;

private:
  /// A run of shapes, a run of CSG parts, or one mesh.
  struct Piece {
    std::uint32_t first;             ///< number of the piece's first object
    const Object* object;            ///< the first shape, or the mesh's object; null for parts
    const Mesh* mesh;                ///< null for shapes and parts
    std::span<const Vec3f> vertices; ///< in the world
    std::span<const Vec3f> normals;
    const CsgPart* part = nullptr; ///< the first part, or the part that is the mesh

    /// Returns whether the piece is a mesh that CSG limits.
    bool is_limited_mesh() const { return mesh != nullptr && part != nullptr && part->is_limited(); }
  };
  /// A shape by itself or a part of a CSG.
  struct Placed {
    const Object* object;
    const CsgPart* part; ///< null for a shape by itself
  };
  class Writer;

  static Placed placed_at(const Piece& piece, std::uint32_t number);
  bool has_extra(const Placed& placed) const;
  /// Calls `visit(number, box)` for the objects of [begin, end) that can be hit.
  template <class Visit> ObjectCounts visit_boxes(std::uint32_t begin, std::uint32_t end, Visit visit) const;
  template <class Visit>
  void visit_shapes(const Piece& piece, std::uint32_t begin, std::uint32_t end, ObjectCounts& counts,
                    Visit visit) const;
  template <class Visit>
  void visit_triangles(const Piece& piece, std::uint32_t begin, std::uint32_t end, ObjectCounts& counts,
                       Visit visit) const;
  void add_shape(const Object& object);
  /// Adds a polygon as triangles. Returns false if the object is no polygon, or has to stay a polygon.
  bool add_as_triangles(const Object& object);
  void add_parts(std::size_t whole, unsigned threads);
  void add_projectors(const Scene& scene, std::size_t first);
  /// Adds a mesh; `part` is the CSG part that the mesh is, or null.
  void add_mesh(const Object& object, const Mesh& mesh, const CsgPart* part, unsigned threads);
  void grow(std::size_t objects);
  std::uint32_t end_of(const Piece& piece) const;
  /// Returns the piece that contains an object. `near` is a piece that is likely to contain it, or null.
  const Piece& piece_of(std::uint32_t number, const Piece* near) const;
  bool is_blended(const Piece& piece, const Mesh::Triangle& triangle) const;
  bool is_mapped(const Piece& piece, const Mesh::Triangle& triangle) const;

  Index owner_of(const Placed& placed) const;
  Index owner_of(const Piece& piece) const;

  const Scene& scene_;
  const std::vector<std::uint32_t>& material_flags_;
  const InstancedMeshes& instanced_;
  CsgParts csg_;
  std::vector<std::size_t> order_;
  std::vector<Piece> pieces_;
  std::vector<Placed> unbounded_, projectors_;
  std::vector<std::uint32_t> projector_sizes_;
  std::vector<std::vector<Vec3f>> transformed_;
  std::deque<Mesh> triangulated_; ///< triangulated polygons; a deque, so that pieces can refer to them
  std::uint32_t count_ = 0;
  bool are_all_seen_ = true;
};

} // namespace celltrace

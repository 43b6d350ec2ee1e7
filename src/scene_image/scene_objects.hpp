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
#include "scene_image/polygon_table.hpp"

#include <deque>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace celltrace {

class SceneObjects {
public:
  /// Those that are not among `instances`, each of `instanced` as one, and what is inside of `patterns`.
  /// Objects from `projectors` on are those of lights. `scene` and `material_flags`, what objects have that
  /// consist of a material, stay as they are as long as this lives. Says which limits the scene passes.
  /// Throws InputError if there are too many objects.
  SceneObjects(const Scene& scene, const Eye& eye, std::size_t projectors,
               const std::vector<std::shared_ptr<const Object>>& patterns,
               const std::vector<std::uint32_t>& material_flags, const InstancedMeshes& instanced,
               const MeshInstances& instances, unsigned threads, PassedLimits& limits);

  /// All that have bounds, those that cannot be hit included: spheres without a radius and triangles without
  /// an area.
  std::uint32_t count() const { return count_; }
  /// The others: planes, unless CSG bounds them.
  std::uint32_t unbounded_count() const { return static_cast<std::uint32_t>(unbounded_.size()); }
  /// The indices in the scene's objects of those that are counted, and of unbounded ones: of a part of a CSG,
  /// that of the whole.
  std::vector<Index> owners() const;
  std::vector<Index> unbounded_owners() const;
  /// What lights are projected through, without bounds or with.
  std::uint32_t projector_count() const { return static_cast<std::uint32_t>(projectors_.size()); }
  /// By projector, how many of these it consists of, one after the other.
  const std::vector<std::uint32_t>& projector_sizes() const { return projector_sizes_; }
  /// The ExtraRecords of these and of unbounded ones.
  std::uint32_t unbounded_extras() const;
  /// Whether primary rays see all of them.
  bool are_all_seen() const { return are_all_seen_; }
  /// The order in which objects of the scene are numbered, if it depends on what is where.
  const std::vector<std::size_t>& order() const { return order_; }
  const CsgParts& csg() const { return csg_; }
  std::vector<SolidBoundary> take_boundaries() { return std::move(csg_.boundaries); }
  const PolygonTable& polygons() const { return polygons_; }

  /// Writes those of [begin, end) that can be hit to `to`, in order. Throws InputError if an object's
  /// coordinates leave what single precision can hold.
  ObjectCensus place(std::uint32_t begin, std::uint32_t end, PlacedObject* to) const;
  /// The same where they have places already, by object; nothing if one that can be hit has none.
  std::optional<ObjectCensus> count_placed(std::uint32_t begin, std::uint32_t end,
                                           std::span<const std::uint32_t> places) const;
  /// Those with records of their own in other tables, of `objects`.
  ObjectCensus count_tables(std::span<const PlacedObject> objects) const;

  /// Makes the records of `objects`. `before` says how many there are in the tables before theirs.
  void write(std::span<const PlacedObject> objects, const RecordTables& tables, const ObjectCensus& before,
             kernel::ObjectRecord* to) const;

  /// Whether all are triangles that no CSG limits, and none of their coordinates leave what single precision
  /// can hold.
  bool are_plain_triangles() const;
  /// As count_placed(), and makes the records of those that have no others in tables: `places` says where in
  /// `to` they belong. Those of are_plain_triangles() only.
  std::optional<ObjectCensus> write_placed(std::uint32_t begin, std::uint32_t end,
                                           std::span<const std::uint32_t> places, const RecordTables& tables,
                                           kernel::ObjectRecord* to) const;
  /// As write() for those of [begin, end) of the scene, where there are no tables; those without a place are
  /// left out.
  void write_apart(std::uint32_t begin, std::uint32_t end, std::span<const std::uint32_t> places,
                   const RecordTables& tables, kernel::ObjectRecord* to) const;
  static constexpr std::uint32_t kNoPlace = 0xFFFFFFFF;

  /// The records of projectors, then of unbounded objects; `before` as for write().
  void write_unbounded(const RecordTables& tables, const ObjectCensus& before,
                       kernel::ObjectRecord* to) const;

private:
  /// Shapes in a row, parts of CSGs in a row, or one mesh.
  struct Piece {
    std::uint32_t first;             ///< number of its first object
    const Object* object;            ///< first of the shapes, or the mesh's; null: parts
    const Mesh* mesh;                ///< null: shapes or parts
    std::span<const Vec3f> vertices; ///< in the world
    std::span<const Vec3f> normals;
    const CsgPart* part = nullptr; ///< first of the parts, or the one that the mesh is

    /// Whether it is a mesh that CSG limits.
    bool is_limited_mesh() const { return mesh != nullptr && part != nullptr && part->is_limited(); }
  };
  /// A shape by itself or a part of a CSG.
  struct Placed {
    const Object* object;
    const CsgPart* part; ///< null: by itself
  };
  class Writer;

  static Placed placed_at(const Piece& piece, std::uint32_t number);
  bool has_extra(const Placed& placed) const;
  /// Calls `visit(number, box)` for those of [begin, end) that can be hit.
  template <class Visit> ObjectCensus visit_boxes(std::uint32_t begin, std::uint32_t end, Visit visit) const;
  template <class Visit>
  void visit_shapes(const Piece& piece, std::uint32_t begin, std::uint32_t end, ObjectCensus& census,
                    Visit visit) const;
  template <class Visit>
  void visit_triangles(const Piece& piece, std::uint32_t begin, std::uint32_t end, ObjectCensus& census,
                       Visit visit) const;
  void add_shape(const Object& object);
  /// False: it stays a polygon, or is none.
  bool add_as_triangles(const Object& object);
  /// Those of one object of the scene.
  void add_parts(std::size_t whole, unsigned threads);
  void add_projectors(const Scene& scene, std::size_t first);
  /// `part`: that it is of a CSG, or null.
  void add_mesh(const Object& object, const Mesh& mesh, const CsgPart* part, unsigned threads);
  void grow(std::size_t objects);
  std::uint32_t end_of(const Piece& piece) const;
  /// `near`: a piece that is likely to be it, or null.
  const Piece& piece_of(std::uint32_t number, const Piece* near) const;
  bool is_blended(const Piece& piece, const Mesh::Triangle& triangle) const;
  bool is_mapped(const Piece& piece, const Mesh::Triangle& triangle) const;

  Index owner_of(const Placed& placed) const;
  Index owner_of(const Piece& piece) const;

  const Scene& scene_;
  const std::vector<std::uint32_t>& material_flags_;
  const InstancedMeshes& instanced_;
  CsgParts csg_;
  PolygonTable polygons_;
  std::vector<std::size_t> order_;
  std::vector<Piece> pieces_;
  std::vector<Placed> unbounded_, projectors_;
  std::vector<std::uint32_t> projector_sizes_;
  std::vector<std::vector<Vec3f>> transformed_;
  std::deque<Mesh> triangulated_; ///< polygons; a deque, so that pieces can refer to them
  std::uint32_t count_ = 0;
  bool are_all_seen_ = true;
};

} // namespace celltrace

// What the instances of a mesh have in common.
#pragma once

#include "celltrace/scene.hpp"
#include "kernel/accel/object_bounds.hpp"

#include <cstdint>
#include <vector>

namespace celltrace {

/// The triangles of a mesh that have an area, ordered so that neighbours in space are neighbours in memory,
/// in groups that the surface area heuristic would part; with the points they need, each of them once.
class MeshPrototype {
public:
  struct Triangle {
    Index vertex[3];
    Index normal[3]; ///< kNoIndex: flat
    Index material;  ///< kNoIndex: the instance's
  };

  /// Whether a mesh is worth while to share.
  static bool is_large_enough(const Mesh& mesh);
  /// Whether that is so, and its triangles have one material each, whatever the instance's.
  static bool can_be_made(const Mesh& mesh);
  /// Of such a mesh. What comes out does not depend on the number of threads.
  MeshPrototype(const Mesh& mesh, unsigned threads);

  const std::vector<Vec3f>& vertices() const { return vertices_; }
  const std::vector<Vec3>& unit_normals() const { return unit_normals_; }
  const std::vector<Triangle>& triangles() const { return triangles_; }
  /// Where the groups begin, and the number of triangles at last. Groups have at most
  /// kernel::kMaxCopiedObjects triangles.
  const std::vector<std::uint32_t>& groups() const { return groups_; }
  /// Boxes around the groups.
  const std::vector<kernel::Aabb>& group_bounds() const { return group_bounds_; }
  std::uint32_t group_count() const { return static_cast<std::uint32_t>(groups_.size()) - 1; }
  /// Triangles that have normals.
  std::uint32_t smooth() const { return smooth_; }
  /// Whether it is certain, without a look at each of them, that the triangles still have areas in single
  /// precision when they are transformed so, and that this holds their coordinates.
  bool surely_keeps_areas(const Transform& transform) const;

private:
  void measure();

  std::vector<Vec3f> vertices_;
  std::vector<Vec3> unit_normals_;
  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> groups_;
  std::vector<kernel::Aabb> group_bounds_;
  std::uint32_t smooth_ = 0;
  double least_height_ = 0; ///< of a triangle over one of its sides
  Vec3f min_{0, 0, 0}, max_{0, 0, 0};
};

} // namespace celltrace

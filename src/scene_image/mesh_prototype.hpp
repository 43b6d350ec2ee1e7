// Data that all instances of a mesh share.
#pragma once

#include "celltrace/scene.hpp"
#include "kernel/accel/object_bounds.hpp"

#include <cstdint>
#include <vector>

namespace celltrace {

/// The triangles of a mesh that have an area, ordered so that neighbours in space are neighbours in memory,
/// in groups that the surface area heuristic would separate. Each point that the triangles use is stored
/// once.
class MeshPrototype {
public:
  struct Triangle {
    Index vertex[3];
    Index normal[3]; ///< kNoIndex if the triangle is flat
    Index material;  ///< kNoIndex for the material of the instance
  };

  /// Returns whether a mesh is large enough to be worth sharing.
  static bool is_large_enough(const Mesh& mesh);
  /// Returns whether the mesh is large enough, and no triangle has several materials.
  static bool can_be_made(const Mesh& mesh);
  /// Builds the prototype of a mesh for which can_be_made() is true. The result does not depend on the number
  /// of threads.
  MeshPrototype(const Mesh& mesh, unsigned threads);

  const std::vector<Vec3f>& vertices() const { return vertices_; }
  const std::vector<Vec3>& unit_normals() const { return unit_normals_; }
  const std::vector<Triangle>& triangles() const { return triangles_; }
  /// Returns the index of each group's first triangle, followed by the number of triangles. Groups have at
  /// most kernel::kMaxCopiedObjects triangles.
  const std::vector<std::uint32_t>& groups() const { return groups_; }
  const std::vector<kernel::Aabb>& group_bounds() const { return group_bounds_; }
  std::uint32_t group_count() const { return static_cast<std::uint32_t>(groups_.size()) - 1; }
  /// Returns the number of triangles with normals.
  std::uint32_t smooth() const { return smooth_; }
  /// Returns whether, without testing each triangle, it is certain that the transformed triangles keep their
  /// areas in single precision, and that single precision holds their coordinates.
  bool surely_preserves_areas(const Transform& transform) const;

private:
  void measure();

  std::vector<Vec3f> vertices_;
  std::vector<Vec3> unit_normals_;
  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> groups_;
  std::vector<kernel::Aabb> group_bounds_;
  std::uint32_t smooth_ = 0;
  double least_height_ = 0; ///< least height of a triangle over one of its sides
  Vec3f min_{0, 0, 0}, max_{0, 0, 0};
};

} // namespace celltrace

// Convex polytopes that half-spaces cut out: the part of space that planes leave in CSG.
#pragma once

#include "celltrace/transform.hpp"
#include "kernel/aabb.hpp"

#include <cstddef>
#include <vector>

namespace celltrace {

/// A polytope that begins as an axis-aligned box and is cut by one half-space after the other.
class Polytope {
public:
  struct Face {
    std::vector<Vec3> corners; ///< corners in order around the face
    std::size_t source;
  };

  /// Limit on absolute values of coordinates. Greater ones count as infinite: no ray reaches that far.
  static constexpr double kReach = 1e7;
  static constexpr std::size_t kBox = static_cast<std::size_t>(-1); ///< source of the box's own faces

  explicit Polytope(const kernel::Aabb& box);

  /// Keeps the points p with dot(normal, p) <= offset, and points slightly beyond. `normal` has any length
  /// but 0. If a face lies in the plane, it gets this `source`.
  void cut(const Vec3& normal, double offset, std::size_t source);
  /// Cuts as cut() does, but keeps no points beyond the plane; the normal has length 1. Corners at most
  /// `tolerance` beyond the plane count as in it.
  void cut_exactly(const Vec3& unit, double offset, double tolerance, std::size_t source);

  bool is_empty() const { return faces_.empty(); }
  const std::vector<Face>& faces() const { return faces_; }

  /// Returns slightly enlarged bounds; infinite where the polytope reaches beyond kReach. If the polytope is
  /// empty, each minimum is greater than the maximum.
  kernel::Aabb bounds() const;
  /// Returns bounds() of the face with this source, or of the whole polytope if it has no such face.
  kernel::Aabb bounds_of_face(std::size_t source) const;

private:
  std::vector<Face> faces_;
};

} // namespace celltrace

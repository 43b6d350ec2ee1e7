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

  /// Coordinates whose absolute value is greater count as infinite: no ray reaches that far.
  static constexpr double kReach = 1e7;
  static constexpr std::size_t kBox = static_cast<std::size_t>(-1); ///< source of the box's own faces

  explicit Polytope(const kernel::Aabb& box);

  /// Keeps the points p with dot(normal, p) <= offset, and a little more. `normal` has any length but 0. The
  /// face that lies in the plane, if there is one, gets this `source`.
  void cut(const Vec3& normal, double offset, std::size_t source);
  /// Cuts as cut() does, but keeps no more than these points; the normal has length 1. Corners less than
  /// `tolerance` beyond the plane count as in it.
  void cut_exactly(const Vec3& unit, double offset, double tolerance, std::size_t source);

  bool is_empty() const { return faces_.empty(); }
  const std::vector<Face>& faces() const { return faces_; }

  /// Returns slightly enlarged bounds; infinite where the polytope reaches beyond kReach. If it is empty,
  /// each minimum is greater than the maximum.
  kernel::Aabb bounds() const;
  /// Returns such bounds of the face of a source, or of the whole polytope if that source has no face.
  kernel::Aabb bounds_of_face(std::size_t source) const;

private:
  std::vector<Face> faces_;
};

} // namespace celltrace

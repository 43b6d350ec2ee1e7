// Convex polytopes, cut out by half-spaces: what planes leave of space in CSG.
#pragma once

#include "celltrace/transform.hpp"
#include "kernel/aabb.hpp"

#include <cstddef>
#include <vector>

namespace celltrace {

/// Begins as an axis-aligned box, and loses what is outside of one half-space after the other.
class Polytope {
public:
  struct Face {
    std::vector<Vec3> corners; ///< in order around it
    std::size_t source;
  };

  /// Coordinates beyond this, in either direction, count as infinite: no ray reaches so far.
  static constexpr double kReach = 1e7;
  static constexpr std::size_t kBox = static_cast<std::size_t>(-1); ///< source of the first faces

  explicit Polytope(const kernel::Aabb& box);

  /// Leaves the points p with dot(normal, p) <= offset, and a little more. `normal` has any length but 0.
  /// The face that lies in the plane, if there is one, is from then on that of `source`.
  void cut(const Vec3& normal, double offset, std::size_t source);
  /// Likewise, but no more than these points, of a normal of length 1. Corners less than `tolerance` beyond
  /// the plane are in it.
  void cut_exactly(const Vec3& unit, double offset, double tolerance, std::size_t source);

  bool is_empty() const { return faces_.empty(); }
  const std::vector<Face>& faces() const { return faces_; }

  /// Around all of it and a little more, infinite where it reaches beyond kReach. Of an empty one, each
  /// minimum is greater than the maximum.
  kernel::Aabb bounds() const;
  /// Likewise around the face of a source; around all of it where that has none.
  kernel::Aabb bounds_of_face(std::size_t source) const;

private:
  std::vector<Face> faces_;
};

} // namespace celltrace

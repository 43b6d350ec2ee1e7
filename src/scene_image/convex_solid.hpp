// Solids between planes, as the triangles of their faces: what CSG makes of planes and boxes, if it is
// convex.
#pragma once

#include "celltrace/scene.hpp"
#include "kernel/aabb.hpp"

#include <optional>
#include <vector>

namespace celltrace {

/// An intersection of half-spaces, each of the material that its face shows.
class ConvexSolid {
public:
  /// Takes away what is outside of an object, placed in the world. False: it is no plane with a normal, and
  /// no box that is not inverse, or of another kind to rays than those before; the solid is of no use then.
  bool cut(const Object& object);

  /// Whether a box of it lies outside of one of the half-spaces as a whole: there is nothing to see.
  bool is_surely_empty() const;

  /// The object that rays see in its place: a box of one material, or a mesh in the world with the materials
  /// of the planes. Of faces in one plane it shows the last one. `around` is a box around all of it. Nothing
  /// if the solid is not bounded by planes on all sides, or is empty or flat.
  std::optional<Object> as_object(const kernel::Aabb& around) const;

private:
  struct HalfSpace {
    Vec3 normal; ///< outward
    double offset;
    Index material;
  };

  /// A box among what it was cut by: all of the solid is in it.
  struct WholeBox {
    Vec3 corners[8];
    std::size_t first; ///< of its six half-spaces
    double reach;      ///< the largest distance of two corners along an axis
  };
  enum class Side { inside, outside, cut };

  static std::optional<Transform> box_between(const std::vector<HalfSpace>& faces);
  Side side_of(const HalfSpace& half_space, double tolerance) const;
  std::vector<HalfSpace> faces_of_whole_box(double size) const;

  std::vector<HalfSpace> half_spaces_;
  std::optional<WholeBox> box_; ///< the first one
  Object first_;
};

} // namespace celltrace

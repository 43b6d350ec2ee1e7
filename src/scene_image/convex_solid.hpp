// Convex solids between planes, made of the planes and boxes of a CSG, and the objects that show their faces.
#pragma once

#include "celltrace/scene.hpp"
#include "kernel/aabb.hpp"

#include <optional>
#include <vector>

namespace celltrace {

/// An intersection of half-spaces. Each half-space has the material that its face shows.
class ConvexSolid {
public:
  /// Cuts off the part of the solid that is outside of an object in the world. Returns false, and leaves the
  /// solid unusable, unless the object is a plane with a normal, or a box that is neither inverse nor flat,
  /// and has the same visibility flags, lights and interior as the objects before.
  bool cut(const Object& object);

  /// Returns whether some half-space contains nothing of the box that has cut the solid, so that nothing is
  /// seen.
  bool is_surely_empty() const;

  /// Returns the object that rays see in place of the solid: a box of one material, or a mesh in the world
  /// with the materials of the planes. If several faces lie in one plane, the last face is shown. `around` is
  /// a box around the whole solid. Returns nothing if the solid is not bounded by planes on all sides, or is
  /// empty or flat.
  std::optional<Object> as_object(const kernel::Aabb& around) const;

private:
  struct HalfSpace {
    Vec3 normal; ///< points outward
    double offset;
    Index material;
  };

  /// A box among the objects that cut the solid; it contains the whole solid.
  struct WholeBox {
    Vec3 corners[8];
    std::size_t first; ///< index of the first of its six half-spaces
    double reach;      ///< largest distance of two corners along an axis
  };
  enum class Side { inside, outside, cut };

  static std::optional<Transform> box_between(const std::vector<HalfSpace>& faces);
  Side side_of(const HalfSpace& half_space, double tolerance) const;
  std::vector<HalfSpace> faces_of_whole_box(double size) const;

  std::vector<HalfSpace> half_spaces_;
  std::optional<WholeBox> box_; ///< the first box that has cut the solid
  Object first_;
};

} // namespace celltrace

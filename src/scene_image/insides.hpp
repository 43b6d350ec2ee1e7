// Finds the objects of a scene that contain a point.
#pragma once

#include "celltrace/scene.hpp"
#include "kernel/aabb.hpp"

#include <vector>

namespace celltrace {

/// An object that a camera may be in.
struct Medium {
  Object object;
  Index interior;   ///< interior of rays that start inside of the object
  kernel::Aabb box; ///< bounds of the object

  /// Returns whether a point is inside by the rules of CSG; a mesh has an inside if it has an inside vector.
  bool contains(const Vec3& point) const;
  /// Returns the volume of a sphere, or of the box around any other object.
  double volume() const;
};

/// Returns all objects of a scene that have an inside; none if no material and no fog depends on the object
/// that a ray is in.
std::vector<Medium> media_of(const Scene& scene);

} // namespace celltrace

// Which objects of a scene a point is in.
#pragma once

#include "celltrace/scene.hpp"
#include "kernel/aabb.hpp"

#include <vector>

namespace celltrace {

/// An object that a camera may be in.
struct Medium {
  Object object;
  Index interior;   ///< that rays begin in there
  kernel::Aabb box; ///< around it

  /// By the rules of CSG; a mesh has an inside if it has an inside vector.
  bool contains(const Vec3& point) const;
  /// Of its box, or of a sphere itself.
  double volume() const;
};

/// All objects of a scene that have an inside; none where no material asks what a ray is in, nor fog does.
std::vector<Medium> media_of(const Scene& scene);

} // namespace celltrace

// The origin of a scene's records. They are single precision: seven digits, which map coordinates take alone
// for where everything is.
#pragma once

#include "celltrace/scene.hpp"

#include <optional>

namespace celltrace {

/// Returns the middle of a scene's objects if they are so far from the origin, for their size, that single
/// precision does not do; else 0. It depends on objects alone, no mistake of a scene's is found, and not all
/// of many objects are looked at.
Vec3 origin_for(const Scene& scene);

/// Returns the largest coordinate of an object that has bounds, if all of them are small beside how far away
/// `location` is; else 0.
double largest_coordinate_from_afar(const Scene& scene, const Vec3& location);

/// Returns a camera in coordinates from `origin`.
Camera moved_to(const Vec3& origin, Camera camera);

/// A scene in coordinates from an origin: all that has a place in it is moved, textures too.
class SceneAtOrigin {
public:
  /// `scene` stays as it is as long as this lives. Throws InputError as validate() does if it has to be
  /// moved.
  SceneAtOrigin(const Scene& scene, const Vec3& origin);

  const Scene& scene() const { return copy_ ? *copy_ : scene_; }

private:
  const Scene& scene_;
  std::optional<Scene> copy_; ///< none if the origin is 0
};

} // namespace celltrace

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

/// Returns a scene in coordinates from `origin`, in which all that has a place is moved, textures too;
/// nothing if the origin is 0. Throws InputError as validate() does if it has to be moved.
std::optional<Scene> moved_to(const Vec3& origin, const Scene& scene);

} // namespace celltrace

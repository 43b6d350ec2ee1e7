// The floating origin of a scene's records. Records have single precision: scenes in map coordinates need all
// its seven digits for the position alone.
#pragma once

#include "celltrace/scene.hpp"

#include <optional>

namespace celltrace {

/// Returns the middle of a scene's objects if they are so far from the origin, compared with their size, that
/// single precision is not enough; else 0. The result depends only on objects. The scene is not validated,
/// and if there are many objects, only a sample of them is examined.
Vec3 origin_for(const Scene& scene);

/// Returns the largest coordinate of objects with bounds if all of them are small compared with the distance
/// of `location`; else 0.
double largest_coordinate_from_afar(const Scene& scene, const Vec3& location);

/// Returns a camera in coordinates relative to `origin`.
Camera moved_to(const Vec3& origin, Camera camera);

/// Returns a scene in coordinates relative to `origin`: moves everything that has a place, including
/// textures. Returns nothing if the origin is 0. Otherwise throws InputError as validate() does.
std::optional<Scene> moved_to(const Vec3& origin, const Scene& scene);

} // namespace celltrace

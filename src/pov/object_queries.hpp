// Answers a scene's queries about declared objects, trace(), inside(), min_extent() and max_extent(), in
// double precision.
#pragma once

#include <optional>

#include "geometry/extent.hpp"
#include "pov/object.hpp"

namespace celltrace::pov {

struct Session;

/// The first point where a ray hits an object.
struct ObjectHit {
  Vec3 point;
  Vec3 normal; ///< of unit length; points outwards, whichever side the ray comes from
};
/// Returns the first hit of a ray; `direction` has any length but 0. Unsupported features of the object count
/// as used.
std::optional<ObjectHit> trace(Session& session, const ObjectDefinition& object, const Vec3& origin,
                               const Vec3& direction, const Location& where);

bool contains(Session& session, const ObjectDefinition& object, const Vec3& point, const Location& where);

/// Returns POV-Ray's bounding box of an object.
Extent extent_of(Session& session, const ObjectDefinition& object, const Location& where);

} // namespace celltrace::pov

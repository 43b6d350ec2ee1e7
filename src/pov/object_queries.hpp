// What the scene can ask about objects that it has declared: trace(), inside(), min_extent() and
// max_extent(), in double precision.
#pragma once

#include <optional>

#include "geometry/extent.hpp"
#include "pov/object.hpp"

namespace celltrace::pov {

struct Session;

/// Where a ray hits an object first.
struct ObjectHit {
  Vec3 point;
  Vec3 normal; ///< of unit length; outwards, on whichever side the ray comes from
};
/// `direction` of any length but 0. What the object lacks support for counts as used.
std::optional<ObjectHit> trace(Session& session, const ObjectDefinition& object, const Vec3& origin,
                               const Vec3& direction, const Location& where);

bool contains(Session& session, const ObjectDefinition& object, const Vec3& point, const Location& where);

/// POV-Ray's bounding box.
Extent extent_of(Session& session, const ObjectDefinition& object, const Location& where);

} // namespace celltrace::pov

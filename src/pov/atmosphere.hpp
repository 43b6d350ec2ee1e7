// Sky spheres, fogs and rainbows.
#pragma once

#include "pov/session.hpp"
#include "pov/value.hpp"

namespace celltrace::pov {

/// Fails unless a sky_sphere has a pigment.
void check(Session& session, const SkySphereDefinition& sky, const Location& where);
void add_layer(Session& session, SkySphereDefinition& sky, const PigmentDefinition& pigment,
               const Location& where);
/// Moves the pigments that it has got.
void transform(Session& session, SkySphereDefinition& sky, const Transform& next, const Location& where);

/// Whether a fog of this type is one that lies on the ground.
bool is_ground_fog(Session& session, double type, const Location& where);
/// A mere number is the distance.
void set_colour_or_distance(Session& session, Fog& fog, const Quantity& value, const Location& where);
/// As in POV-Ray, only the direction of its heights turns.
void transform(Fog& fog, const Transform& next);
/// 0 if it has no direction.
void set_up(Fog& fog, const Vec3& up);
/// Makes a complete fog black where POV-Ray divides by zero for it.
void settle(Session& session, Fog& fog, const Location& where);

/// With POV-Ray's defaults: no direction, as far away as can be, and an arc without an end.
std::shared_ptr<RainbowDefinition> new_rainbow();
void set_colours(Rainbow& rainbow, const PigmentMap& map);
/// Fails unless a rainbow has all that it needs.
void check(Session& session, const Rainbow& rainbow, const Location& where);

} // namespace celltrace::pov

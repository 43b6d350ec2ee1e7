// Sky spheres, fogs and rainbows.
#pragma once

#include "pov/session.hpp"
#include "pov/value.hpp"

namespace celltrace::pov {

/// Fails unless a sky_sphere has a pigment.
void check(Session& session, const SkySphereDefinition& sky, const Location& where);
void add_layer(Session& session, SkySphereDefinition& sky, const PigmentDefinition& pigment,
               const Location& where);
/// Transforms the pigments that a sky_sphere has so far.
void transform(Session& session, SkySphereDefinition& sky, const Transform& next, const Location& where);

/// Returns whether fogs of this type lie on the ground.
bool is_ground_fog(Session& session, double type, const Location& where);
/// Sets a fog's distance if the value is a single number, otherwise its colour.
void set_colour_or_distance(Session& session, Fog& fog, const Quantity& value, const Location& where);
/// Turns the fog's up direction; as in POV-Ray, nothing else of a fog is transformed.
void transform(Fog& fog, const Transform& next);
/// Sets the up direction to `up`, made a unit vector, or to 0 if `up` has no length.
void set_up(Fog& fog, const Vec3& up);
/// Makes a complete fog black where POV-Ray divides by zero for it.
void settle(Session& session, Fog& fog, const Location& where);

/// Returns a rainbow with POV-Ray's defaults: no direction, the greatest distance, and an arc without an end.
std::shared_ptr<RainbowDefinition> new_rainbow();
void set_colours(Rainbow& rainbow, const PigmentMap& map);
/// Fails if the direction, `up` or the angles of a rainbow are unusable.
void check(Session& session, const Rainbow& rainbow, const Location& where);

} // namespace celltrace::pov

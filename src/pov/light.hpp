// Light sources as they are written.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "pov/object.hpp"
#include "pov/quantity.hpp"

namespace celltrace::pov {

struct Session;

// Returns a new light. The light that is being read is session.lights.back() until its end.
std::shared_ptr<ObjectDefinition> light(Session& session, const Vec3& location, const Vec3& colour);
/// Returns a copy of a declared light. Fails if `declared` is something else.
std::shared_ptr<ObjectDefinition> light(Session& session, const ObjectDefinition& declared,
                                        const Location& where);

Light moved(Light light, const Transform& next);
/// Returns a point light for each place of an area light, or for 16 along each side of a larger grid.
/// POV-Ray's area_illumination also takes the mean of these lights, but multiplies it by the mean shadow, in
/// which corners count less.
std::vector<Light> lights_at_places(const Light& light);
LightArea moved(LightArea area, const Transform& next);

// The modifiers of a light source.

Light& light_of(ObjectDefinition& object);
LightDefinition& definition_of(ObjectDefinition& object);
/// Sets the kind of a light, and the numbers of that kind to POV-Ray's defaults.
void set_kind(ObjectDefinition& object, Light::Kind kind);
/// Sets the kind by the name of a shape, an index in shape_names().
void set_kind(Session& session, ObjectDefinition& object, int shape, const Location& where);
void set_point_at(Session& session, ObjectDefinition& object, const Quantity& point, const Location& where);
/// Sets a number that only spotlights and cylinders have.
void set_beam(Session& session, ObjectDefinition& object, double Light::*number, double value,
              const Location& where);
/// Gives a light soft shadows, those of an area: two sides of it, and the number of lights along each.
void set_area(Session& session, ObjectDefinition& object, const Vec3& across, const Vec3& along,
              const std::array<double, 2>& places, const Location& where);
/// Returns the area, whose properties may be given before or after the area itself.
LightArea& area_of(ObjectDefinition& object);
void set_adaptive(ObjectDefinition& object, double level);
/// Returns what is seen in place of the light that is being read, moved to the light's current place. As in
/// POV-Ray, later modifiers move it from there.
std::shared_ptr<ObjectDefinition> look(Session& session, const ObjectDefinition& object,
                                       const Location& where);
/// Returns the object that the light shines through. Later modifiers apply to it.
std::shared_ptr<ObjectDefinition> projector(Session& session, const ObjectDefinition& object,
                                            const Location& where);
/// Adds one of these two objects to a light. Fails for any other object.
void add_object(Session& session, ObjectDefinition& light, const std::shared_ptr<ObjectDefinition>& object,
                const Location& where);
/// Returns the object; fails if it is one of these two.
ObjectPtr own_object(Session& session, ObjectPtr object, const Location& where);
/// Makes a light shadowless. As in POV-Ray, shadowless is a kind of light: if another kind is set before or
/// after, the later one wins.
void set_shadowless(ObjectDefinition& object);
void transform(ObjectDefinition& object, const Transform& next);

} // namespace celltrace::pov

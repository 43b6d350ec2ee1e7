// Light sources as they are written.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "pov/object.hpp"
#include "pov/quantity.hpp"

namespace celltrace::pov {

struct Session;

// The one that is being read is session.lights.back() until its end.
std::shared_ptr<ObjectDefinition> light(Session& session, const Vec3& location, const Vec3& colour);
/// A copy of one that was declared. Fails if that is something else.
std::shared_ptr<ObjectDefinition> light(Session& session, const ObjectDefinition& declared,
                                        const Location& where);

Light moved(Light light, const Transform& next);
/// Instead of a light with an area, a point at each place of it, or at 16 along each side of a larger grid.
/// POV-Ray's area_illumination has the mean light of these, too, but multiplies it with the mean shadow, in
/// which corners count less.
std::vector<Light> lights_at_places(const Light& light);
LightArea moved(LightArea area, const Transform& next);

// The modifiers of a light source.

Light& light_of(ObjectDefinition& object);
LightDefinition& definition_of(ObjectDefinition& object);
/// Also sets the numbers of that kind, to what POV-Ray begins with.
void set_kind(ObjectDefinition& object, Light::Kind kind);
/// By the name of a shape, its place in shape_names().
void set_kind(Session& session, ObjectDefinition& object, int shape, const Location& where);
void set_point_at(Session& session, ObjectDefinition& object, const Quantity& point, const Location& where);
/// A number that only spotlights and cylinders have.
void set_beam(Session& session, ObjectDefinition& object, double Light::*number, double value,
              const Location& where);
/// Shadows are those of an area: two sides of it, and how many places there are along each.
void set_area(Session& session, ObjectDefinition& object, const Vec3& across, const Vec3& along,
              const std::array<double, 2>& places, const Location& where);
/// What is said of its area, before or after that is given.
LightArea& area_of(ObjectDefinition& object);
void set_adaptive(ObjectDefinition& object, double level);
/// What the light that is being read looks like, moved to where that is by now. As in POV-Ray, modifiers
/// behind it apply to it there.
std::shared_ptr<ObjectDefinition> look(Session& session, const ObjectDefinition& object,
                                       const Location& where);
/// What it shines through. Modifiers behind it apply to it.
std::shared_ptr<ObjectDefinition> projector(Session& session, const ObjectDefinition& object,
                                            const Location& where);
/// One of these two. Fails if the object is another one.
void add_object(Session& session, ObjectDefinition& light, const std::shared_ptr<ObjectDefinition>& object,
                const Location& where);
/// The object, unless it is one of these: that is an error.
ObjectPtr own_object(Session& session, ObjectPtr object, const Location& where);
/// As in POV-Ray, this is a kind of its own: what is said of another one before or after it cancels the
/// other.
void set_shadowless(ObjectDefinition& object);
void transform(ObjectDefinition& object, const Transform& next);

} // namespace celltrace::pov

// Sky spheres, fogs and rainbows.
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "pov/actions.hpp"
#include "pov/finite.hpp"

namespace celltrace::pov {

void add_layer(Session& session, SkySphereDefinition& sky, const PigmentDefinition& pigment,
               const Location& where) {
  if (pigment.depends_on_surface()) session.fail(where, "a sky_sphere has no surface for this pigment");
  append(session, sky.pigments, pigment, where);
}

void check(Session& session, const SkySphereDefinition& sky, const Location& where) {
  if (sky.pigments.empty() && !sky.unsupported) session.fail(where, "a sky_sphere needs a pigment");
}

void transform(Session& session, SkySphereDefinition& sky, const Transform& next, const Location& where) {
  for (PigmentDefinition& pigment : sky.pigments)
    move(session, pigment.pattern, next, where);
}

bool is_ground_fog(Session& session, double type, const Location& where) {
  const double whole = std::trunc(type);
  if (whole != 1 && whole != 2)
    session.diagnostics.warn_once(where, "there are fogs of type 1 and 2: this is one of type 1");
  return whole == 2;
}

void set_colour_or_distance(Session& session, Fog& fog, const Quantity& value, const Location& where) {
  if (value.is_float()) {
    fog.distance = session.number(value, where);
    return;
  }
  const Pigment colour = session.colour(value, where);
  fog.colour = colour.rgb;
  fog.filter = colour.filter;
  fog.transmit = colour.transmit;
}

void transform(Fog& fog, const Transform& next) {
  if (is_finite(next)) set_up(fog, next.direction(fog.up));
}

void set_up(Fog& fog, const Vec3& up) {
  const double length = glm::length(up);
  fog.up = length > 0 ? up / length : Vec3(0);
}

void settle(Session& session, Fog& fog, const Location& where) {
  if (!fog.is_ground || fog.distance == 0) return;
  const bool has_up = fog.up != Vec3(0);
  if (has_up && fog.altitude != 0) return;
  session.diagnostics.warn_once(where, has_up
                                           ? "a ground fog without 'fog_alt' is black where it is"
                                           : "a ground fog whose 'up' has no direction is black everywhere");
  constexpr double kThick = 1e-4, kThin = 1e-10;
  fog.is_ground = has_up;
  fog.altitude = kThin;
  fog.distance = kThick;
  fog.colour = Vec3(0);
  fog.filter = fog.transmit = 0;
  fog.turbulence.amount = Vec3(0);
}

std::shared_ptr<RainbowDefinition> new_rainbow() {
  // POV-Ray takes its default for radians.
  constexpr double kEndless = 360 * 180 / std::numbers::pi;
  constexpr double kFarthest = 1e7;
  auto rainbow = std::make_shared<RainbowDefinition>();
  rainbow->value.distance = kFarthest;
  rainbow->value.direction = Vec3(0);
  rainbow->value.arc_angle = rainbow->value.falloff_angle = kEndless;
  return rainbow;
}

void set_colours(Rainbow& rainbow, const PigmentMap& map) {
  rainbow.colours.clear();
  for (const auto& [position, pigment] : map.entries)
    rainbow.colours.push_back({position, pigment.rgb, pigment.filter, pigment.transmit});
}

void check(Session& session, const Rainbow& rainbow, const Location& where) {
  constexpr double kLeast = 1e-10;
  const double length = glm::length(rainbow.direction);
  if (length < kLeast) session.fail(where, "this rainbow's direction has no length");
  const Vec3 across = glm::cross(rainbow.direction, rainbow.up);
  if (glm::length(across) < kLeast * length)
    session.fail(where, "this rainbow's direction and 'up' are one line");
  const bool is_given = rainbow.falloff_angle < new_rainbow()->value.falloff_angle;
  if (is_given && rainbow.arc_angle < rainbow.falloff_angle)
    session.fail(where, "this rainbow's 'arc_angle' is less than its 'falloff_angle'");
}

} // namespace celltrace::pov

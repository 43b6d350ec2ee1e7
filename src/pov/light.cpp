#include "pov/light.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "pov/actions.hpp"
#include "pov/session.hpp"
#include "pov/shapes.hpp"

namespace celltrace::pov {

namespace {

ObjectPtr moved(const ObjectPtr& object, const Transform& next) {
  auto copy = std::make_shared<ObjectDefinition>(*object);
  copy->apply(next);
  return copy;
}

} // namespace

Light moved(Light light, const Transform& next) {
  light.location = next.point(light.location);
  light.point_at = next.point(light.point_at);
  if (light.area) light.area = moved(*light.area, next);
  return light;
}

std::vector<Light> lights_at_places(const Light& light) {
  // Limit on lights along a side. Larger: each surface is lit by more lights; smaller: penumbrae
  // have steps.
  constexpr int kMostPlaces = 16;
  const LightArea& area = *light.area;
  const int columns = std::min(area.columns, kMostPlaces), rows = std::min(area.rows, kMostPlaces);
  const auto place = [](int i, int count) { return count > 1 ? i / (count - 1.0) - 0.5 : 0.0; };
  std::vector<Light> lights;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      double u = place(column, columns), v = place(row, rows);
      if (area.circular && (u != 0 || v != 0)) {
        const double shrunk = std::max(std::fabs(u), std::fabs(v)) / std::hypot(u, v);
        u *= shrunk;
        v *= shrunk;
      }
      const Vec3 offset = area.across * u + area.along * v;
      Light& one = lights.emplace_back(light);
      one.area.reset();
      one.colour /= columns * rows;
      one.location += offset;
      if (!one.parallel) one.point_at += offset;
    }
  return lights;
}

LightArea moved(LightArea area, const Transform& next) {
  area.across = next.direction(area.across);
  area.along = next.direction(area.along);
  return area;
}

std::shared_ptr<ObjectDefinition> light(Session& session, const Vec3& location, const Vec3& colour) {
  auto object = std::make_shared<ObjectDefinition>();
  object->shape = LightDefinition{Light{location, colour}, nullptr, {}, false};
  session.lights.push_back(object);
  return object;
}

std::shared_ptr<ObjectDefinition> light(Session& session, const ObjectDefinition& declared,
                                        const Location& where) {
  if (!declared.light()) session.fail(where, "this is not a light source");
  auto object = std::make_shared<ObjectDefinition>(declared);
  // Moves the light to its current place; later modifiers, such as point_at, are not moved.
  object->transform = Transform();
  transform(*object, declared.transform);
  session.lights.push_back(object);
  return object;
}

LightDefinition& definition_of(ObjectDefinition& object) {
  return *std::get<HeapValue<LightDefinition>>(object.shape);
}

Light& light_of(ObjectDefinition& object) {
  return definition_of(object).light;
}

void set_kind(ObjectDefinition& object, Light::Kind kind) {
  Light& light = light_of(object);
  const bool is_cylinder = kind == Light::Kind::cylinder;
  light.kind = kind;
  light.shadowless = false;
  light.radius = is_cylinder ? 0.75 : 30;
  light.falloff = is_cylinder ? 1 : 45;
  light.tightness = 0;
  // The light stays parallel if `spotlight` follows.
  if (is_cylinder) light.parallel = true;
}

void set_shadowless(ObjectDefinition& object) {
  set_kind(object, Light::Kind::point);
  light_of(object).shadowless = true;
}

void set_kind(Session& session, ObjectDefinition& object, int shape, const Location& where) {
  const std::string_view name = shape_names()[static_cast<std::size_t>(shape)];
  if (has_option(shape)) session.fail(where, "unexpected '" + std::string(name) + '\'');
  if (name != "cylinder") session.fail(where, "there is no light source of this shape");
  set_kind(object, Light::Kind::cylinder);
}

void set_point_at(Session& session, ObjectDefinition& object, const Quantity& point, const Location& where) {
  Light& light = light_of(object);
  if (light.kind == Light::Kind::point && !light.parallel)
    session.fail(where, "only a spotlight, cylinder or parallel light points at something");
  light.point_at = point.vec3();
}

void set_beam(Session& session, ObjectDefinition& object, double Light::*number, double value,
              const Location& where) {
  Light& light = light_of(object);
  if (light.kind == Light::Kind::point)
    session.fail(where, "only a spotlight or cylinder has 'radius', 'falloff' and 'tightness'");
  light.*number = value;
}

void set_area(Session& session, ObjectDefinition& object, const Vec3& across, const Vec3& along,
              const std::array<double, 2>& places, const Location& where) {
  constexpr int kMostPlaces = 256;
  LightDefinition& definition = definition_of(object);
  for (const double count : places)
    if (!(count >= 1 && count < kMostPlaces + 1))
      session.fail(where,
                   "an area light has 1 to " + std::to_string(kMostPlaces) + " places along each side");
  definition.has_area = true;
  definition.area.across = across;
  definition.area.along = along;
  definition.area.columns = static_cast<int>(places[0]);
  definition.area.rows = static_cast<int>(places[1]);
}

LightArea& area_of(ObjectDefinition& object) {
  return definition_of(object).area;
}

void set_adaptive(ObjectDefinition& object, double level) {
  constexpr double kAlways = 100; // more than any grid can be subdivided
  area_of(object).adaptive = static_cast<int>(std::clamp(level, 0.0, kAlways));
}

std::shared_ptr<ObjectDefinition> look(Session& session, const ObjectDefinition& object,
                                       const Location& where) {
  if (session.lights.empty()) session.fail(where, "only a light source looks like something");
  auto moved_object = std::make_shared<ObjectDefinition>(object);
  moved_object->apply(Transform::translate(light_of(*session.lights.back()).location));
  moved_object->role = ObjectDefinition::Role::look;
  return moved_object;
}

std::shared_ptr<ObjectDefinition> projector(Session& session, const ObjectDefinition& object,
                                            const Location& where) {
  if (session.lights.empty()) session.fail(where, "only a light source is projected through something");
  auto copy = std::make_shared<ObjectDefinition>(object);
  copy->role = ObjectDefinition::Role::projector;
  return copy;
}

void add_object(Session& session, ObjectDefinition& light, const std::shared_ptr<ObjectDefinition>& object,
                const Location& where) {
  using Role = ObjectDefinition::Role;
  if (object->role == Role::none) session.fail(where, "a light source consists of no objects");
  LightDefinition& definition = definition_of(light);
  const bool is_look = object->role == Role::look;
  ObjectPtr& place = is_look ? definition.looks_like : definition.projected_through;
  if (place)
    session.fail(where, is_look ? "a light source looks like one object only"
                                : "a light source is projected through one object only");
  nest(session, light, *object, where);
  object->role = Role::none;
  object->where = where;
  place = object;
}

ObjectPtr own_object(Session& session, ObjectPtr object, const Location& where) {
  if (object->role != ObjectDefinition::Role::none)
    session.fail(where, "only a light source looks like something or is projected through it");
  return object;
}

void transform(ObjectDefinition& object, const Transform& next) {
  LightDefinition& definition = definition_of(object);
  definition.light = moved(definition.light, next);
  if (definition.has_area) definition.area = moved(definition.area, next);
  for (ObjectPtr* own : {&definition.looks_like, &definition.projected_through})
    if (*own) *own = moved(*own, next);
}

} // namespace celltrace::pov

#include "pov/camera.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>

#include <glm/geometric.hpp>

#include "celltrace/error.hpp"
#include "pov/actions.hpp"
#include "pov/finite.hpp"
#include "pov/patterns.hpp"
#include "pov/session.hpp"
#include "pov/shapes.hpp"

namespace celltrace::pov {

namespace {

struct CameraKind {
  const char* name;
  Camera::Kind kind;
};

/// All kinds but cylinders, whose word is a shape's.
constexpr CameraKind kKinds[] = {
    {"perspective", Camera::Kind::perspective}, {"orthographic", Camera::Kind::orthographic},
    {"spherical", Camera::Kind::spherical},     {"ultra_wide_angle", Camera::Kind::ultra_wide_angle},
    {"omnimax", Camera::Kind::omnimax},         {"panoramic", Camera::Kind::panoramic},
    {"fisheye", Camera::Kind::fisheye},
};
constexpr Camera::Kind kCylinders[] = {Camera::Kind::cylinder_1, Camera::Kind::cylinder_2,
                                       Camera::Kind::cylinder_3, Camera::Kind::cylinder_4};

constexpr Vec3 kDefaultRight{1.33, 0, 0};
constexpr Vec3 kDefaultUp{0, 1, 0};
constexpr Vec3 kDefaultLookAt{0, 0, 1};
constexpr double kRadiansPerDegree = 3.14159265358979323846 / 180;
constexpr double kTiny = 1e-10;

void set_flat_angle(Camera& camera, double degrees) {
  if (degrees < 0 || degrees >= 180) throw InputError("a camera's angle must lie between 0 and 180 degrees");
  if (degrees == 0) return;
  const double length = glm::length(camera.direction);
  const double width = glm::length(camera.right);
  if (length == 0) return;
  camera.direction *= width / (2 * std::tan(degrees * kRadiansPerDegree / 2)) / length;
}

/// Returns whether the camera projects onto a plane: its angle is then that of a picture at the distance of
/// the direction's length.
bool is_flat(Camera::Kind kind) {
  return kind == Camera::Kind::perspective || kind == Camera::Kind::orthographic;
}

/// Returns whether the camera looks along the sky, so that the sky does not tell what is sideways.
bool looks_along_sky(const Vec3& location, const Vec3& look_at, const Vec3& sky) {
  const double distance = glm::distance(look_at, location);
  return distance >= kTiny && glm::length(glm::cross(sky, (look_at - location) / distance)) < kTiny;
}

/// Turns the camera towards a point, with the sky as up; lengths and handedness stay as they are.
void turn(Camera& camera, const Vec3& look_at, const Vec3& sky) {
  const Vec3 line_of_sight = look_at - camera.location;
  const double distance = glm::length(line_of_sight);
  const double sign = glm::dot(glm::cross(camera.up, camera.direction), camera.right) > 0 ? 1 : -1;
  const double depth = glm::length(camera.direction);
  const double height = glm::length(camera.up);
  const double width = glm::length(camera.right);

  const Vec3 forward = line_of_sight / distance;
  Vec3 sideways = glm::cross(sky, forward);
  if (looks_along_sky(camera.location, look_at, sky)) sideways = width > 0 ? camera.right : kDefaultRight;
  sideways = glm::normalize(sideways);
  camera.direction = forward * depth;
  camera.up = glm::cross(forward, sideways) * height;
  camera.right = sideways * (sign * width);
}

constexpr double kVersionOfFixedOrder = 3.5;

/// Gives an orthographic camera whose picture has no size of its own the size that a perspective one has at
/// the point looked at.
void scale_orthographic(Camera& camera, double distance) {
  const double depth = glm::length(camera.direction);
  camera.right *= distance / depth;
  camera.up *= distance / depth;
}

void move(Camera& camera, const Transform& next) {
  camera.location = next.point(camera.location);
  camera.direction = next.direction(camera.direction);
  camera.right = next.direction(camera.right);
  camera.up = next.direction(camera.up);
}

Camera view_of(const CameraDefinition& definition) {
  Camera camera;
  camera.location = definition.location;
  camera.direction = definition.direction;
  camera.right = definition.right.value_or(kDefaultRight);
  camera.up = definition.up.value_or(kDefaultUp);
  return camera;
}

void set_view(CameraDefinition& definition, const Camera& camera) {
  definition.location = camera.location;
  definition.direction = camera.direction;
  definition.right = camera.right;
  definition.up = camera.up;
}

void warn_of_sky(Session& session, const CameraDefinition& camera) {
  if (camera.look_at && looks_along_sky(camera.location, *camera.look_at, camera.sky))
    session.diagnostics.warn_once(camera.look_at_where,
                                  "this camera looks along its 'sky': it keeps the 'right' that it has");
}

/// Returns whether the camera's rays have a direction, and makes it explicit. Rays of a camera without a
/// `direction` go towards the points of the picture: a tiny direction hardly changes them, and gives one to
/// the ray through the picture's middle.
bool has_direction(Camera& camera) {
  constexpr double kNextToNothing = 1e-6;
  if (!is_finite(camera.location) || !is_finite(camera.direction) || !is_finite(camera.right) ||
      !is_finite(camera.up))
    return false;
  if (glm::length(camera.direction) > 0) return true;
  const Vec3 forward = glm::cross(camera.right, camera.up);
  const double area = glm::length(forward);
  if (area == 0) return false;
  camera.direction = forward * (kNextToNothing * glm::length(camera.up) / area);
  return true;
}

} // namespace

std::vector<const char*> camera_kind_names() {
  std::vector<const char*> names;
  for (const CameraKind& kind : kKinds)
    names.push_back(kind.name);
  return names;
}

void set_kind(CameraDefinition& camera, int name) {
  camera.kind = kKinds[name].kind;
  if (camera.kind != Camera::Kind::orthographic || !camera.acts_at_once) return;
  const double distance = glm::length(camera.look_at.value_or(kDefaultLookAt) - camera.location);
  if (distance < kTiny || glm::length(camera.direction) < kTiny) return;
  Camera view = view_of(camera);
  scale_orthographic(view, distance);
  set_view(camera, view);
}

void set_kind_by_pattern(Session& session, CameraDefinition& camera, int pattern, const Location& where) {
  const std::string_view word = pattern_words()[static_cast<std::size_t>(pattern)].word;
  const auto* found = std::find_if(std::begin(kKinds), std::end(kKinds),
                                   [&](const CameraKind& kind) { return kind.name == word; });
  if (found == std::end(kKinds)) session.fail(where, "there is no camera of this kind");
  camera.kind = found->kind;
}

void set_kind(Session& session, CameraDefinition& camera, int shape, double number, const Location& where) {
  const std::string_view name = shape_names()[static_cast<std::size_t>(shape)];
  if (has_option(shape)) session.fail(where, "unexpected '" + std::string(name) + '\'');
  if (name != "cylinder") session.fail(where, "there is no camera of this shape");
  if (!(number >= 1 && number < 1 + std::size(kCylinders)))
    session.fail(where, "cameras on a cylinder are of type 1, 2, 3 or 4");
  camera.kind = kCylinders[static_cast<int>(number) - 1];
}

void set_angles(Session& session, CameraDefinition& camera, double angle, double vertical_angle,
                const Location& where) {
  if (camera.kind != Camera::Kind::spherical)
    session.fail(where, "only a spherical camera has a second angle");
  camera.angle = angle;
  camera.vertical_angle = vertical_angle;
}

void set_angle(Session& session, CameraDefinition& camera, double angle, const Location& where) {
  if (!std::isfinite(angle)) {
    session.diagnostics.warn_once(where, "an angle that is not finite is ignored");
    return;
  }
  camera.angle = angle;
  camera.vertical_angle.reset();
  if (!camera.acts_at_once || !is_flat(camera.kind)) return;
  Camera view = view_of(camera);
  try {
    set_flat_angle(view, angle);
  } catch (const InputError& error) {
    session.fail(where, error.what());
  }
  camera.direction = view.direction;
}

void set_no_angle(Session& session, CameraDefinition& camera, const Location& where) {
  if (camera.kind != Camera::Kind::orthographic)
    session.fail(where, "only an orthographic camera has an 'angle' without a number");
  set_angle(session, camera, 0, where);
}

void set_look_at(Session& session, CameraDefinition& camera, const Vec3& point, const Location& where) {
  camera.look_at = point;
  camera.look_at_where = where;
  if (!camera.acts_at_once) return;
  if (glm::distance(point, camera.location) < kTiny) {
    session.diagnostics.warn_once(where, "this 'look_at' is ignored: the camera is there, up to here");
    return;
  }
  warn_of_sky(session, camera);
  Camera view = view_of(camera);
  turn(view, point, camera.sky);
  set_view(camera, view);
}

void transform(CameraDefinition& camera, const Transform& next) {
  if (!camera.acts_at_once) {
    camera.transform = camera.transform.then(next);
    return;
  }
  Camera view = view_of(camera);
  move(view, next);
  set_view(camera, view);
}

void check(Session& session, const CameraDefinition& camera, const Location& where) {
  constexpr double kLeast = 1e-5; // POV-Ray's bound
  if (camera.acts_at_once || !camera.look_at) return;
  if (glm::distance(*camera.look_at, camera.location) < kLeast)
    session.fail(where, "the camera's 'location' and 'look_at' are the same point");
  warn_of_sky(session, camera);
}

std::shared_ptr<CameraDefinition> start_camera(Session& session, const CameraDefinition& from,
                                               const Location& where) {
  auto camera = std::make_shared<CameraDefinition>(from);
  if (from.acts_at_once || !session.builder.is_before(kVersionOfFixedOrder)) return camera;
  camera->acts_at_once = true;
  try {
    if (const std::optional<Camera> view = from.finish()) set_view(*camera, *view);
  } catch (const InputError& error) {
    session.fail(where, error.what());
  }
  camera->transform = Transform();
  return camera;
}

UnsupportedPtr CameraDefinition::first_unsupported() const {
  if (unsupported || aperture == 0 || blur_samples == 0) return unsupported;
  return make_unsupported("'aperture'", aperture_where);
}

std::optional<Camera> CameraDefinition::finish() const {
  Camera camera = view_of(*this);
  camera.kind = kind;
  if (!is_flat(kind)) {
    camera.angle = angle.value_or(kind == Camera::Kind::spherical ? 360 : 90);
    camera.vertical_angle = vertical_angle.value_or(camera.angle / 2);
    if (camera.angle < 0 || camera.vertical_angle < 0)
      throw InputError("a camera's angle must not be negative");
  }
  const bool has_depth = glm::length(direction) != 0;
  const bool needs_depth = kind == Camera::Kind::orthographic || kind == Camera::Kind::spherical ||
                           (is_flat(kind) && angle.value_or(0) != 0);
  if (needs_depth && !has_depth) return std::nullopt;
  if (!acts_at_once) {
    if (angle && is_flat(kind)) set_flat_angle(camera, *angle);
    if (look_at) turn(camera, *look_at, sky);
    if (kind == Camera::Kind::orthographic && ((!right && !up) || angle))
      scale_orthographic(camera, glm::length(look_at.value_or(kDefaultLookAt) - location));
    move(camera, transform);
  }
  if (!has_direction(camera)) return std::nullopt;
  // Replaces zero axes, which make the picture a line or a point: a Scene's cameras may not have them.
  constexpr double kNearlyNothing = 1e-300;
  for (Vec3* axis : {&camera.right, &camera.up})
    if (*axis == Vec3(0)) axis->x = kNearlyNothing;
  return camera;
}

} // namespace celltrace::pov

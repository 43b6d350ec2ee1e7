// The camera as written, and the Camera that it becomes.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "celltrace/scene.hpp"
#include "pov/location.hpp"
#include "pov/texture.hpp"

namespace celltrace::pov {

struct Session;

/// Returns the words that stand for kinds of cameras and for nothing else.
std::vector<const char*> camera_kind_names();

/// The fields of a camera in any order, which finish() applies in a fixed order. In a scene of a version
/// before 3.5 each field takes effect at once, and finish() has nothing left to apply.
struct CameraDefinition {
  bool acts_at_once = false;
  Camera::Kind kind = Camera::Kind::perspective;
  Vec3 location{0, 0, 0};
  Vec3 direction{0, 0, 1};
  Vec3 sky{0, 1, 0};
  std::optional<Vec3> right;
  std::optional<Vec3> up;
  std::optional<Vec3> look_at;
  Location look_at_where;
  std::optional<double> angle;           ///< horizontal, in degrees
  std::optional<double> vertical_angle;  ///< in degrees
  double aperture = 0, blur_samples = 0; ///< focal blur needs both to be nonzero
  Location aperture_where;
  Transform transform;
  UnsupportedPtr unsupported;
  Location where;

  UnsupportedPtr first_unsupported() const;
  /// Returns the camera; nothing if none of its rays has a direction, so that it sees the background alone.
  /// Throws InputError, without a position, if its angle is negative, or 180 degrees or more.
  std::optional<Camera> finish() const;
};

/// Starts a camera as a copy of another, or of the current default.
std::shared_ptr<CameraDefinition> start_camera(Session& session, const CameraDefinition& from,
                                               const Location& where);

/// Sets the kind by its index in camera_kind_names().
void set_kind(CameraDefinition& camera, int name);
/// Sets the kind by a pattern's word, `spherical`.
void set_kind_by_pattern(Session& session, CameraDefinition& camera, int pattern, const Location& where);
/// Sets the kind by the name of a shape, an index in shape_names(), and the number after the name. Fails if
/// there is no such kind.
void set_kind(Session& session, CameraDefinition& camera, int shape, double number, const Location& where);
/// Sets a camera's horizontal and vertical angle. Fails if the camera has no such angles.
void set_angles(Session& session, CameraDefinition& camera, double angle, double vertical_angle,
                const Location& where);
void set_angle(Session& session, CameraDefinition& camera, double angle, const Location& where);
/// Accepts the word `angle` without a number, which Blender writes. Fails unless the camera is orthographic.
void set_no_angle(Session& session, CameraDefinition& camera, const Location& where);
void set_look_at(Session& session, CameraDefinition& camera, const Vec3& point, const Location& where);
void transform(CameraDefinition& camera, const Transform& next);
/// Checks a complete camera at `where`: warns of settings that place it otherwise than meant, and fails if it
/// looks at its own location.
void check(Session& session, const CameraDefinition& camera, const Location& where);

} // namespace celltrace::pov

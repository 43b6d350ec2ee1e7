// The camera as written, and what it comes to.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "celltrace/scene.hpp"
#include "pov/location.hpp"
#include "pov/texture.hpp"

namespace celltrace::pov {

struct Session;

/// The words for kinds of cameras that are no words of something else.
std::vector<const char*> camera_kind_names();

/// Fields in any order, which finish() applies in a fixed one; or, in a scene of a version before 3.5, each
/// of them acts on what is there by then, and finish() has nothing left to do.
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
  double aperture = 0, blur_samples = 0; ///< there is focal blur if neither is 0
  Location aperture_where;
  Transform transform;
  UnsupportedPtr unsupported;
  Location where;

  UnsupportedPtr first_unsupported() const;
  /// Nothing if no ray of the camera has a direction: it sees the background alone. Throws InputError,
  /// without a position, if its angle is 180 degrees or more, or negative.
  std::optional<Camera> finish() const;
};

/// One that starts as another, or as the default, where the scene has got to.
std::shared_ptr<CameraDefinition> start_camera(Session& session, const CameraDefinition& from,
                                               const Location& where);

/// By its place in camera_kind_names().
void set_kind(CameraDefinition& camera, int name);
/// By a pattern's word, `spherical`.
void set_kind_by_pattern(Session& session, CameraDefinition& camera, int pattern, const Location& where);
/// By the name of a shape, its place in shape_names(), and the number behind it. Fails if there is none such.
void set_kind(Session& session, CameraDefinition& camera, int shape, double number, const Location& where);
/// A camera that is seen with the angle from left to right, and from bottom to top. Fails if it has no such.
void set_angles(Session& session, CameraDefinition& camera, double angle, double vertical_angle,
                const Location& where);
void set_angle(Session& session, CameraDefinition& camera, double angle, const Location& where);
/// Takes the word `angle` without a number, which Blender writes. Fails unless the camera is orthographic.
void set_no_angle(Session& session, CameraDefinition& camera, const Location& where);
void set_look_at(Session& session, CameraDefinition& camera, const Vec3& point, const Location& where);
void transform(CameraDefinition& camera, const Transform& next);
/// Of a complete camera, at `where`: warns of what makes it stand otherwise than meant, and fails if it looks
/// at its own location.
void check(Session& session, const CameraDefinition& camera, const Location& where);

} // namespace celltrace::pov

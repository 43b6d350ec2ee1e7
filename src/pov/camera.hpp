// The camera as written, and what it comes to.
#pragma once

#include <optional>

#include "celltrace/scene.hpp"
#include "pov/location.hpp"
#include "pov/texture.hpp"

namespace celltrace::pov {

/// Fields in any order; finish() applies them in the fixed one of that version of POV-Ray's language.
struct CameraDefinition {
  Camera::Kind kind = Camera::Kind::perspective;
  Vec3 location{0, 0, 0};
  Vec3 direction{0, 0, 1};
  Vec3 sky{0, 1, 0};
  std::optional<Vec3> right;
  std::optional<Vec3> up;
  std::optional<Vec3> look_at;
  std::optional<double> angle; ///< horizontal, in degrees
  Transform transform;
  UnsupportedPtr unsupported;
  Location where;

  /// Throws InputError, without a position, if the camera has no view: an angle of 180 degrees or more, no
  /// direction.
  Camera finish(double version) const;
};

} // namespace celltrace::pov

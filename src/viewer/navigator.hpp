// The camera of a viewer: how keys and the mouse move it.
#pragma once

#include "celltrace/scene.hpp"

#include <string>
#include <vector>

namespace celltrace::viewer {

/// A camera and where it came from. Steps are in parts of the scene's size, so that they suit any scene.
class Navigator {
public:
  enum class Mode {
    planar, ///< the camera moves in the plane that it stands on, and turns in its place
    radial  ///< it moves on a sphere around a point that it goes on looking at
  };

  /// `low` and `high`: corners of a box around the scene.
  Navigator(const Camera& camera, const Vec3& low, const Vec3& high);

  const Camera& camera() const { return camera_; }
  Mode mode() const { return mode_; }
  void set_mode(Mode mode);

  /// To the right, and forward: planar, so many steps in the plane; radial, so many steps to the right and up
  /// around the point.
  void go(double right, double forward);
  /// So many steps up; radial: away from the point.
  void rise(double steps);
  /// Turns to the right and up by degrees; radial: the scene is turned so.
  void turn(double right, double up);
  /// Above 1 things become larger: by a narrower view, and where a camera has none, or radial, from nearer.
  void zoom(double factor);
  /// To one of the views, which begin with the scene's own camera; all movement is forgotten.
  void look_from(std::size_t view);
  std::size_t view() const { return view_; }
  const std::vector<std::string>& views() const { return names_; }
  /// To the view as it was.
  void reset() { look_from(view_); }

private:
  Vec3 up() const;
  void orbit(double right, double up);
  void rotate(const Vec3& axis, double degrees, const Vec3& around);
  Camera camera_towards(const Vec3& direction, const Vec3& up) const;
  Vec3 point_looked_at() const;

  Camera camera_, own_;
  Vec3 low_, high_;
  double step_;
  Mode mode_ = Mode::planar;
  Vec3 pivot_{0, 0, 0};
  std::size_t view_ = 0;
  std::vector<std::string> names_;
};

} // namespace celltrace::viewer

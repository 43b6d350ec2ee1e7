// The camera of a viewer: how keys and the mouse move it.
#pragma once

#include "celltrace/scene.hpp"

#include <string>
#include <vector>

namespace celltrace::viewer {

/// A camera and where it came from. Steps are in parts of the scene's size, or of the distance of what is in
/// the middle if that is nearer, so that they suit any scene.
class Navigator {
public:
  enum class Mode {
    planar, ///< keys move the camera in the plane that it stands on
    radial  ///< they move it on a sphere around the point that it looks at
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
  /// Turns in its place, to the right and up by degrees.
  void turn(double right, double up);
  /// Goes to the right and up around the point that it looks at, by degrees, whatever the mode.
  void orbit(double right, double up);
  /// To the right, and forward in the plane, in steps, whatever the mode.
  void walk(double right, double forward);
  /// Whether the point that it goes around is one that it was told.
  bool knows_pivot() const { return knows_pivot_; }
  /// The point that it goes around is so far ahead in the middle of the picture.
  void set_pivot(double distance);
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
  void rotate(const Vec3& axis, double degrees, const Vec3& around);
  Camera camera_towards(const Vec3& direction, const Vec3& up) const;
  Vec3 point_looked_at() const;
  void forget_pivot();
  void keep_looking();

  Camera camera_, own_;
  Vec3 low_, high_;
  double size_; ///< of the scene
  double step_ = 1;
  Mode mode_ = Mode::planar;
  Vec3 pivot_{0, 0, 0};
  bool knows_pivot_ = false;
  std::size_t view_ = 0;
  std::vector<std::string> names_;
};

} // namespace celltrace::viewer

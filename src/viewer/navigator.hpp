// Moves the camera of a viewer by keys and the mouse.
#pragma once

#include "celltrace/scene.hpp"

#include <string>
#include <vector>

namespace celltrace::viewer {

/// A camera and its starting point. Steps are fractions of the scene's size, or of the distance to the object
/// in the middle if that is nearer, so that they suit any scene.
class Navigator {
public:
  enum class Mode {
    planar, ///< keys move the camera in the plane that it stands on
    radial  ///< keys move the camera on a sphere around the point that it looks at
  };

  /// `low` and `high`: corners of a box around the scene.
  Navigator(const Camera& camera, const Vec3& low, const Vec3& high);

  const Camera& camera() const { return camera_; }
  Mode mode() const { return mode_; }
  void set_mode(Mode mode);

  /// Moves by steps: in planar mode to the right and forward in the plane; in radial mode to the right and up
  /// around the point.
  void go(double right, double forward);
  /// Moves up by steps; in radial mode away from the point.
  void rise(double steps);
  /// Turns the camera in place, to the right and up by degrees.
  void turn(double right, double up);
  /// Orbits to the right and up around the point that the camera looks at, by degrees, in any mode.
  void orbit(double right, double up);
  /// Moves to the right and forward in the plane, by steps, in any mode.
  void walk(double right, double forward);
  /// Returns whether the point to orbit was set by set_pivot().
  bool has_pivot() const { return has_pivot_; }
  /// Sets the point to orbit, in the middle of the picture at this distance.
  void set_pivot(double distance);
  /// Zooms; a factor above 1 enlarges: by a narrower angle, or by moving closer if the camera has none or in
  /// radial mode.
  void zoom(double factor);
  /// Goes to one of the views, of which the first is the scene's own camera; all movement is forgotten.
  void show_view(std::size_t view);
  std::size_t view() const { return view_; }
  const std::vector<std::string>& views() const { return names_; }
  /// Goes back to the start of the present view.
  void reset() { show_view(view_); }

private:
  Vec3 up() const;
  void rotate(const Vec3& axis, double degrees, const Vec3& around);
  Camera camera_towards(const Vec3& direction, const Vec3& up) const;
  Vec3 view_centre() const;
  void forget_pivot();
  void recentre_pivot();

  Camera camera_, own_;
  Vec3 low_, high_;
  double size_; ///< size of the scene
  double step_ = 1;
  Mode mode_ = Mode::planar;
  Vec3 pivot_{0, 0, 0};
  bool has_pivot_ = false;
  std::size_t view_ = 0;
  std::vector<std::string> names_;
};

} // namespace celltrace::viewer

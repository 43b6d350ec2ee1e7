// The camera's location, for the code that prepares a scene for single precision.
#pragma once

#include "celltrace/scene.hpp"

#include <vector>

namespace celltrace {

/// Tells passes over a scene where the camera is, and remembers whether a pass has used that. If no pass has,
/// the scene image is valid for any location; otherwise the image is built anew when the camera moves. Passes
/// must read the location here, never from Scene::camera.
class Eye {
public:
  enum class Moves { no, yes };

  Eye() = default;
  /// `moves` tells whether frames from other locations may follow. If not, passes need not find out whether
  /// they depend on the location.
  explicit Eye(const Camera& camera, Moves moves = Moves::no)
      : location_(camera.location), start_(camera.location), may_move_(moves == Moves::yes) {}
  /// Makes an eye whose start() depends on the scene as well.
  Eye(const Camera& camera, const Scene& scene, Moves moves);

  /// Returns the location. The prepared scene depends on the location from then on.
  const Vec3& location() const noexcept {
    is_used_ = true;
    return location_;
  }
  /// Returns a point that is as far away as the origins of rays, on which the precision of rays depends: the
  /// location or, if it is so far away that rays start just before the scene, a nearer point. The prepared
  /// scene depends on this point from then on.
  const Vec3& start() const noexcept {
    is_used_ = true;
    return start_;
  }
  /// Returns start() for boundaries of CSG's solids. From then on these boundaries depend on it; they are
  /// updated separately when the camera moves.
  const Vec3& start_of_boundaries() const noexcept {
    has_boundaries_ = true;
    return start_;
  }
  bool may_move() const noexcept { return may_move_; }

  /// Returns whether the eye is near the surface of a sphere: within a 256th of the sphere's radius. If so,
  /// the prepared scene depends on the location; otherwise it is valid only for locations that are not near,
  /// either.
  bool is_near_surface(const Sphere& sphere, const Transform& transform) const;

  /// Returns whether the prepared scene is known to be the same for this location.
  bool prepares_alike(const Vec3& location) const {
    return location == location_ || (!has_boundaries_ && prepares_alike_but_boundaries(location));
  }
  /// Returns whether the prepared scene is known to be the same for this location except for boundaries.
  bool prepares_alike_but_boundaries(const Vec3& location) const;
  /// Moves the eye to a location for which the prepared scene is the same except for boundaries.
  void move_to(const Camera& camera, const Scene& scene);
  /// Returns whether there may be locations for which the prepared scene differs.
  bool matters() const noexcept {
    return !may_move_ || is_used_ || has_boundaries_ || !spheres_.empty() || !placed_spheres_.empty();
  }

private:
  struct PlacedSphere {
    Sphere sphere;
    Transform to_sphere;
  };

  Vec3 location_ = Vec3(0);
  Vec3 start_ = Vec3(0);
  bool may_move_ = false;
  // Mutable, because passes get a const Eye.
  mutable bool is_used_ = false;
  mutable bool has_boundaries_ = false;
  mutable std::vector<Sphere> spheres_; ///< spheres in the world that the eye is not near
  mutable std::vector<PlacedSphere> placed_spheres_;
};

} // namespace celltrace

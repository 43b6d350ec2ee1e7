// The camera's location, as what prepares a scene for single precision asks for it.
#pragma once

#include "celltrace/scene.hpp"

#include <vector>

namespace celltrace {

/// Tells passes over a scene where the camera is, and remembers whether one of them has asked. A scene image
/// for which nobody asked shows the same from everywhere; any other is made anew when the camera moves.
/// Passes read the location from here only, never from Scene::camera.
class Eye {
public:
  enum class Moves { no, yes };

  Eye() = default;
  /// `moves`: whether frames from other locations may follow. If not, passes need not find out whether they
  /// depend on it.
  explicit Eye(const Camera& camera, Moves moves = Moves::no)
      : location_(camera.location), start_(camera.location), may_move_(moves == Moves::yes) {}
  /// Where rays start depends on the scene, too.
  Eye(const Camera& camera, const Scene& scene, Moves moves);

  /// Returns the location; what is prepared depends on it from here on.
  const Vec3& location() const noexcept {
    is_asked_ = true;
    return location_;
  }
  /// Returns a place as far away as where rays start, which their precision depends on: the location, unless
  /// it is so far away that they start before the scene. What is prepared depends on it from here on.
  const Vec3& start() const noexcept {
    is_asked_ = true;
    return start_;
  }
  /// Returns start() for boundaries of CSG's solids. They alone depend on it from here on, and are moved by
  /// themselves when the camera does.
  const Vec3& start_of_boundaries() const noexcept {
    has_boundaries_ = true;
    return start_;
  }
  bool may_move() const noexcept { return may_move_; }

  /// Returns whether the eye is near the surface of a sphere for its size: within a 256th of its radius. If
  /// it is, the result depends on the location; if it is not, on that no later location is, either.
  bool is_near_surface(const Sphere& sphere, const Transform& transform) const;

  /// Returns whether what was prepared is known to be the same for this location.
  bool prepares_alike(const Vec3& location) const {
    return location == location_ || (!has_boundaries_ && prepares_alike_but_boundaries(location));
  }
  /// Returns whether it is known to be the same but for boundaries.
  bool prepares_alike_but_boundaries(const Vec3& location) const;
  /// Goes elsewhere; what was prepared is the same there but for boundaries.
  void move_to(const Camera& camera, const Scene& scene);
  /// Returns whether there may be locations for which it is not.
  bool matters() const noexcept {
    return !may_move_ || is_asked_ || has_boundaries_ || !spheres_.empty() || !placed_spheres_.empty();
  }

private:
  struct PlacedSphere {
    Sphere sphere;
    Transform to_sphere;
  };

  Vec3 location_ = Vec3(0);
  Vec3 start_ = Vec3(0);
  bool may_move_ = false;
  // Passes get the eye as one of their inputs.
  mutable bool is_asked_ = false;
  mutable bool has_boundaries_ = false;
  mutable std::vector<Sphere> spheres_; ///< that the eye is not near, in the world
  mutable std::vector<PlacedSphere> placed_spheres_;
};

} // namespace celltrace

// How the packets of a bundle see the scene whose rays all go through one point. Kernel dialect.
#pragma once

#include "kernel/accel/bundle_frusta.hpp"

namespace celltrace::kernel {

/// Rays toward a light, about a point near where they begin: seen from the light itself, what lies near their
/// origins is rounded by more than the tolerance of shadows.
struct BundleMoments {
  float base[3], light[3];
  float span;                 ///< the origins are not farther from the base
  VectorLanes of[kSimdLanes]; ///< each packet's cross products of origins, from the base, and directions
};

/// A projective map of the scene, for rays that all go through one point: in it, a ray has everywhere the
/// same first two coordinates, in proportion to the third. Those of a packet's rays lie in a rectangle.
///
/// The third axis of the map is the one along which the rays are longest, the major one. Seen from the point
/// itself, distances to it are the third coordinate. If it is far away, the map is made around a point near
/// the bundle, in whose plane the first two coordinates are exact, and little depends on where the far one
/// is.
template <class S> struct BundleView {
  using F = typename S::F;

  float origin[3];
  uint32_t axes[3];                 ///< of the scene, the major one last
  float forth;                      ///< -1 or 1: which way along the major axis
  float slope[2] = {0, 0};          ///< by which the first two axes lean along the major one
  float third = 1.0f, ahead = 0.0f; ///< the third coordinate: of a step along the major axis, of the origin
  LaneInterval<S> seen[2];          ///< the rectangles, where the third coordinate is 1
  float span = 0.0f;                ///< rays begin that far from the origin, at most
  const BundleMoments* moments = nullptr; ///< by which rays to a light are tested; no others have them

  void set_major(uint32_t axis) {
    axes[0] = axis == 0 ? 1 : 0;
    axes[1] = axis == 2 ? 1 : 2;
    axes[2] = axis;
  }

  /// A difference of points.
  V3<S> mapped(const V3<S>& v) const {
    const F* const components[3] = {&v.x, &v.y, &v.z};
    const F along = *components[axes[2]] * F(forth);
    return {*components[axes[0]] - along * F(slope[0]), *components[axes[1]] - along * F(slope[1]),
            along * F(third)};
  }
  /// From points to the origin.
  V3<S> to_origin(const V3<S>& points) const {
    V3<S> v = mapped(splat3<S>(origin) - points);
    v.z = v.z - F(ahead);
    return v;
  }
  /// A direction, where the map is that from a point itself.
  V3<S> mapped(const VectorLanes& v) const {
    return {F::load(v[axes[0]].lane), F::load(v[axes[1]].lane), F::load(v[axes[2]].lane) * F(forth)};
  }
};

/// Packets whose rays all go through one point into one octant.
template <class S> struct ViewBundle {
  BundleView<S> view;
  LaneRayBounds<S> bounds;
  RayBounds all; ///< around those
  uint32_t octant = 0;
  bool turned = false;  ///< they are the opposite of the rays'
  uint32_t packets = 0; ///< of others all else is meaningless
};

} // namespace celltrace::kernel

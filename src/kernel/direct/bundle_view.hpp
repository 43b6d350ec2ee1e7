// The view of a bundle whose rays all pass through one point: a pinhole, or a light. Kernel dialect.
#pragma once

#include "kernel/accel/bundle_frusta.hpp"

namespace celltrace::kernel {

/// Origins of shadow rays, relative to a base point near all of them: relative to the light, triangles near
/// these origins would be rounded by more than kShadowEpsilon.
struct ShadowOrigins {
  float base[3], light[3];
  float span;                     ///< an upper bound of the origins' distances from the base
  VectorLanes origin[kSimdLanes]; ///< by packet: origin - base
  /// By packet: the range on a ray in which objects occlude it, relative to the distance of the light.
  FloatLanes low[kSimdLanes], high[kSimdLanes];
};

/// A projective map of the scene for rays that all pass through one point, like a camera's map onto its image
/// plane. All points of a ray have the same ratio of the first two coordinates to the third, the depth. The
/// ratios of a packet's rays lie in a rectangle.
///
/// Depth runs along the major axis, on which the directions are longest. If the common point is near,
/// coordinates are relative to it. If it is far away, they would be rounded too much. The map is then made
/// around a point near the bundle: in the plane of depth through that point the first two coordinates are
/// exact, and the position of the common point has little influence.
template <class S> struct BundleView {
  using F = typename S::F;

  float origin[3];
  uint32_t axes[3];                              ///< axes of the scene, the major axis last
  float forth;                                   ///< -1 or 1: sign of the rays' directions on the major axis
  float slope[2] = {0, 0};                       ///< shear of the first two axes along the major axis
  float depth_scale = 1.0f, depth_offset = 0.0f; ///< depth = scale * length on the major axis - offset
  LaneInterval<S> seen[2];                       ///< the rectangles of the packets, at depth 1
  float span = 0.0f; ///< an upper bound of the distances from `origin` at which rays start
  const ShadowOrigins* shadows = nullptr; ///< for rays toward a light, otherwise null

  void set_major(uint32_t axis) {
    axes[0] = axis == 0 ? 1 : 0;
    axes[1] = axis == 2 ? 1 : 2;
    axes[2] = axis;
  }

  /// Maps a difference of points.
  V3<S> mapped(const V3<S>& v) const {
    const F* const components[3] = {&v.x, &v.y, &v.z};
    const F along = *components[axes[2]] * F(forth);
    return {*components[axes[0]] - along * F(slope[0]), *components[axes[1]] - along * F(slope[1]),
            along * F(depth_scale)};
  }
  /// Maps the vectors from points to the origin.
  V3<S> to_origin(const V3<S>& points) const {
    V3<S> v = mapped(splat3<S>(origin) - points);
    v.z = v.z - F(depth_offset);
    return v;
  }
};

/// Packets whose rays all pass through one point and have directions in one octant.
template <class S> struct ViewBundle {
  BundleView<S> view;
  LaneRayBounds<S> bounds;
  RayBounds all; ///< contains the bounds of all packets
  uint32_t octant = 0;
  bool turned = false;     ///< true if bounds and octant are those of reversed rays
  uint32_t packets = 0;    ///< packets of the bundle; members are undefined for other packets
  uint32_t incoherent = 0; ///< packets whose frusta hit many leaves that none of their rays hits
  float density = 0.0f;    ///< rays in a unit square at depth 1; 0: unknown
};

} // namespace celltrace::kernel

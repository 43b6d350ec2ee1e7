// Where rays cross the surface of a shape. Kernel dialect.
#pragma once

#include "kernel/math.hpp"
#include "kernel/packet.hpp"

#include <stdint.h>

namespace celltrace::kernel {

/// Hits nearer or farther than this are none, as in POV-Ray.
constexpr float kMinHitDistance = 1e-4f;
constexpr float kMaxHitDistance = 1e7f;
/// Epsilon at both ends of a shadow ray, which is POV-Ray's: closer crossings do not count, so that a surface
/// does not shadow itself.
constexpr float kShadowEpsilon = 1e-3f;

/// Two crossings of each ray of a packet with a surface, by distance along the ray. Distances of lanes
/// outside their mask are meaningless. Shapes with one crossing have `far_hit` empty; shapes with more fill
/// several.
template <class S> struct Crossings {
  typename S::F near, far;
  typename S::M near_hit, far_hit;
  typename S::F u, v; ///< of triangles: barycentric coordinates, the weights of the second and third vertex

  /// Makes it none. Field by field: masks that were just written stall processors that copy them as a part of
  /// something larger.
  void clear() {
    near = far = u = v = typename S::F(0.0f);
    near_hit = far_hit = S::M::none();
  }
};
/// In place of a distance, where all crossings of a ray are asked for.
constexpr float kEveryCrossing = 1e30f;
/// No shape has more pairs of crossings: a torus has four crossings.
constexpr uint32_t kMaxCrossingPairs = 2;

/// The rays that start on an object, of as many lanes as S has, from `first` on.
template <class S>
typename S::M lanes_that_start_on(const RayPacket& rays, uint32_t self, uint32_t first = 0) {
  using I = typename S::I;
  return I::load(reinterpret_cast<const int32_t*>(rays.start_object.lane + first)) ==
         I::splat(static_cast<int32_t>(self));
}

/// Merges the crossings with object `self` into the closest hits.
template <class S> void keep_closest(const Crossings<S>& c, uint32_t self, HitPacket& hits) {
  using F = typename S::F;
  using I = typename S::I;
  using M = typename S::M;
  const M near_valid = c.near_hit & (c.near > F(kMinHitDistance));
  const M far_valid = c.far_hit & (c.far > F(kMinHitDistance));
  const F distance = S::select(near_valid, c.near, c.far);
  const F nearest = F::load(hits.distance.lane);
  const M hit = near_valid | far_valid;
  const M not_farther = hit & (distance <= nearest);
  // Of two hits at the same distance that of the object with the lower offset counts: the result does not
  // depend on the order of the tests.
  auto* objects = reinterpret_cast<int32_t*>(hits.object.lane);
  const I present = I::load(objects);
  const I candidate = I::splat(static_cast<int32_t>(self));
  const M closer = not_farther & ((distance < nearest) | (candidate < present));
  S::select(closer, distance, nearest).store(hits.distance.lane);
  S::select(closer, c.u, F::load(hits.u.lane)).store(hits.u.lane);
  S::select(closer, c.v, F::load(hits.v.lane)).store(hits.v.lane);
  S::select(closer, candidate, present).store(objects);
}

/// A crossing of one ray, and the offset of the object.
struct SingleHit {
  float distance, u, v;
  uint32_t object;
};
/// As keep_closest(), of the ray in one lane.
[[gnu::always_inline]] inline void keep_closer(const SingleHit& hit, uint32_t lane, HitPacket& hits) {
  const float nearest = hits.distance.lane[lane];
  const auto present = static_cast<int32_t>(hits.object.lane[lane]);
  if (!(hit.distance < nearest || (hit.distance == nearest && static_cast<int32_t>(hit.object) < present)))
    return;
  hits.distance.lane[lane] = hit.distance;
  hits.u.lane[lane] = hit.u;
  hits.v.lane[lane] = hit.v;
  hits.object.lane[lane] = hit.object;
}

} // namespace celltrace::kernel

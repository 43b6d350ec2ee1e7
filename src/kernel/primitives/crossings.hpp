// Crossings of rays with the surface of a shape. Kernel dialect.
#pragma once

#include "kernel/math.hpp"
#include "kernel/packet.hpp"

#include <stdint.h>

namespace celltrace::kernel {

/// Distances of hits, as in POV-Ray: nearer or farther crossings do not count.
constexpr float kMinHitDistance = 1e-4f;
constexpr float kMaxHitDistance = 1e7f;
/// Epsilon at both ends of a shadow ray, as in POV-Ray: closer crossings do not count, so that a surface does
/// not shadow itself.
constexpr float kShadowEpsilon = 1e-3f;

/// Two crossings of each ray of a packet with a surface, by distance along the ray. Distances of lanes
/// outside their mask are meaningless. Shapes with one crossing have an empty `far_hit`; shapes with more
/// than two fill several pairs.
template <class S> struct Crossings {
  typename S::F near, far;
  typename S::M near_hit, far_hit;
  typename S::F u, v; ///< for triangles: barycentric coordinates, the weights of the second and third vertex

  /// Removes the crossings. Works member by member, as masks that were just written stall processors that
  /// copy them as a part of something larger.
  void clear() {
    near = far = u = v = typename S::F(0.0f);
    near_hit = far_hit = S::M::none();
  }
};
/// Limit in place of a distance if all crossings of a ray are wanted.
constexpr float kEveryCrossing = 1e30f;
/// Largest number of pairs of crossings that a shape fills: a torus has four crossings.
constexpr uint32_t kMaxCrossingPairs = 2;

/// Returns the rays that start on an object, for as many lanes as S has, beginning at lane `first`.
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
  // The hit of the object with the lower offset wins if two hits are at the same distance, so that the result
  // does not depend on the order of the tests.
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
/// Merges a crossing of the ray in one lane into its closest hit; see keep_closest().
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

// Rays against the bounds of BVH nodes: the rays of a packet against one node, and their frustum against four
// nodes at a time. The frustum is given by intervals that contain the origins and directions of its rays: a
// node that it misses is missed by every one of them (interval arithmetic: Boulos, Wald and Shirley, Geometric
// and arithmetic culling methods for entire ray packets, 2006). Kernel dialect.
#pragma once

#include "kernel/packet.hpp"
#include "kernel/scalar.hpp"

namespace celltrace::kernel {

/// Whether at most one bit is set.
inline bool is_single(uint32_t lanes) {
  return (lanes & (lanes - 1)) == 0;
}

namespace detail {

/// Directions closer to 0 than this count as this, with the same sign, so that 1 / direction is finite.
constexpr float kTinyDirection = 1e-12f;
/// Relative epsilon of the distance at which a node is left, which is rounded three times.
constexpr float kRoundedUp = 1.000001f;

} // namespace detail

/// Rays whose directions differ by more do not share a frustum. Measured on scenes with mirrors and glass.
constexpr float kMaxDirectionSpread = 1.0f;

/// The octant of a ray's direction: bit a is set if it is negative on axis a.
inline uint32_t octant_of(const RayPacket& rays, uint32_t lane) {
  return (rays.direction.x.lane[lane] < 0.0f ? 1u : 0u) | (rays.direction.y.lane[lane] < 0.0f ? 2u : 0u) |
         (rays.direction.z.lane[lane] < 0.0f ? 4u : 0u);
}

/// The slab test's order of planes: which rows of NodeRecord::bounds are the near and the far ones for rays of
/// an octant, axis by axis.
struct SlabOrder {
  explicit SlabOrder(uint32_t octant)
      : near{octant & 1, 2 + ((octant >> 1) & 1), 4 + ((octant >> 2) & 1)}, far{near[0] ^ 1, near[1] ^ 1,
                                                                                near[2] ^ 1} {}

  uint32_t near[3], far[3];
};

/// The rays of one octant, prepared for slab tests. Results of lanes of other octants are meaningless.
template <class S> class OctantRays {
public:
  using F = typename S::F;

  /// Undefined until set() has been called.
  OctantRays() = default;
  [[gnu::noinline]] void set(const RayPacket& rays, uint32_t octant) {
    origin_ = rays.origin.template load<S>();
    const V3<S> along = rays.direction.template load<S>();
    inverse_ = {inverse_of(along.x, (octant & 1) != 0), inverse_of(along.y, (octant & 2) != 0),
                inverse_of(along.z, (octant & 4) != 0)};
  }

  /// The lanes that hit the bounds of child `i`, each up to its `tfar`.
  uint32_t intersect(const float (&bounds)[6][4], const SlabOrder& sides, uint32_t i, const F& tfar) const {
    const auto near = [&](uint32_t axis) { return F(bounds[sides.near[axis]][i]); };
    const auto far = [&](uint32_t axis) { return F(bounds[sides.far[axis]][i]); };
    const F first = S::max(S::max((near(0) - origin_.x) * inverse_.x, (near(1) - origin_.y) * inverse_.y),
                           S::max((near(2) - origin_.z) * inverse_.z, F(0.0f)));
    const F last = S::min(S::min((far(0) - origin_.x) * inverse_.x, (far(1) - origin_.y) * inverse_.y),
                          S::min((far(2) - origin_.z) * inverse_.z, tfar));
    return (first <= last * F(detail::kRoundedUp)).bits();
  }

private:
  static F inverse_of(const F& direction, bool backward) {
    return F(1.0f) / (backward ? S::min(direction, F(-detail::kTinyDirection))
                               : S::max(direction, F(detail::kTinyDirection)));
  }

  V3<S> origin_, inverse_;
};

/// Intervals that contain the origins and directions of some rays, axis by axis.
struct RayBounds {
  Interval origin[3], direction[3];

  /// Whether all directions are of one octant.
  bool is_in(uint32_t octant) const {
    for (uint32_t axis = 0; axis < 3; ++axis)
      if (((octant >> axis) & 1) != 0 ? !(direction[axis].high < 0.0f) : !(direction[axis].low >= 0.0f))
        return false;
    return true;
  }
  /// Sum of the differences of directions on all axes.
  float direction_spread() const {
    float sum = 0.0f;
    for (const Interval& each : direction)
      sum += each.high - each.low;
    return sum;
  }
  void include(const RayBounds& other) {
    for (uint32_t axis = 0; axis < 3; ++axis) {
      origin[axis] = united(origin[axis], other.origin[axis]);
      direction[axis] = united(direction[axis], other.direction[axis]);
    }
  }
};

/// Of the rays in `lanes`, at least one.
template <class S> [[gnu::noinline]] RayBounds bounds_of(const RayPacket& rays, uint32_t lanes) {
  using F = typename S::F;
  const auto inside = S::M::from_bits(lanes);
  const uint32_t some = static_cast<uint32_t>(__builtin_ctz(lanes));
  const FloatLanes* origins[3] = {&rays.origin.x, &rays.origin.y, &rays.origin.z};
  const FloatLanes* directions[3] = {&rays.direction.x, &rays.direction.y, &rays.direction.z};
  // Lanes outside take the value of one inside.
  const auto interval = [&](const FloatLanes& values) {
    return interval_of<S>(S::select(inside, F::load(values.lane), F(values.lane[some])));
  };
  const auto as_some = [&](const FloatLanes& values) { return F::load(values.lane) == F(values.lane[some]); };
  // Primary rays have one origin.
  const auto from_there = as_some(rays.origin.x) & as_some(rays.origin.y) & as_some(rays.origin.z);
  const bool one_origin = (from_there.bits() & lanes) == lanes;
  RayBounds bounds;
  for (uint32_t axis = 0; axis < 3; ++axis) {
    const float origin = origins[axis]->lane[some];
    bounds.origin[axis] = one_origin ? Interval{origin, origin} : interval(*origins[axis]);
    bounds.direction[axis] = interval(*directions[axis]);
  }
  return bounds;
}

/// Of one ray.
inline RayBounds bounds_of_ray(const RayPacket& rays, uint32_t lane) {
  const FloatLanes* origins[3] = {&rays.origin.x, &rays.origin.y, &rays.origin.z};
  const FloatLanes* directions[3] = {&rays.direction.x, &rays.direction.y, &rays.direction.z};
  RayBounds bounds;
  for (uint32_t axis = 0; axis < 3; ++axis) {
    const float origin = origins[axis]->lane[lane], direction = directions[axis]->lane[lane];
    bounds.origin[axis] = {origin, origin};
    bounds.direction[axis] = {direction, direction};
  }
  return bounds;
}

/// The operands of the slab test for a frustum on one axis. The least distance to a near plane is that from the
/// nearest origin along the steepest ray, the greatest distance to a far plane that from the farthest origin
/// along the flattest ray. Distances to planes behind the origins are negative and otherwise meaningless.
struct Slab {
  float near_origin, near_inverse, far_origin, far_inverse;
};
inline Slab slab_of(const Interval& origin, const Interval& direction, bool backward) {
  using detail::kTinyDirection;
  if (backward)
    return {origin.low, 1.0f / smaller(direction.low, -kTinyDirection), origin.high,
            1.0f / smaller(direction.high, -kTinyDirection)};
  return {origin.high, 1.0f / larger(direction.high, kTinyDirection), origin.low,
          1.0f / larger(direction.low, kTinyDirection)};
}

template <class S> class Frustum {
public:
  using F4 = typename S::F4;

  /// Undefined until set() has been called.
  Frustum() = default;

  /// Rays of this octant.
  void set(const RayBounds& bounds, uint32_t octant) {
    for (uint32_t axis = 0; axis < 3; ++axis)
      set(axis, slab_of(bounds.origin[axis], bounds.direction[axis], ((octant >> axis) & 1) != 0));
  }
  void set(uint32_t axis, const Slab& slab) {
    near_origin_[axis] = F4::splat(slab.near_origin);
    near_inverse_[axis] = F4::splat(slab.near_inverse);
    far_origin_[axis] = F4::splat(slab.far_origin);
    far_inverse_[axis] = F4::splat(slab.far_inverse);
  }

  /// Which children of a node the frustum hits before `tfar`, bit i for child i. `enter` receives lower bounds
  /// of the distances to them.
  uint32_t intersect(const float (&bounds)[6][4], const SlabOrder& sides, float tfar, float (&enter)[4]) const {
    F4 first = F4::splat(0.0f);
    F4 last = F4::splat(tfar);
    for (uint32_t axis = 0; axis < 3; ++axis) {
      first = S::max(first, (F4::load(bounds[sides.near[axis]]) - near_origin_[axis]) * near_inverse_[axis]);
      last = S::min(last, (F4::load(bounds[sides.far[axis]]) - far_origin_[axis]) * far_inverse_[axis]);
    }
    first.store(enter);
    return not_above_bits(first, last * F4::splat(detail::kRoundedUp));
  }

private:
  F4 near_origin_[3], near_inverse_[3];
  F4 far_origin_[3], far_inverse_[3];
};

} // namespace celltrace::kernel

// Tests of rays against the bounds of BVH nodes: the rays of a packet against one node, and their frustum
// against four nodes at a time. A frustum is given by intervals that contain the origins and directions of
// its rays: a node that it misses is missed by each of its rays (interval arithmetic: Boulos, Wald and
// Shirley, Geometric and arithmetic culling methods for entire ray packets, 2006). Kernel dialect.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/packet.hpp"
#include "kernel/scalar.hpp"

namespace celltrace::kernel {

/// Returns true if at most one bit is set.
inline bool is_single(uint32_t lanes) {
  return (lanes & (lanes - 1)) == 0;
}

namespace detail {

/// Least absolute value of a direction's components. Smaller components are set to this value, with the same
/// sign, so that 1 / direction stays finite.
constexpr float kTinyDirection = 1e-12f;
/// Relative epsilon of the distance to a node's far plane, as a factor. The distance is rounded three times,
/// and a ray that only grazes the node must not miss it.
constexpr float kRoundedUp = 1.000001f;

} // namespace detail

/// Returns the octant of a ray's direction: bit a is set if the direction is negative on axis a.
inline uint32_t octant_of(const RayPacket& rays, uint32_t lane) {
  return (rays.direction.x.lane[lane] < 0.0f ? 1u : 0u) | (rays.direction.y.lane[lane] < 0.0f ? 2u : 0u) |
         (rays.direction.z.lane[lane] < 0.0f ? 4u : 0u);
}

/// Returns the lanes whose directions are in an octant.
template <class S>
[[gnu::always_inline]] inline uint32_t lanes_in_octant(const RayPacket& rays, uint32_t octant) {
  const typename S::F zero(0.0f);
  const V3<S> direction = rays.direction.template load<S>();
  const uint32_t x = (direction.x < zero).bits(), y = (direction.y < zero).bits(),
                 z = (direction.z < zero).bits();
  const auto same = [](uint32_t negative, uint32_t wanted) { return wanted != 0 ? negative : ~negative; };
  return same(x, octant & 1) & same(y, octant & 2) & same(z, octant & 4);
}

/// The order of planes in the slab test: the rows of NodeRecord::bounds with the near and the far planes for
/// rays of an octant, for each axis.
struct SlabOrder {
  explicit SlabOrder(uint32_t octant)
      : near{octant & 1, 2 + ((octant >> 1) & 1), 4 + ((octant >> 2) & 1)}, far{near[0] ^ 1, near[1] ^ 1,
                                                                                near[2] ^ 1} {}

  uint32_t near[3], far[3];
};

/// The rays of one octant, prepared for slab tests. Results for lanes in other octants are undefined.
template <class S> class OctantRays {
public:
  using F = typename S::F;

  /// Leaves the rays undefined until set() is called.
  OctantRays() = default;
  CELLTRACE_ONE_COPY void set(const RayPacket& rays, uint32_t octant) {
    origin_ = rays.origin.template load<S>();
    const V3<S> direction = rays.direction.template load<S>();
    inverse_ = {inverse_of(direction.x, (octant & 1) != 0), inverse_of(direction.y, (octant & 2) != 0),
                inverse_of(direction.z, (octant & 4) != 0)};
  }

  /// Returns the lanes that hit the bounds of child `i`, each from `tnear` up to its own `tfar`.
  uint32_t intersect(const float (&bounds)[6][4], const SlabOrder& order, uint32_t i, const F& tfar,
                     float tnear = 0.0f) const {
    const auto near = [&](uint32_t axis) { return F(bounds[order.near[axis]][i]); };
    const auto far = [&](uint32_t axis) { return F(bounds[order.far[axis]][i]); };
    const F t_enter = S::max(S::max((near(0) - origin_.x) * inverse_.x, (near(1) - origin_.y) * inverse_.y),
                             S::max((near(2) - origin_.z) * inverse_.z, F(tnear)));
    const F t_exit = S::min(S::min((far(0) - origin_.x) * inverse_.x, (far(1) - origin_.y) * inverse_.y),
                            S::min((far(2) - origin_.z) * inverse_.z, tfar));
    return (t_enter <= t_exit * F(detail::kRoundedUp)).bits();
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

  /// Returns true if all directions are in one octant.
  bool is_in(uint32_t octant) const {
    for (uint32_t axis = 0; axis < 3; ++axis)
      if (((octant >> axis) & 1) != 0 ? !(direction[axis].high < 0.0f) : !(direction[axis].low >= 0.0f))
        return false;
    return true;
  }
  /// Returns the sum of the differences of directions over all axes.
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

/// Returns the bounds of the rays in `lanes`, which must not be empty.
template <class S> CELLTRACE_ONE_COPY RayBounds bounds_of(const RayPacket& rays, uint32_t lanes) {
  using F = typename S::F;
  const auto active = S::M::from_bits(lanes);
  const uint32_t active_lane = static_cast<uint32_t>(__builtin_ctz(lanes));
  const FloatLanes* origins[3] = {&rays.origin.x, &rays.origin.y, &rays.origin.z};
  const FloatLanes* directions[3] = {&rays.direction.x, &rays.direction.y, &rays.direction.z};
  // Inactive lanes take the value of an active lane, so that they do not widen the interval.
  const auto interval = [&](const FloatLanes& values) {
    return interval_of<S>(S::select(active, F::load(values.lane), F(values.lane[active_lane])));
  };
  const auto is_same = [&](const FloatLanes& values) {
    return F::load(values.lane) == F(values.lane[active_lane]);
  };
  // Primary rays have a common origin, which saves three reductions.
  const auto same_origin = is_same(rays.origin.x) & is_same(rays.origin.y) & is_same(rays.origin.z);
  const bool common_origin = (same_origin.bits() & lanes) == lanes;
  RayBounds bounds;
  for (uint32_t axis = 0; axis < 3; ++axis) {
    const float origin = origins[axis]->lane[active_lane];
    bounds.origin[axis] = common_origin ? Interval{origin, origin} : interval(*origins[axis]);
    bounds.direction[axis] = interval(*directions[axis]);
  }
  return bounds;
}

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

/// Operands of the slab test for a frustum on one axis. The least distance to a near plane is measured from
/// the nearest origin along the steepest ray, the greatest distance to a far plane from the farthest origin
/// along the flattest ray. The size of a negative distance, to a plane behind the origins, does not matter:
/// for near planes it is clamped to 0, and for far planes it is a miss.
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

/// A conservative bound of some rays of one octant, for slab tests against four nodes at a time.
template <class S> class Frustum {
public:
  using F4 = typename S::F4;

  /// Leaves the frustum undefined until set() is called.
  Frustum() = default;

  /// Sets the bounds to those of rays in one octant.
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

  /// Returns the children of a node that the frustum hits from `tnear` up to `tfar`, bit i for child i.
  /// `enter` receives lower bounds of the distances to these children.
  uint32_t intersect(const float (&bounds)[6][4], const SlabOrder& order, float tfar, float (&enter)[4],
                     float tnear = 0.0f) const {
    F4 t_enter = F4::splat(tnear);
    F4 t_exit = F4::splat(tfar);
    for (uint32_t axis = 0; axis < 3; ++axis) {
      t_enter =
          S::max(t_enter, (F4::load(bounds[order.near[axis]]) - near_origin_[axis]) * near_inverse_[axis]);
      t_exit = S::min(t_exit, (F4::load(bounds[order.far[axis]]) - far_origin_[axis]) * far_inverse_[axis]);
    }
    t_enter.store(enter);
    return not_above_bits(t_enter, t_exit * F4::splat(detail::kRoundedUp));
  }

private:
  F4 near_origin_[3], near_inverse_[3];
  F4 far_origin_[3], far_inverse_[3];
};

} // namespace celltrace::kernel

// Rays of a packet against boxes, and some of them taken together as a beam: intervals that hold all their
// origins and directions, tested against four boxes at a time. What the beam misses, every one of its rays
// misses. Kernel dialect.
#pragma once

#include "kernel/packet.hpp"
#include "kernel/scalar.hpp"

namespace celltrace::kernel {

namespace detail {

/// 1 / direction where that is almost 0 is that of this, with the same sign.
constexpr float kTinyDirection = 1e-12f;
/// Distances to planes are rounded three times.
constexpr float kRoundedUp = 1.000001f;

} // namespace detail

/// The octant of a ray's direction: bit a is set if it is negative on axis a.
inline uint32_t octant_of(const RayPacket& rays, uint32_t lane) {
  return (rays.direction.x.lane[lane] < 0.0f ? 1u : 0u) | (rays.direction.y.lane[lane] < 0.0f ? 2u : 0u) |
         (rays.direction.z.lane[lane] < 0.0f ? 4u : 0u);
}

/// Rows of NodeRecord::box that rays of an octant enter and leave by, axis by axis.
struct BoxSides {
  explicit BoxSides(uint32_t octant)
      : near{octant & 1, 2 + ((octant >> 1) & 1), 4 + ((octant >> 2) & 1)}, far{near[0] ^ 1, near[1] ^ 1,
                                                                                near[2] ^ 1} {}

  uint32_t near[3], far[3];
};

/// The rays of one octant as boxes need them. What is said of lanes of other octants is meaningless.
template <class S> class OctantRays {
public:
  using F = typename S::F;

  OctantRays(const RayPacket& rays, uint32_t octant) : origin_(rays.origin.template load<S>()) {
    const V3<S> along = rays.direction.template load<S>();
    inverse_ = {inverse_of(along.x, (octant & 1) != 0), inverse_of(along.y, (octant & 2) != 0),
                inverse_of(along.z, (octant & 4) != 0)};
  }

  /// Which lanes meet box `i` of the four, each up to its `limit`.
  uint32_t meet(const float (&box)[6][4], const BoxSides& sides, uint32_t i, const F& limit) const {
    const auto near = [&](uint32_t axis) { return F(box[sides.near[axis]][i]); };
    const auto far = [&](uint32_t axis) { return F(box[sides.far[axis]][i]); };
    const F first = S::max(S::max((near(0) - origin_.x) * inverse_.x, (near(1) - origin_.y) * inverse_.y),
                           S::max((near(2) - origin_.z) * inverse_.z, F(0.0f)));
    const F last = S::min(S::min((far(0) - origin_.x) * inverse_.x, (far(1) - origin_.y) * inverse_.y),
                          S::min((far(2) - origin_.z) * inverse_.z, limit));
    return (first <= last * F(detail::kRoundedUp)).bits();
  }

private:
  static F inverse_of(const F& direction, bool backward) {
    return F(1.0f) / (backward ? S::min(direction, F(-detail::kTinyDirection))
                               : S::max(direction, F(detail::kTinyDirection)));
  }

  V3<S> origin_, inverse_;
};

template <class S> class Beam {
public:
  using F = typename S::F;
  using F4 = typename S::F4;

  /// Meets nothing sensible until it is set.
  Beam() = default;

  /// The rays in `lanes`, at least one, all of this octant.
  void set(const RayPacket& rays, uint32_t lanes, uint32_t octant) {
    const auto inside = S::M::from_bits(lanes);
    const uint32_t some = static_cast<uint32_t>(__builtin_ctz(lanes));
    const FloatLanes* origins[3] = {&rays.origin.x, &rays.origin.y, &rays.origin.z};
    const FloatLanes* directions[3] = {&rays.direction.x, &rays.direction.y, &rays.direction.z};
    // Lanes outside take the value of one inside.
    const auto interval = [&](const FloatLanes& values) {
      return interval_of<S>(S::select(inside, F::load(values.lane), F(values.lane[some])));
    };
    const auto as_some = [&](const FloatLanes& values) {
      return F::load(values.lane) == F(values.lane[some]);
    };
    // Primary rays have one origin.
    const auto from_there = as_some(rays.origin.x) & as_some(rays.origin.y) & as_some(rays.origin.z);
    const bool one_origin = (from_there.bits() & lanes) == lanes;
    direction_spread_ = 0.0f;
    for (uint32_t axis = 0; axis < 3; ++axis) {
      const Interval direction = interval(*directions[axis]);
      direction_spread_ += direction.high - direction.low;
      const float origin = origins[axis]->lane[some];
      set_axis(axis, one_origin ? Interval{origin, origin} : interval(*origins[axis]), direction,
               ((octant >> axis) & 1) != 0);
    }
  }

  /// One ray alone.
  void set(const RayPacket& rays, uint32_t lane) {
    const uint32_t octant = octant_of(rays, lane);
    const FloatLanes* origins[3] = {&rays.origin.x, &rays.origin.y, &rays.origin.z};
    const FloatLanes* directions[3] = {&rays.direction.x, &rays.direction.y, &rays.direction.z};
    direction_spread_ = 0.0f;
    for (uint32_t axis = 0; axis < 3; ++axis) {
      const float origin = origins[axis]->lane[lane], direction = directions[axis]->lane[lane];
      set_axis(axis, {origin, origin}, {direction, direction}, ((octant >> axis) & 1) != 0);
    }
  }

  /// Sum of the differences of directions on all axes.
  float direction_spread() const { return direction_spread_; }

  /// Which of four boxes (as in NodeRecord) the beam may meet between its origins and `limit` along it; bit i
  /// for box i. `enter` gets a lower bound of the distance at which it does.
  uint32_t meets(const float (&box)[6][4], const BoxSides& sides, float limit, float (&enter)[4]) const {
    F4 first = F4::splat(0.0f);
    F4 last = F4::splat(limit);
    for (uint32_t axis = 0; axis < 3; ++axis) {
      const F4 near = F4::load(box[sides.near[axis]]) - near_origin_[axis];
      const F4 far = F4::load(box[sides.far[axis]]) - far_origin_[axis];
      first = S::max(first, S::min(near * inverse_low_[axis], near * inverse_high_[axis]));
      last = S::min(last, S::max(far * inverse_low_[axis], far * inverse_high_[axis]));
    }
    first.store(enter);
    return not_above_bits(first, last * F4::splat(detail::kRoundedUp));
  }

private:
  void set_axis(uint32_t axis, const Interval& origin, const Interval& direction, bool backward) {
    constexpr float kTiny = detail::kTinyDirection;
    // 1 / direction falls from the low end to the high one.
    const float low = backward ? smaller(direction.low, -kTiny) : larger(direction.low, kTiny);
    const float high = backward ? smaller(direction.high, -kTiny) : larger(direction.high, kTiny);
    inverse_low_[axis] = F4::splat(1.0f / high);
    inverse_high_[axis] = F4::splat(1.0f / low);
    near_origin_[axis] = F4::splat(backward ? origin.low : origin.high);
    far_origin_[axis] = F4::splat(backward ? origin.high : origin.low);
  }

  F4 inverse_low_[3], inverse_high_[3];
  F4 near_origin_[3], far_origin_[3];
  float direction_spread_;
};

} // namespace celltrace::kernel

// Some rays of a packet taken together: intervals that hold all their origins and directions, tested against
// four boxes at a time. What the beam misses, every one of its rays misses. Kernel dialect.
#pragma once

#include "kernel/packet.hpp"
#include "kernel/scalar.hpp"

namespace celltrace::kernel {

template <class S> class Beam {
public:
  using F = typename S::F;
  using F4 = typename S::F4;

  /// The rays in `lanes`, at least one, whose directions have the same signs (octant_of()).
  Beam(const RayPacket& rays, uint32_t lanes, uint32_t octant) : origin_(rays.origin.template load<S>()) {
    const V3<S> along = rays.direction.template load<S>();
    inverse_ = {inverse_of(along.x, (octant & 1) != 0), inverse_of(along.y, (octant & 2) != 0),
                inverse_of(along.z, (octant & 4) != 0)};
    const F* origins[3] = {&origin_.x, &origin_.y, &origin_.z};
    const F* directions[3] = {&along.x, &along.y, &along.z};
    const auto inside = S::M::from_bits(lanes);
    const uint32_t some = static_cast<uint32_t>(__builtin_ctz(lanes));
    const float origin_of_some[3] = {rays.origin.x.lane[some], rays.origin.y.lane[some],
                                     rays.origin.z.lane[some]};
    const float direction_of_some[3] = {rays.direction.x.lane[some], rays.direction.y.lane[some],
                                        rays.direction.z.lane[some]};
    for (uint32_t axis = 0; axis < 3; ++axis) {
      const bool backward = ((octant >> axis) & 1) != 0;
      // Lanes outside take the value of one inside.
      const Interval origin = interval_of<S>(S::select(inside, *origins[axis], F(origin_of_some[axis])));
      const Interval direction =
          interval_of<S>(S::select(inside, *directions[axis], F(direction_of_some[axis])));
      origin_spread_ = larger(origin_spread_, origin.high - origin.low);
      direction_spread_ += direction.high - direction.low;
      // 1 / direction falls from the low end to the high one. A direction of almost 0 keeps its sign.
      const float low = backward ? smaller(direction.low, -kTiny) : larger(direction.low, kTiny);
      const float high = backward ? smaller(direction.high, -kTiny) : larger(direction.high, kTiny);
      inverse_low_[axis] = F4::splat(1.0f / high);
      inverse_high_[axis] = F4::splat(1.0f / low);
      near_origin_[axis] = F4::splat(backward ? origin.low : origin.high);
      far_origin_[axis] = F4::splat(backward ? origin.high : origin.low);
      near_plane_[axis] = 2 * axis + (backward ? 1 : 0);
    }
  }

  /// The octant of a ray's direction: bit a is set if it is negative on axis a.
  static uint32_t octant_of(const RayPacket& rays, uint32_t lane) {
    return (rays.direction.x.lane[lane] < 0.0f ? 1u : 0u) | (rays.direction.y.lane[lane] < 0.0f ? 2u : 0u) |
           (rays.direction.z.lane[lane] < 0.0f ? 4u : 0u);
  }

  /// Greatest difference of origins on an axis, and sum of the differences of directions on all.
  float origin_spread() const { return origin_spread_; }
  float direction_spread() const { return direction_spread_; }

  /// Which of four boxes (as in NodeRecord) the beam may meet between its origins and `limit` along it; bit i
  /// for box i. `enter` gets a lower bound of the distance at which it does.
  uint32_t meets(const float (&box)[6][4], float limit, float (&enter)[4]) const {
    F4 first = F4::splat(0.0f);
    F4 last = F4::splat(limit);
    for (uint32_t axis = 0; axis < 3; ++axis) {
      const F4 near = F4::load(box[near_plane_[axis]]) - near_origin_[axis];
      const F4 far = F4::load(box[near_plane_[axis] ^ 1]) - far_origin_[axis];
      first = S::max(first, S::min(near * inverse_low_[axis], near * inverse_high_[axis]));
      last = S::min(last, S::max(far * inverse_low_[axis], far * inverse_high_[axis]));
    }
    first.store(enter);
    return not_above_bits(first, last * F4::splat(kRoundedUp));
  }

  /// Which rays of the packet meet box `i` of the four up to their `limit`. Lanes of other octants are
  /// meaningless.
  uint32_t rays_that_meet(const float (&box)[6][4], uint32_t i, const F& limit) const {
    const auto near = [&](uint32_t axis) { return F(box[near_plane_[axis]][i]); };
    const auto far = [&](uint32_t axis) { return F(box[near_plane_[axis] ^ 1][i]); };
    const F first = S::max(S::max((near(0) - origin_.x) * inverse_.x, (near(1) - origin_.y) * inverse_.y),
                           S::max((near(2) - origin_.z) * inverse_.z, F(0.0f)));
    const F last = S::min(S::min((far(0) - origin_.x) * inverse_.x, (far(1) - origin_.y) * inverse_.y),
                          S::min((far(2) - origin_.z) * inverse_.z, limit));
    return (first <= last * F(kRoundedUp)).bits();
  }

private:
  static constexpr float kTiny = 1e-12f;
  /// Distances to planes are rounded three times.
  static constexpr float kRoundedUp = 1.000001f;

  static F inverse_of(const F& direction, bool backward) {
    return F(1.0f) / (backward ? S::min(direction, F(-kTiny)) : S::max(direction, F(kTiny)));
  }

  V3<S> origin_, inverse_;
  F4 inverse_low_[3], inverse_high_[3];
  F4 near_origin_[3], far_origin_[3];
  uint32_t near_plane_[3]; ///< row of NodeRecord::box that the beam meets first
  float origin_spread_ = 0.0f;
  float direction_spread_ = 0.0f;
};

} // namespace celltrace::kernel

// The frusta of a bundle's packets, one in each SIMD lane. Kernel dialect.
#pragma once

#include "kernel/accel/frustum.hpp"

namespace celltrace::kernel {

template <class S> struct LaneInterval {
  typename S::F low, high;

  static LaneInterval splat(const Interval& same) {
    return {typename S::F(same.low), typename S::F(same.high)};
  }
  /// Returns the interval that contains the intervals of all lanes.
  Interval all() const { return {interval_of<S>(low).low, interval_of<S>(high).high}; }
};

/// The RayBounds of one packet in each lane.
template <class S> struct LaneRayBounds { LaneInterval<S> origin[3], direction[3]; };

/// The vector type with a lane for each packet of a bundle: 4 on an SPE, 16 where memory is direct.
template <class S, uint32_t kPackets> struct BundleLanes;
template <class S> struct BundleLanes<S, 4> {
  using Type = typename S::F4;
  static Type splat(float value) { return Type::splat(value); }
  static uint32_t at_most(const Type& a, const Type& b) { return not_above_bits(a, b); }
  static float greatest_of(uint32_t packets, const float (&values)[4]) {
    float greatest = 0.0f;
    for_each_lane(packets, [&](uint32_t packet) { greatest = larger(greatest, values[packet]); });
    return greatest;
  }
};
template <class S> struct BundleLanes<S, 16> {
  using Type = typename S::F;
  static Type splat(float value) { return Type(value); }
  static uint32_t at_most(const Type& a, const Type& b) { return (a <= b).bits(); }
  static float greatest_of(uint32_t packets, const float (&values)[16]) {
    return interval_of<S>(S::select(S::M::from_bits(packets), Type::load(values), Type(0.0f))).high;
  }
};

/// The frusta of a bundle's packets, all of one octant.
template <class S, uint32_t kPackets> class BundleFrusta {
public:
  using Lanes = BundleLanes<S, kPackets>;
  using L = typename Lanes::Type;

  void set(uint32_t packet, const RayBounds& bounds, uint32_t octant) {
    for (uint32_t axis = 0; axis < 3; ++axis) {
      const Slab slab = slab_of(bounds.origin[axis], bounds.direction[axis], ((octant >> axis) & 1) != 0);
      Axis& a = axes_[axis];
      a.near_origin[packet] = slab.near_origin;
      a.near_inverse[packet] = slab.near_inverse;
      a.far_origin[packet] = slab.far_origin;
      a.far_inverse[packet] = slab.far_inverse;
    }
  }
  /// Sets the frusta of all packets at once.
  void set(const LaneRayBounds<S>& bounds, uint32_t octant) {
    for (uint32_t axis = 0; axis < 3; ++axis) {
      const bool backward = ((octant >> axis) & 1) != 0;
      const auto inverse_of = [&](const L& direction) {
        return L(1.0f) / (backward ? S::min(direction, L(-detail::kTinyDirection))
                                   : S::max(direction, L(detail::kTinyDirection)));
      };
      const LaneInterval<S>& origin = bounds.origin[axis];
      const LaneInterval<S>& direction = bounds.direction[axis];
      Axis& a = axes_[axis];
      (backward ? origin.low : origin.high).store(a.near_origin);
      inverse_of(backward ? direction.low : direction.high).store(a.near_inverse);
      (backward ? origin.high : origin.low).store(a.far_origin);
      inverse_of(backward ? direction.high : direction.low).store(a.far_inverse);
    }
  }

  /// Extracts the frustum of one packet.
  void get(uint32_t packet, Frustum<S>& frustum) const {
    for (uint32_t axis = 0; axis < 3; ++axis) {
      const Axis& a = axes_[axis];
      frustum.set(
          axis, {a.near_origin[packet], a.near_inverse[packet], a.far_origin[packet], a.far_inverse[packet]});
    }
  }

  /// Returns the packets whose frusta hit the bounds of child `i`, each up to its own tfar.
  uint32_t intersect(const float (&bounds)[6][4], const SlabOrder& order, uint32_t i,
                     const float (&tfar)[kPackets]) const {
    L t_enter = Lanes::splat(0.0f);
    L t_exit = L::load(tfar);
    for (uint32_t axis = 0; axis < 3; ++axis) {
      const Axis& a = axes_[axis];
      const L near = Lanes::splat(bounds[order.near[axis]][i]),
              far = Lanes::splat(bounds[order.far[axis]][i]);
      t_enter = S::max(t_enter, (near - L::load(a.near_origin)) * L::load(a.near_inverse));
      t_exit = S::min(t_exit, (far - L::load(a.far_origin)) * L::load(a.far_inverse));
    }
    return Lanes::at_most(t_enter, t_exit * Lanes::splat(detail::kRoundedUp));
  }

private:
  struct alignas(64) Axis {
    float near_origin[kPackets], near_inverse[kPackets];
    float far_origin[kPackets], far_inverse[kPackets];
  };
  Axis axes_[3] = {};
};

} // namespace celltrace::kernel

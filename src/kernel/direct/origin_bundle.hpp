// Rays of a bundle that start at one point, wherever they go. Kernel dialect.
#pragma once

#include "kernel/direct/bundle_view.hpp"

namespace celltrace::kernel {

/// The coherent packets among those of a bundle: as PinholeBundle for rays that are not a camera's.
template <class S> class OriginBundle : public ViewBundle<S> {
public:
  using F = typename S::F;
  using ViewBundle<S>::view, ViewBundle<S>::bounds, ViewBundle<S>::all, ViewBundle<S>::octant,
      ViewBundle<S>::packets;

  F shortening; ///< of unit directions: none is longer on the major axis

  /// Each query has some lanes. No packets, if they do not start at one point or only one is coherent.
  OriginBundle(const RayQuery* queries, uint32_t count) {
    const RayPacket& rays = *queries[0].rays;
    const auto lane = static_cast<uint32_t>(__builtin_ctz(queries[0].lanes));
    for (uint32_t axis = 0; axis < 3; ++axis)
      view.origin[axis] = rays.origin[axis].lane[lane];
    if (!start_there(queries, count)) return;
    uint32_t major = 0;
    for (uint32_t axis = 1; axis < 3; ++axis)
      if (magnitude(rays.direction[axis].lane[lane]) > magnitude(rays.direction[major].lane[lane]))
        major = axis;
    view.set_major(major);
    octant = octant_of(rays, lane);
    view.forth = ((octant >> major) & 1) != 0 ? -1.0f : 1.0f;
    for (uint32_t packet = 0; packet < count; ++packet)
      include(queries[packet], packet);
    if (is_single(packets))
      packets = 0;
    else
      bound();
  }

private:
  static constexpr float kRelativeEpsilon = 1e-6f; ///< for the rounding of slopes

  bool start_there(const RayQuery* queries, uint32_t count) const {
    const V3<S> origin = splat3<S>(view.origin);
    for (uint32_t packet = 0; packet < count; ++packet) {
      const V3<S> start = queries[packet].rays->origin.template load<S>();
      const uint32_t same = ((start.x == origin.x) & (start.y == origin.y) & (start.z == origin.z)).bits();
      if ((queries[packet].lanes & ~same) != 0) return false;
    }
    return true;
  }

  /// Includes a packet if its rays are coherent with those before.
  void include(const RayQuery& query, uint32_t packet) {
    const auto active = S::M::from_bits(query.lanes);
    const auto any_lane = static_cast<uint32_t>(__builtin_ctz(query.lanes));
    // Other lanes take the value of an active one, so that they do not widen intervals.
    const auto along = [&](uint32_t axis) {
      const FloatLanes& all_lanes = query.rays->direction[axis];
      return S::select(active, F::load(all_lanes.lane), F(all_lanes.lane[any_lane]));
    };
    const F length = along(view.axes[2]) * F(view.forth);
    if ((length > F(1e-3f)).bits() != 0xFFFF) return; // otherwise slopes exceed 1000
    const F scale = F(1.0f) / length;
    Interval slopes[2], extents[2];
    for (uint32_t i = 0; i < 2; ++i) {
      const Interval exact = interval_of<S>(along(view.axes[i]) * scale);
      slopes[i] = {exact.low - kRelativeEpsilon * (1.0f + magnitude(exact.low)),
                   exact.high + kRelativeEpsilon * (1.0f + magnitude(exact.high))};
      const bool backward = ((octant >> view.axes[i]) & 1) != 0;
      if (backward ? !(slopes[i].high < 0.0f) : !(slopes[i].low >= 0.0f)) return;
      extents[i] = packets == 0 ? slopes[i] : united(slopes[i], slopes_[i]);
    }
    if (extents[0].high - extents[0].low + extents[1].high - extents[1].low > tuning::kMaxDirectionSpread)
      return;
    for (uint32_t i = 0; i < 2; ++i) {
      set_lane(slopes[i].low, packet, lows_[i]);
      set_lane(slopes[i].high, packet, highs_[i]);
      slopes_[i] = extents[i];
    }
    packets |= 1u << packet;
  }
  /// Sets a packet's lane. The first packet's value is also that of the lanes of packets that are not
  /// included.
  void set_lane(float value, uint32_t packet, FloatLanes& lanes) const {
    if (packets == 0) F(value).store(lanes.lane);
    lanes.lane[packet] = value;
  }

  void bound() {
    F square(1.0f);
    for (uint32_t i = 0; i < 3; ++i) {
      const uint32_t axis = view.axes[i];
      all.origin[axis] = {view.origin[axis], view.origin[axis]};
      bounds.origin[axis] = LaneInterval<S>::splat(all.origin[axis]);
      if (i == 2) {
        all.direction[axis] = {view.forth, view.forth};
        bounds.direction[axis] = LaneInterval<S>::splat(all.direction[axis]);
        continue;
      }
      view.seen[i] = {F::load(lows_[i].lane), F::load(highs_[i].lane)};
      bounds.direction[axis] = view.seen[i];
      all.direction[axis] = slopes_[i];
      const F least = ((octant >> axis) & 1) != 0 ? view.seen[i].high : view.seen[i].low;
      square = square + least * least;
    }
    shortening = F(1.000001f) / S::sqrt(square);
  }

  Interval slopes_[2];            ///< of all packets, on the two minor axes
  FloatLanes lows_[2], highs_[2]; ///< by packet
};

} // namespace celltrace::kernel

// The shadow rays of a bundle toward one light. Kernel dialect.
#pragma once

#include "kernel/direct/bundle_view.hpp"

namespace celltrace::kernel {

/// The coherent packets of a bundle. Rays toward a near light are reversed and start at the light, as primary
/// rays do at a pinhole. Rays toward a far light start at a plane below their origins, so that the distance
/// of the light does not cost precision.
template <class S> class LightBundle : public ViewBundle<S> {
public:
  using F = typename S::F;
  using ViewBundle<S>::view, ViewBundle<S>::bounds, ViewBundle<S>::all, ViewBundle<S>::octant,
      ViewBundle<S>::turned, ViewBundle<S>::packets, ViewBundle<S>::incoherent;

  F reach; ///< by packet: greatest length of its rays on the major axis

  /// Computes the bounds of the queries' rays. Each query has some lanes.
  LightBundle(const float (&light)[3], const RayQuery* queries, uint32_t count) : queries_(queries) {
    const RayPacket& rays = *queries[0].rays;
    const auto lane = static_cast<uint32_t>(__builtin_ctz(queries[0].lanes));
    uint32_t major = 0;
    for (uint32_t axis = 1; axis < 3; ++axis)
      if (longer(rays, axis, major, lane)) major = axis;
    view.set_major(major);
    octant = octant_of(rays, lane);
    major_sign_ = ((octant >> major) & 1) != 0 ? -1.0f : 1.0f;
    for (uint32_t packet = 0; packet < count; ++packet)
      include(packet);
    if (is_single(packets)) {
      packets = 0;
      return;
    }
    reach = F::load(reaches_.lane);
    if (2 * spread_count_ >= __builtin_popcount(packets))
      bound_near(light);
    else
      bound_far(light);
    set_origins(light);
    find_incoherent_origins();
  }

private:
  /// Epsilon for the rounding of slopes and positions, relative to their sizes.
  static constexpr float kRelativeEpsilon = 1e-6f;
  /// Difference of slopes below which packets are too narrow for coordinates relative to the light: rounding
  /// would blur their rectangles.
  static constexpr float kLeastSpread = 1e-3f;

  static bool longer(const RayPacket& rays, uint32_t axis, uint32_t than, uint32_t lane) {
    return magnitude(rays.direction[axis].lane[lane]) > magnitude(rays.direction[than].lane[lane]);
  }

  /// Reads the active lanes of a packet's vectors. Other lanes take the value of an active lane, so that they
  /// do not widen intervals.
  struct ActiveLanes {
    typename S::M lanes;
    uint32_t any_lane;

    explicit ActiveLanes(const RayQuery& query)
        : lanes(S::M::from_bits(query.lanes)), any_lane(static_cast<uint32_t>(__builtin_ctz(query.lanes))) {}
    F operator()(const VectorLanes& v, uint32_t axis) const {
      const FloatLanes& all = v[axis];
      return S::select(lanes, F::load(all.lane), F(all.lane[any_lane]));
    }
  };

  /// Includes a packet if its rays are coherent with those of the packets so far.
  void include(uint32_t packet) {
    const RayQuery& query = queries_[packet];
    const uint32_t* const axes = view.axes;
    const ActiveLanes active(query);
    const F length = active(query.rays->direction, axes[2]) * F(major_sign_);
    if ((length > F(1e-3f)).bits() != 0xFFFF) return; // otherwise slopes exceed 1000
    const F scale = F(1.0f) / length;
    Interval extents[2];
    float spread = 0.0f;
    for (uint32_t i = 0; i < 2; ++i) {
      Interval slopes = interval_of<S>(active(query.rays->direction, axes[i]) * scale);
      slopes = {slopes.low - kRelativeEpsilon, slopes.high + kRelativeEpsilon};
      const bool backward = ((octant >> axes[i]) & 1) != 0;
      if (backward ? !(slopes.high < 0.0f) : !(slopes.low >= 0.0f)) return;
      spread += slopes.high - slopes.low;
      set_lane(slopes.low, packet, lows_[i]);
      set_lane(slopes.high, packet, highs_[i]);
      extents[i] = packets == 0 ? slopes : united(slopes, slopes_[i]);
    }
    if (extents[0].high - extents[0].low + extents[1].high - extents[1].low > tuning::kMaxDirectionSpread)
      return;
    spread_count_ += spread >= kLeastSpread ? 1 : 0;
    slopes_[0] = extents[0];
    slopes_[1] = extents[1];
    const F lengths = S::select(active.lanes, F::load(query.distance->lane) * length, F(0.0f));
    const float longest = interval_of<S>(lengths).high;
    set_lane(longest, packet, reaches_);
    farthest_ = larger(farthest_, longest);
    packets |= 1u << packet;
  }

  /// Sets a packet's lane. The first packet's value is also stored in the lanes of packets that are not
  /// included.
  void set_lane(float value, uint32_t packet, FloatLanes& lanes) const {
    if (packets == 0) F(value).store(lanes.lane);
    lanes.lane[packet] = value;
  }

  /// Computes the bounds of reversed rays, which start at the light.
  void bound_near(const float (&light)[3]) {
    turned = true;
    octant ^= 7;
    view.forth = -major_sign_;
    view.span = 3.0f * farthest_;
    const float epsilon = kRelativeEpsilon * farthest_; // bounds the distance at which a ray passes the light
    for (uint32_t i = 0; i < 3; ++i) {
      const uint32_t axis = view.axes[i];
      view.origin[axis] = light[axis];
      all.origin[axis] = {light[axis] - epsilon, light[axis] + epsilon};
      bounds.origin[axis] = LaneInterval<S>::splat(all.origin[axis]);
      if (i == 2) {
        all.direction[axis] = {view.forth, view.forth};
        bounds.direction[axis] = LaneInterval<S>::splat(all.direction[axis]);
      } else {
        all.direction[axis] = {-slopes_[i].high, -slopes_[i].low};
        view.seen[i] = {-F::load(highs_[i].lane), -F::load(lows_[i].lane)};
        bounds.direction[axis] = view.seen[i];
      }
    }
  }

  /// Computes the bounds of rays where they cross a plane below their origins.
  void bound_far(const float (&light)[3]) {
    const uint32_t* const axes = view.axes;
    for (uint32_t axis = 0; axis < 3; ++axis)
      view.origin[axis] = some_origin(axis);
    view.forth = major_sign_;
    const float depth = (light[axes[2]] - view.origin[axes[2]]) * major_sign_;
    for (uint32_t i = 0; i < 2; ++i)
      view.slope[i] = (light[axes[i]] - view.origin[axes[i]]) / depth;
    // By packet: the places where its rays cross the plane through the view's origin, and the least height of
    // their origins above this plane.
    FloatLanes lowest;
    F(0.0f).store(lowest.lane);
    float extent = 0.0f;
    for_each_lane(packets, [&](uint32_t packet) {
      const RayQuery& query = queries_[packet];
      const VectorLanes &points = query.rays->origin, &directions = query.rays->direction;
      const ActiveLanes active(query);
      const F height = (active(points, axes[2]) - F(view.origin[axes[2]])) * F(major_sign_);
      const F steps = height / (active(directions, axes[2]) * F(major_sign_));
      for (uint32_t i = 0; i < 2; ++i) {
        const Interval crossed = interval_of<S>(active(points, axes[i]) - F(view.origin[axes[i]]) -
                                                active(directions, axes[i]) * steps);
        lows_[i].lane[packet] = crossed.low;
        highs_[i].lane[packet] = crossed.high;
        extent = larger(extent, larger(magnitude(crossed.low), magnitude(crossed.high)));
      }
      const Interval heights = interval_of<S>(height);
      lowest.lane[packet] = heights.low;
      reaches_.lane[packet] += heights.high - heights.low;
      extent = larger(extent, larger(magnitude(heights.low), magnitude(heights.high)));
    });
    reach = F::load(reaches_.lane);
    extent = larger(extent, kRelativeEpsilon * depth); // avoids 0
    // The offset is in proportion to the extent of the origins, so that all coordinates have similar
    // magnitudes.
    view.depth_offset = 64.0f * extent;
    view.depth_scale = -view.depth_offset / depth;
    const F scale(1.0f / view.depth_offset);
    const F epsilon(4.0f * kRelativeEpsilon * extent);
    const F begin = F::load(lowest.lane);
    for (uint32_t i = 0; i < 2; ++i) {
      const LaneInterval<S> extents = {F::load(lows_[i].lane) - epsilon, F::load(highs_[i].lane) + epsilon};
      view.seen[i] = {extents.low * scale, extents.high * scale};
      all.direction[axes[i]] = slopes_[i];
      bounds.direction[axes[i]] = LaneInterval<S>::splat(slopes_[i]);
      const F slow = F(slopes_[i].low) * begin, fast = F(slopes_[i].high) * begin;
      const F origin(view.origin[axes[i]]);
      bounds.origin[axes[i]] = {extents.low + S::min(slow, fast) + origin,
                                extents.high + S::max(slow, fast) + origin};
    }
    const F plane = begin * F(major_sign_) + F(view.origin[axes[2]]);
    bounds.origin[axes[2]] = {plane, plane};
    all.direction[axes[2]] = {major_sign_, major_sign_};
    bounds.direction[axes[2]] = LaneInterval<S>::splat(all.direction[axes[2]]);
    for (uint32_t axis = 0; axis < 3; ++axis)
      all.origin[axis] = bounds.origin[axis].all();
  }

  /// Sets the rays' origins relative to one of these.
  void set_origins(const float (&light)[3]) {
    for (uint32_t axis = 0; axis < 3; ++axis) {
      shadows_.light[axis] = light[axis];
      shadows_.base[axis] = some_origin(axis);
    }
    const V3<S> base = splat3<S>(shadows_.base), place = splat3<S>(light) - base;
    F span(0.0f);
    for_each_lane(packets, [&](uint32_t packet) {
      const RayQuery& query = queries_[packet];
      const ActiveLanes active(query);
      const VectorLanes& points = query.rays->origin;
      const V3<S> from = V3<S>{active(points, 0), active(points, 1), active(points, 2)} - base;
      span = S::max(span, absolute_sum<S>(from));
      shadows_.origin[packet].template store<S>(from);
      const V3<S> to_light = place - from;
      const F scale = F(1.0f) / S::sqrt(dot<S>(to_light, to_light));
      S::min(F(kShadowEpsilon) * scale, F(1.0f)).store(shadows_.low[packet].lane);
      ((F::load(query.distance->lane) - F(kShadowEpsilon)) * scale).store(shadows_.high[packet].lane);
    });
    shadows_.span = interval_of<S>(span).high;
    view.shadows = &shadows_;
  }
  /// Finds packets whose rectangles are much larger than their shares of the whole bundle's rectangle.
  void find_incoherent_origins() {
    F area(1.0f);
    float whole = 1.0f;
    for (uint32_t i = 0; i < 2; ++i) {
      area = area * (view.seen[i].high - view.seen[i].low);
      const Interval extent = view.seen[i].all();
      whole *= extent.high - extent.low;
    }
    const float share = whole / static_cast<float>(__builtin_popcount(packets));
    incoherent = (area > F(tuning::kIncoherentOrigins * share)).bits() & packets;
  }
  float some_origin(uint32_t axis) const {
    const RayQuery& first = queries_[__builtin_ctz(packets)];
    return first.rays->origin[axis].lane[__builtin_ctz(first.lanes)];
  }

  const RayQuery* queries_;                 ///< valid in the constructor only
  float major_sign_;                        ///< sign of directions on the major axis
  Interval slopes_[2];                      ///< range of all packets, on the two minor axes
  int spread_count_ = 0;                    ///< number of packets whose slopes differ by kLeastSpread or more
  float farthest_ = 0.0f;                   ///< maximum of `reach`
  FloatLanes lows_[2], highs_[2], reaches_; ///< by packet: rectangles; `reach`
  ShadowOrigins shadows_;
};

} // namespace celltrace::kernel

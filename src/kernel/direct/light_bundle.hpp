// Rays of a bundle on their way to a light. Kernel dialect.
#pragma once

#include "kernel/direct/bundle_view.hpp"

namespace celltrace::kernel {

/// Those packets of a bundle that have enough in common. Rays to a light that is near are turned around, and
/// leave it; to one that is far away, they leave a plane beneath the points they come from.
template <class S> class LightBundle : public ViewBundle<S> {
public:
  using F = typename S::F;
  using ViewBundle<S>::view, ViewBundle<S>::bounds, ViewBundle<S>::all, ViewBundle<S>::octant,
      ViewBundle<S>::turned, ViewBundle<S>::packets;

  F reach; ///< how far the rays of each packet go, at most, on the major axis

  /// Looks at the queries' `lanes`; each has some.
  LightBundle(const float (&light)[3], const RayQuery* queries, uint32_t count) : queries_(queries) {
    const RayPacket& rays = *queries[0].rays;
    const auto lane = static_cast<uint32_t>(__builtin_ctz(queries[0].lanes));
    uint32_t major = 0;
    for (uint32_t axis = 1; axis < 3; ++axis)
      if (longer(rays, axis, major, lane)) major = axis;
    view.set_major(major);
    octant = octant_of(rays, lane);
    way_ = ((octant >> major) & 1) != 0 ? -1.0f : 1.0f;
    for (uint32_t packet = 0; packet < count; ++packet)
      take(packet);
    if (is_single(packets)) {
      packets = 0;
      return;
    }
    reach = F::load(reaches_.lane);
    if (2 * wide_ >= __builtin_popcount(packets))
      see_from(light);
    else
      see_from_afar(light);
    take_moments(light);
  }

private:
  static constexpr float kRounding = 1e-6f;
  /// Packets whose slopes differ less are lost in the rounding of distances from the light.
  static constexpr float kLeastSpread = 1e-3f;

  static bool longer(const RayPacket& rays, uint32_t axis, uint32_t than, uint32_t lane) {
    return magnitude(rays.direction[axis].lane[lane]) > magnitude(rays.direction[than].lane[lane]);
  }

  /// What of a packet's vectors is in its lanes; lanes outside take the value of one inside.
  struct Inside {
    typename S::M lanes;
    uint32_t some;

    explicit Inside(const RayQuery& query)
        : lanes(S::M::from_bits(query.lanes)), some(static_cast<uint32_t>(__builtin_ctz(query.lanes))) {}
    F operator()(const VectorLanes& v, uint32_t axis) const {
      const FloatLanes& all = v[axis];
      return S::select(lanes, F::load(all.lane), F(all.lane[some]));
    }
  };

  /// Takes a packet along if its rays go the same way.
  void take(uint32_t packet) {
    const RayQuery& query = queries_[packet];
    const uint32_t* const axes = view.axes;
    const Inside inside(query);
    const F length = inside(query.rays->direction, axes[2]) * F(way_);
    if ((length > F(1e-3f)).bits() != 0xFFFF) return;
    const F scale = F(1.0f) / length;
    Interval across[2];
    float spread = 0.0f;
    for (uint32_t i = 0; i < 2; ++i) {
      Interval slopes = interval_of<S>(inside(query.rays->direction, axes[i]) * scale);
      slopes = {slopes.low - kRounding, slopes.high + kRounding};
      const bool backward = ((octant >> axes[i]) & 1) != 0;
      if (backward ? !(slopes.high < 0.0f) : !(slopes.low >= 0.0f)) return;
      spread += slopes.high - slopes.low;
      put(slopes.low, packet, lows_[i]);
      put(slopes.high, packet, highs_[i]);
      across[i] = packets == 0 ? slopes : united(slopes, across_[i]);
    }
    if (across[0].high - across[0].low + across[1].high - across[1].low > kMaxDirectionSpread) return;
    wide_ += spread >= kLeastSpread ? 1 : 0;
    across_[0] = across[0];
    across_[1] = across[1];
    const F lengths = S::select(inside.lanes, F::load(query.distance->lane) * length, F(0.0f));
    const float longest = interval_of<S>(lengths).high;
    put(longest, packet, reaches_);
    farthest_ = larger(farthest_, longest);
    packets |= 1u << packet;
  }

  /// The first packet's number also stands in the lanes of those that are left out.
  void put(float value, uint32_t packet, FloatLanes& lanes) const {
    if (packets == 0) F(value).store(lanes.lane);
    lanes.lane[packet] = value;
  }

  void see_from(const float (&light)[3]) {
    turned = true;
    octant ^= 7;
    view.forth = -way_;
    view.span = 3.0f * farthest_;
    const float off = kRounding * farthest_; // what a ray passes the light by
    for (uint32_t i = 0; i < 3; ++i) {
      const uint32_t axis = view.axes[i];
      view.origin[axis] = light[axis];
      all.origin[axis] = {light[axis] - off, light[axis] + off};
      bounds.origin[axis] = LaneInterval<S>::splat(all.origin[axis]);
      if (i == 2) {
        all.direction[axis] = {view.forth, view.forth};
        bounds.direction[axis] = LaneInterval<S>::splat(all.direction[axis]);
      } else {
        all.direction[axis] = {-across_[i].high, -across_[i].low};
        view.seen[i] = {-F::load(highs_[i].lane), -F::load(lows_[i].lane)};
        bounds.direction[axis] = view.seen[i];
      }
    }
  }

  void see_from_afar(const float (&light)[3]) {
    const uint32_t* const axes = view.axes;
    for (uint32_t axis = 0; axis < 3; ++axis)
      view.origin[axis] = some_origin(axis);
    view.forth = way_;
    const float depth = (light[axes[2]] - view.origin[axes[2]]) * way_;
    for (uint32_t i = 0; i < 2; ++i)
      view.slope[i] = (light[axes[i]] - view.origin[axes[i]]) / depth;
    // Where the rays of each packet cross the plane of the origin, and how far above it the lowest begins.
    FloatLanes lowest;
    F(0.0f).store(lowest.lane);
    float wide = 0.0f;
    for_each_lane(packets, [&](uint32_t packet) {
      const RayQuery& query = queries_[packet];
      const VectorLanes &points = query.rays->origin, &directions = query.rays->direction;
      const Inside inside(query);
      const F height = (inside(points, axes[2]) - F(view.origin[axes[2]])) * F(way_);
      const F steps = height / (inside(directions, axes[2]) * F(way_));
      for (uint32_t i = 0; i < 2; ++i) {
        const Interval crossed = interval_of<S>(inside(points, axes[i]) - F(view.origin[axes[i]]) -
                                                inside(directions, axes[i]) * steps);
        lows_[i].lane[packet] = crossed.low;
        highs_[i].lane[packet] = crossed.high;
        wide = larger(wide, larger(magnitude(crossed.low), magnitude(crossed.high)));
      }
      const Interval heights = interval_of<S>(height);
      lowest.lane[packet] = heights.low;
      reaches_.lane[packet] += heights.high - heights.low;
      wide = larger(wide, larger(magnitude(heights.low), magnitude(heights.high)));
    });
    reach = F::load(reaches_.lane);
    wide = larger(wide, kRounding * depth); // not 0
    // Of the size of what is seen, so that all coordinates are of a size.
    view.ahead = 64.0f * wide;
    view.third = -view.ahead / depth;
    const F scale(1.0f / view.ahead);
    const F off(4.0f * kRounding * wide);
    const F begin = F::load(lowest.lane);
    for (uint32_t i = 0; i < 2; ++i) {
      const LaneInterval<S> across = {F::load(lows_[i].lane) - off, F::load(highs_[i].lane) + off};
      view.seen[i] = {across.low * scale, across.high * scale};
      all.direction[axes[i]] = across_[i];
      bounds.direction[axes[i]] = LaneInterval<S>::splat(across_[i]);
      const F slow = F(across_[i].low) * begin, fast = F(across_[i].high) * begin;
      const F origin(view.origin[axes[i]]);
      bounds.origin[axes[i]] = {across.low + S::min(slow, fast) + origin,
                                across.high + S::max(slow, fast) + origin};
    }
    const F plane = begin * F(way_) + F(view.origin[axes[2]]);
    bounds.origin[axes[2]] = {plane, plane};
    all.direction[axes[2]] = {way_, way_};
    bounds.direction[axes[2]] = LaneInterval<S>::splat(all.direction[axes[2]]);
    for (uint32_t axis = 0; axis < 3; ++axis)
      all.origin[axis] = bounds.origin[axis].all();
  }

  void take_moments(const float (&light)[3]) {
    moments_.span = 0.0f;
    for (uint32_t axis = 0; axis < 3; ++axis) {
      moments_.light[axis] = light[axis];
      moments_.base[axis] = some_origin(axis);
    }
    const V3<S> base = splat3<S>(moments_.base);
    F span(0.0f);
    for_each_lane(packets, [&](uint32_t packet) {
      const RayQuery& query = queries_[packet];
      const Inside inside(query);
      const VectorLanes& points = query.rays->origin;
      const V3<S> from = V3<S>{inside(points, 0), inside(points, 1), inside(points, 2)} - base;
      span = S::max(span, absolute_sum<S>(from));
      moments_.of[packet].template store<S>(cross<S>(from, query.rays->direction.template load<S>()));
    });
    moments_.span = interval_of<S>(span).high;
    view.moments = &moments_;
  }
  float some_origin(uint32_t axis) const {
    const RayQuery& first = queries_[__builtin_ctz(packets)];
    return first.rays->origin[axis].lane[__builtin_ctz(first.lanes)];
  }

  const RayQuery* queries_; ///< until all is known
  float way_;
  Interval across_[2];                      ///< slopes of all of them
  int wide_ = 0;                            ///< packets whose slopes differ enough
  float farthest_ = 0.0f;                   ///< greatest of `reach`
  FloatLanes lows_[2], highs_[2], reaches_; ///< a lane for each packet
  BundleMoments moments_;
};

} // namespace celltrace::kernel

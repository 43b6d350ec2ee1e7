// Rays of a bundle that start at one point, with any directions. Kernel dialect.
#pragma once

#include "kernel/direct/bundle_view.hpp"

namespace celltrace::kernel {

/// The coherent packets of a bundle as in PinholeBundle, but for any rays that start at one point.
template <class S> class OriginBundle : public ViewBundle<S> {
public:
  using F = typename S::F;
  using ViewBundle<S>::view, ViewBundle<S>::bounds, ViewBundle<S>::all, ViewBundle<S>::octant,
      ViewBundle<S>::packets, ViewBundle<S>::density;

  F shortening; ///< largest length of unit directions on the major axis

  /// Computes the bounds of the queries' rays. No query may be without lanes; directions may have any length.
  /// The bundle has no packets if the rays do not start at one point or only one packet is coherent.
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
    include_coherent(find_slopes(queries, count));
    if (is_single(packets))
      packets = 0;
    else
      bound();
  }

private:
  static constexpr float kRelativeEpsilon = 1e-6f; ///< bound of the rounding error of slopes
  static constexpr float kMostSlope = 1e3f;
  static constexpr float kLeastArea = 1e-12f;

  bool start_there(const RayQuery* queries, uint32_t count) const {
    const V3<S> origin = splat3<S>(view.origin);
    for (uint32_t packet = 0; packet < count; ++packet) {
      const V3<S> start = queries[packet].rays->origin.template load<S>();
      const uint32_t same = ((start.x == origin.x) & (start.y == origin.y) & (start.z == origin.z)).bits();
      if ((queries[packet].lanes & ~same) != 0) return false;
    }
    return true;
  }

  /// Finds the slopes of all packets. Returns the packets whose slopes are finite and in the octant.
  uint32_t find_slopes(const RayQuery* queries, uint32_t count) {
    F slopes[2][kSimdLanes];
    uint32_t aside = 0; // packets with rays that are not along the major axis
    for (uint32_t packet = 0; packet < kSimdLanes; ++packet) {
      // Lanes without a packet get the slopes of the first packet.
      const RayQuery& query = queries[packet < count ? packet : 0];
      const auto active = S::M::from_bits(query.lanes);
      const auto any_lane = static_cast<uint32_t>(__builtin_ctz(query.lanes));
      // Inactive lanes take the value of an active lane, so that they do not widen intervals.
      const auto along = [&](uint32_t axis) {
        const FloatLanes& all_lanes = query.rays->direction[axis];
        return S::select(active, F::load(all_lanes.lane), F(all_lanes.lane[any_lane]));
      };
      const F length = along(view.axes[2]) * F(view.forth), shortest(1e-36f);
      aside |= static_cast<uint32_t>((length > shortest).bits() != 0xFFFF) << packet;
      const F scale = F(1.0f) / S::max(length, shortest);
      slopes[0][packet] = along(view.axes[0]) * scale;
      slopes[1][packet] = along(view.axes[1]) * scale;
    }
    uint32_t others = aside;
    for (uint32_t i = 0; i < 2; ++i) {
      find_extremes(slopes[i], lows_[i], highs_[i]);
      const F low = F::load(lows_[i].lane), high = F::load(highs_[i].lane), one(1.0f),
              epsilon(kRelativeEpsilon);
      const F least = low - epsilon * (one + S::abs(low)), most = high + epsilon * (one + S::abs(high));
      least.store(lows_[i].lane);
      most.store(highs_[i].lane);
      const bool backward = ((octant >> view.axes[i]) & 1) != 0;
      others |= ~(backward ? most < F(0.0f) : least >= F(0.0f)).bits();
      others |= (S::max(most, -least) > F(kMostSlope)).bits();
    }
    return ((1u << count) - 1) & ~others;
  }

  /// Finds the least and the greatest lane of each of sixteen packets. All packets are reduced at once,
  /// because in the reduction of one packet each step waits for the previous step.
  static void find_extremes(const F (&values)[kSimdLanes], FloatLanes& low, FloatLanes& high) {
    using F4 = typename S::F4;
    for (uint32_t first = 0; first < kSimdLanes; first += 4) {
      F a = values[first], b = values[first + 1], c = values[first + 2], d = values[first + 3];
      S::transpose_quads(a, b, c, d);
      // Lane 4q + i belongs to the packet `first` + i.
      FloatLanes lows, highs;
      S::min(S::min(a, b), S::min(c, d)).store(lows.lane);
      S::max(S::max(a, b), S::max(c, d)).store(highs.lane);
      const auto quad = [](const FloatLanes& lanes, uint32_t q) { return F4::load(lanes.lane + 4 * q); };
      S::min(S::min(quad(lows, 0), quad(lows, 1)), S::min(quad(lows, 2), quad(lows, 3)))
          .store(low.lane + first);
      S::max(S::max(quad(highs, 0), quad(highs, 1)), S::max(quad(highs, 2), quad(highs, 3)))
          .store(high.lane + first);
    }
  }

  /// Includes the packets that are coherent with the previous ones.
  void include_coherent(uint32_t candidates) {
    for_each_lane(candidates, [&](uint32_t packet) {
      Interval extents[2];
      float spread = 0.0f;
      for (uint32_t i = 0; i < 2; ++i) {
        const Interval own = {lows_[i].lane[packet], highs_[i].lane[packet]};
        extents[i] = packets == 0 ? own : united(own, slopes_[i]);
        spread += extents[i].high - extents[i].low;
      }
      if (spread > tuning::kMaxDirectionSpread) return;
      slopes_[0] = extents[0];
      slopes_[1] = extents[1];
      packets |= 1u << packet;
    });
    if (packets == 0) return;
    // Lanes of packets that are not included get the values of an included packet.
    const auto included = S::M::from_bits(packets);
    const auto any = static_cast<uint32_t>(__builtin_ctz(packets));
    for (uint32_t i = 0; i < 2; ++i) {
      S::select(included, F::load(lows_[i].lane), F(lows_[i].lane[any])).store(lows_[i].lane);
      S::select(included, F::load(highs_[i].lane), F(highs_[i].lane[any])).store(highs_[i].lane);
    }
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
    const float width = slopes_[0].high - slopes_[0].low, height = slopes_[1].high - slopes_[1].low;
    density = static_cast<float>(__builtin_popcount(packets) * kSimdLanes) / (width * height + kLeastArea);
  }

  Interval slopes_[2];            ///< range of all packets, on the two minor axes
  FloatLanes lows_[2], highs_[2]; ///< index: packet; bounds of its slopes
};

} // namespace celltrace::kernel

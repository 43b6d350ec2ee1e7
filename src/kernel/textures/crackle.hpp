// By the distances to the nearest of random points, of which there is one in each unit cell: cracks between
// stones (Worley 1996). Kernel dialect.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/direct/neighbours_of_lanes.hpp"
#include "kernel/packet.hpp"
#include "kernel/textures/features.hpp"
#include "kernel/textures/pattern_traits.hpp"

namespace celltrace::kernel {

/// Its parameters: the factors of the three shortest distances; the metric's number; and what the offset adds
/// to what distances are a root of.
struct CracklePattern : RarePattern {
  static constexpr const char* kName = "crackle";

  template <class Spu>
  [[gnu::always_inline]] static typename Spu::rare_simd::F
  value(SceneAccess<Spu>& scene, const V3<typename Spu::rare_simd>& p, const PatternRecord& r) {
    using S = typename Spu::rare_simd;
    using F = typename S::F;
    const uint32_t last = r.parameter[2] != 0.0f ? 2 : r.parameter[1] != 0.0f ? 1 : 0;
    const Nearest<S> nearest = nearest_of<Spu>(scene, p, r, {last, false});
    F sum(0.0f);
    for (uint32_t i = 0; i < 3; ++i)
      if (r.parameter[i] != 0.0f)
        sum = sum + distance<S>(nearest.power[i] + F(r.parameter[4]), r.parameter[3]) * F(r.parameter[i]);
    return S::min(S::max(sum, F(0.0f)), F(1.0f));
  }

  template <class S> struct Nearest {
    typename S::F power[3]; ///< of the three shortest distances, ascending
    V3<S> point;            ///< the nearest one
  };
  /// What is asked of the nearest points: the distances up to number `last`, and perhaps the nearest one.
  struct Wanted {
    uint32_t last;
    bool point;
  };
  template <class Spu>
  [[gnu::always_inline]] static Nearest<typename Spu::rare_simd>
  nearest_of(SceneAccess<Spu>& scene, const V3<typename Spu::rare_simd>& p, const PatternRecord& r,
             const Wanted& wanted) {
    using S = typename Spu::rare_simd;
    using F = typename S::F;
    const F far(kFar);
    Nearest<S> nearest = {{far, far, far}, p};
    Features<Spu> features(scene, features_of(r));
    const float metric = r.parameter[3];
    // The inner cells first: most of the others are then too far away.
    if constexpr (kHasRoomForCode<Spu>)
      if (take_inner_of_lanes(features, p, metric, wanted, nearest) &&
          reaches_no_further<S>(nearest.power[wanted.last], S::M::all()))
        return nearest;
    for_each_cell_of<S>(p, [&](uint32_t lanes, const uint32_t(&cell)[3], const V3<S>& from) {
      const auto here = S::M::from_bits(lanes);
      if constexpr (kHasRoomForCode<Spu>) {
        take_inner(features, cell, from, p, lanes, metric, wanted, nearest);
        if (reaches_no_further<S>(nearest.power[wanted.last], here)) return;
      }
      // What a cell's points are away at least, along an axis: where room for code is short, by the usual
      // metric alone.
      const auto across = [metric](const F& coordinate, int32_t steps) {
        const F width = gap<S>(coordinate, steps);
        if constexpr (!kHasRoomForCode<Spu>) return metric == 2.0f ? width * width : F(0.0f);
        return along<S>(width, metric);
      };
      const auto is_too_far = [&](const F& sum) {
        return (here & (sum < nearest.power[wanted.last])).bits() == 0;
      };
      for (int32_t reach = kHasRoomForCode<Spu> ? 2 : 1; reach <= 2; ++reach)
        for (int32_t x = -reach; x <= reach; ++x) {
          const F gap_x = across(from.x, x);
          const uint32_t plane = features.number_after(0, cell[0] + static_cast<uint32_t>(x));
          for (int32_t y = -reach; y <= reach; ++y) {
            const F gap_xy = gap_x + across(from.y, y);
            const bool is_outer = reach == 2 && (x < -1 || x > 1 || y < -1 || y > 1);
            if (reach == 2 && is_too_far(gap_xy)) continue;
            const uint32_t column = features.number_after(plane, cell[1] + static_cast<uint32_t>(y));
            const int32_t step = reach == 1 || is_outer ? 1 : 4;
            for (int32_t z = -reach; z <= reach; z += step) {
              if (reach == 2 && is_too_far(gap_xy + across(from.z, z))) continue;
              const FeatureRecord feature =
                  features.at(features.number_after(column, cell[2] + static_cast<uint32_t>(z)));
              const V3<S> d = {F(feature.place[0] + static_cast<float>(x)) - from.x,
                               F(feature.place[1] + static_cast<float>(y)) - from.y,
                               F(feature.place[2] + static_cast<float>(z)) - from.z};
              take<S>(S::select(here, power<S>(d, metric), far), d, p, nearest);
            }
          }
        }
    });
    return nearest;
  }

private:
  /// What a distance is a root of where no point is known.
  static constexpr float kFar = 1e30f;

  /// The points of the inner cells, for lanes that are all in one cell, unless they have been taken before.
  template <class Spu, class S>
  CELLTRACE_ONE_COPY static void take_inner(Features<Spu>& features, const uint32_t (&cell)[3],
                                            const V3<S>& from, const V3<S>& p, uint32_t lanes, float metric,
                                            const Wanted& wanted, Nearest<S>& nearest) {
    using F = typename S::F;
    if ((S::M::from_bits(lanes) & (nearest.power[0] < F(kFar))).bits() != 0) return;
    FeatureNeighbours<S> room;
    const FeatureNeighbours<S>& neighbours = features.neighbours_of(cell, room);
    if (__builtin_popcount(lanes) > tuning::kMostLanesByFeatures) {
      const auto here = S::M::from_bits(lanes);
      const auto take_all = [&](float of_metric) __attribute__((always_inline)) {
        Nearest<S> found = nearest;
        for (uint32_t i = 0; i < FeatureNeighbours<S>::kCount; ++i) {
          const V3<S> d = neighbours.way_to(i, from);
          take<S>(S::select(here, power<S>(d, of_metric), F(kFar)), d, p, found);
        }
        return found;
      };
      if (metric == 2.0f && wanted.last <= 1 && !wanted.point) {
        // What is not taken over, compilers do not compute.
        const Nearest<S> found = take_all(2.0f);
        nearest.power[0] = found.power[0];
        nearest.power[1] = found.power[1];
      } else {
        nearest = take_all(metric);
      }
      return;
    }
    VectorLanes of_lane;
    of_lane.template store<S>(from);
    for_each_lane(lanes, [&](uint32_t lane) {
      const float at[3] = {of_lane.x.lane[lane], of_lane.y.lane[lane], of_lane.z.lane[lane]};
      const auto found =
          neighbours.nearest_to(at, wanted.last, [&](const V3<S>& d) { return power<S>(d, metric); });
      const auto here = S::M::from_bits(1u << lane);
      for (uint32_t i = 0; i <= wanted.last; ++i)
        nearest.power[i] = S::select(here, F(found.power[i]), nearest.power[i]);
      nearest.point = select<S>(here, p + splat3<S>(found.way), nearest.point);
    });
  }

  /// Those of all lanes at once; false: they are in few cells.
  template <class Spu, class S>
  [[gnu::always_inline]] static bool take_inner_of_lanes(Features<Spu>& features, const V3<S>& p,
                                                         float metric, const Wanted& wanted,
                                                         Nearest<S>& nearest) {
    const NeighboursOfLanes<S> neighbours(features, p);
    const uint32_t most = features.are_cached() ? tuning::kMostCellsInCache : tuning::kMostCellsOfFeatures;
    if (!neighbours.are_of_more_cells_than(most)) return false;
    take_neighbours(neighbours, p, metric, wanted, nearest);
    return true;
  }
  template <class S>
  CELLTRACE_ONE_COPY static void take_neighbours(const NeighboursOfLanes<S>& neighbours, const V3<S>& p,
                                                 float metric, const Wanted& wanted, Nearest<S>& nearest) {
    if (metric == 2.0f && wanted.last == 0 && wanted.point) {
      Nearest<S> found = nearest;
      neighbours.for_each_near([&](const V3<S>& d) __attribute__((always_inline)) {
        take<S>(power<S>(d, 2.0f), d, p, found);
      });
      nearest.power[0] = found.power[0];
      nearest.point = found.point;
    } else {
      neighbours.for_each_near([&](const V3<S>& d) __attribute__((always_inline)) {
        take<S>(power<S>(d, metric), d, p, nearest);
      });
    }
    const typename S::F reach = nearest.power[wanted.last];
    FloatLanes least[3];
    for (uint32_t i = 0; i <= wanted.last; ++i)
      nearest.power[i].store(least[i].lane);
    VectorLanes way = {};
    uint32_t nearer = 0;
    const auto take_pairs = [&](const V3<S>& ways, const int32_t* lanes, uint32_t count) {
      FloatLanes found;
      VectorLanes to;
      power<S>(ways, metric).store(found.lane);
      to.template store<S>(ways);
      for (uint32_t i = 0; i < count; ++i) {
        const auto lane = static_cast<uint32_t>(lanes[i]);
        float next = found.lane[i];
        if (next < least[0].lane[lane]) {
          nearer |= 1u << lane;
          way.x.lane[lane] = to.x.lane[i];
          way.y.lane[lane] = to.y.lane[i];
          way.z.lane[lane] = to.z.lane[i];
        }
        for (uint32_t rank = 0; rank <= wanted.last; ++rank) {
          float& known = least[rank].lane[lane];
          const float lower = next < known ? next : known;
          next = next < known ? known : next;
          known = lower;
        }
      }
    };
    neighbours.for_each_far([&](const typename S::F& gap) { return along<S>(gap, metric); },
                            [&](const typename S::F& sum)
                                __attribute__((always_inline)) { return (sum < reach).bits(); },
                            take_pairs);
    for (uint32_t i = 0; i <= wanted.last; ++i)
      nearest.power[i] = S::F::load(least[i].lane);
    if (wanted.point && nearer != 0)
      nearest.point = select<S>(S::M::from_bits(nearer), p + way.template load<S>(), nearest.point);
  }

  /// How far a coordinate in a cell is from those of the cell that is `steps` further.
  template <class S>
  [[gnu::always_inline]] static typename S::F gap(const typename S::F& from, int32_t steps) {
    using F = typename S::F;
    if (steps == 0) return F(0.0f);
    return steps > 0 ? F(static_cast<float>(steps)) - from : from - F(static_cast<float>(steps + 1));
  }
  /// Whether no point beyond the inner cells, which are 1 away or more along an axis, is nearer.
  template <class S>
  [[gnu::always_inline]] static bool reaches_no_further(const typename S::F& power,
                                                        const typename S::M& here) {
    return (here & (power > typename S::F(1.0f))).bits() == 0;
  }

  /// What a distance along one axis adds to what the distance is a root of.
  template <class S>
  [[gnu::always_inline]] static typename S::F along(const typename S::F& distance, float metric) {
    using F = typename S::F;
    if (metric == 2.0f) return distance * distance;
    return metric == 1.0f ? distance : pow<S>(distance, F(metric));
  }
  /// What the distance is a root of.
  template <class S> [[gnu::always_inline]] static typename S::F power(const V3<S>& d, float metric) {
    using F = typename S::F;
    if (metric == 2.0f) return dot<S>(d, d);
    F sum(0.0f);
    const F distance[3] = {S::abs(d.x), S::abs(d.y), S::abs(d.z)};
    for (const F& one : distance)
      sum = sum + along<S>(one, metric);
    return sum;
  }
  template <class S>
  [[gnu::always_inline]] static typename S::F distance(const typename S::F& power, float metric) {
    using F = typename S::F;
    if (metric == 2.0f) return S::sqrt(power);
    return metric == 1.0f ? power : pow<S>(power, F(1.0f / metric));
  }

  template <class S>
  [[gnu::always_inline]] static void take(const typename S::F& power, const V3<S>& d, const V3<S>& p,
                                          Nearest<S>& nearest) {
    using F = typename S::F;
    F(&least)[3] = nearest.power;
    nearest.point = select<S>(power < least[0], p + d, nearest.point);
    const F second = S::max(least[0], power), third = S::max(least[1], second);
    least[0] = S::min(least[0], power);
    least[1] = S::min(least[1], second);
    least[2] = S::min(least[2], third);
  }
};

} // namespace celltrace::kernel

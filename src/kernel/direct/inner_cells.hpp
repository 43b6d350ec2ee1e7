// The search for nearest points of crackle in inner cells: the cells around each point, whose feature points
// are all known at once. Kernel dialect, for direct memory.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/direct/feature_neighbours.hpp"
#include "kernel/direct/neighbours_of_lanes.hpp"
#include "kernel/textures/crackle.hpp"

namespace celltrace::kernel {

/// Finds nearest points in inner cells first: most of the other cells are then too far away.
template <class S> class InnerCells {
  using Crackle = CracklePattern;
  using Nearest = Crackle::Nearest<S>;
  using Wanted = Crackle::Wanted;

public:
  /// Distance, in cells, up to which cells around a point are inner cells.
  static constexpr int32_t kTaken = 1;

  /// Returns true if the nearest points of all lanes are in the inner cells of these lanes. If it returns
  /// false, `nearest` may contain points of inner cells.
  template <class Spu>
  [[gnu::always_inline]] static bool suffice(Features<Spu>& features, const V3<S>& p, float metric,
                                             const Wanted& wanted, Nearest& nearest) {
    return take_inner_of_lanes(features, p, metric, wanted, nearest) &&
           reaches_no_further(nearest.power[wanted.last], S::M::all());
  }
  /// Returns true if the nearest points of `lanes`, all of which are in one cell, are in the inner cells.
  template <class Spu>
  [[gnu::always_inline]] static bool suffice_in(const uint32_t (&cell)[3], Features<Spu>& features,
                                                const V3<S>& from, const V3<S>& p, uint32_t lanes,
                                                float metric, const Wanted& wanted, Nearest& nearest) {
    take_inner(features, cell, from, p, lanes, metric, wanted, nearest);
    return reaches_no_further(nearest.power[wanted.last], S::M::from_bits(lanes));
  }

  /// Returns the least that a distance along an axis contributes to distance^metric.
  [[gnu::always_inline]] static typename S::F least_along(const typename S::F& offset, float metric) {
    return Crackle::along<S>(offset, metric);
  }

private:
  /// Processes the feature points of the inner cells for lanes in one cell, unless this has been done before.
  template <class Spu>
  CELLTRACE_ONE_COPY static void take_inner(Features<Spu>& features, const uint32_t (&cell)[3],
                                            const V3<S>& from, const V3<S>& p, uint32_t lanes, float metric,
                                            const Wanted& wanted, Nearest& nearest) {
    using F = typename S::F;
    if ((S::M::from_bits(lanes) & (nearest.power[0] < F(Crackle::kFar))).bits() != 0) return;
    FeatureNeighbours<S> room;
    const FeatureNeighbours<S>& neighbours = neighbours_of(cell, features, room);
    const auto here = S::M::from_bits(lanes);
    const auto take_all = [&](float of_metric) __attribute__((always_inline)) {
      Nearest found = nearest;
      for (uint32_t i = 0; i < FeatureNeighbours<S>::kCount; ++i) {
        const V3<S> d = neighbours.offset_to(i, from);
        Crackle::take<S>(S::select(here, Crackle::power<S>(d, of_metric), F(Crackle::kFar)), d, p, found);
      }
      return found;
    };
    if (metric == 2.0f && wanted.last <= 1 && !wanted.point) {
      // Compilers leave out the members that are not assigned here.
      const Nearest found = take_all(2.0f);
      nearest.power[0] = found.power[0];
      nearest.power[1] = found.power[1];
    } else {
      nearest = take_all(metric);
    }
  }

  /// Processes the points of all lanes at once. Returns false if the points are in few cells.
  template <class Spu>
  [[gnu::always_inline]] static bool take_inner_of_lanes(Features<Spu>& features, const V3<S>& p,
                                                         float metric, const Wanted& wanted,
                                                         Nearest& nearest) {
    const NeighboursOfLanes<S> neighbours(features, p);
    const uint32_t most = features.scene().pattern_caches().neighbours != nullptr
                              ? tuning::kMostCellsInCache
                              : tuning::kMostCellsOfFeatures;
    if (!neighbours.are_of_more_cells_than(most)) return false;
    take_neighbours(neighbours, p, metric, wanted, nearest);
    return true;
  }
  CELLTRACE_ONE_COPY static void take_neighbours(const NeighboursOfLanes<S>& neighbours, const V3<S>& p,
                                                 float metric, const Wanted& wanted, Nearest& nearest) {
    if (metric == 2.0f && wanted.last == 0 && wanted.point) {
      Nearest found = nearest;
      neighbours.for_each_near([&](const V3<S>& d) __attribute__((always_inline)) {
        Crackle::take<S>(Crackle::power<S>(d, 2.0f), d, p, found);
      });
      nearest.power[0] = found.power[0];
      nearest.point = found.point;
    } else {
      neighbours.for_each_near([&](const V3<S>& d) __attribute__((always_inline)) {
        Crackle::take<S>(Crackle::power<S>(d, metric), d, p, nearest);
      });
    }
    const typename S::F reach = nearest.power[wanted.last];
    FloatLanes least[3];
    for (uint32_t i = 0; i <= wanted.last; ++i)
      nearest.power[i].store(least[i].lane);
    VectorLanes offset = {};
    uint32_t nearer = 0;
    const auto take_pairs = [&](const V3<S>& offsets, const int32_t* lanes, uint32_t count) {
      FloatLanes found;
      VectorLanes to;
      Crackle::power<S>(offsets, metric).store(found.lane);
      to.template store<S>(offsets);
      for (uint32_t i = 0; i < count; ++i) {
        const auto lane = static_cast<uint32_t>(lanes[i]);
        float next = found.lane[i];
        if (next < least[0].lane[lane]) {
          nearer |= 1u << lane;
          offset.x.lane[lane] = to.x.lane[i];
          offset.y.lane[lane] = to.y.lane[i];
          offset.z.lane[lane] = to.z.lane[i];
        }
        for (uint32_t rank = 0; rank <= wanted.last; ++rank) {
          float& known = least[rank].lane[lane];
          const float lower = next < known ? next : known;
          next = next < known ? known : next;
          known = lower;
        }
      }
    };
    neighbours.for_each_far([&](const typename S::F& gap) { return Crackle::along<S>(gap, metric); },
                            [&](const typename S::F& sum)
                                __attribute__((always_inline)) { return (sum < reach).bits(); },
                            take_pairs);
    for (uint32_t i = 0; i <= wanted.last; ++i)
      nearest.power[i] = S::F::load(least[i].lane);
    if (wanted.point && nearer != 0)
      nearest.point = select<S>(S::M::from_bits(nearer), p + offset.template load<S>(), nearest.point);
  }

  /// Returns true if no point beyond the inner cells, at least 1 away along an axis, can be nearer.
  [[gnu::always_inline]] static bool reaches_no_further(const typename S::F& power,
                                                        const typename S::M& here) {
    return (here & (power > typename S::F(1.0f))).bits() == 0;
  }
  /// Returns the points in and around a cell, valid until the next call: in `room`, unless they are cached.
  template <class Spu>
  static const FeatureNeighbours<S>& neighbours_of(const uint32_t (&cell)[3], Features<Spu>& features,
                                                   FeatureNeighbours<S>& room) {
    if (auto* const cache = features.scene().pattern_caches().neighbours)
      return cache->around(features, cell);
    room.gather(features, cell);
    return room;
  }
};

} // namespace celltrace::kernel

// The crackle pattern: distances to the nearest feature points, one at random in each unit cell, which look
// like cracks between stones (Worley 1996). Kernel dialect.
#pragma once

#include "kernel/packet.hpp"
#include "kernel/textures/features.hpp"
#include "kernel/textures/pattern_traits.hpp"
#include "records/random_tables.hpp"

namespace celltrace::kernel {

/// The parameters are the factors of the three shortest distances, the metric's exponent, and the offset,
/// which is added to distance^metric.
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
    typename S::F power[3]; ///< distance^metric of the three nearest points, ascending
    V3<S> point;            ///< the nearest point
  };
  /// Requested results: the distances up to index `last`, and the nearest point if `point`.
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
    using InnerCells = typename Strategy<Spu>::template InnerCells<S>;
    if (InnerCells::suffice(features, p, metric, wanted, nearest)) return nearest;
    for_each_cell_of<S>(p, [&](uint32_t lanes, const uint32_t(&cell)[3], const V3<S>& from) {
      const auto here = S::M::from_bits(lanes);
      if (InnerCells::suffice_in(cell, features, from, p, lanes, metric, wanted, nearest)) return;
      // Returns the least distance^metric of a cell's points along one axis.
      const auto across = [metric](const F& coordinate, int32_t steps) {
        return InnerCells::least_along(gap<S>(coordinate, steps), metric);
      };
      const auto is_too_far = [&](const F& sum) {
        return (here & (sum < nearest.power[wanted.last])).bits() == 0;
      };
      for (int32_t reach = InnerCells::kTaken + 1; reach <= 2; ++reach)
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

  /// Initial distance^metric, before any feature point is known.
  static constexpr float kFar = 1e30f;

  /// Returns the part of distance^metric that a distance along one axis contributes.
  template <class S>
  [[gnu::always_inline]] static typename S::F along(const typename S::F& distance, float metric) {
    using F = typename S::F;
    if (metric == 2.0f) return distance * distance;
    return metric == 1.0f ? distance : pow<S>(distance, F(metric));
  }
  /// Returns distance^metric.
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

private:
  /// Returns the distance along an axis from a coordinate in a cell to the cell that is `steps` further.
  template <class S>
  [[gnu::always_inline]] static typename S::F gap(const typename S::F& from, int32_t steps) {
    using F = typename S::F;
    if (steps == 0) return F(0.0f);
    return steps > 0 ? F(static_cast<float>(steps)) - from : from - F(static_cast<float>(steps + 1));
  }
  template <class S>
  [[gnu::always_inline]] static typename S::F distance(const typename S::F& power, float metric) {
    using F = typename S::F;
    if (metric == 2.0f) return S::sqrt(power);
    return metric == 1.0f ? power : pow<S>(power, F(1.0f / metric));
  }
};

} // namespace celltrace::kernel

// The random points in and around a unit cell, side by side in SIMD lanes. Kernel dialect, where memory is
// direct.
//
// Where few lanes of a packet are in the same cell, the distances from one lane's point to all of these are
// found at once, in place of those from all lanes to one of them after the other. Where points are farther
// apart, see neighbours_of_lanes.hpp.
#pragma once

#include "records/random_tables.hpp"

#include <stdint.h>

namespace celltrace::kernel {

/// The points of a cell and the 26 around it, in the order of x, y, z. From the cell's corner.
template <class S> class FeatureNeighbours {
public:
  using F = typename S::F;

  /// `features`: the Features of a table.
  template <class Table> void gather(Table& features, const uint32_t (&cell)[3]) {
    uint32_t i = 0;
    for (int32_t x = -1; x <= 1; ++x) {
      const uint32_t plane = features.number_after(0, cell[0] + static_cast<uint32_t>(x));
      for (int32_t y = -1; y <= 1; ++y) {
        const uint32_t column = features.number_after(plane, cell[1] + static_cast<uint32_t>(y));
        for (int32_t z = -1; z <= 1; ++z, ++i) {
          const auto feature = features.at(features.number_after(column, cell[2] + static_cast<uint32_t>(z)));
          place_[0][i] = feature.place[0] + static_cast<float>(x);
          place_[1][i] = feature.place[1] + static_cast<float>(y);
          place_[2][i] = feature.place[2] + static_cast<float>(z);
        }
      }
    }
    for (; i < kPlaces; ++i)
      place_[0][i] = place_[1][i] = place_[2][i] = kFar;
  }

  static constexpr uint32_t kCount = 27;
  /// The way from points of all lanes to point `i`.
  [[gnu::always_inline]] V3<S> way_to(uint32_t i, const V3<S>& from) const {
    return {F(place_[0][i]) - from.x, F(place_[1][i]) - from.y, F(place_[2][i]) - from.z};
  }

  /// The least of what distances are a root of, in ascending order, up to number `last`; where the nearest
  /// point is, from `from`.
  struct Nearest {
    float power[3], way[3];
  };
  /// `power(way)` of each way.
  template <class Power>
  [[gnu::always_inline]] Nearest nearest_to(const float (&from)[3], uint32_t last, const Power& power) const {
    const F far(1e30f);
    F low = power(ways(0, from)), high = power(ways(S::kLanes, from));
    Nearest nearest = {{1e30f, 1e30f, 1e30f}, {}};
    const uint32_t in_low = (low <= high).bits();
    const F both = S::min(low, high);
    high = S::max(low, high);
    low = both;
    for (uint32_t i = 0;; ++i) {
      const float least = least_of(low);
      nearest.power[i] = least;
      const uint32_t lane = static_cast<uint32_t>(__builtin_ctz((low == F(least)).bits()));
      if (i == 0) {
        const uint32_t place = (in_low >> lane & 1) != 0 ? lane : lane + S::kLanes;
        for (uint32_t axis = 0; axis < 3; ++axis)
          nearest.way[axis] = place_[axis][place] - from[axis];
      }
      if (i == last) return nearest;
      const auto taken = S::M::from_bits(1u << lane);
      low = S::select(taken, high, low);
      high = S::select(taken, far, high);
    }
  }

private:
  static constexpr uint32_t kPlaces = 2 * S::kLanes;
  static_assert(kCount <= kPlaces && kCount > S::kLanes);
  /// Whose square is far beyond all distances.
  static constexpr float kFar = 1e15f;

  [[gnu::always_inline]] V3<S> ways(uint32_t first, const float (&from)[3]) const {
    return {F::load(place_[0] + first) - F(from[0]), F::load(place_[1] + first) - F(from[1]),
            F::load(place_[2] + first) - F(from[2])};
  }
  [[gnu::always_inline]] static float least_of(const F& numbers) {
    float least, greatest;
    S::extremes(numbers, least, greatest);
    return least;
  }

  alignas(64) float place_[3][kPlaces];
};

/// The neighbours of the cells that a packet's points are in, for points beside them: a normal asks at four
/// that are close together. Of one table.
template <class S> class NeighbourCache {
public:
  NeighbourCache() {
    for (uint64_t& name : names_)
      name = kNone;
  }

  /// Those in `features`. They stay until the next call.
  template <class Table> const FeatureNeighbours<S>& around(Table& features, const uint32_t (&cell)[3]) {
    // As many bits of each coordinate as there are numbers of cells.
    uint64_t name = 0;
    for (const uint32_t coordinate : cell)
      name = name * kFeatures + coordinate % kFeatures;
    for (uint32_t i = 0; i < kCells; ++i)
      if (names_[i] == name) return neighbours_[i];
    const uint32_t oldest = next_;
    next_ = (next_ + 1) % kCells;
    names_[oldest] = name;
    neighbours_[oldest].gather(features, cell);
    return neighbours_[oldest];
  }

private:
  static constexpr uint64_t kNone = ~uint64_t{0};
  static constexpr uint32_t kCells = S::kLanes;

  uint64_t names_[kCells];
  uint32_t next_ = 0;
  FeatureNeighbours<S> neighbours_[kCells];
};

} // namespace celltrace::kernel

// The feature points in and around a unit cell, for all lanes in this cell. If lanes are in many cells, see
// neighbours_of_lanes.hpp. Kernel dialect, for direct memory.
#pragma once

#include "records/random_tables.hpp"

#include <stdint.h>

namespace celltrace::kernel {

/// The feature points of a cell and the 26 cells around it, in the order of x, y, z, relative to the cell's
/// corner.
template <class S> class FeatureNeighbours {
public:
  using F = typename S::F;

  /// Finds the points; `features` are the Features of a table.
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
  }

  static constexpr uint32_t kCount = 27;
  /// Returns the vectors from points of all lanes to point `i`.
  [[gnu::always_inline]] V3<S> offset_to(uint32_t i, const V3<S>& from) const {
    return {F(place_[0][i]) - from.x, F(place_[1][i]) - from.y, F(place_[2][i]) - from.z};
  }

private:
  float place_[3][kCount];
};

/// A cache of the feature points around the cells with a packet's points, for further points near by: a
/// normal evaluates four points that are close together. All feature points are from one table.
template <class S> class NeighbourCache {
public:
  NeighbourCache() {
    for (uint64_t& name : names_)
      name = kNone;
  }

  /// Returns the points around a cell in `features`, which are valid until the next call.
  template <class Table> const FeatureNeighbours<S>& around(Table& features, const uint32_t (&cell)[3]) {
    // The name has the coordinates modulo kFeatures, after which cells repeat.
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

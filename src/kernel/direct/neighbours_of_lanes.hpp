// The feature points around points of lanes that are each in a unit cell of its own. Kernel dialect, for
// direct memory.
//
// Far away, and if points are at random, each lane of a packet is in another cell. For all lanes at once the
// points of the nearest cells are read: the lane's own cell, and the cells that share with it a face, an edge
// or a corner on the sides to which the lane's point is nearer. The few other cells that may have a nearer
// point differ from lane to lane: pairs of a lane and a cell fill packets.
#pragma once

#include "kernel/direct/record_lanes.hpp"
#include "kernel/direct/wavefront_queue.hpp"
#include "kernel/math.hpp"
#include "kernel/packet.hpp"
#include "kernel/textures/features.hpp"
#include "records/random_tables.hpp"

#include <stddef.h>
#include <stdint.h>

namespace celltrace::kernel {

template <class S> class NeighboursOfLanes {
public:
  using F = typename S::F;
  using I = typename S::I;

  /// Finds the cells of points; `features` are the Features of a table.
  template <class Table> NeighboursOfLanes(Table& features, const V3<S>& p) : table_(features.words()) {
    const F* const coordinates[3] = {&p.x, &p.y, &p.z};
    for (uint32_t axis = 0; axis < 3; ++axis)
      from_[axis] = fraction<S>(*coordinates[axis], cell_[axis]);
  }

  /// Returns true if the lanes' points are in more than `most` cells.
  bool are_of_more_cells_than(uint32_t most) const {
    alignas(64) int32_t of_lane[3][S::kLanes];
    for (uint32_t axis = 0; axis < 3; ++axis)
      cell_[axis].store(of_lane[axis]);
    uint32_t left = (1u << S::kLanes) - 1, cell[3];
    for (uint32_t i = 0; i < most && left != 0; ++i)
      left &= ~find_cell<S>(static_cast<uint32_t>(__builtin_ctz(left)), cell_, of_lane, cell);
    return left != 0;
  }

  /// Calls `take(offset)` for the eight nearest cells with the vectors from each lane's point to the feature
  /// point.
  template <class Take> [[gnu::always_inline]] void for_each_near(const Take& take) const {
    F step[3][2];
    I next[3];
    for (uint32_t axis = 0; axis < 3; ++axis) {
      step[axis][0] = F(0.0f);
      step[axis][1] = to_near(from_[axis]);
      next[axis] = cell_[axis] + S::to_int(step[axis][1]);
    }
    for (uint32_t x = 0; x < 2; ++x) {
      const I plane = hash_at(x == 0 ? cell_[0] : next[0]);
      for (uint32_t y = 0; y < 2; ++y) {
        const I column = hash_at(plane ^ (y == 0 ? cell_[1] : next[1]));
        for (uint32_t z = 0; z < 2; ++z)
          take(offset_to(hash_at(column ^ (z == 0 ? cell_[2] : next[2])),
                         {step[0][x], step[1][y], step[2][z]}, from_));
      }
    }
  }

  /// Calls `take(offsets, lanes, count)` for the other cells of the 26 around each lane's cell, in pairs of a
  /// lane and a cell: lanes[i] is the lane of the i-th vector. `along(gap)` returns the contribution of a gap
  /// along one axis to distance^metric, `reaching(sum)` the lanes that need points whose gaps add up to
  /// `sum`.
  template <class Along, class Reaching, class Take>
  void for_each_far(const Along& along, const Reaching& reaching, const Take& take) const {
    Pairs pairs;
    WavefrontQueue<Pairs> queue(&pairs);
    F gaps[3][kSteps];
    for (uint32_t axis = 0; axis < 3; ++axis) {
      const F low = from_[axis], high = F(1.0f) - low;
      gaps[axis][kStay] = F(0.0f);
      gaps[axis][kNear] = along(S::min(low, high));
      gaps[axis][kFar] = along(S::max(low, high));
    }
    for (uint32_t x = 0; x < kSteps; ++x)
      for (uint32_t y = 0; y < kSteps; ++y)
        for (uint32_t z = x == kFar || y == kFar ? 0 : kFar; z < kSteps; ++z) {
          constexpr float kFactor[kSteps] = {0.0f, 1.0f, -1.0f};
          queue.push(0, reaching(gaps[0][x] + gaps[1][y] + gaps[2][z]), {kFactor[x], kFactor[y], kFactor[z]},
                     *this, take);
        }
    queue.flush(*this, take);
  }

private:
  static constexpr uint32_t kStay = 0, kNear = 1, kFar = 2, kSteps = 3;
  /// Pairs of a lane and a cell `factor` steps away toward the near side. Vectors are stored at any lane.
  struct Pairs : WorkKind {
    struct Source {
      float factor[3];
    };
    alignas(64) int32_t lane[2 * S::kLanes] = {};
    alignas(64) float factor[3][2 * S::kLanes] = {};

    void put(const Source& from, uint32_t lanes, uint32_t to) {
      S::lane_numbers(lanes).store_unaligned(lane + to);
      for (uint32_t axis = 0; axis < 3; ++axis)
        F(from.factor[axis]).store_unaligned(factor[axis] + to);
    }
    template <class Take>
    void run(uint32_t, uint32_t lanes, const NeighboursOfLanes& neighbours, const Take& take) const {
      neighbours.take_all(*this, static_cast<uint32_t>(__builtin_popcount(lanes)), take);
    }
  };

  template <class Take> void take_all(const Pairs& pairs, uint32_t count, const Take& take) const {
    const I lanes = I::load(pairs.lane);
    F step[3], from[3];
    I number = I::splat(0);
    for (uint32_t axis = 0; axis < 3; ++axis) {
      from[axis] = S::pick(from_[axis], lanes);
      step[axis] = to_near(from[axis]) * F::load(pairs.factor[axis]);
      number = hash_at(number ^ (S::pick(cell_[axis], lanes) + S::to_int(step[axis])));
    }
    take(offset_to(number, {step[0], step[1], step[2]}, from), pairs.lane, count);
  }

  /// Returns the step along an axis to the nearer neighbour: 1 or -1.
  static F to_near(const F& from) { return S::select(from < F(0.5f), F(-1.0f), F(1.0f)); }
  /// Returns the vectors from points in cells to the feature point of the cell with a number, which is some
  /// steps away.
  [[gnu::always_inline]] V3<S> offset_to(const I& number, const V3<S>& steps, const F (&from)[3]) const {
    WordLanes first;
    first_word(number).store(reinterpret_cast<int32_t*>(first.lane));
    const auto record_of = [&](uint32_t lane) __attribute__((always_inline)) {
      return reinterpret_cast<const float*>(table_ + first.lane[lane]);
    };
    F words[4];
    load_words<S>(record_of, 0, words);
    return {words[0] + steps.x - from[0], words[1] + steps.y - from[1], words[2] + steps.z - from[2]};
  }
  static I first_word(const I& number) {
    return S::template shift_left<2>(number & I::splat(static_cast<int32_t>(kFeatures - 1)));
  }
  [[gnu::always_inline]] I hash_at(const I& number) const {
    return I::gather(table_ + 3, first_word(number));
  }

  static_assert(offsetof(FeatureRecord, hash) == 12 && sizeof(FeatureRecord) == 16);
  const int32_t* table_;
  I cell_[3];
  F from_[3]; ///< position of each lane's point in its cell
};

} // namespace celltrace::kernel

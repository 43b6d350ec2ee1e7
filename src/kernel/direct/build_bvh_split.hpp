// Splitting of a range of references in two by the surface area heuristic (SAH) over bins of their centres
// (Wald, On fast Construction of SAH-based Bounding Volume Hierarchies, 2007). Kernel dialect.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/direct/build_bvh_lanes.hpp"

namespace celltrace::kernel::bvh {

/// Splits a range in the middle, without reordering it.
template <class S>
void halve_range(const Reference* references, const Range<S>& range, Range<S>& left, Range<S>& right) {
  const uint32_t middle = range.begin + range.count() / 2;
  left = range_of<S>(references, range.begin, middle);
  right = range_of<S>(references, middle, range.end);
}

/// Returns the bounds of the doubled centres of a range's references.
template <class S> LaneAabb<S> centres_of(const Reference* references, const Range<S>& range) {
  LaneAabb<S> centres = LaneAabb<S>::empty();
  for (uint32_t i = range.begin; i < range.end; ++i)
    centres.grow(LaneAabb<S>::of(references[i]).centre());
  return centres;
}

constexpr uint32_t kFewBins = tuning::kFewBins;

/// Splits ranges with `kBins` bins on each axis, a power of two.
template <class S, uint32_t kBins> class BinnedSplitter {
public:
  using F4 = typename S::F4;

  /// Splits a `range` of at least two references and reorders them stably: the references of `left` come
  /// first. `spare` has room for the range.
  CELLTRACE_ONE_COPY static void split(Reference* references, Reference* spare, const Range<S>& range,
                                       Range<S>& left, Range<S>& right) {
    // If the range lies on a line along an axis, every SAH cost is 0.
    if (range.box.area() == 0.0f) return halve_range(references, range, left, right);
    if constexpr (S::kWidth == kSimdLanes && kBins == kFewBins) {
      const LaneCuts<S, kBins> cuts(references, range);
      const uint32_t lane = cuts.best();
      if (lane == cuts.kNone) return halve_range(references, range, left, right);
      cuts.sides_of(lane, range.weight, left, right);
      partition(references, spare, range, left, right,
                [&](const Reference&, uint32_t i) { return cuts.is_on_left(i - range.begin, lane); });
    } else {
      const BinMapping mapping(centres_of(references, range));
      Bins bins;
      fill(bins, references, range, mapping);
      const Cut cut = best_cut(bins);
      if (cut.bin == 0) return halve_range(references, range, left, right);
      measure(bins, cut, left, right);
      partition(references, spare, range, left, right, [&](const Reference& reference, uint32_t) {
        return static_cast<uint32_t>(mapping.bin_of(reference, cut.axis) < cut.bin);
      });
    }
  }

private:
  /// Maps centres to bins, on each axis.
  struct BinMapping {
    F4 base, scale;
    alignas(16) float base_of[4];
    float scale_of[3];

    explicit BinMapping(const LaneAabb<S>& centres) {
      alignas(16) float extent[4];
      (centres.max - centres.min).store(extent);
      centres.min.store(base_of);
      for (int axis = 0; axis < 3; ++axis)
        scale_of[axis] = extent[axis] > kFlatExtent ? (kBins - 1) / extent[axis] : 0.0f;
      // Lane 3 is unused; -1 keeps its results from being denormal numbers, which are slow on some
      // processors.
      base = four<S>(base_of[0], base_of[1], base_of[2], -1.0f);
      scale = four<S>(scale_of[0], scale_of[1], scale_of[2], 0.0f);
    }
    void bins_of(const F4& centre, uint32_t (&bin)[4]) const {
      alignas(16) float position[4];
      ((centre - base) * scale + F4::splat(kRoundToInteger)).store(position);
      for (int axis = 0; axis < 3; ++axis)
        bin[axis] = low_bits(position[axis]);
    }
    /// Maps a centre to a bin on one axis.
    uint32_t bin_of(const Reference& reference, uint32_t axis) const {
      const float centre = reference.min[axis] + reference.max[axis];
      return low_bits((centre - base_of[axis]) * scale_of[axis] + kRoundToInteger);
    }
    static uint32_t low_bits(float number) {
      uint32_t bits;
      __builtin_memcpy(&bits, &number, sizeof bits);
      return bits & (kBins - 1);
    }
  };

  struct Bins {
    LaneAabb<S> bounds[3][kBins];
    uint32_t weight[3][kBins];
  };

  /// A split. `bin` is the first bin on the right; 0: there is no split.
  struct Cut {
    uint32_t axis, bin;
  };

  static void fill(Bins& bins, const Reference* references, const Range<S>& range,
                   const BinMapping& mapping) {
    for (uint32_t axis = 0; axis < 3; ++axis)
      for (uint32_t i = 0; i < kBins; ++i) {
        bins.bounds[axis][i] = LaneAabb<S>::empty();
        bins.weight[axis][i] = 0;
      }
    for (uint32_t i = range.begin; i < range.end; ++i) {
      const LaneAabb<S> bounds = LaneAabb<S>::of(references[i]);
      uint32_t bin[4];
      mapping.bins_of(bounds.centre(), bin);
      for (uint32_t axis = 0; axis < 3; ++axis) {
        bins.bounds[axis][bin[axis]].grow(bounds);
        bins.weight[axis][bin[axis]] += references[i].weight;
      }
    }
  }

  static Cut best_cut(const Bins& bins) {
    Cut best = {0, 0};
    float least = kHuge;
    for (uint32_t axis = 0; axis < 3; ++axis) {
      float left_cost[kBins];
      LaneAabb<S> bounds = bins.bounds[axis][0];
      uint32_t weight = bins.weight[axis][0];
      for (uint32_t i = 1; i < kBins; ++i) {
        left_cost[i] = bounds.area() * static_cast<float>(weight);
        bounds.grow(bins.bounds[axis][i]);
        weight += bins.weight[axis][i];
      }
      bounds = LaneAabb<S>::empty();
      weight = 0;
      for (uint32_t i = kBins - 1; i > 0; --i) {
        bounds.grow(bins.bounds[axis][i]);
        weight += bins.weight[axis][i];
        // The area of an empty side is infinite and its weight 0; the product is NaN, which is never less.
        const float cost = left_cost[i] + bounds.area() * static_cast<float>(weight);
        if (cost < least) {
          least = cost;
          best = {axis, i};
        }
      }
    }
    return best;
  }

  static void measure(const Bins& bins, const Cut& cut, Range<S>& left, Range<S>& right) {
    left = right = {0, 0, 0, LaneAabb<S>::empty()};
    for (uint32_t i = 0; i < kBins; ++i) {
      Range<S>& side = i < cut.bin ? left : right;
      side.box.grow(bins.bounds[cut.axis][i]);
      side.weight += bins.weight[cut.axis][i];
    }
  }

  /// Partitions the references, stably and without branches, which would be mispredicted: each reference is
  /// stored on both sides, and only the end of its own side advances. The left end never passes the reference
  /// that is read.
  template <class IsOnLeft>
  static void partition(Reference* references, Reference* spare, const Range<S>& range, Range<S>& left,
                        Range<S>& right, IsOnLeft is_on_left) {
    uint32_t on_left = range.begin, on_right = 0;
    for (uint32_t i = range.begin; i < range.end; ++i) {
      const uint32_t goes_left = is_on_left(references[i], i);
      copy<S>(references[i], spare[on_right]);
      copy<S>(references[i], references[on_left]);
      on_left += goes_left;
      on_right += 1 - goes_left;
    }
    for (uint32_t i = 0; i < on_right; ++i)
      copy<S>(spare[i], references[on_left + i]);
    left.begin = range.begin;
    left.end = right.begin = on_left;
    right.end = range.end;
  }
};

template <class S>
void split_range(Reference* references, Reference* spare, const Range<S>& range, Range<S>& left,
                 Range<S>& right) {
  if (range.count() > kFewReferences)
    BinnedSplitter<S, tuning::kManyBins>::split(references, spare, range, left, right);
  else
    BinnedSplitter<S, kFewBins>::split(references, spare, range, left, right);
}

} // namespace celltrace::kernel::bvh

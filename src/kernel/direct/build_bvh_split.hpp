// Where to cut a range of references in two: by the surface area heuristic over bins of their centres (Wald,
// On fast construction of SAH-based bounding volume hierarchys, 2007). Kernel dialect.
#pragma once

#include "kernel/direct/build_bvh_lanes.hpp"

namespace celltrace::kernel::bvh {

/// Cuts a range in two in the order in which its references are.
template <class S>
void halve_range(const Reference* references, const Range<S>& range, Range<S>& left, Range<S>& right) {
  const uint32_t middle = range.begin + range.count() / 2;
  left = range_of<S>(references, range.begin, middle);
  right = range_of<S>(references, middle, range.end);
}

/// Around the doubles of the centres of a range's references.
template <class S> LaneAabb<S> centres_of(const Reference* references, const Range<S>& range) {
  LaneAabb<S> centres = LaneAabb<S>::empty();
  for (uint32_t i = range.begin; i < range.end; ++i)
    centres.grow(LaneAabb<S>::of(references[i]).centre());
  return centres;
}

/// Of ranges of kFewReferences at most.
constexpr uint32_t kFewBins = 4;

/// Cuts ranges in two. `kBins` is a power of two.
template <class S, uint32_t kBins> class BinnedSplitter {
public:
  using F4 = typename S::F4;

  /// Orders the references of `range` (two at least) so that those of `left` come first, stably. `spare` has
  /// room for all of them.
  [[gnu::noinline]] static void split(Reference* references, Reference* spare, const Range<S>& range,
                                      Range<S>& left, Range<S>& right) {
    // Points and lines are all the same to rays, and to the heuristic.
    if (range.box.area() == 0.0f) return halve_range(references, range, left, right);
    if constexpr (S::kWidth == kSimdLanes && kBins == kFewBins) {
      const LaneCuts<S, kBins> cuts(references, range);
      const uint32_t lane = cuts.best();
      if (lane == cuts.kNone) return halve_range(references, range, left, right);
      cuts.sides_of(lane, range.weight, left, right);
      partition(references, spare, range, left, right,
                [&](const Reference&, uint32_t i) { return cuts.is_on_left(i - range.begin, lane); });
    } else {
      const Places places(centres_of(references, range));
      Bins bins;
      fill(bins, references, range, places);
      const Cut cut = best_cut(bins);
      if (cut.bin == 0) return halve_range(references, range, left, right);
      measure(bins, cut, left, right);
      partition(references, spare, range, left, right, [&](const Reference& reference, uint32_t) {
        return static_cast<uint32_t>(places.bin_of(reference, cut.axis) < cut.bin);
      });
    }
  }

private:
  /// From centres to bins, coordinate by coordinate.
  struct Places {
    F4 base, scale;
    alignas(16) float base_of[4];
    float scale_of[3];

    explicit Places(const LaneAabb<S>& centres) {
      alignas(16) float extent[4];
      (centres.max - centres.min).store(extent);
      centres.min.store(base_of);
      for (int axis = 0; axis < 3; ++axis)
        scale_of[axis] = extent[axis] > kFlatExtent ? (kBins - 1) / extent[axis] : 0.0f;
      // Off the range of denormal numbers, which some processors are slow with.
      base = four<S>(base_of[0], base_of[1], base_of[2], -1.0f);
      scale = four<S>(scale_of[0], scale_of[1], scale_of[2], 0.0f);
    }
    void bins_of(const F4& centre, uint32_t (&bin)[4]) const {
      alignas(16) float place[4];
      ((centre - base) * scale + F4::splat(kRoundToInteger)).store(place);
      for (int axis = 0; axis < 3; ++axis)
        bin[axis] = low_bits(place[axis]);
    }
    /// The same along one axis.
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
    LaneAabb<S> box[3][kBins];
    uint32_t weight[3][kBins];
  };

  /// `bin` is the first on the right; 0 if there is no cut.
  struct Cut {
    uint32_t axis, bin;
  };

  static void fill(Bins& bins, const Reference* references, const Range<S>& range, const Places& places) {
    for (uint32_t axis = 0; axis < 3; ++axis)
      for (uint32_t i = 0; i < kBins; ++i) {
        bins.box[axis][i] = LaneAabb<S>::empty();
        bins.weight[axis][i] = 0;
      }
    for (uint32_t i = range.begin; i < range.end; ++i) {
      const LaneAabb<S> box = LaneAabb<S>::of(references[i]);
      uint32_t bin[4];
      places.bins_of(box.centre(), bin);
      for (uint32_t axis = 0; axis < 3; ++axis) {
        bins.box[axis][bin[axis]].grow(box);
        bins.weight[axis][bin[axis]] += references[i].weight;
      }
    }
  }

  static Cut best_cut(const Bins& bins) {
    Cut best = {0, 0};
    float least = kHuge;
    for (uint32_t axis = 0; axis < 3; ++axis) {
      float left_cost[kBins];
      LaneAabb<S> box = bins.box[axis][0];
      uint32_t weight = bins.weight[axis][0];
      for (uint32_t i = 1; i < kBins; ++i) {
        left_cost[i] = box.area() * static_cast<float>(weight);
        box.grow(bins.box[axis][i]);
        weight += bins.weight[axis][i];
      }
      box = LaneAabb<S>::empty();
      weight = 0;
      for (uint32_t i = kBins - 1; i > 0; --i) {
        box.grow(bins.box[axis][i]);
        weight += bins.weight[axis][i];
        // The area of nothing is infinite, and nothing times that is less than no number.
        const float cost = left_cost[i] + box.area() * static_cast<float>(weight);
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
      side.box.grow(bins.box[cut.axis][i]);
      side.weight += bins.weight[cut.axis][i];
    }
  }

  /// Sends each reference both ways and keeps the one that is right: branches would be guesses. Stores on the
  /// left never pass what is still to be read.
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

/// Cuts a range, with as many bins as are worth while for so many references.
template <class S>
void split_range(Reference* references, Reference* spare, const Range<S>& range, Range<S>& left,
                 Range<S>& right) {
  if (range.count() > kFewReferences)
    BinnedSplitter<S, 8>::split(references, spare, range, left, right);
  else
    BinnedSplitter<S, kFewBins>::split(references, spare, range, left, right);
}

} // namespace celltrace::kernel::bvh

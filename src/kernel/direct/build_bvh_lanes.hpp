// The SAH split of a range of few references, with one candidate split plane in each SIMD lane: for
// processors whose registers hold all lanes of a packet. Kernel dialect.
#pragma once

#include "celltrace/spe/simd.hpp"
#include "kernel/direct/build_bvh_bounds.hpp"
#include "kernel/tuning.hpp"

namespace celltrace::kernel::bvh {

constexpr uint32_t kFewReferences = tuning::kFewReferences;

/// The split plane of each lane. If two planes have the same cost, the lower lane's is taken.
template <uint32_t kBins> struct CutLanes {
  static constexpr uint32_t kCuts = 3 * (kBins - 1);
  static_assert(kCuts <= kSimdLanes, "a lane for each");

  uint32_t is_x = 0, is_y = 0;              ///< a bit for each lane: axis of its plane; neither: z
  alignas(64) int32_t bin[kSimdLanes] = {}; ///< first bin on the right; 0: the lane is unused

  constexpr CutLanes() {
    for (uint32_t lane = 0; lane < kCuts; ++lane) {
      if (axis(lane) == 0) is_x |= 1u << lane;
      if (axis(lane) == 1) is_y |= 1u << lane;
      bin[lane] = static_cast<int32_t>(kBins - 1 - lane % (kBins - 1));
    }
  }
  static constexpr uint32_t axis(uint32_t lane) { return lane / (kBins - 1); }
};
template <uint32_t kBins> inline constexpr CutLanes<kBins> kCutLanes;

/// Weights and bounds on both sides of every split plane of a range. `kBins` is a power of two.
template <class S, uint32_t kBins> class LaneCuts {
public:
  static constexpr uint32_t kNone = kSimdLanes;

  /// Computes the costs of a range of at most kFewReferences.
  LaneCuts(const Reference* references, const Range<S>& range) {
    alignas(16) float centres[kFewReferences][4]; // doubled, as in LaneAabb::centre()
    LaneAabb<S> centre_bounds = LaneAabb<S>::empty();
    for (uint32_t i = 0; i < range.count(); ++i) {
      const F4 centre = LaneAabb<S>::of(references[range.begin + i]).centre();
      centre_bounds.grow(centre);
      centre.store(centres[i]);
    }
    const M is_x = M::from_bits(kCutLanes<kBins>.is_x), is_y = M::from_bits(kCutLanes<kBins>.is_y);
    const auto of_axis = [&](const F& x, const F& y, const F& z) {
      return S::select(is_x, x, S::select(is_y, y, z));
    };
    alignas(16) float first[4];
    alignas(16) float last[4];
    centre_bounds.min.store(first);
    centre_bounds.max.store(last);
    const F base = of_axis(first[0], first[1], first[2]);
    const F extent = of_axis(last[0], last[1], last[2]) - base;
    const F scale = S::select(extent > F(kFlatExtent), F(kBins - 1) / extent, F(0.0f));
    const I bin = I::load(kCutLanes<kBins>.bin);
    const I low_bits = I::splat(static_cast<int32_t>(kBins - 1));
    SideBounds left, right;
    I left_weight = I::splat(0);
    for (uint32_t i = 0; i < range.count(); ++i) {
      const Reference& reference = references[range.begin + i];
      const F low[3] = {reference.min[0], reference.min[1], reference.min[2]};
      const F high[3] = {reference.max[0], reference.max[1], reference.max[2]};
      const F centre = of_axis(centres[i][0], centres[i][1], centres[i][2]);
      const M on_left = (S::bits_of((centre - base) * scale + F(kRoundToInteger)) & low_bits) < bin;
      left.grow(on_left, low, high);
      right.grow(!on_left, low, high);
      left_weight =
          left_weight + S::select(on_left, I::splat(static_cast<int32_t>(reference.weight)), I::splat(0));
      on_left_[i] = static_cast<uint16_t>(on_left.bits());
    }
    const I right_weight = I::splat(static_cast<int32_t>(range.weight)) - left_weight;
    const F cost = left.area() * S::to_float(left_weight) + right.area() * S::to_float(right_weight);
    // The area of an empty side is infinite and its weight 0; the product is NaN, which must not win.
    cost_ = S::select(cost < F(kHuge), cost, F(kHuge));
    left.store(left_);
    right.store(right_);
    left_weight.store(left_weight_);
  }

  /// Returns the lane with the least cost, or kNone.
  uint32_t best() const {
    alignas(64) float lanes[kSimdLanes];
    cost_.store(lanes);
    const F4 four = S::min(S::min(F4::load(lanes), F4::load(lanes + 4)),
                           S::min(F4::load(lanes + 8), F4::load(lanes + 12)));
    alignas(16) float last[4];
    four.store(last);
    const float a = last[0] < last[1] ? last[0] : last[1], b = last[2] < last[3] ? last[2] : last[3];
    const float least = a < b ? a : b;
    return least < kHuge ? static_cast<uint32_t>(__builtin_ctz((cost_ == F(least)).bits())) : kNone;
  }

  /// Sets weight and bounds of both sides of the split in a lane.
  void sides_of(uint32_t lane, uint32_t weight, Range<S>& left, Range<S>& right) const {
    left.box = left_.at(lane);
    right.box = right_.at(lane);
    left.weight = static_cast<uint32_t>(left_weight_[lane]);
    right.weight = weight - left.weight;
  }
  /// Returns 1 if reference i of the range is on the left of the split in a lane, otherwise 0.
  uint32_t is_on_left(uint32_t i, uint32_t lane) const { return on_left_[i] >> lane & 1; }

private:
  using F = typename S::F;
  using I = typename S::I;
  using M = typename S::M;
  using F4 = typename S::F4;

  struct CutBounds {
    alignas(64) float low[3][kSimdLanes];
    alignas(64) float high[3][kSimdLanes];

    LaneAabb<S> at(uint32_t lane) const {
      return {four<S>(low[0][lane], low[1][lane], low[2][lane], 0.0f),
              four<S>(high[0][lane], high[1][lane], high[2][lane], 0.0f)};
    }
  };

  /// The bounds of one side, for the split plane of each lane.
  struct SideBounds {
    F low[3] = {kHuge, kHuge, kHuge};
    F high[3] = {-kHuge, -kHuge, -kHuge};

    void grow(const M& lanes, const F (&min)[3], const F (&max)[3]) {
      for (int axis = 0; axis < 3; ++axis) {
        low[axis] = S::select(lanes, S::min(low[axis], min[axis]), low[axis]);
        high[axis] = S::select(lanes, S::max(high[axis], max[axis]), high[axis]);
      }
    }
    F area() const {
      const F x = high[0] - low[0], y = high[1] - low[1], z = high[2] - low[2];
      return x * y + (x + y) * z;
    }
    void store(CutBounds& to) const {
      for (int axis = 0; axis < 3; ++axis) {
        low[axis].store(to.low[axis]);
        high[axis].store(to.high[axis]);
      }
    }
  };

  F cost_;
  CutBounds left_, right_;
  alignas(64) int32_t left_weight_[kSimdLanes];
  uint16_t on_left_[kFewReferences]; ///< index: reference; a bit for each lane
};

} // namespace celltrace::kernel::bvh

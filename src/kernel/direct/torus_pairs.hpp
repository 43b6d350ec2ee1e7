// Tests of single rays with single tori that wait for each other. Kernel dialect, where memory is direct.
//
// Most rays that come to a torus's bounds miss it, which is soon known. For the others there is the quartic,
// which would be solved for few rays of a packet where they have scattered. Pairs of a ray and a torus are
// gathered instead, until there are as many as a vector has lanes.
#pragma once

#include "kernel/direct/recent_occluders.hpp"
#include "kernel/primitives/torus.hpp"
#include "kernel/tuning.hpp"

namespace celltrace::kernel {

template <class Spu> class TorusPairs {
public:
  using S = typename Spu::simd;
  using F = typename S::F;
  using M = typename S::M;

  /// Tori that occlude rays are added to `recent` if that remembers any.
  explicit TorusPairs(RecentOccluders& recent) : recent_(recent) {}

  /// Until end_traversal() the rays of `query` may wait for each other, if that pays: of late most tests were
  /// of pairs enough. From time to time it is tried.
  void begin_traversal(RayQuery& query) { query_ = pause_ == 0 ? &query : nullptr; }
  bool may_wait() const { return query_ != nullptr; }

  /// Lets those of that query's rays that come near a torus wait. `rays` and `ratio` are in its space, `self`
  /// is its offset. False: these are too many to wait.
  [[gnu::noinline]] bool add(const LocalRays<S>& rays, float ratio, uint32_t self) {
    const uint32_t near = TorusPrimitive::may_hit<S>(rays, F(ratio)).bits() & query_->lanes;
    const auto lanes = static_cast<uint32_t>(__builtin_popcount(near));
    if (lanes > tuning::kMostRaysThatWait) return false;
    if (lanes == 0) return true;
    if (count_ + lanes > S::kLanes) test();
    VectorLanes origin, direction;
    origin.template store<S>(rays.origin);
    direction.template store<S>(rays.direction);
    const uint32_t start_here = rays.starts_here.bits();
    for (uint32_t left = near; left != 0; left &= left - 1, ++count_) {
      const auto lane = static_cast<uint32_t>(__builtin_ctz(left));
      copy_lane(origin, lane, origin_, count_);
      copy_lane(direction, lane, direction_, count_);
      ratio_.lane[count_] = ratio;
      start_here_ |= (start_here >> lane & 1) << count_;
      pairs_[count_] = {self, lane};
    }
    return true;
  }

  /// Tests what still waits.
  void end_traversal() {
    if (pause_ != 0) {
      --pause_;
      return;
    }
    score_ += count_ >= kFewest ? 1 : -1;
    if (score_ < 0) {
      pause_ = kPause;
      score_ = kTrials;
    }
    if (count_ != 0) test();
    query_ = nullptr;
  }

private:
  static constexpr uint32_t kFewest = 8; ///< pairs that one test is faster for than one for each torus
  static constexpr int32_t kTrials = 2;  ///< traversals with fewer, more than others, until no ray waits
  static constexpr int32_t kMostScore = 64;
  static constexpr uint32_t kPause = 2048; ///< traversals in which none does

  struct Pair {
    uint32_t torus, lane;
  };

  /// The closest hits so far become those of rays that hit closer, and rays to lights are occluded.
  [[gnu::noinline]] void test() {
    const uint32_t all = (1u << count_) - 1;
    if (count_ >= kFewest && score_ < kMostScore) ++score_;
    count_ = 0;
    const bool shadows = query_->hits == nullptr;
    const FloatLanes& limits = shadows ? *query_->distance : query_->hits->distance;
    FloatLanes limit;
    for (uint32_t i = 0; i < S::kLanes; ++i) {
      // Lanes without a pair hit nothing.
      const bool is_pair = (all >> i & 1) != 0;
      limit.lane[i] = is_pair ? limits.lane[pairs_[i].lane] : 0.0f;
      if (!is_pair) ratio_.lane[i] = ratio_.lane[0];
    }
    const float nearest = shadows ? kShadowEpsilon : kMinHitDistance;
    const AskedCrossings asked = {nearest, &limit};
    const LocalRays<S> rays = {origin_.template load<S>(), direction_.template load<S>(),
                               M::from_bits(start_here_), &asked};
    const F ratio = F::load(ratio_.lane);
    const bool start_elsewhere = start_here_ == 0;
    start_here_ = 0;
    if (shadows && start_elsewhere)
      return occlude(TorusPrimitive::crossed<S>(M::from_bits(all), rays, ratio, nullptr).bits());
    Crossings<S> crossings[TorusPrimitive::kCrossingPairs];
    TorusPrimitive::intersect_local<S>(rays, {ratio, F(0.0f), M::none()}, crossings);
    F at(kEveryCrossing);
    const auto take = [&](const M& hit, const F& distance) {
      at = S::min(at, S::select(hit & (distance > F(nearest)), distance, F(kEveryCrossing)));
    };
    for (const Crossings<S>& c : crossings) {
      take(c.near_hit, c.near);
      take(c.far_hit, c.far);
    }
    const F farthest = F::load(limit.lane);
    if (shadows) return occlude((at < farthest - F(kShadowEpsilon)).bits() & all);
    keep_closest(at, (at <= farthest).bits() & all);
  }
  void occlude(uint32_t dark) {
    for_each_lane(dark, [&](uint32_t i) {
      query_->lanes &= ~(1u << pairs_[i].lane);
      if (recent_.remembers) recent_.add(pairs_[i].torus);
    });
  }
  /// A ray may be in several pairs.
  void keep_closest(const F& distance, uint32_t hit) {
    FloatLanes at;
    distance.store(at.lane);
    for_each_lane(hit, [&](uint32_t i) {
      keep_closer({at.lane[i], 0.0f, 0.0f, pairs_[i].torus}, pairs_[i].lane, *query_->hits);
    });
  }

  RecentOccluders& recent_;
  RayQuery* query_ = nullptr;
  uint32_t pause_ = 0;
  int32_t score_ = kTrials;
  uint32_t count_ = 0, start_here_ = 0;
  // Rays and tori by pair, in the space of the torus.
  VectorLanes origin_ = {}, direction_ = {};
  FloatLanes ratio_ = {};
  Pair pairs_[S::kLanes];
};

} // namespace celltrace::kernel

// Shadow rays of several packets against one torus. Kernel dialect, where memory is direct.
//
// Of most packets that come to a torus's bounds only few rays come near its tube. Those of all are gathered,
// so that the quartic is solved for as many at a time as a vector has lanes.
#pragma once

#include "kernel/direct/clipping.hpp"
#include "kernel/primitives/torus.hpp"

namespace celltrace::kernel {

template <class S> class TorusShadows {
public:
  using F = typename S::F;
  using M = typename S::M;

  /// Of the queries lanes are removed that the torus occludes, where `clipping` leaves something of it.
  TorusShadows(float ratio, const ClippingObject& clipping, RayQuery* queries)
      : ratio_(ratio), clipping_(clipping), queries_(queries) {}

  /// Tests some of a query's rays, which do not start on it, at once or later. `rays` are in its space.
  void add(uint32_t query, const LocalRays<S>& rays, uint32_t lanes) {
    const F ratio(ratio_);
    lanes &= TorusPrimitive::may_hit<S>(rays, ratio).bits();
    if (lanes == 0) return;
    if (is_clipped()) clipping_.template clip<S>(*queries_[query].rays, clipped_);
    const uint32_t dark = lanes & TorusPrimitive::crossed_in_plane<S>(rays, ratio, clipped()).bits();
    queries_[query].lanes &= ~dark;
    lanes &= ~dark;
    if (lanes != 0) gather(query, rays, lanes);
  }
  /// Tests those that are left.
  void finish() {
    if (count_ != 0) test();
  }

private:
  /// Lanes of a query, from this place on.
  struct Run {
    uint32_t query, lanes, first;
  };

  void gather(uint32_t query, const LocalRays<S>& rays, uint32_t lanes) {
    const auto count = static_cast<uint32_t>(__builtin_popcount(lanes));
    const auto numbers = S::lane_numbers(lanes);
    const auto keep = [&](const F& of_rays, float* kept) {
      S::pick(of_rays, numbers).store_unaligned(kept + count_);
    };
    keep(rays.origin.x, origin_[0]);
    keep(rays.origin.y, origin_[1]);
    keep(rays.origin.z, origin_[2]);
    keep(rays.direction.x, direction_[0]);
    keep(rays.direction.y, direction_[1]);
    keep(rays.direction.z, direction_[2]);
    keep(F::load(queries_[query].distance->lane), limit_);
    if (is_clipped()) {
      keep(F::load(clipped_.enter.lane), enter_);
      keep(F::load(clipped_.leave.lane), leave_);
    }
    runs_[run_count_++] = {query, lanes, count_};
    count_ += count;
    if (count_ >= S::kLanes) test();
  }

  [[gnu::noinline]] void test() {
    const uint32_t tested = count_ < S::kLanes ? count_ : S::kLanes;
    FloatLanes limit;
    F::load(limit_).store(limit.lane);
    const AskedCrossings asked = {kShadowEpsilon, &limit};
    const LocalRays<S> rays = {{F::load(origin_[0]), F::load(origin_[1]), F::load(origin_[2])},
                               {F::load(direction_[0]), F::load(direction_[1]), F::load(direction_[2])},
                               M::none(),
                               &asked};
    if (is_clipped()) {
      F::load(enter_).store(clipped_.enter.lane);
      F::load(leave_).store(clipped_.leave.lane);
    }
    const uint32_t dark =
        TorusPrimitive::crossed<S>(M::from_bits((1u << tested) - 1), rays, F(ratio_), clipped()).bits();
    for (uint32_t i = 0; i < run_count_; ++i)
      queries_[runs_[i].query].lanes &= ~S::spread(dark >> runs_[i].first, runs_[i].lanes);
    const Run last = runs_[run_count_ - 1];
    run_count_ = 0;
    count_ -= tested;
    if (count_ == 0) return;
    const uint32_t done = S::spread((1u << (S::kLanes - last.first)) - 1, last.lanes);
    runs_[run_count_++] = {last.query, last.lanes & ~done, 0};
    for (uint32_t axis = 0; axis < 3; ++axis) {
      F::load(origin_[axis] + S::kLanes).store(origin_[axis]);
      F::load(direction_[axis] + S::kLanes).store(direction_[axis]);
    }
    for (float* const numbers : {limit_, enter_, leave_})
      F::load(numbers + S::kLanes).store(numbers);
  }

  bool is_clipped() const { return clipping_.object != nullptr; }
  const ClippedRays* clipped() const { return is_clipped() ? &clipped_ : nullptr; }

  const float ratio_;
  const ClippingObject clipping_;
  ClippedRays clipped_;
  RayQuery* const queries_;
  uint32_t run_count_ = 0, count_ = 0;
  Run runs_[S::kLanes];
  // By ray that waits, in the space of the torus.
  static constexpr uint32_t kRoom = 2 * S::kLanes;
  alignas(64) float origin_[3][kRoom] = {}, direction_[3][kRoom] = {};
  alignas(64) float limit_[kRoom] = {}, enter_[kRoom] = {}, leave_[kRoom] = {};
};

} // namespace celltrace::kernel

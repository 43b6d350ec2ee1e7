// Shadow rays of several packets against one object of a shape with kHasShadowTest. Kernel dialect, for
// direct memory.
//
// In most packets that reach such an object's bounds, only few rays come near its surface, such as the tube
// of a torus. The near rays of all packets are gathered, so that the object's equation is solved for as many
// rays at a time as a vector has lanes.
#pragma once

#include "kernel/direct/clipping.hpp"
#include "kernel/direct/wavefront_queue.hpp"
#include "kernel/primitives/local_shape.hpp"

namespace celltrace::kernel {

/// Rays in the space of an object, and the distances between which clipping leaves a part of it.
template <class Shape, class S> class ShapeShadowRays : public WorkKind {
public:
  using F = typename S::F;
  using M = typename S::M;

  struct Source {
    uint32_t query;
    const LocalRays<S>& rays;
    const FloatLanes& distance;
    const ClippedRays* clipped; ///< null: the object is not clipped
  };

  void begin() { run_count_ = 0; }
  void put(const Source& from, uint32_t lanes, uint32_t to) {
    const auto order = S::lane_numbers(lanes);
    const auto store = [&](uint32_t i, const F& of_rays) {
      S::pick(of_rays, order).store_unaligned(values_[i] + to);
    };
    store(0, from.rays.origin.x);
    store(1, from.rays.origin.y);
    store(2, from.rays.origin.z);
    store(3, from.rays.direction.x);
    store(4, from.rays.direction.y);
    store(5, from.rays.direction.z);
    store(6, F::load(from.distance.lane));
    if (from.clipped != nullptr) {
      store(7, F::load(from.clipped->enter.lane));
      store(8, F::load(from.clipped->leave.lane));
    }
    runs_[run_count_++] = {from.query, lanes, to};
  }
  /// Removes the lanes that the object occludes from their queries.
  [[gnu::noinline]] void run(uint32_t, uint32_t lanes, float parameter, const ClippingObject& clipping,
                             RayQuery* queries) const {
    const auto at = [&](uint32_t i) { return F::load(values_[i]); };
    FloatLanes limit;
    at(6).store(limit.lane);
    ClippedRays clipped;
    clipped.keeps_inside = clipping.keeps_inside;
    at(7).store(clipped.enter.lane);
    at(8).store(clipped.leave.lane);
    const CrossingRequest request = {kShadowEpsilon, &limit};
    const LocalRays<S> rays = {{at(0), at(1), at(2)}, {at(3), at(4), at(5)}, M::none(), &request};
    const ClippedRays* const where = clipping.object != nullptr ? &clipped : nullptr;
    const uint32_t dark = Shape::template crossed<S>(M::from_bits(lanes), rays, F(parameter), where).bits();
    for (uint32_t i = 0; i < run_count_; ++i)
      queries[runs_[i].query].lanes &= ~S::spread(dark >> runs_[i].first, runs_[i].lanes);
  }

private:
  static constexpr uint32_t kValues = 9; ///< values per ray
  /// Lanes of a query, which begin at lane `first`.
  struct Run {
    uint32_t query, lanes, first;
  };

  uint32_t run_count_;
  Run runs_[S::kLanes];
  alignas(64) float values_[kValues][2 * S::kLanes] = {}; ///< vectors are stored at any lane
};

/// Removes lanes that an object, clipped by `clipping`, occludes from queries of shadow rays.
template <class Shape, class S> class ShapeShadows {
public:
  ShapeShadows(float parameter, const ClippingObject& clipping, RayQuery* queries)
      : parameter_(parameter), clipping_(clipping), queries_(queries) {}

  /// Tests some of a query's rays, which must not start on the object, now or later. `rays` are in its space.
  void add(uint32_t query, const LocalRays<S>& rays, uint32_t lanes) {
    const typename S::F parameter(parameter_);
    lanes &= Shape::template may_hit<S>(rays, parameter).bits();
    if (lanes == 0) return;
    const ClippedRays* const clipped = clipping_.object != nullptr ? &clipped_ : nullptr;
    if (clipped != nullptr) clipping_.template clip<S>(*queries_[query].rays, clipped_);
    const uint32_t dark = lanes & Shape::template surely_crossed<S>(rays, parameter, clipped).bits();
    queries_[query].lanes &= ~dark;
    queue_.push(0, lanes & ~dark, {query, rays, *queries_[query].distance, clipped}, parameter_, clipping_,
                queries_);
  }
  /// Tests the remaining rays.
  void finish() { queue_.flush(parameter_, clipping_, queries_); }

private:
  const float parameter_;
  const ClippingObject clipping_;
  RayQuery* const queries_;
  ClippedRays clipped_ = {};
  ShapeShadowRays<Shape, S> packet_;
  WavefrontQueue<ShapeShadowRays<Shape, S>> queue_{&packet_};
};

} // namespace celltrace::kernel

// The ray trees of a bundle in direct memory: rays that leave their packets fill new packets together with
// rays of other trees. Kernel dialect.
#pragma once

#include "kernel/direct/bundle_pool.hpp"
#include "kernel/direct/bundle_queries.hpp"
#include "kernel/direct/fractal_ahead.hpp"
#include "kernel/program/bundle_tracer.hpp"
#include "kernel/shading/material_lanes.hpp"

namespace celltrace::kernel {

/// Extends BundleTracer, which is `Tracer`.
template <class Tracer, class Spu> class PooledTrees {
protected:
  using S = typename Spu::simd;
  using F = typename S::F;

  struct PrimaryRays {
    RayPacket rays;
    template <class Member> static RayPacket& of(Member& member) { return member.rays; }
  };

  PooledTrees(Spu& spu, SampleBundle<Spu>* samples) : pool_(spu, samples) {}

  // --- search ---

  template <class Put, class Fill> bool search(uint32_t column, uint32_t row, Put put, Fill fill) {
    const auto sort = [&] { pool_.sort(all().scene_, all().frame_, all().store_.members); };
    if (all().takes_samples()) {
      all().place(0, 0);
      all().find_hits([&](RayQuery* queries) { traversal().intersect_from_origin(queries, kPackets); }, sort);
      return true;
    }
    const FrameBlock& frame = all().frame_;
    const PinholeBundle<S> bundle(frame, column, row);
    const bool missed = !traversal().enter(bundle);
    const bool is_traced = has_atmosphere(frame) || (frame.light_features & light_feature::first_hits) != 0;
    const bool plain = frame.sky == kNoOffset && !is_traced;
    if (missed && plain && is_whole(column, row)) {
      fill(column * kEdge, row * kEdge, all().tracer_.background(kPackets * kSimdLanes));
      return false;
    }
    all().place(column, row);
    if (missed && !is_traced) {
      all().for_each_member([&](auto& member) {
        if (!plain) make_primary_rays(all().scene_.spu(), frame, member.column, member.row, member.rays);
        put(member.column, member.row, all().tracer_.background(member.rays, member.lanes));
      });
      return false;
    }
    all().find_hits([&](RayQuery* queries) { traversal().intersect_from_pinhole(queries, bundle); }, sort);
    return true;
  }

  // --- surfaces ---

  void begin_trees() {
    tracer().pooling().queue = BundlePool<Spu>::has_own_lanes(all().frame_) ? nullptr : &pool_.rays;
    pool_.begin();
    tracer().add_transparency_to(pool_.transparency);
    if (auto* const fractals = all().scene_.pattern_caches().fractals;
        fractals != nullptr && fractals->begin())
      iterate_fractals(*fractals);
  }
  /// Prefetches extra records of member `i`.
  void hint(uint32_t i) {
    if (all().frame_.object_count <= tuning::kObjectsInCoreCache || i == kPackets) return;
    const auto& member = all().store_.members[i];
    hint_extras(all().scene_, member.hits, member.hit);
  }
  template <class Member> [[gnu::always_inline]] bool shade_end(Member& member) {
    pool_.reset_transparency();
    if (auto* const fractals = all().scene_.pattern_caches().fractals) fractals->show(member.number);
    HitPoints<S>& points = all().store_.points;
    if (member.hit != 0) {
      find_hit_points(all().scene_, member.rays, member.hits, member.hit, points);
      member.point = points.point;
    }
    VectorLanes seen;
    LightRound only = all().begin_round(0, member);
    if (!tracer().ends_at_once(member.rays, member.lanes, member.hits, points, only, seen)) return false;
    if (member.hit != 0 && only.is_fresh) only.template clear<S>();
    pool_.put(member.number, member.lanes, seen);
    return true;
  }
  template <class Member> void begin_tree(const Member& member) {
    pool_.begin_tree(member.number, tracer().pooling().pixels);
  }
  /// Returns true for a root, whose points shade_end() has already found.
  static bool has_hit_points(const void* root) { return root != nullptr; }
  uint32_t take_hits() {
    return tracer().take_hits([&](uint32_t missed) { return defer_sky(missed); });
  }
  /// Leaves hits without secondary rays to shade_ending(), if they are few. Returns these hits.
  uint32_t defer_ends(uint32_t hit) {
    const HitPoints<S>& points = all().store_.points;
    const uint32_t ends = hit & ~(points.spawning | points.blended);
    if (ends == 0 || !may_wait(ends) || !pool_.hits.has_room()) return 0;
    pool_.hits.push(0, ends, {waiting_rays(), tracer().hits()});
    return ends;
  }
  template <class Member> void store_tree(const Member& member) {
    pool_.put_tree(member.number, member.lanes, tracer().light());
  }
  void end_tree() {
    while (pool_.hits.has_full())
      pool_.hits.run_next(*this);
  }
  /// Traces the rays that have left their packets. Returns false if it was stopped.
  template <class Stopped> bool finish(Stopped stopped) {
    while (!pool_.rays.empty() || !pool_.hits.empty()) {
      if (stopped()) return false;
      if (pool_.hits.has_full() || pool_.rays.empty())
        pool_.hits.run_next(*this);
      else if (!pool_.rays.run_next(*this, stopped))
        return false;
    }
    pool_.skies.flush(*this);
    pool_.shadows.flush(*this);
    return true;
  }
  void drop() { pool_.drop(); }

  // --- light ---

  /// Leaves light of a few lanes of the current node to light_points(). Returns false if the light has to be
  /// traced now, as it does not go to pixels or its rays have a packet of their own.
  bool defer_light(uint32_t number, uint32_t lanes, const VectorLanes& colour) {
    if (lanes == 0 || !may_wait(lanes) || number >= ShadowPoints::kKeys) return false;
    VectorLanes point;
    point.template store<S>(all().store_.points.point);
    pool_.shadows.push(number, lanes,
                       {point, tracer().hits().object, colour, tracer().pooling().pixels,
                        all().shadows_.needs_interiors() ? &tracer().node() : nullptr},
                       *this);
    return true;
  }
  template <class Member> void add_deferred_light(Member& member) {
    pool_.add(member.number, member.hit, LightRound::from(all().frame_, 0, member.light));
  }

  // --- pixels ---

  template <class Member> uint32_t lanes_with_ray(const Member& member) const {
    return pool_.with_ray(member.number);
  }
  template <class Member> V3<S> light_of(Member& member) {
    return pool_.light_of(member.number, member.hit, LightRound::from(all().frame_, 0, member.light));
  }

public:
  // --- the bodies of the wavefront queues ---

  /// Traces a packet of pooled rays and their trees. Returns false if it was stopped.
  template <class Stopped> bool trace_pooled(const PooledRays& rays, uint32_t lanes, const Stopped& stopped) {
    tracer().begin(rays);
    pool_.reset_transparency();
    all().find_closest();
    all().shade_node(nullptr);
    if (!all().trace_tree(stopped)) return false;
    pool_.add_tree(tracer().pooling().pixels, lanes, tracer().light());
    return true;
  }
  /// Shades hits without secondary rays, between trees.
  void shade_ending(const EndingHits& ending, uint32_t lanes) {
    tracer().begin(ending.rays);
    tracer().hits() = ending.hits;
    find_hit_points(all().scene_, tracer().node().rays, tracer().hits(), lanes, all().store_.points);
    all().shade_points(nullptr, lanes);
    pool_.add(tracer().pooling().pixels, lanes, tracer().light());
  }
  /// Adds the sky that rays see to their pixels.
  void see_sky(const SkyRays& rays, uint32_t lanes) {
    VectorLanes light;
    light.template store<S>(tracer().behind(rays.direction, lanes) * rays.throughput.template load<S>());
    pool_.add(rays.pixels, lanes, light);
  }
  /// Adds the light that points receive from a lamp to their pixels.
  void light_points(uint32_t number, ShadowPoints& points, uint32_t lanes) {
    for_each_light(all().scene_, all().frame_, number, 1, [&](uint32_t, const LightRecord& light) {
      all().shadows_.set_interiors(&points.interiors);
      all().shadows_.trace(light, all().store_.lit.to_light, points.point.template load<S>(), points.object,
                           false, lanes, points.light);
    });
    pool_.add(points.pixels, lanes, points.light);
  }

private:
  static constexpr uint32_t kEdge = kBundleEdge<Spu>;
  static constexpr uint32_t kPackets = kBundlePackets<Spu>;

  Tracer& all() { return static_cast<Tracer&>(*this); }
  auto& tracer() { return all().tracer_; }
  auto& traversal() { return all().shadows_.traversal(); }

  bool is_whole(uint32_t column, uint32_t row) {
    constexpr uint32_t kPixels = kEdge * kPacketEdge;
    return (column + 1) * kPixels <= all().frame_.width && (row + 1) * kPixels <= all().frame_.height;
  }

  /// Finds the values of fractals at the hits of the primary rays.
  template <class Fractals> [[gnu::noinline]] void iterate_fractals(Fractals& fractals) {
    for (auto& member : all().store_.members) {
      if (member.hit == 0) continue;
      HitPoints<S>& points = all().store_.points;
      find_hit_points(all().scene_, member.rays, member.hits, member.hit, points);
      add_fractals(all().scene_, member.number, points.material, points.point,
                   member.hit & points.textured & ~points.blended, fractals);
    }
    fractals.run();
  }

  /// Returns true if some lanes of the current node may wait in a queue: their light goes to pixels,
  /// independent of the rays' packet, and they are few.
  bool may_wait(uint32_t lanes) {
    return tracer().pooling().queue != nullptr && tracer().node().target == 0 && had_better_wait(lanes);
  }
  PooledRays::Source waiting_rays() { return {tracer().node(), tracer().pooling().pixels}; }
  /// Leaves a few lanes of the current node without a hit to see_sky(). Returns false if their sky has to be
  /// added now.
  bool defer_sky(uint32_t missed) {
    if (all().frame_.sky == kNoOffset || !may_wait(missed)) return false;
    pool_.skies.push(0, missed, waiting_rays(), *this);
    return true;
  }

  BundlePool<Spu> pool_;
};

} // namespace celltrace::kernel

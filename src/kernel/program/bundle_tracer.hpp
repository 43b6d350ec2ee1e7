// What a bundle of packets sees: what its primary rays hit and what light comes there is searched for
// together; from there on each packet's tree of rays is worked off by itself. Kernel dialect.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/accel/traversal.hpp"
#include "kernel/cameras/primary_rays.hpp"
#include "kernel/direct/fractal_ahead.hpp"
#include "kernel/program/bundle_pool.hpp"
#include "kernel/program/pixel_sampler.hpp"
#include "kernel/shading/ray_tracer.hpp"
#include "kernel/shading/shadow_tracer.hpp"

namespace celltrace::kernel {

template <class Spu, uint32_t kAccelerators = kAnyAccelerator> class BundleTracer {
public:
  using S = typename Spu::simd;
  using F = typename S::F;

  /// `spill`: room for FrameBlock::ray_stack_nodes nodes. `samples` says where the rays of frames of samples
  /// go through; null: there are no such frames. Inlined: it would take much of an SPE's stack by itself.
  [[gnu::always_inline]] BundleTracer(Spu& spu, const FrameBlock& frame, SceneAccess<Spu>& scene, ea_t spill,
                                      SampleBundle<Spu>* samples)
      : frame_(frame), scene_(scene), samples_(samples), scratch_(*spu.template allocate<RayNode>()),
        tracer_(spu, frame, scene, spill, frame.ray_stack_nodes, scratch_),
        store_(*spu.template allocate<Store>()), shadows_(spu, frame, scene, scratch_, tracer_.counters()),
        pool_(spu, samples) {}

  /// Calls `put(column, row, colours)` for each packet in the picture of the bundle at (column, row); that
  /// counts bundles, `put` packets. Or `fill(column, row, colour)` where all of the bundle has one colour and
  /// is in the picture. In a frame of samples the bundle is theirs, and at (0, 0). Asks `stopped()` before
  /// each further node of a ray tree, of which there may be as many as take minutes; once that is true the
  /// rest of the bundle is left out.
  template <class Put, class Fill, class Stopped>
  void trace(uint32_t column, uint32_t row, Put put, [[maybe_unused]] Fill fill, Stopped stopped) {
    if (takes_samples()) column = row = 0;
    if constexpr (kHasBundleViews<Spu>) {
      if (takes_samples()) {
        place(0, 0);
        find_hits([&](RayQuery* queries) { shadows_.traversal().intersect_from_origin(queries, kPackets); });
      } else {
        const PinholeBundle<S> bundle(frame_, column, row);
        const bool missed = !shadows_.traversal().enter(bundle);
        const bool asks_more = has_atmosphere(frame_) || (frame_.light_ways & light_way::first_hits) != 0;
        const bool plain = frame_.sky == kNoOffset && !asks_more;
        if (missed && plain && is_whole(column, row))
          return fill(column * kEdge, row * kEdge, tracer_.background(kPackets * kSimdLanes));
        place(column, row);
        if (missed && !asks_more)
          return for_each_member([&](Member& member) {
            if (!plain) make_primary_rays(scene_.spu(), frame_, member.column, member.row, rays_of(member));
            put(member.column, member.row, tracer_.background(rays_of(member), member.lanes));
          });
        find_hits([&](RayQuery* queries) { shadows_.traversal().intersect(queries, bundle); });
      }
    } else {
      place(column, row);
      find_hits([&](RayQuery* queries) { shadows_.traversal().intersect(queries, kPackets); });
    }
    if (!trace_trees(stopped)) {
      if constexpr (kPoolsRays<Spu>) pool_.drop();
      return;
    }
    for (uint32_t i = 0; i < kPackets; ++i) {
      Member& member = store_.members[i];
      if (member.pixels == 0) continue;
      V3<S> seen = light_of(i);
      uint32_t with_ray = member.lanes;
      if constexpr (kPoolsRays<Spu>) with_ray = pool_.with_ray(i);
      if (with_ray != member.pixels) {
        const F black(0.0f);
        seen = select<S>(S::M::from_bits(with_ray), seen, {black, black, black});
        if (samples_ != nullptr)
          for_each_lane(member.pixels & ~with_ray,
                        [&](uint32_t lane) { samples_->at[i].clear.lane[lane] = 1.0f; });
      }
      put(member.column, member.row, seen);
    }
  }

  void begin_frame() {
    tracer_.reset_counters();
    shadows_.traversal().begin_frame();
  }
  const RayCounters& ray_counters() const { return tracer_.counters(); }
  const TraversalCounters& traversal_counters() const { return shadows_.traversal().counters(); }
  uint32_t spilled_nodes() const { return tracer_.spilled_nodes(); }

  /// Local store that nothing is in between two calls of trace().
  uint8_t* scratch() { return reinterpret_cast<uint8_t*>(&store_); }
  static constexpr uint32_t scratch_bytes() { return static_cast<uint32_t>(sizeof(Store)); }

private:
  static constexpr uint32_t kEdge = kBundleEdge<Spu>;
  static constexpr uint32_t kPackets = kBundlePackets<Spu>;
  static constexpr uint32_t kFirstHitTag = 7;

  /// What it takes to ask what comes of light that points send on.
  struct LitPoints {
    ShadowRays to_light;
    VectorLanes light[kLightsARound]; ///< that they send on, gathered in a round
  };
  /// What is kept of hits once they are shaded; the objects are where they were.
  struct ShadedHits {
    WordLanes object;
    VectorLanes seen; ///< where rays stay in their packets: all but the gathered light
  };
  struct PrimaryRays {
    RayPacket rays;
  };
  struct Member : LitPoints, Present<PrimaryRays, kHasRoomForCode<Spu>> {
    V3<S> point; ///< once they are shaded: where they have hit something
    union {
      HitPacket hits; ///< until they are shaded
      ShadedHits shaded;
    };
    uint32_t column, row;
    uint32_t pixels;     ///< lanes in the picture
    uint32_t lanes, hit; ///< of them, those that have a ray; of these, those that hit something
  };
  struct Store {
    Member members[kPackets];
    // Of the node that is being shaded.
    HitPoints<S> points;
    union {
      LitPoints lit;             ///< if it is no root
      FirstHitRecord first_hits; ///< of a root, on their way to main memory
    };
  };

  /// The primary rays of a member: elsewhere than those to a light, or where these will be.
  static RayPacket& rays_of(Member& member) {
    if constexpr (kHasRoomForCode<Spu>)
      return member.rays;
    else
      return member.to_light.rays;
  }
  /// Calls `visit` with each packet in the picture.
  template <class Visit> void for_each_member(const Visit& visit) {
    for (uint32_t i = 0; i < kPackets; ++i)
      if (store_.members[i].pixels != 0) visit(store_.members[i]);
  }

  bool is_whole(uint32_t column, uint32_t row) const {
    constexpr uint32_t kPixels = kEdge * kPacketEdge;
    return (column + 1) * kPixels <= frame_.width && (row + 1) * kPixels <= frame_.height;
  }
  void place(uint32_t column, uint32_t row) {
    for (uint32_t i = 0; i < kPackets; ++i) {
      Member& member = store_.members[i];
      member.column = column * kEdge + i % kEdge;
      member.row = row * kEdge + i / kEdge;
      const bool inside = member.column < frame_.packet_columns && member.row < frame_.packet_rows;
      member.pixels = inside ? lanes_in_picture(frame_, member.column, member.row) : 0;
      if (takes_samples()) member.pixels = samples_->lanes[i];
      member.lanes = member.pixels;
    }
  }

  bool takes_samples() const { return static_cast<FramePurpose>(frame_.purpose) == FramePurpose::samples; }
  /// Those of a member; returns the lanes that have one.
  uint32_t make_rays(uint32_t number) {
    Member& member = store_.members[number];
    F x = pixels_across<S>(frame_, member.column), y = pixels_down<S>(frame_, member.row);
    if (takes_samples()) {
      x = F::load(samples_->at[number].x.lane);
      y = F::load(samples_->at[number].y.lane);
    }
    return make_rays_through(scene_.spu(), frame_.camera, x, y, rays_of(member));
  }

  /// `run` answers the queries of all packets; those of packets outside are for nothing.
  template <class Run> void find_hits(Run run) {
    RayQuery queries[kPackets];
    for (uint32_t i = 0; i < kPackets; ++i) {
      Member& member = store_.members[i];
      if (member.pixels != 0) member.lanes &= make_rays(i);
      queries[i] = {&rays_of(member), &member.hits, nullptr, nullptr, member.lanes};
    }
    run(queries);
    if constexpr (kPoolsRays<Spu>) pool_.sort(scene_, frame_, store_.members);
    for (uint32_t i = 0; i < kPackets; ++i) {
      Member& member = store_.members[i];
      member.hit = hit_lanes<S>(member.hits, member.lanes);
    }
  }

  /// Finds out what comes of the light that has been gathered at what the primary rays hit. Not inlined:
  /// records of lights are not on the stack while rays are shaded.
  CELLTRACE_ONE_COPY void find_lights() {
    const LightRound lights = LightRound::from(frame_, 0, nullptr);
    shadows_.set_interiors(nullptr);
    for_each_light(scene_, frame_, 0, lights.count, [&](uint32_t number, const LightRecord& light) {
      if (is_asked_for(light)) find_light(number, light);
    });
  }
  void find_light(uint32_t number, const LightRecord& light) {
    RayQuery queries[kPackets];
    const bool by_packet = shadows_.asks_by_packet(light);
    const bool is_at_pinhole = shadows_.is_at_pinhole(light);
    uint32_t asked = 0;
    for (uint32_t i = 0; i < kPackets; ++i) {
      Member& member = store_.members[i];
      if (member.hit == 0) continue;
      scene_.spu().compute(scalar_work::kBundleLight);
      VectorLanes& colour = member.light[number];
      const uint32_t lanes = lanes_above<S>(colour, member.hit, kLeastLight);
      if (is_at_pinhole) {
        shadows_.take_unoccluded(lanes, colour);
        continue;
      }
      if (lanes == 0 || by_packet) {
        shadows_.trace(light, member.to_light, member.point, member.shaded.object, is_aimed(number, 0), lanes,
                       colour);
        continue;
      }
      shadows_.aim(light, member.to_light, member.point, member.shaded.object, is_aimed(number, 0), lanes);
      queries[asked++] = {&member.to_light.rays, nullptr, &member.to_light.distance, &colour, lanes};
    }
    if (asked != 0) shadows_.trace(light, queries, asked);
  }
  /// Works off the trees of all packets. What the first round gathers of the roots' light is asked for when
  /// all roots have been shaded, for all of them together, and added last: so the sum does not depend on who
  /// traces what when. False: it was stopped on the way.
  template <class Stopped> CELLTRACE_ONE_COPY bool trace_trees(Stopped stopped) {
    const bool hints = kPrefetchesLines<Spu> && frame_.object_count > tuning::kObjectsInCoreCache;
    if constexpr (kPoolsRays<Spu>) begin_pooling();
    if constexpr (kIteratesAhead<Spu>)
      if (auto* const fractals = scene_.fractals(); fractals != nullptr && fractals->begin())
        iterate_fractals(*fractals);
    for (uint32_t i = 0; i < kPackets; ++i) {
      Member& member = store_.members[i];
      if (hints && i + 1 < kPackets)
        hint_extras(scene_, store_.members[i + 1].hits, store_.members[i + 1].hit);
      if (member.pixels != 0 && wants_first_hits()) {
        scene_.spu().enter_module(modules::kFirstHits);
        put_first_hits(member);
      }
      if (member.lanes == 0 || !shade_root(member)) continue;
      if (!trace_tree(stopped)) return false;
      keep_tree(member);
      if constexpr (kPoolsRays<Spu>)
        while (pool_.hits.full())
          shade_queued();
    }
    find_lights();
    if constexpr (kPoolsRays<Spu>)
      if (!trace_pooled(stopped)) return false;
    for (uint32_t i = 0; i < kPackets; ++i)
      if (store_.members[i].hit != 0) add_left_light(i);
    return true;
  }

  /// Finds what fractals are where the primary rays have hit them.
  template <class Fractals> [[gnu::noinline]] void iterate_fractals(Fractals& fractals) {
    for (uint32_t i = 0; i < kPackets; ++i) {
      Member& member = store_.members[i];
      if (member.hit == 0) continue;
      const HitPoints<S>& points = store_.points;
      find_hit_points(scene_, rays_of(member), member.hits, member.hit, store_.points);
      add_fractals(scene_, i, points.material, points.point, member.hit & points.textured & ~points.blended,
                   fractals);
    }
    fractals.run();
  }

  bool wants_first_hits() const {
    return static_cast<FramePurpose>(frame_.purpose) == FramePurpose::grid &&
           (frame_.light_ways & light_way::first_hits) != 0;
  }
  /// Puts to main memory what the primary rays of a member hit.
  CELLTRACE_ONE_COPY void put_first_hits(Member& member) {
    scene_.spu().run_in_module(modules::kFirstHits);
    const ea_t table = frame_.grid_points + frame_.packet_columns * frame_.surface_rows * kGridPacketBytes;
    const HitPoints<S>& points = store_.points;
    if (member.hit != 0) find_hit_points(scene_, rays_of(member), member.hits, member.hit, store_.points);
    FirstHitRecord& record = store_.first_hits;
    for (uint32_t lane = 0; lane < kSimdLanes; ++lane) {
      const bool is_hit = (member.hit >> lane & 1) != 0;
      record.distance[lane] = member.hits.distance.lane[lane];
      record.interior[lane] = is_hit ? points.interior.lane[lane] : kNoOffset;
    }
    if (frame_.camera.ahead != 0.0f) {
      const F way = way_to_start<S>(frame_.camera, rays_of(member).direction.template load<S>());
      (F::load(record.distance) + way).store(record.distance);
    }
    if (member.hit != 0) {
      points.normal.x.store(record.normal[0]);
      points.normal.y.store(record.normal[1]);
      points.normal.z.store(record.normal[2]);
    }
    constexpr auto kBytes = static_cast<uint32_t>(sizeof(FirstHitRecord));
    const uint32_t packet = (member.row - frame_.surface_row) * frame_.packet_columns + member.column;
    scene_.spu().put(&record, table + packet * kBytes, kBytes, kFirstHitTag);
    scene_.spu().wait_all(1u << kFirstHitTag);
  }

  LightRound begin_round(uint32_t first, LitPoints& lit) const {
    LightRound round = LightRound::from(frame_, first, lit.light);
    if constexpr (kHasRoomForCode<Spu>) {
      round.is_fresh = true;
      round.to_first = &lit.to_light;
    } else {
      round.template clear<S>();
    }
    return round;
  }
  /// Whether shading has left the rays toward a light, of a round that begins with `first`.
  static bool is_aimed(uint32_t number, uint32_t first) { return kHasRoomForCode<Spu> && number == first; }
  /// Shades what the primary rays of a member hit. False: all that they see is known but for the light that
  /// is asked for later. Otherwise the member's tree has begun.
  bool shade_root(Member& member) {
    if constexpr (kPoolsRays<Spu>) pool_.clear_lanes();
    if constexpr (kIteratesAhead<Spu>)
      if (auto* const fractals = scene_.fractals())
        fractals->show(static_cast<uint32_t>(&member - store_.members));
    if constexpr (kHasRoomForCode<Spu>) {
      if (member.hit != 0) {
        find_hit_points(scene_, rays_of(member), member.hits, member.hit, store_.points);
        member.point = store_.points.point;
      }
      VectorLanes seen;
      LightRound only = begin_round(0, member);
      if (tracer_.ends_at_once(rays_of(member), member.lanes, member.hits, store_.points, only, seen)) {
        if (member.hit != 0 && only.is_fresh) only.template clear<S>();
        keep(member, seen);
        return false;
      }
    }
    const auto number = static_cast<uint32_t>(&member - store_.members);
    if constexpr (kPoolsRays<Spu>) {
      pool_.begin_tree(number, tracer_.pooling().pixels);
    } else {
      if (samples_ != nullptr) tracer_.add_clear_to(samples_->at[number].clear);
    }
    tracer_.begin(rays_of(member), member.lanes);
    copy_packet<Spu>(member.hits, tracer_.hits());
    shade_node(&member);
    return true;
  }
  // Not inlined: one copy of each saves local store, and their vectors are not on the stack while others run.

  CELLTRACE_ONE_COPY uint32_t take_hits() { return tracer_.take_hits(); }
  /// Shades what the rays of the node have hit that is being traced. If it is a member's root, the light of
  /// the first round is left where it is gathered.
  CELLTRACE_ONE_COPY void shade_node(Member* root) {
    uint32_t hit;
    if constexpr (kPoolsRays<Spu>)
      hit = tracer_.take_hits([&](uint32_t missed) { return queue_sky(missed); });
    else
      hit = take_hits();
    if (hit == 0) return;
    if (!kHasRoomForCode<Spu> || root == nullptr)
      find_hit_points(scene_, tracer_.node().rays, tracer_.hits(), hit, store_.points);
    if (root != nullptr) copy_packet<Spu>(store_.points.point, root->point);
    if constexpr (kPoolsRays<Spu>) {
      if (root == nullptr) hit &= ~queue_ends(hit);
      if (hit == 0) return;
    }
    shade_points(root, hit);
  }
  /// Shades what take_hits() told of, whose points are known.
  [[gnu::always_inline]] void shade_points(Member* root, uint32_t hit) {
    for (uint32_t first = 0;;) {
      const bool is_left = root != nullptr && first == 0;
      const LightRound round = begin_round(first, is_left ? *root : store_.lit);
      tracer_.shade_hits(store_.points, hit, round);
      if (!tracer_.has_gathered()) {
        if (is_left) round.template clear<S>();
      } else if (!is_left) {
        light_packet(hit, round);
        tracer_.add_gathered(round, hit);
      }
      first += kLightsARound;
      if (first >= frame_.light_count) return;
    }
  }
  /// Works off the nodes that are still to come. False: it was stopped on the way.
  template <class Stopped> bool trace_tree(Stopped stopped) {
    while (tracer_.advance()) {
      if (stopped()) return false;
      find_closest();
      shade_node(nullptr);
    }
    return true;
  }
  void find_closest() {
    shadows_.traversal().find_closest(tracer_.node().rays, tracer_.node().lanes, tracer_.hits(),
                                      tracer_.node().reflected);
  }

  /// What a member's primary rays see but for the light that is asked for later.
  void keep(Member& member, const VectorLanes& seen) {
    if constexpr (kPoolsRays<Spu>)
      pool_.put(static_cast<uint32_t>(&member - store_.members), member.lanes, seen);
    else
      copy_packet<Spu>(seen, member.shaded.seen);
  }
  /// The same of a member whose tree is complete.
  void keep_tree(Member& member) {
    if constexpr (kPoolsRays<Spu>)
      pool_.put_tree(static_cast<uint32_t>(&member - store_.members), member.lanes, tracer_.light());
    else
      keep(member, tracer_.light());
  }
  /// Adds what has come of the light that a root's first round gathered.
  void add_left_light(uint32_t number) {
    Member& member = store_.members[number];
    const LightRound round = LightRound::from(frame_, 0, member.light);
    if constexpr (kPoolsRays<Spu>)
      pool_.add(number, member.hit, round);
    else
      round.add_to<S>(member.shaded.seen, member.hit);
  }
  /// All that the primary rays of a member see.
  V3<S> light_of(uint32_t number) {
    Member& member = store_.members[number];
    if constexpr (!kPoolsRays<Spu>)
      return member.shaded.seen.template load<S>();
    else
      return pool_.light_of(number, member.hit, LightRound::from(frame_, 0, member.light));
  }

  void begin_pooling() {
    tracer_.pooling().pool = BundlePool<Spu>::has_own_lanes(frame_) ? nullptr : &pool_.rays;
    pool_.begin();
    tracer_.add_clear_to(pool_.clear);
  }
  /// Traces the rays that have left their packets.
  template <class Stopped> bool trace_pooled(Stopped stopped) {
    while (!pool_.rays.empty() || !pool_.hits.empty()) {
      if (stopped()) return false;
      if (pool_.hits.full() || pool_.rays.empty()) {
        shade_queued();
        continue;
      }
      tracer_.begin(pool_.rays.take());
      const uint32_t lanes = tracer_.node().lanes;
      pool_.clear_lanes();
      find_closest();
      shade_node(nullptr);
      if (!trace_tree(stopped)) return false;
      pool_.add_tree(tracer_.pooling().pixels, lanes, tracer_.light());
    }
    pool_.skies.finish([&](const SkyRays& rays, uint32_t lanes) { see_sky(rays, lanes); });
    pool_.shadows.finish([&](uint32_t number, QueuedPoints& points, uint32_t lanes) {
      for_each_light(scene_, frame_, number, 1,
                     [&](uint32_t, const LightRecord& light) { light_queued(light, points, lanes); });
    });
    return true;
  }

  /// Whether light of the node that is being traced goes to pixels, whatever packet its rays are in.
  bool may_wait() { return tracer_.pooling().pool != nullptr && tracer_.node().target == 0; }
  /// Leaves hits from which no rays go on to shade_queued(), if they are few. Returns their lanes.
  uint32_t queue_ends(uint32_t hit) {
    const uint32_t ends = hit & ~(store_.points.spawning | store_.points.blended);
    if (ends == 0 || !may_wait()) return 0;
    return pool_.hits.add(tracer_.node(), tracer_.pooling().pixels, tracer_.hits(), ends) ? ends : 0;
  }
  /// Shades hits that have waited, between trees.
  CELLTRACE_ONE_COPY void shade_queued() {
    const QueuedHits& queued = pool_.hits.take();
    tracer_.begin(queued.packet);
    copy_packet<Spu>(queued.hits, tracer_.hits());
    const uint32_t lanes = tracer_.node().lanes;
    find_hit_points(scene_, tracer_.node().rays, tracer_.hits(), lanes, store_.points);
    shade_points(nullptr, lanes);
    pool_.add(tracer_.pooling().pixels, lanes, tracer_.light());
  }
  /// Leaves what a few lanes of the node see that hit nothing to see_sky(). False: it has to come now.
  bool queue_sky(uint32_t missed) {
    if (frame_.sky == kNoOffset || !may_wait() || !pool_.skies.takes(missed)) return false;
    pool_.skies.add(tracer_.node(), tracer_.pooling().pixels, missed,
                    [&](const SkyRays& rays) { see_sky(rays, 0xFFFF); });
    return true;
  }
  /// Takes to their pixels what rays see that have waited.
  CELLTRACE_ONE_COPY void see_sky(const SkyRays& rays, uint32_t lanes) {
    VectorLanes light;
    light.template store<S>(tracer_.behind(rays.direction, lanes) * rays.throughput.template load<S>());
    pool_.add(rays.pixels, lanes, light);
  }
  /// Leaves light of a few lanes of the node that is being traced to light_queued(). False: it has to come
  /// now, as what it goes to is no pixel's or its rays have a packet of their own.
  bool queue_light(uint32_t number, const LightRecord& light, uint32_t lanes, const VectorLanes& colour) {
    if (lanes == 0 || !may_wait() || !pool_.shadows.takes(number, lanes)) return false;
    pool_.shadows.add(number, lanes, store_.points.point, tracer_.hits().object, colour,
                      tracer_.pooling().pixels, shadows_.asks_interiors() ? &tracer_.node() : nullptr,
                      [&](QueuedPoints& points) { light_queued(light, points, 0xFFFF); });
    return true;
  }
  /// Takes to their pixels what comes of a light to points that have waited.
  CELLTRACE_ONE_COPY void light_queued(const LightRecord& light, QueuedPoints& points, uint32_t lanes) {
    shadows_.set_interiors(&points.interiors);
    shadows_.trace(light, store_.lit.to_light, points.point.template load<S>(), points.object, false, lanes,
                   points.light);
    pool_.add(points.pixels, lanes, points.light);
  }

  /// The light of a round at the hits of the node that is being traced.
  CELLTRACE_ONE_COPY void light_packet(uint32_t hit, const LightRound& round) {
    for_each_light(scene_, frame_, round.first, round.count, [&](uint32_t number, const LightRecord& light) {
      if (!is_asked_for(light)) return;
      VectorLanes& colour = round.gathered[number - round.first];
      uint32_t lanes = tracer_.lanes_that_count(colour, hit);
      if constexpr (kPoolsRays<Spu>)
        if (queue_light(number, light, lanes, colour)) lanes = 0;
      shadows_.set_interiors(&tracer_.node());
      shadows_.trace(light, store_.lit.to_light, store_.points.point, tracer_.hits().object,
                     is_aimed(number, round.first), lanes, colour);
    });
  }

  const FrameBlock& frame_;
  SceneAccess<Spu>& scene_;
  SampleBundle<Spu>* samples_;
  RayNode& scratch_; ///< the tracer's while surfaces are shaded, else that of shadow rays that are walked
  RayTracer<Spu> tracer_;
  Store& store_;
  ShadowTracer<Spu, kAccelerators> shadows_;
  [[no_unique_address]] Present<BundlePool<Spu>, kPoolsRays<Spu>> pool_;
};

} // namespace celltrace::kernel

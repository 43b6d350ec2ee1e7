// What a bundle of packets sees: what its primary rays hit and what light comes there is searched for
// together; from there on each packet's tree of rays is worked off by itself. Kernel dialect.
#pragma once

#include "kernel/accel/traversal.hpp"
#include "kernel/cameras/primary_rays.hpp"
#include "kernel/direct/hit_sorting.hpp"
#include "kernel/direct/shadow_marking.hpp"
#include "kernel/lights/area_shadow.hpp"
#include "kernel/program/pixel_sampler.hpp"
#include "kernel/shading/ray_tracer.hpp"
#include "kernel/shading/shadow_walk.hpp"

namespace celltrace::kernel {

template <class Spu, uint32_t kAccelerators = kAnyAccelerator> class BundleTracer {
public:
  using S = typename Spu::simd;
  using F = typename S::F;

  /// `spill`: room for FrameBlock::ray_stack_nodes nodes. `samples` says where the rays of frames of samples
  /// go through; null: there are no such frames. Inlined: it would take much of an SPE's stack by itself.
  [[gnu::always_inline]] BundleTracer(Spu& spu, const FrameBlock& frame, SceneAccess<Spu>& scene, ea_t spill,
                                      SampleBundle<Spu>* samples)
      : frame_(frame), scene_(scene), samples_(samples), traversal_(scene, frame),
        tracer_(spu, frame, scene, spill, frame.ray_stack_nodes, *spu.template allocate<RayNode>()),
        members_(spu.template allocate<Member>(kPackets)), area_(allocate_area_shadow(spu, frame)),
        walk_(allocate_shadow_walk(spu, frame)), pool_(spu) {
    static_assert(sizeof(ShadowWalk<S>) <= kResidentNodes * sizeof(RayNode), "lies where nodes would");
    static_assert(sizeof(AreaShadow<S>) <= kResidentNodes * sizeof(RayNode), "lies where nodes would");
  }

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
        find_hits([&](RayQuery* queries) { traversal_.intersect_from_origin(queries, kPackets); });
      } else {
        const PinholeBundle<S> bundle(frame_, column, row);
        const bool missed = !traversal_.enter(bundle);
        const bool asks_more = has_atmosphere(frame_) || (frame_.light_ways & light_way::first_hits) != 0;
        const bool plain = frame_.sky == kNoOffset && !asks_more;
        if (missed && plain && is_whole(column, row))
          return fill(column * kEdge, row * kEdge, tracer_.background(kPackets * kSimdLanes));
        place(column, row);
        if (missed && !asks_more)
          return for_each_member([&](Member& member) {
            if (!plain) make_primary_rays(scene_.spu(), frame_, member.column, member.row, member.rays);
            put(member.column, member.row, tracer_.background(member.rays, member.lanes));
          });
        find_hits([&](RayQuery* queries) { traversal_.intersect(queries, bundle); });
      }
    } else {
      place(column, row);
      find_hits([&](RayQuery* queries) { traversal_.intersect(queries, kPackets); });
    }
    find_lights();
    if constexpr (kPoolsRays<Spu>)
      if (!trace_pooled(stopped)) return pool_.rays.clear();
    for (uint32_t i = 0; i < kPackets; ++i) {
      Member& member = members_[i];
      if (member.pixels == 0) continue;
      V3<S> seen;
      uint32_t with_ray = member.lanes;
      if constexpr (kPoolsRays<Spu>) {
        with_ray = pool_.with_ray[i];
        seen = pool_.light[i].template load<S>();
      } else {
        if (samples_ != nullptr) tracer_.add_clear_to(samples_->at[i].clear);
        if (!trace(member, seen, stopped)) return;
      }
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

  /// Puts to main memory what the primary rays of the bundle hit that was traced last.
  [[gnu::noinline]] void put_first_hits() {
    scene_.spu().run_in_module(modules::kFirstHits);
    const ea_t table = frame_.grid_points + frame_.packet_columns * frame_.packet_rows * kGridPacketBytes;
    for (uint32_t i = 0; i < kPackets; ++i) {
      Member& member = members_[i];
      if (member.pixels == 0) continue;
      // Shading may have left other points there.
      if (member.hit != 0) find_hit_points(scene_, member.rays, member.hits, member.hit, member.points);
      FirstHitRecord& record = member.first_hits;
      for (uint32_t lane = 0; lane < kSimdLanes; ++lane) {
        const bool is_hit = (member.hit >> lane & 1) != 0;
        record.distance[lane] = member.hits.distance.lane[lane];
        record.interior[lane] = is_hit ? member.points.interior.lane[lane] : kNoOffset;
      }
      if (member.hit != 0) {
        member.points.normal.x.store(record.normal[0]);
        member.points.normal.y.store(record.normal[1]);
        member.points.normal.z.store(record.normal[2]);
      }
      constexpr auto kBytes = static_cast<uint32_t>(sizeof(FirstHitRecord));
      scene_.spu().put(&record, table + (member.row * frame_.packet_columns + member.column) * kBytes, kBytes,
                       kFirstHitTag);
    }
    scene_.spu().wait_all(1u << kFirstHitTag);
  }

  void reset_counters() {
    tracer_.reset_counters();
    traversal_.reset_counters();
  }
  const RayCounters& ray_counters() const { return tracer_.counters(); }
  const TraversalCounters& traversal_counters() const { return traversal_.counters(); }
  uint32_t spilled_nodes() const { return tracer_.spilled_nodes(); }

  /// Local store that nothing is in between two calls of trace().
  uint8_t* scratch() { return reinterpret_cast<uint8_t*>(members_); }
  static constexpr uint32_t scratch_bytes() { return kPackets * static_cast<uint32_t>(sizeof(Member)); }

private:
  static constexpr uint32_t kEdge = kBundleEdge<Spu>;
  static constexpr uint32_t kPackets = kBundlePackets<Spu>;
  static constexpr uint32_t kFirstHitTag = 7;

  struct Member {
    RayPacket rays;
    HitPacket hits;
    HitPoints<S> points;
    union {
      RayPacket shadow_rays;     ///< toward the light that is asked of
      FirstHitRecord first_hits; ///< on their way to main memory, after the last light
    };
    FloatLanes distance;
    VectorLanes light[kLightsARound]; ///< that comes to the points, of a round
    uint32_t column, row;
    uint32_t pixels;     ///< lanes in the picture
    uint32_t lanes, hit; ///< of them, those that have a ray; of these, those that hit something
  };

  /// Calls `visit` with each packet in the picture.
  template <class Visit> void for_each_member(const Visit& visit) {
    for (uint32_t i = 0; i < kPackets; ++i)
      if (members_[i].pixels != 0) visit(members_[i]);
  }

  bool is_whole(uint32_t column, uint32_t row) const {
    constexpr uint32_t kPixels = kEdge * kPacketEdge;
    return (column + 1) * kPixels <= frame_.width && (row + 1) * kPixels <= frame_.height;
  }
  void place(uint32_t column, uint32_t row) {
    for (uint32_t i = 0; i < kPackets; ++i) {
      Member& member = members_[i];
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
    Member& member = members_[number];
    F x = pixels_across<S>(frame_, member.column), y = pixels_down<S>(frame_, member.row);
    if (takes_samples()) {
      x = F::load(samples_->at[number].x.lane);
      y = F::load(samples_->at[number].y.lane);
    }
    return make_rays_through(scene_.spu(), frame_.camera, x, y, member.rays);
  }

  /// `run` answers the queries of all packets; those of packets outside are for nothing.
  template <class Run> void find_hits(Run run) {
    RayQuery queries[kPackets];
    for (uint32_t i = 0; i < kPackets; ++i) {
      Member& member = members_[i];
      if (member.pixels != 0) member.lanes &= make_rays(i);
      queries[i] = {&member.rays, &member.hits, nullptr, nullptr, member.lanes};
    }
    run(queries);
    if constexpr (kPoolsRays<Spu>) pool_.sort(scene_, frame_, members_);
    const bool hints = kPrefetchesLines<Spu> && frame_.object_count > tuning::kObjectsInCoreCache;
    for (uint32_t i = 0; i < kPackets; ++i) {
      Member& member = members_[i];
      member.hit = hit_lanes<S>(member.hits, member.lanes);
      if (hints && i + 1 < kPackets)
        hint_extras(scene_, members_[i + 1].hits, hit_lanes<S>(members_[i + 1].hits, members_[i + 1].lanes));
      if (member.hit != 0) find_hit_points(scene_, member.rays, member.hits, member.hit, member.points);
    }
  }

  /// The light of the first round at what the primary rays hit. Not inlined: records of lights are not on the
  /// stack while rays are shaded.
  [[gnu::noinline]] void find_lights() {
    const LightRound lights = LightRound::from(frame_, 0, nullptr);
    lit_ = nullptr;
    for_each_light(scene_, frame_, 0, lights.count, [&](uint32_t number, const LightRecord& light) {
      if (is_asked_for(light)) find_light(number, light);
    });
  }
  void find_light(uint32_t number, const LightRecord& light) {
    RayQuery queries[kPackets];
    const bool by_packet = is_projected(light) || walks_all(light);
    uint32_t asked = 0;
    for (uint32_t i = 0; i < kPackets; ++i) {
      Member& member = members_[i];
      if (member.hit == 0) continue;
      scene_.spu().compute(scalar_work::kBundleLight);
      VectorLanes& colour = member.light[number];
      if (has_area(light)) {
        look_at_area(light, member, member.rays, member.hits, member.hit, colour);
        continue;
      }
      const uint32_t facing = aim_at(light, member, member.rays, member.hits, member.hit, colour, nullptr);
      if (facing == 0) continue;
      if (by_packet) {
        trace_shadows(light, member.shadow_rays, facing, member.distance, colour);
        continue;
      }
      queries[asked++] = {&member.shadow_rays, nullptr, &member.distance, &colour, facing};
    }
    if (asked == 0) return;
    if constexpr (kMarksTranslucent<Spu>)
      if (walk_ != nullptr) return walk_marked(light, queries, asked);
    traversal_.intersect(queries, asked, light);
  }

  /// Makes a member's shadow rays from what `rays` hit in `lanes`, or starts the sampling of a light that has
  /// an area; else `area` is null. `colour` becomes what comes if nothing is in the way. Returns the lanes
  /// that face the light. Not inlined: its surfaces are not on the stack while rays are traced.
  [[gnu::noinline]] uint32_t aim_at(const LightRecord& light, Member& member, const RayPacket& rays,
                                    const HitPacket& hits, uint32_t lanes, VectorLanes& colour,
                                    AreaShadow<S>* area) {
    const Surfaces<S> surfaces = member.points.lit_surfaces(rays.direction.template load<S>(), hits.object);
    IncidentLight<S> incident(light.colour);
    illuminate(scene_, light, surfaces, lanes, incident);
    if (incident.facing == 0) return 0;
    colour.template store<S>(incident.colour);
    if (area != nullptr)
      begin_sampling(scene_.spu(), light, surfaces, incident, *area);
    else
      make_shadow_rays(surfaces, incident, member.shadow_rays, member.distance);
    return incident.facing;
  }

  /// As Traversal's transmittance(), of a light. Not inlined: once in local store is enough.
  [[gnu::noinline]] void trace_shadows(const LightRecord& light, const RayPacket& rays, uint32_t lanes,
                                       FloatLanes& distance, VectorLanes& colour) {
    if (is_projected(light)) {
      lanes = traversal_.project(light, rays, lanes, distance, colour);
      if (lanes == 0 || is_shadowless(light)) return;
    }
    if (walk_ == nullptr) return traversal_.transmittance(rays, lanes, distance, colour);
    if (walks_all(light)) return walk_shadows(light, rays, lanes, distance, colour);
    if constexpr (kMarksTranslucent<Spu>) walk_marked(light, rays, lanes, distance, colour);
  }
  /// Whether all shadow rays toward a light are walked; otherwise those that are marked are, or none.
  bool walks_all(const LightRecord& light) const {
    return walk_ != nullptr && (!kMarksTranslucent<Spu> || is_dimmed(light));
  }
  /// Answers the queries of a bundle: those of their rays are walked that cross something translucent.
  [[gnu::noinline]] void walk_marked(const LightRecord& light, RayQuery* queries, uint32_t count) {
    VectorLanes marks[kPackets];
    VectorLanes* colours[kPackets];
    for (uint32_t i = 0; i < count; ++i) {
      colours[i] = queries[i].light;
      queries[i].light = &marks[i];
    }
    traversal_.mark_translucent(queries, count, light);
    for (uint32_t i = 0; i < count; ++i)
      walk_some(light, queries[i], marked_lanes<S>(*queries[i].light), *colours[queries[i].light - marks]);
  }
  /// The same of the node that is being traced.
  [[gnu::noinline]] void walk_marked(const LightRecord& light, const RayPacket& rays, uint32_t lanes,
                                     const FloatLanes& distance, VectorLanes& colour) {
    const uint32_t inside = lanes & lanes_inside(lit_);
    uint32_t walked = marking_.walked_at_once(lanes, inside);
    VectorLanes marks;
    RayQuery query = {&rays, nullptr, &distance, &marks, lanes & ~walked};
    if (query.lanes != 0) {
      const uint32_t asked = query.lanes;
      traversal_.mark_translucent(query);
      const uint32_t marked = marked_lanes<S>(marks);
      marking_.count(asked, inside, marked);
      walked |= marked;
    }
    walk_some(light, query, walked, colour);
  }
  /// The light of a query that has been marked, of which `walked` lanes are still to be walked.
  void walk_some(const LightRecord& light, const RayQuery& query, uint32_t walked, VectorLanes& colour) {
    const V3<S> dark = {F(0.0f), F(0.0f), F(0.0f)};
    const V3<S> direct = select<S>(S::M::from_bits(query.lanes), colour.template load<S>(), dark);
    if (walked == 0) return colour.template store<S>(direct);
    walk_shadows(light, *query.rays, walked, *query.distance, colour);
    colour.template store<S>(colour.template load<S>() + direct);
  }
  /// Walks `lanes` of shadow rays. The light of the others becomes 0.
  [[gnu::noinline]] void walk_shadows(const LightRecord& light, const RayPacket& rays, uint32_t lanes,
                                      const FloatLanes& distance, VectorLanes& colour) {
    ShadowWalk<S>& walk = *walk_;
    const bool dims = is_dimmed(light);
    scene_.spu().enter_module(modules::kShadowWalk);
    begin_shadow_walk(scene_.spu(), frame_, lit_, rays, lanes, distance, colour, walk);
    while (walk.ray.lanes != 0) {
      traversal_.find_closest(walk.ray.rays, walk.ray.lanes, walk.hits, kSeesAll);
      if (dims) {
        scene_.spu().enter_module(modules::kAtmosphere);
        dim_shadow_rays(scene_, frame_, walk.hits, walk.left, walk.ray, *walk.light);
      }
      scene_.spu().enter_module(modules::kShadowWalk);
      const uint32_t hit = hits_of_walk(scene_.spu(), walk);
      if (hit == 0) return;
      find_hit_points(scene_, walk.ray.rays, walk.hits, hit, walk.points);
      scene_.spu().enter_module(modules::kShadowWalk);
      step_shadow_walk(scene_, walk, tracer_.dropped());
    }
  }

  /// The light of an area, whose places each packet asks by itself. Not inlined: few scenes have such lights.
  [[gnu::noinline]] void look_at_area(const LightRecord& light, Member& member, const RayPacket& rays,
                                      const HitPacket& hits, uint32_t lanes, VectorLanes& colour) {
    AreaShadow<S>& area = *area_;
    const uint32_t facing = aim_at(light, member, rays, hits, lanes, colour, &area);
    if (facing == 0) return;
    if constexpr (kGathersOccluders<Spu>) {
      AreaOccluders<Spu> occluders;
      if (!walks_all(light) && !is_projected(light) &&
          traversal_.gather_occluders(area.rays, facing, light, occluders)) {
        if (occluders.are_none())
          return colour.template store<S>(
              select<S>(S::M::from_bits(facing), colour.template load<S>(), {F(0.0f), F(0.0f), F(0.0f)}));
        while (next_place(scene_.spu(), light, area))
          traversal_.transmittance(area.rays, area.lanes, area.distance, area.light, occluders);
        colour = area.sum;
        tracer_.count_shadow_rays(area.rays_asked);
        return;
      }
    }
    while (next_place(scene_.spu(), light, area)) {
      scene_.spu().compute(scalar_work::kBundleLight);
      trace_shadows(light, area.rays, area.lanes, area.distance, area.light);
    }
    colour = area.sum;
    tracer_.count_shadow_rays(area.rays_asked);
  }

  /// The colours of a packet, of which the hits are known and the light of the first round. False: it was
  /// stopped on the way.
  template <class Stopped> bool trace(Member& member, V3<S>& colour, Stopped stopped) {
    if constexpr (kHasRoomForCode<Spu>) {
      const LightRound all = LightRound::from(frame_, 0, member.light);
      if (tracer_.ends_at_once(member.rays, member.lanes, member.hits, member.points, all, colour))
        return true;
    }
    tracer_.begin(member.rays, member.lanes);
    tracer_.hits() = member.hits;
    if constexpr (kPoolsRays<Spu>)
      pool_.find_places(static_cast<uint32_t>(&member - members_), tracer_.pooling().pixels);
    return trace_tree(member, true, colour, stopped);
  }
  /// The colours of the tree that has begun. `is_first`: its hits are those of the member, whose light is
  /// known.
  template <class Stopped> bool trace_tree(Member& member, bool is_first, V3<S>& colour, Stopped stopped) {
    const LightRound first = LightRound::from(frame_, 0, member.light);
    for (;; is_first = false) {
      const uint32_t hit = tracer_.take_hits();
      if (hit != 0) {
        const RayNode& node = tracer_.node();
        if (!is_first) {
          find_hit_points(scene_, node.rays, tracer_.hits(), hit, member.points);
          light_packet(member, hit, first);
        }
        for (LightRound round = first;;) {
          tracer_.shade_hits(member.points, hit, round);
          if (round.next() >= frame_.light_count) break;
          round = LightRound::from(frame_, round.next(), member.light);
          light_packet(member, hit, round);
        }
      }
      if (!tracer_.advance()) break;
      if (stopped()) return false;
      traversal_.find_closest(tracer_.node().rays, tracer_.node().lanes, tracer_.hits(),
                              tracer_.node().reflected);
    }
    colour = tracer_.light();
    return true;
  }

  /// The colours of all packets of the bundle, whose rays go on in packets that the trees share. False: it
  /// was stopped on the way.
  template <class Stopped> bool trace_pooled(Stopped stopped) {
    RayPooling<Spu>& pooling = tracer_.pooling();
    pooling.pool = has_own_lanes(frame_) ? nullptr : &pool_.rays;
    const F zero(0.0f);
    if (pool_.is_sorted)
      for (uint32_t i = 0; i < kPackets; ++i)
        pool_.light[i].template store<S>({zero, zero, zero});
    tracer_.add_clear_to(pool_.clear);
    V3<S> seen;
    for (uint32_t i = 0; i < kPackets; ++i) {
      Member& member = members_[i];
      if (member.lanes == 0) continue;
      zero.store(pool_.clear.lane);
      if (!trace(member, seen, stopped)) return false;
      if (pool_.is_sorted) {
        add_to_pixels(pool_.sorter.places(i), member.lanes, seen);
      } else {
        pool_.light[i].template store<S>(seen);
        if (samples_ != nullptr) samples_->at[i].clear = pool_.clear;
      }
    }
    while (!pool_.rays.empty()) {
      if (stopped()) return false;
      tracer_.begin(pool_.rays.take());
      const uint32_t lanes = tracer_.node().lanes;
      zero.store(pool_.clear.lane);
      traversal_.find_closest(tracer_.node().rays, lanes, tracer_.hits(), tracer_.node().reflected);
      if (!trace_tree(members_[0], false, seen, stopped)) return false;
      add_to_pixels(pooling.pixels, lanes, seen);
    }
    return true;
  }
  void add_to_pixels(const WordLanes& pixels, uint32_t lanes, const V3<S>& seen) {
    VectorLanes light;
    light.template store<S>(seen);
    for_each_lane(lanes, [&](uint32_t lane) {
      const uint32_t packet = pixels.lane[lane] / kSimdLanes, to = pixels.lane[lane] % kSimdLanes;
      VectorLanes& sum = pool_.light[packet];
      sum.x.lane[to] += light.x.lane[lane];
      sum.y.lane[to] += light.y.lane[lane];
      sum.z.lane[to] += light.z.lane[lane];
      if (samples_ != nullptr) samples_->at[packet].clear.lane[to] += pool_.clear.lane[lane];
    });
  }

  /// The light of a round at the hits of the node that is being traced.
  [[gnu::noinline]] void light_packet(Member& member, uint32_t hit, const LightRound& round) {
    lit_ = &tracer_.node();
    for_each_light(scene_, frame_, round.first, round.count, [&](uint32_t number, const LightRecord& light) {
      if (!is_asked_for(light)) return;
      VectorLanes& colour = member.light[number - round.first];
      const RayPacket& rays = tracer_.node().rays;
      if (has_area(light)) return look_at_area(light, member, rays, tracer_.hits(), hit, colour);
      const uint32_t facing = aim_at(light, member, rays, tracer_.hits(), hit, colour, nullptr);
      if (facing != 0) trace_shadows(light, member.shadow_rays, facing, member.distance, colour);
    });
  }

  const FrameBlock& frame_;
  SceneAccess<Spu>& scene_;
  SampleBundle<Spu>* samples_;
  Traversal<Spu, kAccelerators> traversal_;
  RayTracer<Spu> tracer_;
  Member* members_;
  AreaShadow<S>* area_; ///< null if no light has an area
  ShadowWalk<S>* walk_; ///< null if shadow rays need none
  /// Whether rays stay in the lanes of their pixels.
  static constexpr bool has_own_lanes(const FrameBlock& frame) {
    return (frame.light_ways & light_way::jitter) != 0;
  }
  /// Of rays that leave their packets, and the light that has come to the pixels of each.
  struct Pool {
    explicit Pool(Spu& spu) : rays(spu), sorter(spu), light(spu.template allocate<VectorLanes>(kPackets)) {}

    /// Not where first hits are wanted by pixel.
    void sort(SceneAccess<Spu>& scene, const FrameBlock& frame, Member* members) {
      for (uint32_t i = 0; i < kPackets; ++i)
        with_ray[i] = members[i].lanes;
      is_sorted = frame.object_count <= tuning::kObjectsInCoreCache &&
                  (frame.light_ways & light_way::first_hits) == 0 && !has_own_lanes(frame) &&
                  sorter.sort(scene, members);
    }
    /// The pixels that the rays of a member are those of.
    void find_places(uint32_t member, WordLanes& places) const {
      if (is_sorted) {
        places = sorter.places(member);
        return;
      }
      for (uint32_t lane = 0; lane < kSimdLanes; ++lane)
        places.lane[lane] = member * kSimdLanes + lane;
    }

    RayPool<Spu> rays;
    HitSorter<Spu> sorter;
    VectorLanes* light;
    FloatLanes clear;            ///< of the rays that are being traced
    uint32_t with_ray[kPackets]; ///< lanes of the pixels that have one
    bool is_sorted = false;
  };
  [[no_unique_address]] detail::Present<Pool, kPoolsRays<Spu>> pool_;
  [[no_unique_address]] detail::Present<ShadowMarking, kMarksTranslucent<Spu>> marking_;
  const RayNode* lit_ = nullptr; ///< whose hits lights are looked for at; null: those of primary rays
};

} // namespace celltrace::kernel

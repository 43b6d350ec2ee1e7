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
        scratch_(*spu.template allocate<RayNode>()),
        tracer_(spu, frame, scene, spill, frame.ray_stack_nodes, scratch_),
        store_(*spu.template allocate<Store>()), area_(allocate_area_shadow(spu, frame)),
        walk_(allocate_shadow_walk(spu, frame, scratch_)), pool_(spu) {
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
            if (!plain) make_primary_rays(scene_.spu(), frame_, member.column, member.row, rays_of(member));
            put(member.column, member.row, tracer_.background(rays_of(member), member.lanes));
          });
        find_hits([&](RayQuery* queries) { traversal_.intersect(queries, bundle); });
      }
    } else {
      place(column, row);
      find_hits([&](RayQuery* queries) { traversal_.intersect(queries, kPackets); });
    }
    if (!trace_trees(stopped)) {
      if constexpr (kPoolsRays<Spu>) pool_.rays.clear();
      return;
    }
    for (uint32_t i = 0; i < kPackets; ++i) {
      Member& member = store_.members[i];
      if (member.pixels == 0) continue;
      V3<S> seen = light_of(i);
      uint32_t with_ray = member.lanes;
      if constexpr (kPoolsRays<Spu>) with_ray = pool_.with_ray[i];
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

  void reset_counters() {
    tracer_.reset_counters();
    traversal_.reset_counters();
  }
  const RayCounters& ray_counters() const { return tracer_.counters(); }
  const TraversalCounters& traversal_counters() const { return traversal_.counters(); }
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
  struct Member : LitPoints, detail::Present<PrimaryRays, kHasRoomForCode<Spu>> {
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
      Member& member = store_.members[i];
      if (member.hit == 0) continue;
      scene_.spu().compute(scalar_work::kBundleLight);
      VectorLanes& colour = member.light[number];
      const uint32_t lanes = lanes_above<Spu>(colour, member.hit, kLeastLight);
      if (lanes == 0 || has_area(light) || by_packet) {
        ask_for(light, member, member.point, member.shaded.object, is_aimed(number, 0), lanes, colour);
        continue;
      }
      aim_at(light, member.to_light, member.point, member.shaded.object, is_aimed(number, 0), lanes);
      queries[asked++] = {&member.to_light.rays, nullptr, &member.to_light.distance, &colour, lanes};
    }
    if (asked == 0) return;
    if constexpr (kMarksTranslucent<Spu>)
      if (walk_ != nullptr) return walk_marked(light, queries, asked);
    traversal_.intersect(queries, asked, light);
  }
  /// Leaves in `colour`, which has been gathered, what comes of it to points on objects; in `lanes` it
  /// counts.
  [[gnu::noinline]] void ask_for(const LightRecord& light, LitPoints& at, const V3<S>& point,
                                 const WordLanes& objects, bool is_aimed, uint32_t lanes,
                                 VectorLanes& colour) {
    if (lanes == 0) return colour.template store<S>({F(0.0f), F(0.0f), F(0.0f)});
    aim_at(light, at.to_light, point, objects, is_aimed, lanes);
    if (has_area(light)) return look_at_area(light, lanes, colour);
    trace_shadows(light, at.to_light.rays, lanes, at.to_light.distance, colour);
  }

  /// Makes shadow rays, unless shading has, or starts the sampling of a light that has an area.
  void aim_at(const LightRecord& light, ShadowRays& to_light, const V3<S>& point, const WordLanes& objects,
              bool is_aimed, uint32_t lanes) {
    if (!has_area(light)) tracer_.count_shadow_rays(static_cast<uint32_t>(__builtin_popcount(lanes)));
    if (is_aimed && !has_area(light)) return;
    make_rays_to(light, to_light, point, objects, lanes);
  }
  /// Not inlined: its surfaces are not on the stack while rays are traced.
  [[gnu::noinline]] void make_rays_to(const LightRecord& light, ShadowRays& to_light, const V3<S>& point,
                                      const WordLanes& objects, uint32_t lanes) {
    IncidentLight<S> incident(light.colour);
    aim(scene_.spu(), light, point, incident);
    if (!has_area(light)) {
      make_shadow_rays(point, objects, incident, to_light.rays, to_light.distance);
      return;
    }
    // It is known in which lanes the light counts: nothing is asked of the surfaces but where they are.
    Surfaces<S> surfaces;
    surfaces.point = point;
    surfaces.objects = &objects;
    incident.facing = lanes;
    if (!is_plain(light)) {
      scene_.spu().enter_module(modules::kLights);
      module_lights::attenuate(scene_, light, surfaces, incident);
    }
    begin_sampling(scene_.spu(), light, surfaces, incident, to_light, *area_);
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
    while (walk.ray->lanes != 0) {
      traversal_.find_closest(walk.ray->rays, walk.ray->lanes, walk.hits, kSeesAll);
      if (dims) {
        scene_.spu().enter_module(modules::kAtmosphere);
        dim_shadow_rays(scene_, frame_, walk.hits, walk.left, *walk.ray, *walk.light);
      }
      scene_.spu().enter_module(modules::kShadowWalk);
      const uint32_t hit = hits_of_walk(scene_.spu(), walk);
      if (hit == 0) return;
      find_hit_points(scene_, walk.ray->rays, walk.hits, hit, walk.points);
      scene_.spu().enter_module(modules::kShadowWalk);
      step_shadow_walk(scene_, walk, tracer_.dropped());
    }
  }

  /// The light of an area, whose places each packet asks by itself. Not inlined: few scenes have such lights.
  [[gnu::noinline]] void look_at_area(const LightRecord& light, [[maybe_unused]] uint32_t lanes,
                                      VectorLanes& colour) {
    AreaShadow<S>& area = *area_;
    if constexpr (kGathersOccluders<Spu>) {
      AreaOccluders<Spu> occluders;
      if (!walks_all(light) && !is_projected(light) &&
          traversal_.gather_occluders(area.to_place->rays, lanes, light, occluders)) {
        if (occluders.are_none())
          return colour.template store<S>(
              select<S>(S::M::from_bits(lanes), colour.template load<S>(), {F(0.0f), F(0.0f), F(0.0f)}));
        while (next_place(scene_.spu(), light, area))
          traversal_.transmittance(area.to_place->rays, area.lanes, area.to_place->distance, area.light,
                                   occluders);
        return take_area_light(colour);
      }
    }
    while (next_place(scene_.spu(), light, area)) {
      scene_.spu().compute(scalar_work::kBundleLight);
      trace_shadows(light, area.to_place->rays, area.lanes, area.to_place->distance, area.light);
    }
    take_area_light(colour);
  }
  void take_area_light(VectorLanes& colour) {
    tracer_.count_shadow_rays(area_->rays_asked);
    scene_.spu().enter_module(modules::kAreas);
    module_areas::dim(scene_.spu(), *area_, colour);
  }

  /// Works off the trees of all packets. What the first round gathers of the roots' light is asked for when
  /// all roots have been shaded, for all of them together, and added last: so the sum does not depend on who
  /// traces what when. False: it was stopped on the way.
  template <class Stopped> [[gnu::noinline]] bool trace_trees(Stopped stopped) {
    const bool hints = kPrefetchesLines<Spu> && frame_.object_count > tuning::kObjectsInCoreCache;
    if constexpr (kPoolsRays<Spu>) begin_pooling();
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
      keep(member, tracer_.light());
    }
    find_lights();
    if constexpr (kPoolsRays<Spu>)
      if (!trace_pooled(stopped)) return false;
    for (uint32_t i = 0; i < kPackets; ++i)
      if (store_.members[i].hit != 0) add_left_light(i);
    return true;
  }

  bool wants_first_hits() const {
    return static_cast<FramePurpose>(frame_.purpose) == FramePurpose::grid &&
           (frame_.light_ways & light_way::first_hits) != 0;
  }
  /// Puts to main memory what the primary rays of a member hit.
  [[gnu::noinline]] void put_first_hits(Member& member) {
    scene_.spu().run_in_module(modules::kFirstHits);
    const ea_t table = frame_.grid_points + frame_.packet_columns * frame_.packet_rows * kGridPacketBytes;
    const HitPoints<S>& points = store_.points;
    if (member.hit != 0) find_hit_points(scene_, rays_of(member), member.hits, member.hit, store_.points);
    FirstHitRecord& record = store_.first_hits;
    for (uint32_t lane = 0; lane < kSimdLanes; ++lane) {
      const bool is_hit = (member.hit >> lane & 1) != 0;
      record.distance[lane] = member.hits.distance.lane[lane];
      record.interior[lane] = is_hit ? points.interior.lane[lane] : kNoOffset;
    }
    if (member.hit != 0) {
      points.normal.x.store(record.normal[0]);
      points.normal.y.store(record.normal[1]);
      points.normal.z.store(record.normal[2]);
    }
    constexpr auto kBytes = static_cast<uint32_t>(sizeof(FirstHitRecord));
    scene_.spu().put(&record, table + (member.row * frame_.packet_columns + member.column) * kBytes, kBytes,
                     kFirstHitTag);
    scene_.spu().wait_all(1u << kFirstHitTag);
  }

  LightRound begin_round(uint32_t first, LitPoints& lit) const {
    LightRound round = LightRound::from(frame_, first, lit.light);
    round.template clear<S>();
    if constexpr (kHasRoomForCode<Spu>) round.to_first = &lit.to_light;
    return round;
  }
  /// Whether shading has left the rays toward a light, of a round that begins with `first`.
  static bool is_aimed(uint32_t number, uint32_t first) { return kHasRoomForCode<Spu> && number == first; }
  /// Shades what the primary rays of a member hit. False: all that they see is known but for the light that
  /// is asked for later. Otherwise the member's tree has begun.
  bool shade_root(Member& member) {
    if constexpr (kPoolsRays<Spu>) pool_.clear_lanes();
    if constexpr (kHasRoomForCode<Spu>) {
      if (member.hit != 0) {
        find_hit_points(scene_, rays_of(member), member.hits, member.hit, store_.points);
        member.point = store_.points.point;
      }
      VectorLanes seen;
      LightRound only = LightRound::from(frame_, 0, member.light);
      only.is_fresh = true;
      only.to_first = &member.to_light;
      if (tracer_.ends_at_once(rays_of(member), member.lanes, member.hits, store_.points, only, seen)) {
        keep(member, seen);
        return false;
      }
    }
    const auto number = static_cast<uint32_t>(&member - store_.members);
    if constexpr (kPoolsRays<Spu>) {
      pool_.find_places(number, tracer_.pooling().pixels);
    } else {
      if (samples_ != nullptr) tracer_.add_clear_to(samples_->at[number].clear);
    }
    tracer_.begin(rays_of(member), member.lanes);
    copy_packet<Spu>(member.hits, tracer_.hits());
    shade_node(&member);
    return true;
  }
  // Not inlined: one copy of each saves local store, and their vectors are not on the stack while others run.

  [[gnu::noinline]] uint32_t take_hits() { return tracer_.take_hits(); }
  /// Shades what the rays of the node have hit that is being traced. If it is a member's root, the light of
  /// the first round is left where it is gathered.
  [[gnu::noinline]] void shade_node(Member* root) {
    const uint32_t hit = kHasRoomForCode<Spu> ? tracer_.take_hits() : take_hits();
    if (hit == 0) return;
    if (!kHasRoomForCode<Spu> || root == nullptr)
      find_hit_points(scene_, tracer_.node().rays, tracer_.hits(), hit, store_.points);
    if (root != nullptr) copy_packet<Spu>(store_.points.point, root->point);
    for (uint32_t first = 0;;) {
      const bool is_left = root != nullptr && first == 0;
      const LightRound round = begin_round(first, is_left ? *root : store_.lit);
      tracer_.shade_hits(store_.points, hit, round);
      if (!is_left) {
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
    traversal_.find_closest(tracer_.node().rays, tracer_.node().lanes, tracer_.hits(),
                            tracer_.node().reflected);
  }

  /// What a member's primary rays see but for the light that is asked for later.
  void keep(Member& member, const VectorLanes& seen) {
    if constexpr (kPoolsRays<Spu>)
      pool_.put(static_cast<uint32_t>(&member - store_.members), member.lanes, seen, samples_);
    else
      copy_packet<Spu>(seen, member.shaded.seen);
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
    tracer_.pooling().pool = has_own_lanes(frame_) ? nullptr : &pool_.rays;
    pool_.begin();
    tracer_.add_clear_to(pool_.clear);
  }
  /// Traces the rays that have left their packets.
  template <class Stopped> bool trace_pooled(Stopped stopped) {
    while (!pool_.rays.empty()) {
      if (stopped()) return false;
      tracer_.begin(pool_.rays.take());
      const uint32_t lanes = tracer_.node().lanes;
      pool_.clear_lanes();
      find_closest();
      shade_node(nullptr);
      if (!trace_tree(stopped)) return false;
      pool_.add_to_pixels(tracer_.pooling().pixels, lanes, tracer_.light(), samples_);
    }
    return true;
  }

  /// The light of a round at the hits of the node that is being traced.
  [[gnu::noinline]] void light_packet(uint32_t hit, const LightRound& round) {
    lit_ = &tracer_.node();
    for_each_light(scene_, frame_, round.first, round.count, [&](uint32_t number, const LightRecord& light) {
      if (!is_asked_for(light)) return;
      VectorLanes& colour = round.gathered[number - round.first];
      ask_for(light, store_.lit, store_.points.point, tracer_.hits().object, is_aimed(number, round.first),
              tracer_.lanes_that_count(colour, hit), colour);
    });
  }

  const FrameBlock& frame_;
  SceneAccess<Spu>& scene_;
  SampleBundle<Spu>* samples_;
  Traversal<Spu, kAccelerators> traversal_;
  RayNode& scratch_; ///< the tracer's while surfaces are shaded, else that of shadow rays that are walked
  RayTracer<Spu> tracer_;
  Store& store_;
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

    /// No light has come yet.
    void begin() {
      if (is_sorted)
        for (uint32_t i = 0; i < kPackets; ++i)
          light[i].template store<S>({F(0.0f), F(0.0f), F(0.0f)});
    }
    void clear_lanes() { F(0.0f).store(clear.lane); }
    /// What the primary rays of a member see, and how clear their way is.
    void put(uint32_t member, uint32_t lanes, const VectorLanes& seen, SampleBundle<Spu>* samples) {
      if (is_sorted) return add_to_pixels(sorter.places(member), lanes, seen, samples);
      light[member] = seen;
      if (samples != nullptr) samples->at[member].clear = clear;
    }
    /// More light for some of them that have been sorted.
    void add(uint32_t member, uint32_t lanes, const LightRound& round) {
      if (!is_sorted) return; // light_of() adds it
      VectorLanes more;
      more.template store<S>(round.template sum<S>());
      add_to_pixels(sorter.places(member), lanes, more, nullptr);
    }
    /// All that has come to the pixels of a member.
    V3<S> light_of(uint32_t member, uint32_t lanes, const LightRound& round) const {
      const V3<S> seen = light[member].template load<S>();
      if (is_sorted || lanes == 0) return seen;
      return select<S>(S::M::from_bits(lanes), seen + round.template sum<S>(), seen);
    }
    /// Light of rays that have left their packets, and if there are samples how clear their way is.
    void add_to_pixels(const WordLanes& pixels, uint32_t lanes, const VectorLanes& from,
                       SampleBundle<Spu>* samples) {
      for_each_lane(lanes, [&](uint32_t lane) {
        const uint32_t packet = pixels.lane[lane] / kSimdLanes, to = pixels.lane[lane] % kSimdLanes;
        VectorLanes& sum = light[packet];
        sum.x.lane[to] += from.x.lane[lane];
        sum.y.lane[to] += from.y.lane[lane];
        sum.z.lane[to] += from.z.lane[lane];
        if (samples != nullptr) samples->at[packet].clear.lane[to] += clear.lane[lane];
      });
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

// What a bundle of packets sees: what its primary rays hit and what light comes there is searched for
// together; from there on each packet's tree of rays is worked off by itself. Kernel dialect.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/accel/traversal.hpp"
#include "kernel/cameras/primary_rays.hpp"
#include "kernel/program/pixel_sampler.hpp"
#include "kernel/shading/ray_tracer.hpp"
#include "kernel/shading/shadow_tracer.hpp"

namespace celltrace::kernel {

/// Shadow rays of a packet's hit points, and the light that these send on if nothing is in the way.
struct LitPoints {
  ShadowRays to_light;
  VectorLanes light[kLightsARound]; ///< that they send on, gathered in a round
};
/// The rest of hits once they are shaded; the objects are where they were.
struct ShadedHits {
  WordLanes object;
  VectorLanes seen; ///< where rays stay in their packets: all but the gathered light
};
/// A packet of a bundle. `PrimaryRays`: where its rays are.
template <class S, class PrimaryRays> struct BundleMember : LitPoints, PrimaryRays {
  V3<S> point; ///< once they are shaded: where they have hit something
  union {
    HitPacket hits; ///< until they are shaded
    ShadedHits shaded;
  };
  uint32_t number; ///< in its bundle
  uint32_t column, row;
  uint32_t pixels;     ///< lanes in the picture
  uint32_t lanes, hit; ///< of them, those that have a ray; of these, those that hit something
};

// A strategy's Trees say whether rays stay in the packets of their trees. They have
//
//   PrimaryRays                       the primary rays of a member are `of(member)`
//   search(column, row, put, fill)    finds what primary rays hit; false: nothing, and all has been put
//   begin_trees()
//   hint(i)                           member i will be shaded soon
//   shade_end(member)                 whether all that a member sees is known, as no rays go on
//   begin_tree(member)
//   take_hits()                       as RayTracer's
//   knows_points(root)                whether the points that a node has hit are known; null: it is no root
//   leave_ends(hit)                   hits that are left for later
//   leave_light(number, lanes, colour)  whether light at the node is left for later
//   keep_tree(member)                 what a member sees is complete, but for what has been left
//   end_tree()
//   finish(stopped)                   works off what has been left; false: it was stopped on the way
//   drop()                            forgets it
//   add_left_light(member)            adds what came of light that the root's first round gathered
//   lanes_with_ray(member), light_of(member)    what its pixels see

/// Traces bundles.
template <class Spu, uint32_t kAccelerators = kAnyAccelerator>
class BundleTracer : public Strategy<Spu>::template Trees<BundleTracer<Spu, kAccelerators>, Spu> {
  using Trees = typename Strategy<Spu>::template Trees<BundleTracer, Spu>;
  friend Trees;

public:
  using S = typename Spu::simd;
  using F = typename S::F;

  /// `spill`: room for FrameBlock::ray_stack_nodes nodes. `samples` says where the rays of frames of samples
  /// go through; null: there are no such frames. Inlined: it would take much of an SPE's stack by itself.
  [[gnu::always_inline]] BundleTracer(Spu& spu, const FrameBlock& frame, SceneAccess<Spu>& scene, ea_t spill,
                                      SampleBundle<Spu>* samples)
      : Trees(spu, samples), frame_(frame), scene_(scene), samples_(samples),
        scratch_(*spu.template allocate<RayNode>()),
        tracer_(spu, frame, scene, spill, frame.ray_stack_nodes, scratch_),
        store_(*spu.template allocate<Store>()), shadows_(spu, frame, scene, scratch_, tracer_.counters()) {}

  /// Calls `put(column, row, colours)` for each packet in the picture of the bundle at (column, row); that
  /// counts bundles, `put` packets. Or `fill(column, row, colour)` where all of the bundle has one colour and
  /// is in the picture. In a frame of samples the bundle is theirs, and at (0, 0). Asks `stopped()` before
  /// each further node of a ray tree, of which there may be as many as take minutes; once that is true the
  /// rest of the bundle is left out.
  template <class Put, class Fill, class Stopped>
  void trace(uint32_t column, uint32_t row, Put put, Fill fill, Stopped stopped) {
    if (takes_samples()) column = row = 0;
    if (!Trees::search(column, row, put, fill)) return;
    if (!trace_trees(stopped)) return Trees::drop();
    for_each_member([&](Member & member) __attribute__((always_inline)) {
      V3<S> seen = Trees::light_of(member);
      blacken(member, Trees::lanes_with_ray(member), seen);
      put(member.column, member.row, seen);
    });
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
  using PrimaryRays = typename Trees::PrimaryRays;
  using Member = BundleMember<S, PrimaryRays>;
  static constexpr uint32_t kEdge = kBundleEdge<Spu>;
  static constexpr uint32_t kPackets = kBundlePackets<Spu>;
  static constexpr uint32_t kFirstHitTag = 7;

  struct Store {
    Member members[kPackets];
    // Of the node that is being shaded.
    HitPoints<S> points;
    union {
      LitPoints lit;             ///< if it is no root
      FirstHitRecord first_hits; ///< of a root, on their way to main memory
    };
  };

  /// Calls `visit` with each packet in the picture.
  template <class Visit> [[gnu::always_inline]] void for_each_member(const Visit& visit) {
    for (uint32_t i = 0; i < kPackets; ++i)
      if (store_.members[i].pixels != 0) visit(store_.members[i]);
  }

  // --- search ---

  bool takes_samples() const { return static_cast<FramePurpose>(frame_.purpose) == FramePurpose::samples; }
  void place(uint32_t column, uint32_t row) {
    for (uint32_t i = 0; i < kPackets; ++i) {
      Member& member = store_.members[i];
      member.number = i;
      member.column = column * kEdge + i % kEdge;
      member.row = row * kEdge + i / kEdge;
      const bool inside = member.column < frame_.packet_columns && member.row < frame_.packet_rows;
      member.pixels = inside ? lanes_in_picture(frame_, member.column, member.row) : 0;
      if (takes_samples()) member.pixels = samples_->lanes[i];
      member.lanes = member.pixels;
    }
  }
  /// Those of a member; returns the lanes that have one.
  uint32_t make_rays(uint32_t number) {
    Member& member = store_.members[number];
    F x = pixels_across<S>(frame_, member.column), y = pixels_down<S>(frame_, member.row);
    if (takes_samples()) {
      x = F::load(samples_->at[number].x.lane);
      y = F::load(samples_->at[number].y.lane);
    }
    return make_rays_through(scene_.spu(), frame_.camera, x, y, PrimaryRays::of(member));
  }
  /// `run` answers the queries of all packets; those of packets outside are for nothing. `sort` may give the
  /// rays other places.
  template <class Run, class Sort> void find_hits(Run run, Sort sort) {
    RayQuery queries[kPackets];
    for (uint32_t i = 0; i < kPackets; ++i) {
      Member& member = store_.members[i];
      if (member.pixels != 0) member.lanes &= make_rays(i);
      queries[i] = {&PrimaryRays::of(member), &member.hits, nullptr, nullptr, member.lanes};
    }
    run(queries);
    sort();
    for (uint32_t i = 0; i < kPackets; ++i) {
      Member& member = store_.members[i];
      member.hit = hit_lanes<S>(member.hits, member.lanes);
    }
  }

  // --- surfaces ---

  /// Works off the trees of all packets. What the first round gathers of the roots' light is asked for when
  /// all roots have been shaded, for all of them together, and added last: so the sum does not depend on who
  /// traces what when. False: it was stopped on the way.
  template <class Stopped> CELLTRACE_ONE_COPY bool trace_trees(Stopped stopped) {
    Trees::begin_trees();
    for (uint32_t i = 0; i < kPackets; ++i) {
      Member& member = store_.members[i];
      Trees::hint(i + 1);
      if (member.pixels != 0 && wants_first_hits()) {
        scene_.spu().enter_module(modules::kFirstHits);
        put_first_hits(member);
      }
      if (member.lanes == 0 || !shade_root(member)) continue;
      if (!trace_tree(stopped)) return false;
      Trees::keep_tree(member);
      Trees::end_tree();
    }
    find_lights();
    if (!Trees::finish(stopped)) return false;
    for (uint32_t i = 0; i < kPackets; ++i)
      if (store_.members[i].hit != 0) Trees::add_left_light(store_.members[i]);
    return true;
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
    if (member.hit != 0)
      find_hit_points(scene_, PrimaryRays::of(member), member.hits, member.hit, store_.points);
    FirstHitRecord& record = store_.first_hits;
    for (uint32_t lane = 0; lane < kSimdLanes; ++lane) {
      const bool is_hit = (member.hit >> lane & 1) != 0;
      record.distance[lane] = member.hits.distance.lane[lane];
      record.interior[lane] = is_hit ? points.interior.lane[lane] : kNoOffset;
    }
    if (frame_.camera.ahead != 0.0f) {
      const F way = way_to_start<S>(frame_.camera, PrimaryRays::of(member).direction.template load<S>());
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
    Strategy<Spu>::template begin_round<S>(round, lit);
    return round;
  }
  /// Shades what the primary rays of a member hit. False: all that they see is known but for the light that
  /// is asked for later. Otherwise the member's tree has begun.
  bool shade_root(Member& member) {
    if (Trees::shade_end(member)) return false;
    Trees::begin_tree(member);
    tracer_.begin(PrimaryRays::of(member), member.lanes);
    copy_packet<Spu>(member.hits, tracer_.hits());
    shade_node(&member);
    return true;
  }
  // Not inlined: one copy of each saves local store, and their vectors are not on the stack while others run.

  /// Shades what the rays of the node have hit that is being traced. If it is a member's root, the light of
  /// the first round is left where it is gathered.
  CELLTRACE_ONE_COPY void shade_node(Member* root) {
    uint32_t hit = Trees::take_hits();
    if (hit == 0) return;
    if (!Trees::knows_points(root))
      find_hit_points(scene_, tracer_.node().rays, tracer_.hits(), hit, store_.points);
    if (root != nullptr)
      copy_packet<Spu>(store_.points.point, root->point);
    else
      hit &= ~Trees::leave_ends(hit);
    if (hit == 0) return;
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

  // --- light ---

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
        shadows_.trace(light, member.to_light, member.point, member.shaded.object,
                       Strategy<Spu>::is_aimed(number, 0), lanes, colour);
        continue;
      }
      shadows_.aim(light, member.to_light, member.point, member.shaded.object,
                   Strategy<Spu>::is_aimed(number, 0), lanes);
      queries[asked++] = {&member.to_light.rays, nullptr, &member.to_light.distance, &colour, lanes};
    }
    if (asked != 0) shadows_.trace(light, queries, asked);
  }
  /// The light of a round at the hits of the node that is being traced.
  CELLTRACE_ONE_COPY void light_packet(uint32_t hit, const LightRound& round) {
    for_each_light(scene_, frame_, round.first, round.count, [&](uint32_t number, const LightRecord& light) {
      if (!is_asked_for(light)) return;
      VectorLanes& colour = round.gathered[number - round.first];
      uint32_t lanes = tracer_.lanes_that_count(colour, hit);
      if (Trees::leave_light(number, lanes, colour)) lanes = 0;
      shadows_.set_interiors(&tracer_.node());
      shadows_.trace(light, store_.lit.to_light, store_.points.point, tracer_.hits().object,
                     Strategy<Spu>::is_aimed(number, round.first), lanes, colour);
    });
  }

  // --- pixels ---

  /// Makes pixels black that have no ray.
  [[gnu::always_inline]] void blacken(const Member& member, uint32_t with_ray, V3<S>& seen) {
    if (with_ray == member.pixels) return;
    const F black(0.0f);
    seen = select<S>(S::M::from_bits(with_ray), seen, {black, black, black});
    if (samples_ != nullptr)
      for_each_lane(member.pixels & ~with_ray,
                    [&](uint32_t lane) { samples_->at[member.number].clear.lane[lane] = 1.0f; });
  }

  const FrameBlock& frame_;
  SceneAccess<Spu>& scene_;
  SampleBundle<Spu>* samples_;
  RayNode& scratch_; ///< the tracer's while surfaces are shaded, else that of shadow rays that are walked
  RayTracer<Spu> tracer_;
  Store& store_;
  ShadowTracer<Spu, kAccelerators> shadows_;
};

} // namespace celltrace::kernel

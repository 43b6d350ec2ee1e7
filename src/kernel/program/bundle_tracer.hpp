// Tracing of bundles: the hits of primary rays, and the light at these hits, are found for all packets
// together. Otherwise each packet's ray tree is traced by itself. Kernel dialect.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/accel/traversal.hpp"
#include "kernel/cameras/primary_rays.hpp"
#include "kernel/program/pixel_sampler.hpp"
#include "kernel/shading/ray_tracer.hpp"
#include "kernel/shading/shadow_tracer.hpp"

namespace celltrace::kernel {

/// Shadow rays of a packet's hit points, and the light that these send on if nothing occludes it.
struct LitPoints {
  ShadowRays to_light;
  VectorLanes light[kLightsARound]; ///< light gathered in a round
};
/// Results of hits once they are shaded; the objects have the same place as in HitPacket.
struct ShadedHits {
  WordLanes object;
  VectorLanes seen; ///< if rays stay in their packets: colours without the gathered light
};
/// A packet of a bundle. `PrimaryRays` determines where its rays are stored.
template <class S, class PrimaryRays> struct BundleMember : LitPoints, PrimaryRays {
  V3<S> point; ///< hit points, once these are shaded
  union {
    HitPacket hits; ///< until the hits are shaded
    ShadedHits shaded;
  };
  uint32_t number; ///< index in its bundle
  uint32_t column, row;
  uint32_t pixels;     ///< lanes in the picture
  uint32_t lanes, hit; ///< `lanes`: pixels that have a ray; `hit`: lanes whose ray hits something
};

// A strategy's Trees decide whether rays stay in the packets of their trees. Trees have
//
//   PrimaryRays                       type whose `of(member)` returns the primary rays of a member
//   search(column, row, put, fill)    finds the hits of primary rays; false: none, and all pixels are put
//   begin_trees()                     is called before the members are shaded
//   hint(i)                           prefetches records for member i, which will be shaded soon
//   shade_end(member)                 shades a member whose hits spawn no rays; false: it does spawn some
//   begin_tree(member)                is called before the tree of a member is traced
//   take_hits()                       does what RayTracer::take_hits() does
//   has_hit_points(root)              true if the hit points of a node are known; `root`: null if no root
//   defer_ends(hit)                   returns the hits of a node that are shaded later
//   defer_light(number, lanes, colour)  true if light of a node is traced later
//   store_tree(member)                stores the colours of a member, which lack what was left for later
//   end_tree()                        is called after the tree of a member was traced
//   finish(stopped)                   traces and shades what was left for later; false: it was stopped
//   drop()                            forgets what was left for later
//   add_deferred_light(member)        adds the unoccluded light that the root's first round gathered
//   lanes_with_ray(member), light_of(member)    return the pixels with a ray, and their colours

/// Traces bundles.
template <class Spu, uint32_t kAccelerators = kAnyAccelerator>
class BundleTracer : public Strategy<Spu>::template Trees<BundleTracer<Spu, kAccelerators>, Spu> {
  using Trees = typename Strategy<Spu>::template Trees<BundleTracer, Spu>;
  friend Trees;

public:
  using S = typename Spu::simd;
  using F = typename S::F;

  /// Allocates memory. `spill` has room for FrameBlock::ray_stack_nodes nodes. `samples` are the positions of
  /// rays in frames of samples; null: there are no such frames. Inlined, as it would take much of an SPE's
  /// stack by itself.
  [[gnu::always_inline]] BundleTracer(Spu& spu, const FrameBlock& frame, SceneAccess<Spu>& scene, ea_t spill,
                                      SampleBundle<Spu>* samples)
      : Trees(spu, samples), frame_(frame), scene_(scene), samples_(samples),
        scratch_(*spu.template allocate<RayNode>()),
        tracer_(spu, frame, scene, spill, frame.ray_stack_nodes, scratch_),
        store_(*spu.template allocate<Store>()), shadows_(spu, frame, scene, scratch_, tracer_.counters()) {}

  /// Traces the bundle at (column, row), counted in bundles. Calls `put(column, row, colours)` for each
  /// packet in the picture, counted in packets, or `fill(column, row, colour)` if the whole bundle is in the
  /// picture and has one colour. In a frame of samples the bundle consists of the samples, and is at (0, 0).
  /// Calls `stopped()` before each further node of a ray tree, as a tree may take minutes; if it returns
  /// true, the rest of the bundle is left out.
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

  /// Returns local store that is unused between two calls of trace().
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
    // For the node that is being shaded:
    HitPoints<S> points;
    union {
      LitPoints lit;             ///< if the node is not a root
      FirstHitRecord first_hits; ///< first hits of a root, while they are put to main memory
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
  /// Makes the rays of a member; returns the lanes that have a ray.
  uint32_t make_rays(uint32_t number) {
    Member& member = store_.members[number];
    F x = pixels_across<S>(frame_, member.column), y = pixels_down<S>(frame_, member.row);
    if (takes_samples()) {
      x = F::load(samples_->at[number].x.lane);
      y = F::load(samples_->at[number].y.lane);
    }
    return make_rays_through(scene_.spu(), frame_.camera, x, y, PrimaryRays::of(member));
  }
  /// Finds the hits of primary rays. `run` answers the queries of all packets; results of packets outside the
  /// picture are not used. `sort` may move rays to other packets.
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

  /// Traces the trees of all packets. The light that the first round gathers at the roots is searched for
  /// when all roots have been shaded, for all of them together, and added last, so that the sum does not
  /// depend on the order of tracing. Returns false if it was stopped.
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
      Trees::store_tree(member);
      Trees::end_tree();
    }
    find_lights();
    if (!Trees::finish(stopped)) return false;
    for (uint32_t i = 0; i < kPackets; ++i)
      if (store_.members[i].hit != 0) Trees::add_deferred_light(store_.members[i]);
    return true;
  }

  bool wants_first_hits() const {
    return static_cast<FramePurpose>(frame_.purpose) == FramePurpose::grid &&
           (frame_.light_features & light_feature::first_hits) != 0;
  }
  /// Puts the first hits of a member's primary rays to main memory.
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
      const F ahead = start_offset<S>(frame_.camera, PrimaryRays::of(member).direction.template load<S>());
      (F::load(record.distance) + ahead).store(record.distance);
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
  /// Shades the hits of a member's primary rays. Returns false if the member is complete except for light
  /// that is added later. Otherwise its tree has begun.
  bool shade_root(Member& member) {
    if (Trees::shade_end(member)) return false;
    Trees::begin_tree(member);
    tracer_.begin(PrimaryRays::of(member), member.lanes);
    copy_packet<Spu>(member.hits, tracer_.hits());
    shade_node(&member);
    return true;
  }
  // The functions are not inlined: one copy of each saves local store, and their vectors are not on the stack
  // while others run.

  /// Shades the hits of the current node. If it is the root of a member, the light of the first round is left
  /// where it is gathered.
  CELLTRACE_ONE_COPY void shade_node(Member* root) {
    uint32_t hit = Trees::take_hits();
    if (hit == 0) return;
    if (!Trees::has_hit_points(root))
      find_hit_points(scene_, tracer_.node().rays, tracer_.hits(), hit, store_.points);
    if (root != nullptr)
      copy_packet<Spu>(store_.points.point, root->point);
    else
      hit &= ~Trees::defer_ends(hit);
    if (hit == 0) return;
    shade_points(root, hit);
  }
  /// Shades hits whose points are known.
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
  /// Traces the remaining nodes of a tree. Returns false if it was stopped.
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

  /// Traces shadow rays for the light that has been gathered at the hits of primary rays. Not inlined, so
  /// that records of lights are not on the stack while hits are shaded.
  CELLTRACE_ONE_COPY void find_lights() {
    const LightRound lights = LightRound::from(frame_, 0, nullptr);
    shadows_.set_interiors(nullptr);
    for_each_light(scene_, frame_, 0, lights.count, [&](uint32_t number, const LightRecord& light) {
      if (needs_shadow_rays(light)) find_light(number, light);
    });
  }
  void find_light(uint32_t number, const LightRecord& light) {
    RayQuery queries[kPackets];
    const bool by_packet = shadows_.traces_by_packet(light);
    const bool is_at_pinhole = shadows_.is_at_pinhole(light);
    uint32_t query_count = 0;
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
      queries[query_count++] = {&member.to_light.rays, nullptr, &member.to_light.distance, &colour, lanes};
    }
    if (query_count != 0) shadows_.trace(light, queries, query_count);
  }
  /// Traces shadow rays for the light of a round at the hits of the current node.
  CELLTRACE_ONE_COPY void light_packet(uint32_t hit, const LightRound& round) {
    for_each_light(scene_, frame_, round.first, round.count, [&](uint32_t number, const LightRecord& light) {
      if (!needs_shadow_rays(light)) return;
      VectorLanes& colour = round.gathered[number - round.first];
      uint32_t lanes = tracer_.lanes_that_count(colour, hit);
      if (Trees::defer_light(number, lanes, colour)) lanes = 0;
      shadows_.set_interiors(&tracer_.node());
      shadows_.trace(light, store_.lit.to_light, store_.points.point, tracer_.hits().object,
                     Strategy<Spu>::is_aimed(number, round.first), lanes, colour);
    });
  }

  // --- pixels ---

  /// Makes pixels without a ray black.
  [[gnu::always_inline]] void blacken(const Member& member, uint32_t with_ray, V3<S>& seen) {
    if (with_ray == member.pixels) return;
    const F black(0.0f);
    seen = select<S>(S::M::from_bits(with_ray), seen, {black, black, black});
    if (samples_ != nullptr)
      for_each_lane(member.pixels & ~with_ray,
                    [&](uint32_t lane) { samples_->at[member.number].transparency.lane[lane] = 1.0f; });
  }

  const FrameBlock& frame_;
  SceneAccess<Spu>& scene_;
  SampleBundle<Spu>* samples_;
  RayNode& scratch_; ///< node of the tracer while surfaces are shaded, else of walked shadow rays
  RayTracer<Spu> tracer_;
  Store& store_;
  ShadowTracer<Spu, kAccelerators> shadows_;
};

} // namespace celltrace::kernel

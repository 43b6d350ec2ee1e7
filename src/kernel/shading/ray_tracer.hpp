// Raytrace: what a packet of primary rays sees. The ray tree is walked with an explicit stack and cut by
// level and by contribution (adaptive depth control, Hall and Greenberg 1983). Kernel dialect.
#pragma once

#include "kernel/modules.hpp"
#include "kernel/shading/intersector.hpp"
#include "kernel/shading/secondary_rays.hpp"

namespace celltrace::kernel {

struct RayCounters {
  uint64_t primary = 0, shadow = 0, reflection = 0, refraction = 0;
  uint64_t dropped = 0; ///< beyond what the stacks hold
};

/// The tree of one packet at a time. `Answers` says what rays hit and what light comes through to them: a
/// Intersector, or where another SPE searches, what hands its answers on. With trace() the tree is worked off
/// at once; whoever has to wait for answers takes its steps: begin(), then for each node() take_hits() and
/// shade_hits(), until advance() finds no more.
template <class Spu, class Answers = Intersector<Spu>, uint32_t kResident = kResidentNodes> class RayTracer {
public:
  using S = typename Spu::simd;
  using F = typename S::F;
  using I = typename S::I;
  using M = typename S::M;

  RayTracer(Spu& spu, const FrameBlock& frame, SceneAccess<Spu>& scene, ea_t spill)
      // In braces, so that every compiler allocates in this order.
      : RayTracer{spu,
                  frame,
                  scene,
                  spill,
                  frame.ray_stack_nodes,
                  *place_intersector(spu, frame, scene),
                  *spu.template allocate<RayNode>()} {}
  /// `spill` has room for `spill_nodes`. `scratch` may be shared by tracers.
  RayTracer(Spu& spu, const FrameBlock& frame, SceneAccess<Spu>& scene, ea_t spill, uint32_t spill_nodes,
            Answers& intersector, RayNode& scratch)
      : frame_(frame), scene_(scene), intersector_(intersector), stack_(spu, spill, spill_nodes),
        node_(*spu.template allocate<RayNode>()), child_(scratch) {}

  /// The colours of primary rays, which leave the camera. What they hit is known, and the intersector may
  /// know what light comes there. Points of later hits replace the first ones'.
  [[gnu::always_inline]] V3<S> trace(const RayPacket& rays, uint32_t lanes, const HitPacket& hits,
                                     HitPoints<S>& points) {
    if constexpr (kHasRoomForCode<Spu>) {
      V3<S> colour;
      if (ends_at_once(rays, lanes, hits, points, colour)) return colour;
    }
    begin(rays, lanes);
    hits_ = hits;
    uint32_t hit = take_hits();
    for (;;) {
      if (hit != 0) shade_hits(points, hit);
      intersector_.forget_light();
      if (!advance()) return light();
      intersector_.find_closest(node_.rays, node_.lanes, hits_);
      hit = take_hits();
      if (hit != 0) find_hit_points(scene_, node_.rays, hits_, hit, points);
    }
  }

  /// Those of `rays` primary rays that hit nothing.
  V3<S> background(uint32_t rays) {
    counters_.primary += rays;
    return splat3<S>(frame_.background);
  }

  /// Starts the tree of a packet of primary rays.
  void begin(const RayPacket& rays, uint32_t lanes) {
    scene_.spu().compute(scalar_work::kPrimaryPacket);
    clear(0);
    accumulators_in_use_ = 1;
    start(rays, lanes);
  }
  /// The rays whose closest hits are wanted next, and where to put them.
  const RayNode& node() const { return node_; }
  HitPacket& hits() { return hits_; }
  /// The lanes of node() that hit something; the others see the background.
  uint32_t take_hits() {
    scene_.spu().compute(scalar_work::kNode);
    const uint32_t hit = hit_lanes<S>(hits_, node_.lanes);
    const uint32_t missed = node_.lanes & ~hit;
    if (missed != 0) add(missed, splat3<S>(frame_.background));
    return hit;
  }
  /// The light of the surfaces that take_hits() told of, and the rays that go on from there.
  [[gnu::always_inline]] void shade_hits(const HitPoints<S>& points, uint32_t hit) {
    const Surfaces<S> surfaces = {points.point, points.normal, node_.rays.direction.template load<S>(),
                                  &hits_.object};
    if (const uint32_t plain = hit & ~points.blended; plain != 0)
      spawn(surfaces, points.interior, shade(surfaces, points.interior, points.material, plain, F(1.0f)));
    if (points.blended != 0) shade_blended(surfaces, points);
  }
  /// Goes on to the next node() of the tree. False: there is none, light() is complete.
  bool advance() {
    while (!stack_.empty()) {
      stack_.pop(node_);
      if (node_.gathers == 0) return true;
      gather();
    }
    return false;
  }
  V3<S> light() const { return light_[0].template load<S>(); }

  Answers& intersector() { return intersector_; }

  void reset_counters() {
    counters_ = RayCounters();
    intersector_.reset_counters();
    stack_.reset_counters();
  }
  const RayCounters& counters() const { return counters_; }
  const TraversalCounters& traversal_counters() const { return intersector_.counters(); }
  uint32_t spilled_nodes() const { return stack_.spilled(); }

private:
  static Answers* place_intersector(Spu& spu, const FrameBlock& frame, SceneAccess<Spu>& scene) {
    struct Storage {
      alignas(16) uint8_t bytes[sizeof(Answers)];
    };
    return new (static_cast<void*>(spu.template allocate<Storage>())) Answers(scene, frame);
  }

  static uint32_t count(uint32_t lanes) { return static_cast<uint32_t>(__builtin_popcount(lanes)); }

  /// As trace(), of rays that go on nowhere; false if some do.
  bool ends_at_once(const RayPacket& rays, uint32_t lanes, const HitPacket& hits, const HitPoints<S>& points,
                    V3<S>& colour) {
    const uint32_t hit = hit_lanes<S>(hits, lanes);
    if (hit != 0) {
      if (points.blended != 0) return false;
      const MaterialLanes<S> m = gather_materials(scene_, points.material, hit);
      if (m.has_reflection || m.has_transmission) return false;
      const Surfaces<S> surfaces = {points.point, points.normal, rays.direction.template load<S>(),
                                    &hits.object};
      colour = local_light(scene_, intersector_, frame_, surfaces, m, hit, counters_.shadow);
    }
    intersector_.forget_light();
    const V3<S> behind = background(count(lanes));
    colour = hit != 0 ? select<S>(M::from_bits(hit), colour, behind) : behind;
    return true;
  }

  /// The root of the tree: the rays as they leave the camera.
  void start(const RayPacket& rays, uint32_t lanes) {
    node_.rays = rays;
    node_.throughput.template store<S>({F(1.0f), F(1.0f), F(1.0f)});
    F(1.0f).store(node_.weight.lane);
    fill(node_.level, 0);
    fill(node_.interior_depth, frame_.camera_interior_count);
    for (uint32_t d = 0; d < frame_.camera_interior_count; ++d)
      fill(node_.interiors[d], frame_.camera_interiors[d]);
    node_.lanes = lanes;
    node_.target = 0;
    node_.gathers = 0;
    counters_.primary += count(lanes);
  }
  static void fill(WordLanes& lanes, uint32_t value) {
    S::I::splat(static_cast<int32_t>(value)).store(reinterpret_cast<int32_t*>(lanes.lane));
  }

  bool push() {
    const bool room = stack_.push(child_);
    if (!room) counters_.dropped += count(child_.lanes);
    return room;
  }

  void clear(uint32_t accumulator) { light_[accumulator].template store<S>({F(0.0f), F(0.0f), F(0.0f)}); }

  void add(uint32_t lanes, const V3<S>& light) {
    VectorLanes& target = light_[node_.target];
    const V3<S> sum = target.template load<S>();
    const V3<S> weighted = light * node_.throughput.template load<S>();
    target.template store<S>(select<S>(M::from_bits(lanes), sum + weighted, sum));
  }

  /// The light of a reflection is complete.
  void gather() {
    const V3<S> sum = light_[node_.gathers].template load<S>();
    const F power = F::load(node_.power.lane);
    --accumulators_in_use_;
    add(node_.lanes, {pow<S>(sum.x, power), pow<S>(sum.y, power), pow<S>(sum.z, power)});
  }

  /// Faces with three materials: each is shaded whole, and the results are blended by the vertices' weights.
  /// Adaptive depth control drops a material by its weight alone, as POV-Ray does. What goes on goes the same
  /// ways for all three: as one ray each where it weighs the same, or every such face would multiply the rays
  /// behind it.
  void shade_blended(const Surfaces<S>& surfaces, const HitPoints<S>& points) {
    const F u = F::load(hits_.u.lane);
    const F v = F::load(hits_.v.lane);
    const F weights[3] = {F(1.0f) - u - v, u, v};
    SecondaryRays<S> all = SecondaryRays<S>::nothing();
    for (uint32_t corner = 0; corner < 3; ++corner) {
      const F w = weights[corner];
      const uint32_t lanes = points.blended & (w >= F(frame_.adc_bailout)).bits();
      if (lanes == 0) continue;
      WordLanes materials = points.material;
      for_each_lane(lanes, [&](uint32_t lane) {
        materials.lane[lane] = scene_.blend(points.material.lane[lane])->material[corner];
      });
      const SecondaryRays<S> one = shade(surfaces, points.interior, materials, lanes, w);
      if (all.is_nothing())
        all = one;
      else if (all.weighs_like(one))
        all.add(one);
      else
        spawn(surfaces, points.interior, one);
    }
    spawn(surfaces, points.interior, all);
  }

  /// Adds the surface's own light, times `share`; returns what goes on. Not inlined, as spawn() is not:
  /// local store has no room for a copy at each call.
  [[gnu::noinline]] SecondaryRays<S> shade(const Surfaces<S>& surfaces, const WordLanes& interior,
                                           const WordLanes& materials, uint32_t lanes, const F& share) {
    scene_.spu().compute(scalar_work::kShade);
    const MaterialLanes<S> m = gather_materials(scene_, materials, lanes);
    add(lanes, local_light(scene_, intersector_, frame_, surfaces, m, lanes, counters_.shadow) * share);
    if (!m.has_reflection && !m.has_transmission) return SecondaryRays<S>::nothing();
    scene_.spu().compute(scalar_work::kSecondaryRays);
    scene_.spu().enter_module(modules::kSecondary);
    F fresnel_ratio(1.0f);
    if (m.fresnel != 0)
      fresnel_ratio = F::load(fresnel_ratios(scene_, interior, lanes & m.fresnel, node_).lane);
    return secondary_rays_of<S>(m, -dot<S>(surfaces.direction, surfaces.normal), fresnel_ratio,
                                frame_.adc_bailout, lanes, share);
  }

  /// Pushes the rays that go on.
  [[gnu::noinline]] void spawn(const Surfaces<S>& surfaces, const WordLanes& interior,
                               const SecondaryRays<S>& onward) {
    if ((onward.mirrors | onward.clear) == 0) return;
    scene_.spu().compute(scalar_work::kSpawn);
    scene_.spu().enter_module(modules::kSecondary);
    const F cosine = -dot<S>(surfaces.direction, surfaces.normal);
    const V3<S> mirrored = mirror<S>(surfaces.direction, surfaces.normal, cosine);
    const uint32_t total = onward.clear != 0 ? transmit(surfaces, interior, onward, cosine, mirrored) : 0;
    reflect(surfaces, onward, onward.mirrors & ~total, mirrored);
  }

  /// Fills child_ with rays from the surfaces whose weight and level allow them; false if there are none.
  bool prepare_child(const Surfaces<S>& surfaces, const V3<S>& direction, const V3<S>& throughput,
                     const F& weight, uint32_t one_level_deeper, uint32_t lanes) {
    scene_.spu().compute(scalar_work::kChild);
    uint32_t go = 0;
    const M heavy = weight >= F(frame_.adc_bailout);
    for_each_lane(lanes & heavy.bits(), [&](uint32_t lane) {
      // A ray that goes straight on takes no level, but as in POV-Ray there has to be one left.
      const uint32_t level = node_.level.lane[lane];
      child_.level.lane[lane] = level + ((one_level_deeper >> lane) & 1);
      go |= static_cast<uint32_t>(level + 1 < frame_.max_trace_level) << lane;
    });
    if (go == 0) return false;
    child_.rays.origin.template store<S>(surfaces.point);
    child_.rays.direction.template store<S>(direction);
    child_.rays.start_object = *surfaces.objects;
    child_.throughput.template store<S>(node_.throughput.template load<S>() * throughput);
    weight.store(child_.weight.lane);
    child_.lanes = go;
    child_.target = node_.target;
    child_.gathers = 0;
    return true;
  }

  void reflect(const Surfaces<S>& surfaces, const SecondaryRays<S>& onward, uint32_t lanes,
               const V3<S>& mirrored) {
    if (lanes == 0) return;
    inherit_interiors();
    if (!prepare_child(surfaces, mirrored, onward.mirror, F::load(node_.weight.lane) * onward.mirror_weight,
                       lanes, lanes))
      return;
    counters_.reflection += count(child_.lanes);
    if (onward.bends_reflection && accumulators_in_use_ < kAccumulators) redirect(onward.reflection_power);
    push();
  }

  void inherit_interiors() {
    child_.interior_depth = node_.interior_depth;
    for (uint32_t d = 0; d < kMaxInteriorDepth; ++d)
      child_.interiors[d] = node_.interiors[d];
  }

  /// Sends the light of child_ to an accumulator of its own, from which a node pushed below it gathers it.
  void redirect(const F& power) {
    child_.gathers = accumulators_in_use_;
    power.store(child_.power.lane);
    if (!push()) return;
    child_.target = accumulators_in_use_++;
    child_.gathers = 0;
    child_.throughput.template store<S>({F(1.0f), F(1.0f), F(1.0f)});
    clear(child_.target);
  }

  /// Pushes the transmitted rays; returns the lanes that were totally reflected.
  uint32_t transmit(const Surfaces<S>& surfaces, const WordLanes& interior, const SecondaryRays<S>& onward,
                    const F& cosine, const V3<S>& mirrored) {
    scene_.spu().compute(scalar_work::kTransmit);
    scene_.spu().run_in_module(modules::kSecondary);
    inherit_interiors();
    const Refraction refraction = cross_surfaces(scene_, interior, onward.clear, child_, counters_.dropped);
    M beyond = M::none();
    const V3<S> bent =
        refract<S>(surfaces.direction, surfaces.normal, cosine, F::load(refraction.ratio.lane), beyond);
    const uint32_t total = beyond.bits() & onward.clear & ~refraction.straight;
    const M total_mask = M::from_bits(total);
    V3<S> direction = select<S>(M::from_bits(refraction.straight), surfaces.direction, bent);
    direction = select<S>(total_mask, mirrored, direction);
    // A totally reflected ray stays inside, unfiltered.
    for_each_lane(total, [&](uint32_t lane) {
      child_.interior_depth.lane[lane] = node_.interior_depth.lane[lane];
      for (uint32_t d = 0; d < kMaxInteriorDepth; ++d)
        child_.interiors[d].lane[lane] = node_.interiors[d].lane[lane];
    });
    const V3<S> unfiltered = {onward.clear_share, onward.clear_share, onward.clear_share};
    // POV-Ray's weight is that of a transmitted ray even where all light is reflected.
    if (prepare_child(surfaces, direction, select<S>(total_mask, unfiltered, onward.through),
                      F::load(node_.weight.lane) * onward.through_weight, onward.clear & ~refraction.straight,
                      onward.clear)) {
      counters_.refraction += count(child_.lanes);
      push();
    }
    return total;
  }

  const FrameBlock& frame_;
  SceneAccess<Spu>& scene_;
  Answers& intersector_;
  RayStack<Spu, kResident> stack_;
  RayNode& node_;  ///< being traced
  RayNode& child_; ///< being made
  HitPacket hits_;
  /// Deeper nesting of bent reflections than this leaves the innermost ones unbent.
  static constexpr uint32_t kAccumulators = 8;
  VectorLanes light_[kAccumulators];
  uint32_t accumulators_in_use_ = 1;
  RayCounters counters_;
};

} // namespace celltrace::kernel

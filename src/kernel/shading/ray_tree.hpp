// The ray tree of a packet of primary rays: the node that is being traced, the stack of waiting nodes, the
// accumulated light, and the secondary rays of surfaces. The tree is cut by level and by contribution
// (adaptive depth control, Hall and Greenberg 1983). Kernel dialect.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/modules.hpp"
#include "kernel/shading/fading.hpp"
#include "kernel/shading/lighting.hpp"
#include "kernel/shading/secondary_rays.hpp"
#include "kernel/shading/shadow_walk.hpp"
#include "kernel/shading/surface_lanes.hpp"

namespace celltrace::kernel {

struct RayCounters {
  uint64_t primary = 0, shadow = 0, reflection = 0, refraction = 0;
  uint64_t dropped = 0; ///< rays beyond the capacity of the stacks
};

/// The part of a RayTracer that manages the tree. The parts are base classes: pointers from one part to
/// another would cost an SPE code that it has no room for.
template <class Spu, uint32_t kResident> class RayTree {
public:
  using S = typename Spu::simd;
  using R = typename Spu::rare_simd;
  using F = typename S::F;
  using I = typename S::I;
  using M = typename S::M;

  /// Starts the tree of a packet of primary rays.
  void begin(const RayPacket& rays, uint32_t lanes) {
    scene_.spu().compute(scalar_work::kPrimaryPacket);
    clear(0);
    accumulators_in_use_ = 1;
    stack_.clear(); // the previous tree may have been broken off
    start(rays, lanes);
  }
  /// Starts with rays of a pool. Each of these rays continues a tree of its own.
  template <class PooledPacket> void begin(const PooledPacket& packet) {
    clear(0);
    accumulators_in_use_ = 1;
    stack_.clear();
    node_ = packet.node;
    pooling_.pixels = packet.pixels;
  }
  /// Return the rays whose closest hits are wanted next, and the place for the hits.
  const RayNode& node() const { return node_; }
  HitPacket& hits() { return hits_; }
  /// Returns the lanes in which gathered light counts. Light of a reflection that is raised to a power always
  /// counts.
  uint32_t lanes_that_count(const VectorLanes& gathered, uint32_t lanes) const {
    return lanes_above<S>(gathered, lanes, node_.target == 0 ? kLeastLight : 0.0f);
  }
  /// Advances to the next node() of the tree. Returns false if there is none: light() is then complete.
  bool advance() {
    while (!stack_.empty()) {
      stack_.pop(node_);
      if (node_.gathers == 0) return true;
      scene_.spu().enter_module(modules::kFading);
      gather();
    }
    return false;
  }
  const VectorLanes& light() const { return light_[0]; }

  /// Sets where later trees add the transparency of their pixels. Necessary with light_feature::alpha.
  void add_transparency_to(FloatLanes& sum) { transparency_ = &sum; }

  /// Returns the state of pooling: the rays that go to a pool, and the pixels of the rays that are traced.
  auto& pooling() { return pooling_; }

  void reset_counters() {
    counters_ = RayCounters();
    stack_.reset_counters();
  }
  const RayCounters& counters() const { return counters_; }
  /// Returns the counters for code that traces rays in place of the tree.
  RayCounters& counters() { return counters_; }
  uint32_t spilled_nodes() const { return stack_.spilled(); }

protected:
  RayTree(Spu& spu, const FrameBlock& frame, SceneAccess<Spu>& scene, ea_t spill, uint32_t spill_nodes,
          RayNode& scratch)
      : frame_(frame), scene_(scene), stack_(spu, spill, spill_nodes, resident_nodes(frame), scratch),
        node_(*spu.template allocate<RayNode>()) {}

  static uint32_t count(uint32_t lanes) { return static_cast<uint32_t>(__builtin_popcount(lanes)); }

  static void fill(WordLanes& lanes, uint32_t value) {
    store_words<S>(lanes, S::I::splat(static_cast<int32_t>(value)));
  }

  /// Sets light() to zero, for light that is added without traced rays.
  void begin_light() {
    const F one(1.0f);
    node_.target = 0;
    node_.throughput.template store<S>({one, one, one});
    clear(0);
  }
  void clear(uint32_t accumulator) { light_[accumulator].template store<S>({F(0.0f), F(0.0f), F(0.0f)}); }

  /// Adds light that comes along the rays of node_.
  void add(uint32_t lanes, const V3<S>& light) {
    add_weighted(lanes, light, node_.throughput.template load<S>());
  }
  void add_weighted(uint32_t lanes, const V3<S>& light, const V3<S>& weight) {
    VectorLanes& target = light_[node_.target];
    const V3<S> sum = target.template load<S>();
    target.template store<S>(select<S>(M::from_bits(lanes), sum + light * weight, sum));
  }

  /// Pushes the secondary rays; `smooth` is the normal before it was disturbed.
  CELLTRACE_ONE_COPY void spawn(const Surfaces<S>& surfaces, const V3<S>& smooth, const WordLanes& interior,
                                const SecondaryRays<S>& onward) {
    if ((onward.mirrors | onward.transmits) == 0 || !round_.is_first()) return;
    scene_.spu().compute(scalar_work::kSpawn);
    scene_.spu().enter_module(modules::kSecondary);
    const F cosine = -dot<S>(surfaces.direction, surfaces.normal);
    V3<S> mirrored;
    by_parts<Spu>(
        mirrored,
        [](const V3<R>& direction, const V3<R>& normal, const V3<R>& undisturbed) {
          return mirror<R>(direction, normal, undisturbed);
        },
        surfaces.direction, surfaces.normal, smooth);
    const uint32_t total = onward.transmits != 0 ? transmit(surfaces, interior, onward, cosine, mirrored) : 0;
    reflect(surfaces, onward, onward.mirrors & ~total, mirrored);
  }

private:
  /// Returns the number of resident nodes; rare features of frames take the other nodes' local store.
  static uint32_t resident_nodes(const FrameBlock& frame) {
    static_assert(sizeof(SurfaceLanes) <= sizeof(RayNode));
    if (has_areas(frame) || walks_shadows(frame)) return 0;
    return has_surface_lanes(frame) ? kResident - 1 : kResident;
  }

  /// Starts the root of the tree: the rays as they leave the camera.
  void start(const RayPacket& rays, uint32_t lanes) {
    copy_packet<Spu>(rays, node_.rays);
    node_.throughput.template store<S>({F(1.0f), F(1.0f), F(1.0f)});
    F(1.0f).store(node_.weight.lane);
    F(1.0f).store(node_.power.lane);
    fill(node_.level, 0);
    fill(node_.interior_depth, frame_.camera_interior_count);
    for (uint32_t d = 0; d < frame_.camera_interior_count; ++d)
      fill(node_.interiors[d], frame_.camera_interiors[d]);
    node_.lanes = lanes;
    node_.reflected = 0;
    node_.target = 0;
    node_.gathers = 0;
    counters_.primary += count(lanes);
  }

  /// Puts the child in the stack or in a pool. Returns false if there is no room.
  bool push() {
    const RayNode& child = stack_.next();
    if ((child.target | child.gathers) == 0 && pooling_.takes(child)) return true;
    const bool room = stack_.push();
    if (!room) counters_.dropped += count(child.lanes);
    return room;
  }

  /// Adds the light of a reflection that is complete.
  CELLTRACE_ONE_COPY void gather() {
    scene_.spu().run_in_module(modules::kFading);
    const V3<S> sum = light_[node_.gathers].template load<S>();
    const F power = F::load(node_.power.lane);
    --accumulators_in_use_;
    V3<S> raised;
    for_each_part<Spu>([&](uint32_t first) {
      const V3<R> base = part_of<Spu>(sum, first);
      const typename R::F exponent = part_of<Spu>(power, first);
      set_part<Spu>(raised, first,
                    V3<R>{pow<R>(base.x, exponent), pow<R>(base.y, exponent), pow<R>(base.z, exponent)});
    });
    add(node_.lanes, raised);
  }

  /// Fills the child with the rays from surfaces that weight and level allow. Returns false if there are
  /// none.
  bool prepare_child(const Surfaces<S>& surfaces, const V3<S>& direction, const V3<S>& throughput,
                     const F& weight, uint32_t one_level_deeper, uint32_t lanes) {
    RayNode& child = stack_.next();
    scene_.spu().compute(scalar_work::kChild);
    // A ray that goes straight on takes no level, but as in POV-Ray one level must be left.
    const I level = load_words<S>(node_.level);
    const auto is_left = level < I::splat(static_cast<int32_t>(frame_.max_trace_level) - 1);
    const uint32_t go = lanes & ((weight >= F(frame_.adc_bailout)) & is_left).bits();
    store_words<S>(child.level, level + S::select(M::from_bits(one_level_deeper), I::splat(1), I::splat(0)));
    if (go == 0) return false;
    child.rays.origin.template store<S>(surfaces.point);
    child.rays.direction.template store<S>(direction);
    child.rays.start_object = *surfaces.objects;
    child.throughput.template store<S>(node_.throughput.template load<S>() * throughput);
    weight.store(child.weight.lane);
    child.lanes = go;
    child.reflected = node_.reflected;
    child.target = node_.target;
    child.gathers = 0;
    return true;
  }

  /// Multiplies the throughput and the transparency of the child's `lanes` by the share of light that an
  /// interior lets out. As in POV-Ray, the transparency takes the grey of the light that passes each surface.
  CELLTRACE_ONE_COPY void fade_child(const WordLanes& interior, const V3<S>& through, uint32_t lanes) {
    RayNode& child = stack_.next();
    scene_.spu().run_in_module(modules::kFading);
    const bool fades = (frame_.light_features & light_feature::fading) != 0;
    if ((frame_.light_features & light_feature::alpha) != 0) {
      const VectorLanes throughput = child.throughput;
      child.throughput.template store<S>(through);
      if (fades) fade(scene_, node_, interior, hits_.distance, lanes, child.throughput, false);
      const F transparency = F::load(node_.power.lane) * grey<S>(child.throughput.template load<S>());
      transparency.store(child.power.lane);
      child.throughput = throughput;
    }
    if (fades) fade(scene_, node_, interior, hits_.distance, lanes, child.throughput, false);
  }

  void reflect(const Surfaces<S>& surfaces, const SecondaryRays<S>& onward, uint32_t lanes,
               const V3<S>& mirrored) {
    if (lanes == 0) return;
    RayNode& child = stack_.next();
    inherit_interiors();
    if (!prepare_child(surfaces, mirrored, onward.mirror, F::load(node_.weight.lane) * onward.mirror_weight,
                       lanes, lanes))
      return;
    child.reflected = child.lanes;
    counters_.reflection += count(child.lanes);
    if (onward.has_reflection_exponent && accumulators_in_use_ < kAccumulators) {
      scene_.spu().enter_module(modules::kFading);
      redirect(onward.reflection_power);
    }
    push();
  }

  void inherit_interiors() {
    RayNode& child = stack_.next();
    child.interior_depth = node_.interior_depth;
    for (uint32_t d = 0; d < kMaxInteriorDepth; ++d)
      child.interiors[d] = node_.interiors[d];
  }

  /// Sends the light of the child to an accumulator of its own, from which a node pushed below the child
  /// gathers the light. Not in the module of its callers, which has no room.
  CELLTRACE_ONE_COPY void redirect(const F& power) {
    scene_.spu().run_in_module(modules::kFading);
    RayNode& gathering = stack_.next();
    gathering.gathers = accumulators_in_use_;
    power.store(gathering.power.lane);
    if (!push()) return;
    RayNode& child = stack_.next_like(gathering);
    child.target = accumulators_in_use_++;
    child.gathers = 0;
    child.throughput.template store<S>({F(1.0f), F(1.0f), F(1.0f)});
    clear(child.target);
  }

  /// Pushes the transmitted rays; returns the lanes with total reflection.
  uint32_t transmit(const Surfaces<S>& surfaces, const WordLanes& interior, const SecondaryRays<S>& onward,
                    const F& cosine, const V3<S>& mirrored) {
    scene_.spu().compute(scalar_work::kTransmit);
    scene_.spu().run_in_module(modules::kSecondary);
    RayNode& child = stack_.next();
    inherit_interiors();
    const Refraction refraction =
        cross_surfaces(scene_, interior, onward.transmits, child, counters_.dropped);
    const F ratio = F::load(refraction.ratio.lane);
    V3<S> bent;
    uint32_t beyond = 0;
    for_each_part<Spu>([&](uint32_t first) {
      const auto part = [first](const auto& values) { return part_of<Spu>(values, first); };
      auto is_total = R::M::none();
      set_part<Spu>(
          bent, first,
          refract<R>(part(surfaces.direction), part(surfaces.normal), part(cosine), part(ratio), is_total));
      beyond |= is_total.bits() << first;
    });
    const uint32_t total = beyond & onward.transmits & ~refraction.straight;
    const M total_mask = M::from_bits(total);
    V3<S> direction = select<S>(M::from_bits(refraction.straight), surfaces.direction, bent);
    direction = select<S>(total_mask, mirrored, direction);
    // A totally reflected ray stays inside. As in POV-Ray, only a film changes its light.
    for_each_lane(total, [&](uint32_t lane) {
      child.interior_depth.lane[lane] = node_.interior_depth.lane[lane];
      for (uint32_t d = 0; d < kMaxInteriorDepth; ++d)
        child.interiors[d].lane[lane] = node_.interiors[d].lane[lane];
    });
    // POV-Ray's weight is that of a transmitted ray even if all light is reflected.
    if (prepare_child(surfaces, direction, select<S>(total_mask, onward.reflected_inside, onward.through),
                      F::load(node_.weight.lane) * onward.through_weight,
                      onward.transmits & ~refraction.straight, onward.transmits)) {
      if ((frame_.light_features & (light_feature::fading | light_feature::alpha)) != 0) {
        scene_.spu().enter_module(modules::kFading);
        fade_child(interior, onward.through, onward.transmits);
      }
      child.reflected |= total & child.lanes;
      counters_.refraction += count(child.lanes);
      push();
    }
    return total;
  }

protected:
  const FrameBlock& frame_;
  SceneAccess<Spu>& scene_;
  RayStack<Spu, kResident> stack_;
  [[no_unique_address]] typename Strategy<Spu>::template RayPooling<Spu> pooling_;
  RayNode& node_; ///< the node that is being traced
  HitPacket hits_;
  /// Number of accumulators. Reflections with exponents that are nested deeper stay without their exponents.
  static constexpr uint32_t kAccumulators = 8;
  VectorLanes light_[kAccumulators];   ///< index: RayNode::target
  FloatLanes* transparency_ = nullptr; ///< transparency of the packet's pixels; with light_feature::alpha
  uint32_t accumulators_in_use_ = 1;
  LightRound round_ = {}; ///< current round of shading; secondary rays are spawned in the first
  RayCounters counters_;
};

} // namespace celltrace::kernel

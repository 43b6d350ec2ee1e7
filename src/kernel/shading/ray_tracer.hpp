// Raytrace: what a packet of primary rays sees. The ray tree is walked with an explicit stack and cut by
// level and by contribution (adaptive depth control, Hall and Greenberg 1983). Kernel dialect.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/direct/ray_pool.hpp"
#include "kernel/modules.hpp"
#include "kernel/shading/atmosphere.hpp"
#include "kernel/shading/fading.hpp"
#include "kernel/shading/lighting.hpp"
#include "kernel/shading/secondary_rays.hpp"
#include "kernel/shading/shadow_walk.hpp"
#include "kernel/shading/surface_lanes.hpp"
#include "kernel/textures/sky.hpp"

namespace celltrace::kernel {

struct RayCounters {
  uint64_t primary = 0, shadow = 0, reflection = 0, refraction = 0;
  uint64_t dropped = 0; ///< beyond what the stacks hold
};

/// The tree of one packet at a time, in steps between which its rays are traced: begin(), then for each
/// node() take_hits() and, if any, shade_hits() for each round of lights, until advance() finds no more.
template <class Spu, uint32_t kResident = kResidentNodes> class RayTracer {
public:
  using S = typename Spu::simd;
  using R = typename Spu::rare_simd;
  using F = typename S::F;
  using I = typename S::I;
  using M = typename S::M;

  /// `spill` has room for `spill_nodes`. `scratch` may be shared by tracers.
  RayTracer(Spu& spu, const FrameBlock& frame, SceneAccess<Spu>& scene, ea_t spill, uint32_t spill_nodes,
            RayNode& scratch)
      : frame_(frame), scene_(scene), stack_(spu, spill, spill_nodes, resident_nodes(frame)),
        node_(*spu.template allocate<RayNode>()), child_(scratch),
        surface_(allocate_surface_lanes(spu, frame)) {}

  /// The colours of primary rays whose hits are known, if all of them end there; false: they do not, or there
  /// are more lights than in one round. Without the light that the round gathers.
  bool ends_at_once(const RayPacket& rays, uint32_t lanes, const HitPacket& hits, const HitPoints<S>& points,
                    const LightRound& round, VectorLanes& colours) {
    if (round.next() != frame_.light_count || has_atmosphere(frame_)) return false;
    const uint32_t hit = hit_lanes<S>(hits, lanes);
    if (!ends(points, hit)) return false;
    const F zero(0.0f), one(1.0f);
    V3<S> seen = {zero, zero, zero};
    if (hit != 0) {
      Surfaces<S> surfaces = points.surfaces(rays.direction.template load<S>(), hits.object);
      prepare_ends(points, hits, hit);
      if (has_layers(points, hit)) {
        seen = light_of_layers(points, hit, round, surfaces);
      } else {
        const MaterialLanes<S> m = materials_of(points, hit, surfaces);
        seen = local_light(scene_, frame_, round, surfaces, m, hit, {one, one, one});
      }
    }
    counters_.primary += count(lanes);
    if (const uint32_t missed = lanes & ~hit; missed != 0)
      seen = select<S>(M::from_bits(hit), seen, behind(rays, missed));
    colours.template store<S>(seen);
    return true;
  }

  /// The colours of primary rays that hit nothing.
  V3<S> background(const RayPacket& rays, uint32_t lanes) {
    counters_.primary += count(lanes);
    return behind(rays, lanes);
  }
  /// Likewise of so many rays where there is no sky.
  V3<S> background(uint32_t rays) {
    counters_.primary += rays;
    return splat3<S>(frame_.background);
  }

  /// Starts the tree of a packet of primary rays.
  void begin(const RayPacket& rays, uint32_t lanes) {
    scene_.spu().compute(scalar_work::kPrimaryPacket);
    clear(0);
    accumulators_in_use_ = 1;
    stack_.clear(); // the tree before may have been broken off
    start(rays, lanes);
  }
  /// Starts with rays of a pool, each of which goes on in its own tree.
  void begin(const PooledPacket& packet) {
    clear(0);
    accumulators_in_use_ = 1;
    stack_.clear();
    node_ = packet.node;
    pooling_.pixels = packet.pixels;
  }
  /// The rays whose closest hits are wanted next, and where to put them.
  const RayNode& node() const { return node_; }
  HitPacket& hits() { return hits_; }
  /// The lanes of node() that hit something; the others see the background.
  uint32_t take_hits() {
    scene_.spu().compute(scalar_work::kNode);
    if (has_atmosphere(frame_)) {
      scene_.spu().enter_module(modules::kAtmosphere);
      cross_atmosphere(scene_, frame_, hits_, node_, light_[node_.target], clear_);
    }
    const uint32_t hit = hit_lanes<S>(hits_, node_.lanes);
    const uint32_t missed = node_.lanes & ~hit;
    if (missed != 0) add(missed, behind(node_.rays, missed));
    return hit;
  }
  /// Shades the surfaces that take_hits() told of, in the light of a round. With the first round rays go on
  /// from there.
  [[gnu::always_inline]] void shade_hits(const HitPoints<S>& points, uint32_t hit, const LightRound& round) {
    round_ = round;
    if constexpr (kHasRoomForCode<Spu>)
      if (ends(points, hit)) return shade_last(points, hit);
    const uint32_t plain = points.plain(hit);
    if (plain != 0) shade_plain(points, plain);
    if (plain == hit) return;
    scene_.spu().enter_module(modules::kComposed);
    shade_composed(points, hit & ~plain);
  }
  /// The lanes in which gathered light counts. That of a bent reflection is raised to a power: all of it
  /// does.
  uint32_t lanes_that_count(const VectorLanes& gathered, uint32_t lanes) const {
    return lanes_above<S>(gathered, lanes, node_.target == 0 ? kLeastLight : 0.0f);
  }
  /// Adds what has come of the light that a round has gathered.
  void add_gathered(const LightRound& round, uint32_t lanes) { round.add_to<S>(light_[node_.target], lanes); }
  /// Goes on to the next node() of the tree. False: there is none, light() is complete.
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

  /// Where trees that begin from now on add how clear their pixels are. Wanted with light_way::alpha.
  void add_clear_to(FloatLanes& clear) { clear_ = &clear; }

  /// Which rays go to a pool, and which pixels those are of that are traced.
  RayPooling<Spu>& pooling() { return pooling_; }

  void reset_counters() {
    counters_ = RayCounters();
    stack_.reset_counters();
  }
  const RayCounters& counters() const { return counters_; }
  /// For those who trace rays in its place.
  RayCounters& counters() { return counters_; }
  uint32_t spilled_nodes() const { return stack_.spilled(); }

private:
  static uint32_t count(uint32_t lanes) { return static_cast<uint32_t>(__builtin_popcount(lanes)); }

  /// What few frames need lies where nodes would.
  static uint32_t resident_nodes(const FrameBlock& frame) {
    static_assert(sizeof(SurfaceLanes) <= sizeof(RayNode));
    if (has_areas(frame) || walks_shadows(frame)) return 0;
    return has_surface_lanes(frame) ? kResident - 1 : kResident;
  }

  V3<S> behind(const RayPacket& rays, uint32_t lanes) {
    V3<S> colour = splat3<S>(frame_.background);
    if (frame_.sky != kNoOffset)
      add_sky(scene_, frame_.sky, rays.direction.template load<S>(), lanes, colour);
    return colour;
  }

  /// The root of the tree: the rays as they leave the camera.
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
  static void fill(WordLanes& lanes, uint32_t value) {
    S::I::splat(static_cast<int32_t>(value)).store(reinterpret_cast<int32_t*>(lanes.lane));
  }

  bool push() {
    if ((child_.target | child_.gathers) == 0 && pooling_.takes(child_)) return true;
    const bool room = stack_.push(child_);
    if (!room) counters_.dropped += count(child_.lanes);
    return room;
  }

  void clear(uint32_t accumulator) { light_[accumulator].template store<S>({F(0.0f), F(0.0f), F(0.0f)}); }

  void add(uint32_t lanes, const V3<S>& light) {
    add_weighted(lanes, light, node_.throughput.template load<S>());
  }
  void add_weighted(uint32_t lanes, const V3<S>& light, const V3<S>& weight) {
    VectorLanes& target = light_[node_.target];
    const V3<S> sum = target.template load<S>();
    target.template store<S>(select<S>(M::from_bits(lanes), sum + light * weight, sum));
  }

  /// The light of a reflection is complete.
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

  /// Surfaces of one material without textures. What it needs is not on the stack while others are shaded.
  CELLTRACE_ONE_COPY void shade_plain(const HitPoints<S>& points, uint32_t lanes) {
    Surfaces<S> surfaces;
    find_surfaces(points, surfaces);
    spawn(surfaces, surfaces.normal, points.interior,
          shade(surfaces, points.interior, points.material, lanes, F(1.0f)));
  }
  /// Surfaces from which no rays go on.
  void shade_last(const HitPoints<S>& points, uint32_t lanes) {
    Surfaces<S> surfaces = points.surfaces(node_.rays.direction.template load<S>(), hits_.object);
    const F one(1.0f);
    prepare_ends(points, hits_, lanes);
    if (has_layers(points, lanes))
      shade_layers(surfaces, points.interior, points.material, lanes, one);
    else
      add_light(surfaces, materials_of(points, lanes, surfaces), lanes, {one, one, one});
  }
  /// Whether trees end there. Textures that weigh less than the bailout are dropped, which all do if that is
  /// above 1.
  bool ends(const HitPoints<S>& points, uint32_t lanes) const {
    return points.ends(lanes) && (frame_.adc_bailout <= 1.0f || (points.textured & lanes) == 0);
  }
  /// What primary rays see of surfaces with layers, without a tree.
  V3<S> light_of_layers(const HitPoints<S>& points, uint32_t lanes, const LightRound& round,
                        Surfaces<S>& surfaces) {
    const F one(1.0f);
    round_ = round;
    round_.is_fresh = false;
    round_.template clear<S>();
    node_.target = 0;
    node_.throughput.template store<S>({one, one, one});
    clear(0);
    shade_layers(surfaces, points.interior, points.material, lanes, one);
    return light_[0].template load<S>();
  }
  /// Before any of the following is asked of surfaces where trees end.
  void prepare_ends(const HitPoints<S>& points, const HitPacket& hits, uint32_t lanes) {
    if (const uint32_t textured = points.textured & lanes; textured != 0)
      prepare_textures(points, hits, textured);
  }
  /// Whether some of them have layers.
  bool has_layers(const HitPoints<S>& points, uint32_t lanes) {
    bool any = false;
    if (const uint32_t textured = points.textured & lanes; textured != 0)
      for_each_value<S>(points.material, textured, [&](uint32_t material, uint32_t) {
        any = any || (scene_.material(material)->flags & material_flag::layered) != 0;
      });
    return any;
  }
  /// Their materials if none has layers, and their normals: with their textures.
  MaterialLanes<S> materials_of(const HitPoints<S>& points, uint32_t lanes, Surfaces<S>& surfaces) {
    MaterialLanes<S> m = gather_materials(scene_, points.material, lanes);
    if ((points.textured & lanes) != 0) add_textures(points.material, m, surfaces);
    return m;
  }
  /// Field by field: no copy of it is on the stack.
  CELLTRACE_ONE_COPY void find_surfaces(const HitPoints<S>& points, Surfaces<S>& surfaces) const {
    surfaces.point = points.point;
    surfaces.normal = points.normal;
    surfaces.direction = node_.rays.direction.template load<S>();
    surfaces.objects = &hits_.object;
    surfaces.any_side = points.lit_behind;
    surfaces.lit_through = points.lit_through;
  }

  /// Finds out what patterns ask for besides points.
  void prepare_textures(const HitPoints<S>& points, const HitPacket& hits, uint32_t lanes) {
    if (surface_ == nullptr) return;
    scene_.spu().enter_module(modules::kSurfaces);
    find_surface_lanes(scene_, points, hits, lanes, *surface_);
  }
  /// What materials leave to their patterns.
  void add_textures(const WordLanes& materials, MaterialLanes<S>& m, Surfaces<S>& surfaces) {
    if (m.disturbed != 0) disturb_normals(scene_, materials, m, surface_, surfaces);
    if (m.patterned != 0) add_pigments<Spu>(scene_, materials, {surfaces.point, surface_}, m);
  }

  /// Surfaces with several materials: each is shaded whole, and the results are blended by their weights.
  /// What goes on goes the same ways for all of them: as one ray each where it weighs the same, or every such
  /// surface would multiply the rays behind it.
  CELLTRACE_ONE_COPY void shade_composed(const HitPoints<S>& points, uint32_t lanes) {
    scene_.spu().run_in_module(modules::kComposed);
    Surfaces<S> surfaces;
    find_surfaces(points, surfaces);
    prepare_textures(points, hits_, lanes);
    const F u = F::load(hits_.u.lane);
    const F v = F::load(hits_.v.lane);
    const F weights[3] = {F(1.0f) - u - v, u, v};
    SecondaryRays<S> all = SecondaryRays<S>::nothing();
    for (uint32_t corner = 0; corner < 3 && points.blended != 0; ++corner) {
      WordLanes materials = points.material;
      for_each_lane(points.blended, [&](uint32_t lane) {
        materials.lane[lane] = scene_.blend(points.material.lane[lane])->material[corner];
      });
      shade_share(surfaces, points, materials, points.blended, weights[corner], all);
    }
    if (const uint32_t textured = lanes & ~points.blended; textured != 0)
      shade_share(surfaces, points, points.material, textured, F(1.0f), all);
    spawn(surfaces, surfaces.normal, points.interior, all);
  }
  /// The share of materials that may be texture maps.
  CELLTRACE_ONE_COPY void shade_share(Surfaces<S>& surfaces, const HitPoints<S>& points,
                                      const WordLanes& materials, uint32_t lanes, const F& weight,
                                      SecondaryRays<S>& all) {
    uint32_t plain = lanes;
    for_each_value<S>(materials, lanes & points.textured, [&](uint32_t material, uint32_t same) {
      const uint32_t map = map_of(*scene_.material(material));
      if (map == kNoOffset) return;
      plain &= ~same;
      scene_.spu().enter_module(modules::kMaps);
      const PatternPoints<S> asked = {surfaces.point, surface_};
      MapWalk<Spu, TextureStage::maps, S> walk(scene_, asked, MapOf::textures);
      walk.enter(map, weight, same);
      MapEntryRecord entry;
      F share;
      uint32_t some;
      WordLanes leaf;
      while (walk.next(entry, share, some)) {
        fill(leaf, entry.child);
        shade_whole(surfaces, points, leaf, some, share, all);
        scene_.spu().enter_module(modules::kMaps);
      }
    });
    if (plain != 0) shade_whole(surfaces, points, materials, plain, weight, all);
  }
  /// Adaptive depth control drops a material by its weight alone, as POV-Ray does.
  CELLTRACE_ONE_COPY void shade_whole(Surfaces<S>& surfaces, const HitPoints<S>& points,
                                      const WordLanes& materials, uint32_t lanes, const F& weight,
                                      SecondaryRays<S>& all) {
    lanes &= (weight >= F(frame_.adc_bailout)).bits();
    if (lanes == 0) return;
    const WordLanes& interior = points.interior;
    const SecondaryRays<S> one = (lanes & points.textured) != 0
                                     ? shade_layers(surfaces, interior, materials, lanes, weight)
                                     : shade(surfaces, interior, materials, lanes, weight);
    if (all.is_nothing())
      all = one;
    else if (all.weighs_like(one))
      all.add(one);
    else
      spawn(surfaces, surfaces.normal, interior, one);
  }

  /// Adds the surface's own light, times `share`; returns what goes on. Not inlined, as spawn() is not:
  /// local store has no room for a copy at each call.
  CELLTRACE_ONE_COPY SecondaryRays<S> shade(const Surfaces<S>& surfaces, const WordLanes& interior,
                                            const WordLanes& materials, uint32_t lanes, const F& share) {
    scene_.spu().compute(scalar_work::kShade);
    const MaterialLanes<S> m = gather_materials(scene_, materials, lanes);
    add_light(surfaces, m, lanes, {share, share, share});
    return round_.is_first() ? onward_rays(surfaces, interior, m, lanes, share) : SecondaryRays<S>::nothing();
  }
  /// Adds what surfaces send by themselves, times `share`. One copy, whose vectors are not on the stack while
  /// rays go on.
  CELLTRACE_ONE_COPY void add_light(const Surfaces<S>& surfaces, const MaterialLanes<S>& m, uint32_t lanes,
                                    const V3<S>& share) {
    const V3<S> weight = share * node_.throughput.template load<S>();
    const V3<S> rest = local_light(scene_, frame_, round_, surfaces, m, lanes, weight);
    if (!round_.only_gathers) add_weighted(lanes, rest, weight);
  }
  CELLTRACE_ONE_COPY SecondaryRays<S> onward_rays(const Surfaces<S>& surfaces, const WordLanes& interior,
                                                  const MaterialLanes<S>& m, uint32_t lanes, const F& share) {
    SecondaryRays<S> onward = SecondaryRays<S>::nothing();
    if (!m.has(material_flag::reflects | material_flag::transmits)) return onward;
    scene_.spu().compute(scalar_work::kSecondaryRays);
    scene_.spu().enter_module(modules::kSecondary);
    F fresnel_ratio(1.0f);
    if (m.fresnel != 0)
      fresnel_ratio = F::load(fresnel_ratios(scene_, interior, lanes & m.fresnel, node_).lane);
    find_secondary_rays<Spu>(m, -dot<S>(surfaces.direction, surfaces.normal), fresnel_ratio,
                             frame_.adc_bailout, lanes, share, onward);
    if ((m.special & onward.mirrors) != 0) {
      scene_.spu().enter_module(modules::kFinishes);
      change_special_mirror(scene_, surfaces, m, onward.mirrors, onward.mirror);
    }
    return onward;
  }

  /// As shade(), of textures with patterns, normals or layers. The light of a layer comes through those
  /// above, but not what it reflects: that is POV-Ray's model. Where normals are disturbed, rays go on by
  /// themselves. The surfaces have their layers' normals meanwhile.
  CELLTRACE_ONE_COPY SecondaryRays<S> shade_layers(Surfaces<S>& surfaces, const WordLanes& interior,
                                                   const WordLanes& top, uint32_t all_lanes, const F& share) {
    const F one(1.0f);
    V3<S> above = {one, one, one}; // what comes through the layers above
    WordLanes materials = top;
    uint32_t lanes = all_lanes;
    SecondaryRays<S> onward = SecondaryRays<S>::nothing();
    const V3<S> smooth = surfaces.normal;
    V3<S> outermost = smooth; // of the uppermost layer
    bool is_disturbed = false;
    for (bool is_top = true; lanes != 0; is_top = false) {
      MaterialLanes<S> m = gather_materials(scene_, materials, lanes);
      surfaces.normal = smooth;
      add_textures(materials, m, surfaces);
      add_light(surfaces, m, lanes, above * share);
      SecondaryRays<S> rays = onward_rays(surfaces, interior, m, lanes, one);
      if (rays.is_nothing()) break;
      const uint32_t clear = rays.clear;
      rays.clear = 0;
      // POV-Ray does not ask what the layers above leave of what is mirrored, but it weighs it by that.
      rays.mirror = rays.mirror * share;
      rays.mirror_weight = rays.mirror_weight * grey<S>(above);
      above = select<S>(S::M::from_bits(clear), above * rays.through, above);
      if (is_top) {
        onward = rays;
        outermost = surfaces.normal;
        is_disturbed = m.disturbed != 0;
      } else if (rays.mirrors != 0) {
        spawn(surfaces, smooth, interior, rays);
      }
      // Transmitted through all layers, by those that were the last.
      const uint32_t bright = (grey<S>(above) > F(frame_.adc_bailout)).bits() & clear;
      onward.clear |= bright & ~m.layered;
      lanes = bright & m.layered;
      for_each_value<S>(materials, lanes, [&](uint32_t offset, uint32_t same) {
        const uint32_t below = scene_.material(offset)->below;
        for_each_lane(same, [&](uint32_t lane) { materials.lane[lane] = below; });
      });
    }
    const F through = S::select(S::M::from_bits(onward.clear), share, F(0.0f));
    onward.through = above * through;
    onward.through_weight = S::select(S::M::from_bits(onward.clear), max_component<S>(above), F(0.0f));
    onward.clear_share = through;
    if (is_disturbed) {
      surfaces.normal = outermost;
      spawn(surfaces, smooth, interior, onward);
      onward.clear_all();
    }
    surfaces.normal = smooth;
    if (surface_ != nullptr) surface_->normal.template store<S>(smooth);
    return onward;
  }

  /// Pushes the rays that go on; `smooth` is the normal before it was disturbed.
  CELLTRACE_ONE_COPY void spawn(const Surfaces<S>& surfaces, const V3<S>& smooth, const WordLanes& interior,
                                const SecondaryRays<S>& onward) {
    if ((onward.mirrors | onward.clear) == 0 || !round_.is_first()) return;
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
    child_.reflected = node_.reflected;
    child_.target = node_.target;
    child_.gathers = 0;
    return true;
  }

  /// What is left of the light that `lanes` of child_ bring out of an interior, and how clear their way is.
  /// POV-Ray takes the grey of what comes through each surface.
  CELLTRACE_ONE_COPY void fade_child(const WordLanes& interior, const V3<S>& through, uint32_t lanes) {
    scene_.spu().run_in_module(modules::kFading);
    const bool fades = (frame_.light_ways & light_way::fading) != 0;
    if ((frame_.light_ways & light_way::alpha) != 0) {
      const VectorLanes throughput = child_.throughput;
      child_.throughput.template store<S>(through);
      if (fades) fade(scene_, node_, interior, hits_.distance, lanes, child_.throughput, false);
      const F clear = F::load(node_.power.lane) * grey<S>(child_.throughput.template load<S>());
      clear.store(child_.power.lane);
      child_.throughput = throughput;
    }
    if (fades) fade(scene_, node_, interior, hits_.distance, lanes, child_.throughput, false);
  }

  void reflect(const Surfaces<S>& surfaces, const SecondaryRays<S>& onward, uint32_t lanes,
               const V3<S>& mirrored) {
    if (lanes == 0) return;
    inherit_interiors();
    if (!prepare_child(surfaces, mirrored, onward.mirror, F::load(node_.weight.lane) * onward.mirror_weight,
                       lanes, lanes))
      return;
    child_.reflected = child_.lanes;
    counters_.reflection += count(child_.lanes);
    if (onward.bends_reflection && accumulators_in_use_ < kAccumulators) {
      scene_.spu().enter_module(modules::kFading);
      redirect(onward.reflection_power);
    }
    push();
  }

  void inherit_interiors() {
    child_.interior_depth = node_.interior_depth;
    for (uint32_t d = 0; d < kMaxInteriorDepth; ++d)
      child_.interiors[d] = node_.interiors[d];
  }

  /// Sends the light of child_ to an accumulator of its own, from which a node pushed below it gathers it.
  /// Not in the module of what calls it, which has no room.
  CELLTRACE_ONE_COPY void redirect(const F& power) {
    scene_.spu().run_in_module(modules::kFading);
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
    const uint32_t total = beyond & onward.clear & ~refraction.straight;
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
      if ((frame_.light_ways & (light_way::fading | light_way::alpha)) != 0) {
        scene_.spu().enter_module(modules::kFading);
        fade_child(interior, onward.through, onward.clear);
      }
      child_.reflected |= total & child_.lanes;
      counters_.refraction += count(child_.lanes);
      push();
    }
    return total;
  }

  const FrameBlock& frame_;
  SceneAccess<Spu>& scene_;
  RayStack<Spu, kResident> stack_;
  [[no_unique_address]] RayPooling<Spu> pooling_;
  RayNode& node_;         ///< being traced
  RayNode& child_;        ///< being made
  SurfaceLanes* surface_; ///< at the hits; null: no pattern of the scene asks for it
  HitPacket hits_;
  /// Deeper nesting of bent reflections than this leaves the innermost ones unbent.
  static constexpr uint32_t kAccumulators = 8;
  VectorLanes light_[kAccumulators];
  FloatLanes* clear_ = nullptr; ///< of the packet, with light_way::alpha
  uint32_t accumulators_in_use_ = 1;
  LightRound round_ = {}; ///< of lights, that is being shaded
  RayCounters counters_;
};

} // namespace celltrace::kernel

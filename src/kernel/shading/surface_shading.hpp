// Shading of the surfaces that rays of a tree have hit: their materials, textures and layers in the light of
// a round, and their secondary rays. Kernel dialect.
#pragma once

#include "kernel/shading/ray_tree.hpp"

namespace celltrace::kernel {

/// The part of a RayTracer that shades surfaces.
template <class Spu, uint32_t kResident> class SurfaceShading : public RayTree<Spu, kResident> {
protected:
  using Tree = RayTree<Spu, kResident>;
  using Tree::add_weighted;
  using Tree::fill;
  using Tree::frame_;
  using Tree::hits_;
  using Tree::light_;
  using Tree::node_;
  using Tree::round_;
  using Tree::scene_;
  using Tree::spawn;

public:
  using typename Tree::F;
  using typename Tree::R;
  using typename Tree::S;

  /// Shades the surfaces of the hits from take_hits() in the light of a round. The first round also spawns
  /// their secondary rays.
  [[gnu::always_inline]] void shade_hits(const HitPoints<S>& points, uint32_t hit, const LightRound& round) {
    round_ = round;
    if (Strategy<Spu>::kShadesEndsApart && ends(points, hit)) return shade_last(points, hit);
    const uint32_t plain = points.plain(hit);
    if (plain != 0) shade_plain(points, plain);
    if (plain == hit) return;
    scene_.spu().enter_module(modules::kComposed);
    shade_composed(points, hit & ~plain);
  }
  /// Returns true if the round has gathered light.
  bool has_gathered() const { return !Strategy<Spu>::is_fresh(round_); }
  /// Adds the light of a round after its shadow rays have been traced.
  void add_gathered(const LightRound& round, uint32_t lanes) { round.add_to<S>(light_[node_.target], lanes); }

protected:
  SurfaceShading(Spu& spu, const FrameBlock& frame, SceneAccess<Spu>& scene, ea_t spill, uint32_t spill_nodes,
                 RayNode& scratch)
      : Tree(spu, frame, scene, spill, spill_nodes, scratch), surface_(allocate_surface_lanes(spu, frame)) {}

  /// Returns true if trees end at these surfaces. Textures with less weight than the bailout are dropped, so
  /// that a bailout above 1 drops all textures.
  bool ends(const HitPoints<S>& points, uint32_t lanes) const {
    return points.ends(lanes) && (frame_.adc_bailout <= 1.0f || (points.textured & lanes) == 0);
  }
  /// Returns the light that primary rays see of surfaces for which ends() is true, without a tree.
  [[gnu::always_inline]] V3<S> light_of_ends(const RayPacket& rays, const HitPacket& hits,
                                             const HitPoints<S>& points, uint32_t lanes, LightRound& round) {
    Surfaces<S> surfaces = points.surfaces(rays.direction.template load<S>(), hits.object);
    prepare_ends(points, hits, lanes);
    if (has_layers(points, lanes)) return light_of_layers(points, lanes, round, surfaces);
    const F one(1.0f);
    const MaterialLanes<S> m = materials_of(points, lanes, surfaces);
    return local_light(scene_, frame_, round, surfaces, m, lanes, {one, one, one});
  }

private:
  /// Shades surfaces of one material without textures. Not inlined, so that its variables are not on the
  /// stack while other surfaces are shaded.
  CELLTRACE_ONE_COPY void shade_plain(const HitPoints<S>& points, uint32_t lanes) {
    Surfaces<S> surfaces;
    find_surfaces(points, surfaces);
    spawn(surfaces, surfaces.normal, points.interior,
          shade(surfaces, points.interior, points.material, lanes, F(1.0f)));
  }
  /// Shades surfaces without secondary rays.
  void shade_last(const HitPoints<S>& points, uint32_t lanes) {
    Surfaces<S> surfaces = points.surfaces(node_.rays.direction.template load<S>(), hits_.object);
    const F one(1.0f);
    prepare_ends(points, hits_, lanes);
    if (has_layers(points, lanes))
      shade_layers(surfaces, points, points.material, lanes, one);
    else
      add_light(surfaces, materials_of(points, lanes, surfaces), lanes, {one, one, one});
  }
  /// Returns the light of surfaces with layers; see light_of_ends().
  V3<S> light_of_layers(const HitPoints<S>& points, uint32_t lanes, LightRound& round,
                        Surfaces<S>& surfaces) {
    const F one(1.0f);
    round_ = round;
    Tree::begin_light();
    shade_layers(surfaces, points, points.material, lanes, one);
    round.is_fresh = round_.is_fresh;
    return Tree::light().template load<S>();
  }
  /// Prepares the textures of surfaces where trees end, for the functions below.
  void prepare_ends(const HitPoints<S>& points, const HitPacket& hits, uint32_t lanes) {
    if (const uint32_t textured = points.textured & lanes; textured != 0)
      prepare_textures(points, hits, textured);
  }
  /// Returns true if some of the surfaces have layers.
  bool has_layers(const HitPoints<S>& points, uint32_t lanes) {
    bool any = false;
    if (const uint32_t textured = points.textured & lanes; textured != 0)
      for_each_value<S>(points.material, textured, [&](uint32_t material, uint32_t) {
        any = any || (scene_.material(material)->flags & material_flag::layered) != 0;
      });
    return any;
  }
  /// Returns the materials of surfaces without layers, with their textures, and disturbs the surfaces'
  /// normals.
  MaterialLanes<S> materials_of(const HitPoints<S>& points, uint32_t lanes, Surfaces<S>& surfaces) {
    MaterialLanes<S> m = gather_materials(scene_, points.material, lanes);
    if ((points.textured & lanes) != 0) add_textures(points.material, m, surfaces);
    return m;
  }
  /// Sets the surfaces member by member, so that no copy is on the stack.
  CELLTRACE_ONE_COPY void find_surfaces(const HitPoints<S>& points, Surfaces<S>& surfaces) const {
    surfaces.point = points.point;
    surfaces.normal = points.normal;
    surfaces.direction = node_.rays.direction.template load<S>();
    surfaces.objects = &hits_.object;
    surfaces.any_side = points.lit_behind;
    surfaces.lit_through = points.lit_through;
  }

  /// Finds the further input of patterns besides points.
  void prepare_textures(const HitPoints<S>& points, const HitPacket& hits, uint32_t lanes) {
    if (surface_ == nullptr) return;
    scene_.spu().enter_module(modules::kSurfaces);
    find_surface_lanes(scene_, points, hits, lanes, *surface_);
  }
  /// Adds the properties of materials that patterns determine.
  void add_textures(const WordLanes& materials, MaterialLanes<S>& m, Surfaces<S>& surfaces) {
    if (m.disturbed != 0) disturb_normals(scene_, materials, m, surface_, surfaces);
    if (m.patterned != 0) add_pigments<Spu>(scene_, materials, {surfaces.point, surface_}, m);
  }

  /// Shades surfaces with several materials: each material is shaded as a whole, and the results are blended
  /// by their weights. The secondary rays of all materials have the same directions. If their weights are
  /// equal, they are merged to one ray each, as otherwise every such surface would multiply the rays behind
  /// it.
  CELLTRACE_ONE_COPY void shade_composed(const HitPoints<S>& points, uint32_t lanes) {
    scene_.spu().run_in_module(modules::kComposed);
    Surfaces<S> surfaces;
    find_surfaces(points, surfaces);
    prepare_textures(points, hits_, lanes);
    SecondaryRays<S> all = SecondaryRays<S>::nothing();
    for (uint32_t corner = 0; corner < 3 && points.blended != 0; ++corner) {
      WordLanes materials = points.material;
      for_each_lane(points.blended, [&](uint32_t lane) {
        materials.lane[lane] = scene_.blend(points.material.lane[lane])->material[corner];
      });
      F weight = F::load(corner == 1 ? hits_.u.lane : hits_.v.lane);
      if (corner == 0) weight = F(1.0f) - F::load(hits_.u.lane) - weight;
      shade_share(surfaces, points, materials, points.blended, weight, all);
    }
    if (const uint32_t textured = lanes & ~points.blended; textured != 0)
      shade_share(surfaces, points, points.material, textured, F(1.0f), all);
    spawn(surfaces, surfaces.normal, points.interior, all);
  }
  /// Shades the share of materials that may be texture maps.
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
  /// Shades materials that are not texture maps. Adaptive depth control drops a material by its weight alone,
  /// as in POV-Ray.
  CELLTRACE_ONE_COPY void shade_whole(Surfaces<S>& surfaces, const HitPoints<S>& points,
                                      const WordLanes& materials, uint32_t lanes, const F& weight,
                                      SecondaryRays<S>& all) {
    lanes &= (weight >= F(frame_.adc_bailout)).bits();
    if (lanes == 0) return;
    const WordLanes& interior = points.interior;
    const SecondaryRays<S> one = (lanes & points.textured) != 0
                                     ? shade_layers(surfaces, points, materials, lanes, weight)
                                     : shade(surfaces, interior, materials, lanes, weight);
    if (all.is_nothing())
      all = one;
    else if (all.template weighs_like<Spu>(one))
      all.template add<Spu>(one);
    else
      spawn(surfaces, surfaces.normal, interior, one);
  }

  /// Adds the surface's own light, times `share`; returns the secondary rays. Not inlined, like spawn():
  /// local store has no room for a copy at each call.
  CELLTRACE_ONE_COPY SecondaryRays<S> shade(const Surfaces<S>& surfaces, const WordLanes& interior,
                                            const WordLanes& materials, uint32_t lanes, const F& share) {
    scene_.spu().compute(scalar_work::kShade);
    const MaterialLanes<S> m = gather_materials(scene_, materials, lanes);
    add_light(surfaces, m, lanes, {share, share, share});
    return round_.is_first() ? onward_rays(surfaces, surfaces.normal, interior, m, lanes, share)
                             : SecondaryRays<S>::nothing();
  }
  /// Adds the light of surfaces without secondary rays, times `share`. Not inlined, so that its vectors are
  /// not on the stack while secondary rays are made.
  CELLTRACE_ONE_COPY void add_light(const Surfaces<S>& surfaces, const MaterialLanes<S>& m, uint32_t lanes,
                                    const V3<S>& share) {
    const V3<S> weight = share * node_.throughput.template load<S>();
    const V3<S> rest = local_light(scene_, frame_, round_, surfaces, m, lanes, weight);
    if (!round_.only_gathers) add_weighted(lanes, rest, weight);
  }
  /// Returns the secondary rays. `smooth`: the surfaces' normals before they were disturbed.
  CELLTRACE_ONE_COPY SecondaryRays<S> onward_rays(const Surfaces<S>& surfaces, const V3<S>& smooth,
                                                  const WordLanes& interior, const MaterialLanes<S>& m,
                                                  uint32_t lanes, const F& share) {
    SecondaryRays<S> onward = SecondaryRays<S>::nothing();
    if (!m.has(material_flag::reflects | material_flag::transmits)) return onward;
    scene_.spu().compute(scalar_work::kSecondaryRays);
    scene_.spu().enter_module(modules::kSecondary);
    F fresnel_ratio(1.0f);
    if (m.fresnel != 0)
      fresnel_ratio = F::load(fresnel_ratios(scene_, interior, lanes & m.fresnel, node_).lane);
    find_secondary_rays<Spu>(m, -dot<S>(surfaces.direction, surfaces.normal), fresnel_ratio,
                             frame_.adc_bailout, lanes, share, onward);
    const F counted = S::select(S::M::from_bits(onward.transmits), share, F(0.0f));
    onward.reflected_inside = {counted, counted, counted};
    if ((m.special & (onward.mirrors | onward.transmits)) != 0) {
      scene_.spu().enter_module(modules::kFinishes);
      change_special_mirror(scene_, surfaces, smooth, m, onward);
    }
    return onward;
  }

  /// Shades textures with patterns, normals or layers; see shade(). As in POV-Ray's model, the layers above
  /// dim the light of a layer, but not its reflections. If normals are disturbed, the secondary rays are
  /// spawned separately. The surfaces have the normals of the layers meanwhile.
  CELLTRACE_ONE_COPY SecondaryRays<S> shade_layers(Surfaces<S>& surfaces, const HitPoints<S>& points,
                                                   const WordLanes& top, uint32_t all_lanes, const F& share) {
    const WordLanes& interior = points.interior;
    const V3<S>& smooth = points.normal;
    const F one(1.0f);
    V3<S> above = {one, one, one}; // transmittance of the layers above
    WordLanes materials = top;
    uint32_t lanes = all_lanes;
    SecondaryRays<S> onward = SecondaryRays<S>::nothing();
    V3<S> outermost = smooth; // normal of the uppermost layer
    bool is_disturbed = false;
    for (bool is_top = true; lanes != 0; is_top = false) {
      MaterialLanes<S> m = gather_materials(scene_, materials, lanes);
      surfaces.normal = smooth;
      add_textures(materials, m, surfaces);
      add_light(surfaces, m, lanes, above * share);
      SecondaryRays<S> rays = onward_rays(surfaces, smooth, interior, m, lanes, one);
      if (rays.is_nothing()) break;
      const uint32_t clear = rays.transmits;
      rays.transmits = 0;
      // As in POV-Ray, mirrored light is not dimmed by the layers above, but its weight is.
      uint32_t bright = 0;
      for_each_part<Spu>([&](uint32_t first) {
        const auto part = [first](const auto& values) { return part_of<Spu>(values, first); };
        const V3<R> before = part(above);
        const V3<R> left = select<R>(R::M::from_bits(part(clear)), before * part(rays.through), before);
        set_part<Spu>(rays.mirror, first, part(rays.mirror) * part(share));
        set_part<Spu>(rays.mirror_weight, first, part(rays.mirror_weight) * grey<R>(before));
        set_part<Spu>(above, first, left);
        bright |= (grey<R>(left) > typename R::F(frame_.adc_bailout)).bits() << first;
      });
      bright &= clear;
      if (is_top) {
        onward = rays;
        outermost = surfaces.normal;
        is_disturbed = m.disturbed != 0;
      } else if (rays.mirrors != 0) {
        spawn(surfaces, smooth, interior, rays);
      }
      // Light is transmitted through all layers in the lanes whose last layer this is.
      onward.transmits |= bright & ~m.layered;
      lanes = bright & m.layered;
      for_each_value<S>(materials, lanes, [&](uint32_t offset, uint32_t same) {
        const uint32_t below = scene_.material(offset)->below;
        for_each_lane(same, [&](uint32_t lane) { materials.lane[lane] = below; });
      });
    }
    for_each_part<Spu>([&](uint32_t first) {
      const auto part = [first](const auto& values) { return part_of<Spu>(values, first); };
      const auto clear = R::M::from_bits(part(onward.transmits));
      const typename R::F zero(0.0f), through = R::select(clear, part(share), zero);
      const V3<R> left = part(above);
      set_part<Spu>(onward.through, first, left * through);
      set_part<Spu>(onward.through_weight, first, R::select(clear, max_component<R>(left), zero));
      set_part<Spu>(onward.reflected_inside, first, part(onward.reflected_inside) * through);
    });
    if (is_disturbed) {
      surfaces.normal = outermost;
      spawn(surfaces, smooth, interior, onward);
      onward.reset();
    }
    surfaces.normal = smooth;
    if (surface_ != nullptr) surface_->normal.template store<S>(smooth);
    return onward;
  }

  SurfaceLanes* surface_; ///< surfaces at the hits; null: no pattern of the scene needs them
};

} // namespace celltrace::kernel

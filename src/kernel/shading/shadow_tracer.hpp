// What comes of light to points: shadow rays are traced, or walked from surface to surface, and lights that
// have an area are asked place by place. Kernel dialect.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/accel/traversal.hpp"
#include "kernel/cameras/list.hpp"
#include "kernel/direct/area_occluders.hpp"
#include "kernel/direct/area_pairs.hpp"
#include "kernel/direct/kept_crossings.hpp"
#include "kernel/lights/area_shadow.hpp"
#include "kernel/shading/ray_tree.hpp"
#include "kernel/shading/shadow_walk.hpp"

namespace celltrace::kernel {

template <class Spu, uint32_t kAccelerators = kAnyAccelerator> class ShadowTracer {
public:
  using S = typename Spu::simd;
  using F = typename S::F;

  /// `scratch` may be shared with a RayTracer, whose `counters` count shadow rays.
  [[gnu::always_inline]] ShadowTracer(Spu& spu, const FrameBlock& frame, SceneAccess<Spu>& scene,
                                      RayNode& scratch, RayCounters& counters)
      : frame_(frame), scene_(scene), traversal_(scene, frame), counters_(counters),
        area_(allocate_area_shadow(spu, frame)), walk_(allocate_shadow_walk(spu, frame, scratch)) {
    static_assert(sizeof(ShadowWalk<S>) <= kResidentNodes * sizeof(RayNode), "lies where nodes would");
    static_assert(sizeof(AreaShadow<S>) <= kResidentNodes * sizeof(RayNode), "lies where nodes would");
  }

  /// What answers the queries, and may answer others.
  Traversal<Spu, kAccelerators>& traversal() { return traversal_; }
  const Traversal<Spu, kAccelerators>& traversal() const { return traversal_; }

  /// The interiors of the rays whose hits are asked about from now on; null: those of the camera.
  void set_interiors(const RayInteriors* interiors) { interiors_ = interiors; }
  /// Whether set_interiors() matters.
  bool asks_interiors() const { return walk_ != nullptr; }

  /// Whether the rays of a bundle to a light are not traced together.
  bool asks_by_packet(const LightRecord& light) const {
    return (light.kind_and_flags & (light_flag::area | light_flag::projected)) != 0 || walks_all(light);
  }

  /// Whether a light is where primary rays begin, and so nothing is between it and what they have hit. Not
  /// asked where there is no room for code.
  bool is_at_pinhole(const LightRecord& light) const {
    if constexpr (!kHasRoomForCode<Spu>) return false;
    constexpr uint32_t kOtherWays =
        light_flag::area | light_flag::parallel | light_flag::projected | light_flag::dimmed;
    if ((light.kind_and_flags & kOtherWays) != 0 || !is_pinhole(frame_.camera) ||
        (frame_.light_ways & light_way::unseen) != 0 || frame_.camera_interior_count != 0)
      return false;
    const float(&eye)[3] = frame_.camera.origin;
    return light.location[0] == eye[0] && light.location[1] == eye[1] && light.location[2] == eye[2];
  }
  /// Leaves in `colour`, which has been gathered, what comes of a light to which nothing is in the way.
  void take_unoccluded(uint32_t lanes, VectorLanes& colour) {
    counters_.shadow += static_cast<uint32_t>(__builtin_popcount(lanes));
    const V3<S> dark = {F(0.0f), F(0.0f), F(0.0f)};
    colour.template store<S>(select<S>(S::M::from_bits(lanes), colour.template load<S>(), dark));
  }

  /// Leaves in `colour`, which has been gathered, what comes of it to points on objects; in `lanes` it
  /// counts.
  CELLTRACE_ONE_COPY void trace(const LightRecord& light, ShadowRays& to_light, const V3<S>& point,
                                const WordLanes& objects, bool is_aimed, uint32_t lanes,
                                VectorLanes& colour) {
    if (lanes == 0) return colour.template store<S>({F(0.0f), F(0.0f), F(0.0f)});
    this->aim(light, to_light, point, objects, is_aimed, lanes);
    if (has_area(light)) return look_at_area(light, lanes, colour);
    trace_shadows(light, to_light.rays, lanes, to_light.distance, colour);
  }

  /// Makes shadow rays, unless shading has, or starts the sampling of a light that has an area.
  void aim(const LightRecord& light, ShadowRays& to_light, const V3<S>& point, const WordLanes& objects,
           bool is_aimed, uint32_t lanes) {
    if (!has_area(light)) counters_.shadow += static_cast<uint32_t>(__builtin_popcount(lanes));
    if (is_aimed && !has_area(light)) return;
    make_rays_to(light, to_light, point, objects, lanes);
  }
  /// Answers the queries of a bundle toward a light, of which asks_by_packet() is false. May change their
  /// order.
  void trace(const LightRecord& light, RayQuery* queries, uint32_t count) {
    if constexpr (kKeepsCrossings<Spu>)
      if (walk_ != nullptr) return look_at_crossings(light, queries, count);
    traversal_.intersect(queries, count, light);
  }

private:
  static constexpr uint32_t kPackets = kBundlePackets<Spu>;

  /// Not inlined: its surfaces are not on the stack while rays are traced.
  CELLTRACE_ONE_COPY void make_rays_to(const LightRecord& light, ShadowRays& to_light, const V3<S>& point,
                                       const WordLanes& objects, uint32_t lanes) {
    IncidentLight<S> incident(light.colour);
    kernel::aim(scene_.spu(), light, point, incident);
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
  CELLTRACE_ONE_COPY void trace_shadows(const LightRecord& light, const RayPacket& rays, uint32_t lanes,
                                        FloatLanes& distance, VectorLanes& colour) {
    if (is_projected(light)) {
      lanes = traversal_.project(light, rays, lanes, distance, colour);
      if (lanes == 0 || is_shadowless(light)) return;
    }
    if (walk_ == nullptr) return traversal_.transmittance(rays, lanes, distance, colour);
    if (walks_all(light)) return walk_shadows(light, rays, lanes, distance, colour);
    if constexpr (kKeepsCrossings<Spu>) look_at_crossings(light, rays, lanes, distance, colour);
  }
  /// Whether all shadow rays toward a light are walked; otherwise those are that have to be, or none.
  bool walks_all(const LightRecord& light) const {
    return walk_ != nullptr && (!kKeepsCrossings<Spu> || is_dimmed(light) || restarts_shadows(frame_));
  }
  /// Whether what surfaces let through depends on where rays come from: it is found surface by surface.
  bool lists_crossings() const { return walks_translucent(frame_) && !walks_for_fading(frame_); }
  /// Answers the queries of a bundle where order matters: what they cross is kept. Only rays are walked that
  /// cross more than there is room for.
  CELLTRACE_ONE_COPY void look_at_crossings(const LightRecord& light, RayQuery* queries, uint32_t count) {
    CrossingPool pool;
    KeptCrossings<S> crossings[kPackets];
    VectorLanes* colours[kPackets];
    for (uint32_t i = 0; i < count; ++i) {
      colours[i] = queries[i].light;
      crossings[i].begin(*colours[i], pool);
      queries[i].light = &crossings[i];
    }
    traversal_.keep_crossings(queries, count, light, lists_crossings());
    for (uint32_t i = 0; i < count; ++i) {
      auto& crossed = static_cast<KeptCrossings<S>&>(*queries[i].light);
      finish(light, queries[i], crossed, *colours[&crossed - crossings]);
    }
  }
  /// The same for one packet.
  CELLTRACE_ONE_COPY void look_at_crossings(const LightRecord& light, const RayPacket& rays, uint32_t lanes,
                                            const FloatLanes& distance, VectorLanes& colour) {
    CrossingPool pool;
    KeptCrossings<S> crossings;
    crossings.begin(colour, pool);
    RayQuery query = {&rays, nullptr, &distance, &crossings, lanes};
    traversal_.keep_crossings(query, lists_crossings());
    finish(light, query, crossings, colour);
  }
  void finish(const LightRecord& light, const RayQuery& query, KeptCrossings<S>& crossings,
              VectorLanes& colour) {
    if (walks_translucent(frame_))
      pass_crossings(query, crossings);
    else
      crossings.finish();
    walk_some(light, query, crossings, crossings.overflowed, colour);
  }
  /// Takes rays through the surfaces that they cross, one after the other.
  void pass_crossings(const RayQuery& query, KeptCrossings<S>& crossings) {
    if (query.lanes == 0 || crossings.empty()) return;
    ShadowWalk<S>& walk = *walk_;
    VectorLanes light = crossings, transmittance;
    begin_shadow_walk(scene_.spu(), frame_, interiors_, *query.rays, query.lanes, *query.distance, light,
                      walk);
    F last(0.0f);
    while (walk.ray->lanes != 0) {
      const uint32_t hit = crossings.take(walk.ray->lanes, walk.hits, transmittance);
      if (hit == 0) break;
      const F distance = F::load(walk.hits.distance.lane);
      (distance - last).store(walk.hits.distance.lane);
      last = S::select(S::M::from_bits(hit), distance, last);
      if (lists_crossings()) {
        find_hit_points(scene_, walk.ray->rays, walk.hits, hit, walk.points);
        step_shadow_walk(scene_, walk, counters_.dropped);
      } else {
        pass_surfaces(hit, transmittance, walk);
      }
    }
    static_cast<VectorLanes&>(crossings) = light;
  }
  /// As step_shadow_walk(), where what surfaces let through is known.
  void pass_surfaces(uint32_t hit, const VectorLanes& transmittance, ShadowWalk<S>& walk) {
    using I = typename S::I;
    I interiors = I::splat(0);
    for_each_value<S>(walk.hits.object, hit, [&](uint32_t object, uint32_t same) {
      const I of_object = I::splat(static_cast<int32_t>(scene_.object(object)->interior));
      interiors = S::select(S::M::from_bits(same), of_object, interiors);
    });
    WordLanes interior;
    store_words<S>(interior, interiors);
    const uint32_t counts = hit & (F::load(walk.hits.distance.lane) > F(kShadowEpsilon)).bits();
    fade(scene_, *walk.ray, interior, walk.hits.distance, counts, *walk.light, true);
    const V3<S> before = walk.light->template load<S>();
    walk.light->template store<S>(
        select<S>(S::M::from_bits(counts), before * transmittance.template load<S>(), before));
    cross_surfaces(scene_, interior, counts, *walk.ray, counters_.dropped);
    walk.ray->lanes = hit;
  }
  /// The light of a query: `answered` in lanes that are left; `walked` lanes are still to be walked.
  void walk_some(const LightRecord& light, const RayQuery& query, const VectorLanes& answered,
                 uint32_t walked, VectorLanes& colour) {
    const V3<S> dark = {F(0.0f), F(0.0f), F(0.0f)};
    const V3<S> direct = select<S>(S::M::from_bits(query.lanes), answered.template load<S>(), dark);
    if (walked == 0) return colour.template store<S>(direct);
    walk_shadows(light, *query.rays, walked, *query.distance, colour);
    colour.template store<S>(colour.template load<S>() + direct);
  }
  /// Walks `lanes` of shadow rays. The light of the others becomes 0.
  CELLTRACE_ONE_COPY void walk_shadows(const LightRecord& light, const RayPacket& rays, uint32_t lanes,
                                       const FloatLanes& distance, VectorLanes& colour) {
    ShadowWalk<S>& walk = *walk_;
    const bool dims = is_dimmed(light);
    scene_.spu().enter_module(modules::kShadowWalk);
    begin_shadow_walk(scene_.spu(), frame_, interiors_, rays, lanes, distance, colour, walk);
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
      step_shadow_walk(scene_, walk, counters_.dropped);
    }
  }

  /// The light of an area, whose places each packet asks by itself. Not inlined: few scenes have such lights.
  CELLTRACE_ONE_COPY void look_at_area(const LightRecord& light, [[maybe_unused]] uint32_t lanes,
                                       VectorLanes& colour) {
    AreaShadow<S>& area = *area_;
    if constexpr (kGathersOccluders<Spu>) {
      using Known = typename AreaOccluders<Spu>::Known;
      AreaOccluders<Spu> occluders;
      Known known = Known::nothing;
      if (!walks_all(light) && !is_projected(light))
        known = traversal_.gather_occluders(area.to_place->rays, lanes, light, occluders);
      if (known == Known::objects) {
        if (occluders.are_none())
          return colour.template store<S>(
              select<S>(S::M::from_bits(lanes), colour.template load<S>(), {F(0.0f), F(0.0f), F(0.0f)}));
        const auto test = [&](RayQuery* queries, uint32_t count) {
          traversal_.test_occluders(queries, count, occluders);
        };
        if (AreaPairs<Spu, false>::can_sample(light)) {
          AreaPairs<Spu, false>(light, grid_, area).sample(test);
        } else {
          while (next_place(scene_.spu(), light, area)) {
            RayQuery query = {&area.to_place->rays, nullptr, &area.to_place->distance, &area.light(),
                              area.lanes};
            test(&query, 1);
            answer(area, query.lanes);
          }
        }
        return take_area_light(colour);
      }
      if (!is_projected(light) && !walks_all(light)) {
        if (walk_ != nullptr) return look_at_crossed_area(light, colour);
        return look_at_occluded_area(light, known == Known::nodes ? &occluders : nullptr, colour);
      }
    }
    while (next_place(scene_.spu(), light, area)) {
      scene_.spu().compute(scalar_work::kBundleLight);
      trace_shadows(light, area.to_place->rays, area.lanes, area.to_place->distance, area.light());
    }
    take_area_light(colour);
  }
  /// The same where what occludes one place may occlude the next one, too. `occluders`: what is known of the
  /// nodes that are in the way; null: nothing.
  CELLTRACE_ONE_COPY void look_at_occluded_area(const LightRecord& light, const AreaOccluders<Spu>* occluders,
                                                VectorLanes& colour) {
    AreaShadow<S>& area = *area_;
    traversal_.remember_occluders(true);
    // False: the light is that of before, and none of it comes.
    const auto trace = [&](const RayPacket& rays, uint32_t lanes, const FloatLanes& distance,
                           VectorLanes& of_place) {
      lanes = traversal_.unoccluded_by_recent(rays, lanes, distance, of_place);
      if (lanes == 0) return false;
      if (occluders != nullptr)
        traversal_.transmittance_of(*occluders, rays, lanes, distance, of_place);
      else
        traversal_.transmittance(rays, lanes, distance, of_place);
      return true;
    };
    if (!sample_pairs(light, [&](const RayQuery& query, const int32_t*, VectorLanes& of_place) {
          return trace(*query.rays, query.lanes, *query.distance, of_place);
        }))
      while (next_place(scene_.spu(), light, area))
        if (!trace(area.to_place->rays, area.lanes, area.to_place->distance, area.light())) answer(area, 0);
    traversal_.remember_occluders(false);
    take_area_light(colour);
  }
  /// The same where what rays cross is kept.
  CELLTRACE_ONE_COPY void look_at_crossed_area(const LightRecord& light, VectorLanes& colour) {
    AreaShadow<S>& area = *area_;
    traversal_.remember_occluders(true);
    const RayInteriors* const of_surfaces = interiors_;
    const auto trace = [&](const RayQuery& query, const int32_t* surfaces, VectorLanes& of_place) {
      const uint32_t lanes =
          traversal_.unoccluded_by_recent(*query.rays, query.lanes, *query.distance, of_place);
      if (lanes == 0) return false;
      RayInteriors of_pairs;
      if (of_surfaces != nullptr) {
        for_each_lane(lanes, [&](uint32_t lane) {
          copy_lane(*of_surfaces, static_cast<uint32_t>(surfaces[lane]), of_pairs, lane);
        });
        interiors_ = &of_pairs;
      }
      look_at_crossings(light, *query.rays, lanes, *query.distance, of_place);
      interiors_ = of_surfaces;
      return true;
    };
    if (!sample_pairs(light, trace))
      while (next_place(scene_.spu(), light, area))
        look_at_crossings(light, area.to_place->rays, area.lanes, area.to_place->distance, area.light());
    traversal_.remember_occluders(false);
    take_area_light(colour);
  }
  /// Samples an area in pairs of a surface and a place, if there is room for them. `trace(query, the surface
  /// of each lane, light)` takes white light to what comes; false: none does.
  template <class Trace> bool sample_pairs(const LightRecord& light, const Trace& trace) {
    AreaShadow<S>& area = *area_;
    if (!AreaPairs<Spu, true>::can_sample(light)) return false;
    const uint32_t asked = area.rays_asked;
    AreaPairs<Spu, true> pairs(light, grid_, area);
    const auto test = [&](RayQuery* queries, uint32_t count) {
      for (uint32_t i = 0; i < count; ++i)
        if (!trace(queries[i], pairs.surface_lanes(i), *queries[i].light)) queries[i].lanes = 0;
    };
    if (pairs.sample(test)) return true;
    area.rays_asked = asked;
    return false;
  }
  void take_area_light(VectorLanes& colour) {
    counters_.shadow += area_->rays_asked;
    scene_.spu().enter_module(modules::kAreas);
    module_areas::dim(scene_.spu(), *area_, colour);
  }

  const FrameBlock& frame_;
  SceneAccess<Spu>& scene_;
  Traversal<Spu, kAccelerators> traversal_;
  RayCounters& counters_;
  AreaShadow<S>* area_; ///< null if no light has an area
  ShadowWalk<S>* walk_; ///< null if shadow rays need none
  [[no_unique_address]] Present<LightGrid, kGathersOccluders<Spu>> grid_;
  const RayInteriors* interiors_ = nullptr;
};

} // namespace celltrace::kernel

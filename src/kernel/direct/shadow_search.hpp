// Shadow rays in direct memory: their crossings are found by one traversal, and possible occluders between
// surfaces and an area light are gathered before its places are sampled. Kernel dialect.
#pragma once

#include "kernel/direct/area_pairs.hpp"
#include "kernel/direct/bundle_queries.hpp"
#include "kernel/direct/crossing_list.hpp"
#include "kernel/shading/shadow_tracer.hpp"

namespace celltrace::kernel {

/// Extends ShadowTracer, which is `Tracer`.
template <class Tracer, class Spu> class DirectShadowSearch {
protected:
  using S = typename Spu::simd;
  using F = typename S::F;

  bool is_at_pinhole(const LightRecord& light) const {
    constexpr uint32_t kUnsupportedLights =
        light_flag::area | light_flag::parallel | light_flag::projected | light_flag::dimmed;
    const FrameBlock& frame = tracer().frame_;
    if ((light.kind_and_flags & kUnsupportedLights) != 0 || !is_pinhole(frame.camera) ||
        (frame.light_features & light_feature::unseen) != 0 || frame.camera_interior_count != 0)
      return false;
    const float(&eye)[3] = frame.camera.origin;
    return light.location[0] == eye[0] && light.location[1] == eye[1] && light.location[2] == eye[2];
  }
  /// Returns true if rays toward a light are walked. As crossings are kept, this is necessary only if the
  /// light is dimmed on its way, or if walks restart.
  bool walks(const LightRecord& light) const { return is_dimmed(light) || restarts_shadows(tracer().frame_); }

  /// Answers the queries of a bundle where the order of crossings matters: the crossings are kept. Only rays
  /// with more crossings than there is room for are walked.
  bool trace_crossings(const LightRecord& light, RayQuery* queries, uint32_t count) {
    CrossingPool pool;
    CrossingList<S> crossings[kPackets];
    VectorLanes* colours[kPackets];
    for (uint32_t i = 0; i < count; ++i) {
      colours[i] = queries[i].light;
      crossings[i].begin(*colours[i], pool);
      queries[i].light = &crossings[i];
    }
    tracer().traversal_.collect_crossings(queries, count, light, lists_crossings());
    for (uint32_t i = 0; i < count; ++i) {
      auto& crossed = static_cast<CrossingList<S>&>(*queries[i].light);
      finish(light, queries[i], crossed, *colours[&crossed - crossings]);
    }
    return true;
  }
  /// Takes one packet through the surfaces that it crosses.
  void trace_crossings(const LightRecord& light, const RayPacket& rays, uint32_t lanes,
                       const FloatLanes& distance, VectorLanes& colour) {
    CrossingPool pool;
    CrossingList<S> crossings;
    crossings.begin(colour, pool);
    RayQuery query = {&rays, nullptr, &distance, &crossings, lanes};
    tracer().traversal_.collect_crossings(query, lists_crossings());
    finish(light, query, crossings, colour);
  }

  /// Samples an area light with all possible occluders if they are known, otherwise with the shadow cache.
  /// Returns false if the light was not sampled.
  bool sample_area(const LightRecord& light, uint32_t lanes, VectorLanes& colour) {
    using Gathered = typename AreaOccluders<Spu>::Gathered;
    if (is_projected(light) || tracer().walks_all(light)) return false;
    AreaShadow<S>& area = *tracer().area_;
    AreaOccluders<Spu> occluders;
    const Gathered known = tracer().traversal_.gather_occluders(area.to_place->rays, lanes, light, occluders);
    if (known == Gathered::objects)
      test_gathered(light, lanes, occluders, colour);
    else if (tracer().walk_ != nullptr)
      sample_crossed_area(light, colour);
    else
      sample_occluded_area(light, known == Gathered::nodes ? &occluders : nullptr, colour);
    return true;
  }

private:
  static constexpr uint32_t kPackets = kBundlePackets<Spu>;

  Tracer& tracer() { return static_cast<Tracer&>(*this); }
  const Tracer& tracer() const { return static_cast<const Tracer&>(*this); }

  /// Returns true if surfaces have to be passed one by one: their transmittance depends on where rays come
  /// from.
  bool lists_crossings() const {
    return walks_translucent(tracer().frame_) && !walks_for_fading(tracer().frame_);
  }
  void finish(const LightRecord& light, const RayQuery& query, CrossingList<S>& crossings,
              VectorLanes& colour) {
    if (walks_translucent(tracer().frame_))
      pass_crossings(query, crossings);
    else
      crossings.finish();
    walk_some(light, query, crossings, crossings.overflowed, colour);
  }
  /// Takes rays through the surfaces that they cross, one after another.
  void pass_crossings(const RayQuery& query, CrossingList<S>& crossings) {
    if (query.lanes == 0 || crossings.empty()) return;
    ShadowWalk<S>& walk = *tracer().walk_;
    VectorLanes light = crossings, transmittance;
    begin_shadow_walk(tracer().scene_.spu(), tracer().frame_, tracer().interiors_, *query.rays, query.lanes,
                      *query.distance, light, walk);
    F last(0.0f);
    while (walk.ray->lanes != 0) {
      const uint32_t hit = crossings.take(walk.ray->lanes, walk.hits, transmittance);
      if (hit == 0) break;
      const F distance = F::load(walk.hits.distance.lane);
      (distance - last).store(walk.hits.distance.lane);
      last = S::select(S::M::from_bits(hit), distance, last);
      if (lists_crossings()) {
        find_hit_points(tracer().scene_, walk.ray->rays, walk.hits, hit, walk.points);
        step_shadow_walk(tracer().scene_, walk, tracer().counters_.dropped);
      } else {
        pass_surfaces(hit, transmittance, walk);
      }
    }
    static_cast<VectorLanes&>(crossings) = light;
  }
  /// Takes rays through one surface each whose transmittance is known; see step_shadow_walk().
  void pass_surfaces(uint32_t hit, const VectorLanes& transmittance, ShadowWalk<S>& walk) {
    using I = typename S::I;
    I interiors = I::splat(0);
    for_each_value<S>(walk.hits.object, hit, [&](uint32_t object, uint32_t same) {
      const I of_object = I::splat(static_cast<int32_t>(tracer().scene_.object(object)->interior));
      interiors = S::select(S::M::from_bits(same), of_object, interiors);
    });
    WordLanes interior;
    store_words<S>(interior, interiors);
    const uint32_t counts = hit & (F::load(walk.hits.distance.lane) > F(kShadowEpsilon)).bits();
    fade(tracer().scene_, *walk.ray, interior, walk.hits.distance, counts, *walk.light, true);
    const V3<S> before = walk.light->template load<S>();
    walk.light->template store<S>(
        select<S>(S::M::from_bits(counts), before * transmittance.template load<S>(), before));
    cross_surfaces(tracer().scene_, interior, counts, *walk.ray, tracer().counters_.dropped);
    walk.ray->lanes = hit;
  }
  /// Stores the light of a query: `answered` in the query's lanes; `walked` lanes are walked first.
  void walk_some(const LightRecord& light, const RayQuery& query, const VectorLanes& answered,
                 uint32_t walked, VectorLanes& colour) {
    const V3<S> dark = {F(0.0f), F(0.0f), F(0.0f)};
    const V3<S> direct = select<S>(S::M::from_bits(query.lanes), answered.template load<S>(), dark);
    if (walked == 0) return colour.template store<S>(direct);
    tracer().walk_shadows(light, *query.rays, walked, *query.distance, colour);
    colour.template store<S>(colour.template load<S>() + direct);
  }

  void test_gathered(const LightRecord& light, uint32_t lanes, const AreaOccluders<Spu>& occluders,
                     VectorLanes& colour) {
    AreaShadow<S>& area = *tracer().area_;
    if (occluders.are_none())
      return colour.template store<S>(
          select<S>(S::M::from_bits(lanes), colour.template load<S>(), {F(0.0f), F(0.0f), F(0.0f)}));
    const auto test = [&](RayQuery* queries, uint32_t count) {
      tracer().traversal_.test_occluders(queries, count, occluders);
    };
    if (AreaPairs<Spu, false>::can_sample(light)) {
      AreaPairs<Spu, false>(light, grid_, area).sample(test);
    } else {
      while (next_place(tracer().scene_.spu(), light, area)) {
        RayQuery query = {&area.to_place->rays, nullptr, &area.to_place->distance, &area.light(), area.lanes};
        test(&query, 1);
        answer(area, query.lanes);
      }
    }
    tracer().take_area_light(colour);
  }
  /// Samples an area light: occluders of one place are tested first for the next place. `occluders` has the
  /// nodes that may contain further occluders; null: these nodes are not known.
  void sample_occluded_area(const LightRecord& light, const AreaOccluders<Spu>* occluders,
                            VectorLanes& colour) {
    AreaShadow<S>& area = *tracer().area_;
    tracer().traversal_.record_occluders(true);
    // Returns false if no light comes; `of_place` is then unchanged.
    const auto trace = [&](const RayPacket& rays, uint32_t lanes, const FloatLanes& distance,
                           VectorLanes& of_place) {
      lanes = tracer().traversal_.unoccluded_by_recent(rays, lanes, distance, of_place);
      if (lanes == 0) return false;
      if (occluders != nullptr)
        tracer().traversal_.transmittance_of(*occluders, rays, lanes, distance, of_place);
      else
        tracer().traversal_.transmittance(rays, lanes, distance, of_place);
      return true;
    };
    if (!sample_pairs(light, [&](const RayQuery& query, const int32_t*, VectorLanes& of_place) {
          return trace(*query.rays, query.lanes, *query.distance, of_place);
        }))
      while (next_place(tracer().scene_.spu(), light, area))
        if (!trace(area.to_place->rays, area.lanes, area.to_place->distance, area.light())) answer(area, 0);
    tracer().traversal_.record_occluders(false);
    tracer().take_area_light(colour);
  }
  /// Samples an area light if the crossings of rays are kept.
  void sample_crossed_area(const LightRecord& light, VectorLanes& colour) {
    AreaShadow<S>& area = *tracer().area_;
    tracer().traversal_.record_occluders(true);
    const RayInteriors* const of_surfaces = tracer().interiors_;
    const auto trace = [&](const RayQuery& query, const int32_t* surfaces, VectorLanes& of_place) {
      const uint32_t lanes =
          tracer().traversal_.unoccluded_by_recent(*query.rays, query.lanes, *query.distance, of_place);
      if (lanes == 0) return false;
      RayInteriors of_pairs;
      if (of_surfaces != nullptr) {
        for_each_lane(lanes, [&](uint32_t lane) {
          copy_lane(*of_surfaces, static_cast<uint32_t>(surfaces[lane]), of_pairs, lane);
        });
        tracer().interiors_ = &of_pairs;
      }
      trace_crossings(light, *query.rays, lanes, *query.distance, of_place);
      tracer().interiors_ = of_surfaces;
      return true;
    };
    if (!sample_pairs(light, trace))
      while (next_place(tracer().scene_.spu(), light, area))
        trace_crossings(light, area.to_place->rays, area.lanes, area.to_place->distance, area.light());
    tracer().traversal_.record_occluders(false);
    tracer().take_area_light(colour);
  }
  /// Samples an area light in pairs of a surface and a place, if there is room for them. `trace(query,
  /// surface of each lane, light)` changes white light to the light that arrives, and returns false if none
  /// does.
  template <class Trace> bool sample_pairs(const LightRecord& light, const Trace& trace) {
    AreaShadow<S>& area = *tracer().area_;
    if (!AreaPairs<Spu, true>::can_sample(light)) return false;
    const uint32_t ray_count = area.ray_count;
    AreaPairs<Spu, true> pairs(light, grid_, area);
    const auto test = [&](RayQuery* queries, uint32_t count) {
      for (uint32_t i = 0; i < count; ++i)
        if (!trace(queries[i], pairs.surface_lanes(i), *queries[i].light)) queries[i].lanes = 0;
    };
    if (pairs.sample(test)) return true;
    area.ray_count = ray_count;
    return false;
  }

  LightGrid grid_;
};

} // namespace celltrace::kernel

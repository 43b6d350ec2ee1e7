// Light that reaches points: shadow rays are traced, or walked from surface to surface, and area lights are
// sampled place by place. Kernel dialect.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/accel/traversal.hpp"
#include "kernel/cameras/list.hpp"
#include "kernel/lights/area_shadow.hpp"
#include "kernel/shading/light_along.hpp"
#include "kernel/shading/ray_tree.hpp"
#include "kernel/shading/shadow_walk.hpp"

namespace celltrace::kernel {

/// Traces rays to lights. A strategy's ShadowSearch has:
///
///   is_at_pinhole(light)                true if a light is known to be where primary rays begin: nothing
///                                       occludes it from their hits
///   walks(light)                        true if rays toward a light are walked, in scenes where some must be
///   trace_crossings(light, queries, count)   takes a bundle through crossed surfaces; false: not done
///   trace_crossings(light, rays, lanes, distance, colour)   takes a packet that is not walked through the
///                                       surfaces that it crosses
///   sample_area(light, lanes, colour)   finds the light of an area light; false: not found
template <class Spu, uint32_t kAccelerators = kAnyAccelerator>
class ShadowTracer : public Strategy<Spu>::template ShadowSearch<ShadowTracer<Spu, kAccelerators>, Spu> {
  using Search = typename Strategy<Spu>::template ShadowSearch<ShadowTracer, Spu>;
  friend Search;

public:
  using S = typename Spu::simd;
  using F = typename S::F;

  /// Allocates memory. `scratch` may be shared with a RayTracer, whose `counters` count shadow rays.
  [[gnu::always_inline]] ShadowTracer(Spu& spu, const FrameBlock& frame, SceneAccess<Spu>& scene,
                                      RayNode& scratch, RayCounters& counters)
      : frame_(frame), scene_(scene), traversal_(scene, frame), counters_(counters),
        area_(allocate_area_shadow(spu, frame)), walk_(allocate_shadow_walk(spu, frame, scratch)) {
    static_assert(sizeof(ShadowWalk<S>) <= kResidentNodes * sizeof(RayNode), "lies where nodes would");
    static_assert(sizeof(AreaShadow<S>) <= kResidentNodes * sizeof(RayNode), "lies where nodes would");
  }

  /// Returns the Traversal, which may answer other queries, too.
  Traversal<Spu, kAccelerators>& traversal() { return traversal_; }
  const Traversal<Spu, kAccelerators>& traversal() const { return traversal_; }

  /// Sets the interiors of the rays whose hits are processed next; null: those of the camera.
  void set_interiors(const RayInteriors* interiors) { interiors_ = interiors; }
  /// Returns true if set_interiors() matters.
  bool needs_interiors() const { return walk_ != nullptr; }

  /// Returns true if the rays of a bundle to a light are not traced together.
  bool traces_by_packet(const LightRecord& light) const {
    return (light.kind_and_flags & (light_flag::area | light_flag::projected)) != 0 || walks_all(light);
  }

  using Search::is_at_pinhole;
  /// Finds the light of a source that nothing occludes: the gathered `colour` in `lanes`, otherwise 0.
  void take_unoccluded(uint32_t lanes, VectorLanes& colour) {
    counters_.shadow += static_cast<uint32_t>(__builtin_popcount(lanes));
    const V3<S> dark = {F(0.0f), F(0.0f), F(0.0f)};
    colour.template store<S>(select<S>(S::M::from_bits(lanes), colour.template load<S>(), dark));
  }

  /// Multiplies `colour`, the gathered light of points on objects, by the share that reaches the points;
  /// colour in lanes other than `lanes` does not count.
  CELLTRACE_ONE_COPY void trace(const LightRecord& light, ShadowRays& to_light, const V3<S>& point,
                                const WordLanes& objects, bool is_aimed, uint32_t lanes,
                                VectorLanes& colour) {
    if (lanes == 0) return colour.template store<S>({F(0.0f), F(0.0f), F(0.0f)});
    this->aim(light, to_light, point, objects, is_aimed, lanes);
    if (has_area(light)) return sample_light_area(light, lanes, colour);
    trace_shadows(light, to_light.rays, lanes, to_light.distance, colour);
  }

  /// Makes shadow rays, unless shading has made them, or starts the sampling of an area light.
  void aim(const LightRecord& light, ShadowRays& to_light, const V3<S>& point, const WordLanes& objects,
           bool is_aimed, uint32_t lanes) {
    if (!has_area(light)) counters_.shadow += static_cast<uint32_t>(__builtin_popcount(lanes));
    if (is_aimed && !has_area(light)) return;
    make_rays_to(light, to_light, point, objects, lanes);
  }
  /// Answers the queries of a bundle toward a light for which traces_by_packet() is false. May change the
  /// queries' order.
  void trace(const LightRecord& light, RayQuery* queries, uint32_t count) {
    if (walk_ == nullptr || !Search::trace_crossings(light, queries, count))
      traversal_.intersect(queries, count, light);
  }

private:
  /// Makes shadow rays. Not inlined, so that surfaces are not on the stack while rays are traced.
  CELLTRACE_ONE_COPY void make_rays_to(const LightRecord& light, ShadowRays& to_light, const V3<S>& point,
                                       const WordLanes& objects, uint32_t lanes) {
    IncidentLight<S> incident(light.colour);
    kernel::aim(scene_.spu(), light, point, incident);
    if (!has_area(light)) {
      make_shadow_rays(point, objects, incident, to_light.rays, to_light.distance);
      return;
    }
    // The lanes in which the light counts are known: only the positions of the surfaces are used.
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

  /// Multiplies `colour` by the transmittance toward a light; see Traversal::transmittance(). Not inlined, as
  /// one copy in local store suffices.
  CELLTRACE_ONE_COPY void trace_shadows(const LightRecord& light, const RayPacket& rays, uint32_t lanes,
                                        FloatLanes& distance, VectorLanes& colour) {
    if (is_projected(light)) {
      lanes = traversal_.project(light, rays, lanes, distance, colour);
      if (lanes == 0 || is_shadowless(light)) return;
    }
    if (walk_ == nullptr) return traversal_.transmittance(rays, lanes, distance, colour);
    if (walks_all(light)) return walk_shadows(light, rays, lanes, distance, colour);
    Search::trace_crossings(light, rays, lanes, distance, colour);
  }
  /// Returns true if all shadow rays toward a light are walked, false if few or none are.
  bool walks_all(const LightRecord& light) const { return walk_ != nullptr && Search::walks(light); }
  /// Walks `lanes` of shadow rays. The light of other lanes becomes 0.
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
        light_along<ShadowRadiance>(scene_, frame_, walk.hits, walk.left, *walk.ray, *walk.light);
      }
      scene_.spu().enter_module(modules::kShadowWalk);
      const uint32_t hit = hits_of_walk(scene_.spu(), walk);
      if (hit == 0) return;
      find_hit_points(scene_, walk.ray->rays, walk.hits, hit, walk.points);
      scene_.spu().enter_module(modules::kShadowWalk);
      step_shadow_walk(scene_, walk, counters_.dropped);
    }
  }

  /// Samples an area light packet by packet. Not inlined, as few scenes have such lights.
  CELLTRACE_ONE_COPY void sample_light_area(const LightRecord& light, uint32_t lanes, VectorLanes& colour) {
    AreaShadow<S>& area = *area_;
    if (Search::sample_area(light, lanes, colour)) return;
    while (next_place(scene_.spu(), light, area)) {
      scene_.spu().compute(scalar_work::kBundleLight);
      trace_shadows(light, area.to_place->rays, area.lanes, area.to_place->distance, area.light());
    }
    take_area_light(colour);
  }
  void take_area_light(VectorLanes& colour) {
    counters_.shadow += area_->ray_count;
    scene_.spu().enter_module(modules::kAreas);
    module_areas::dim(scene_.spu(), *area_, colour);
  }

  const FrameBlock& frame_;
  SceneAccess<Spu>& scene_;
  Traversal<Spu, kAccelerators> traversal_;
  RayCounters& counters_;
  AreaShadow<S>* area_; ///< null if no light has an area
  ShadowWalk<S>* walk_; ///< null if no shadow rays are walked
  const RayInteriors* interiors_ = nullptr;
};

} // namespace celltrace::kernel

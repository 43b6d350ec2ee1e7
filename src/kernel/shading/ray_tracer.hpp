// Ray tracing of packets of primary rays. Kernel dialect.
#pragma once

#include "kernel/shading/light_along.hpp"
#include "kernel/shading/surface_shading.hpp"
#include "kernel/textures/sky.hpp"

namespace celltrace::kernel {

/// Traces the tree of one packet at a time, in steps between which its rays are traced: begin(), then for
/// each node() take_hits() and, if there are hits, shade_hits() for each round of lights, until advance()
/// finds no more nodes.
template <class Spu, uint32_t kResident = kResidentNodes>
class RayTracer : public SurfaceShading<Spu, kResident> {
  using Shading = SurfaceShading<Spu, kResident>;
  using Shading::add;
  using Shading::count;
  using Shading::counters_;
  using Shading::ends;
  using Shading::frame_;
  using Shading::hits_;
  using Shading::light_;
  using Shading::light_of_ends;
  using Shading::node_;
  using Shading::scene_;
  using Shading::transparency_;

public:
  using typename Shading::F;
  using typename Shading::S;
  using M = typename S::M;

  /// Allocates memory. `spill` has room for `spill_nodes`. `scratch` may be shared by tracers.
  RayTracer(Spu& spu, const FrameBlock& frame, SceneAccess<Spu>& scene, ea_t spill, uint32_t spill_nodes,
            RayNode& scratch)
      : Shading(spu, frame, scene, spill, spill_nodes, scratch) {}

  /// Finds the colours of primary rays whose hits are known, without the light that the round gathers.
  /// Returns false if some rays do not end there, or if there are more lights than in one round.
  bool ends_at_once(const RayPacket& rays, uint32_t lanes, const HitPacket& hits, const HitPoints<S>& points,
                    LightRound& round, VectorLanes& colours) {
    if (round.next() != frame_.light_count || has_atmosphere(frame_)) return false;
    const uint32_t hit = hit_lanes<S>(hits, lanes);
    if (!ends(points, hit)) return false;
    const F zero(0.0f);
    V3<S> seen = {zero, zero, zero};
    if (hit != 0) seen = light_of_ends(rays, hits, points, hit, round);
    counters_.primary += count(lanes);
    if (const uint32_t missed = lanes & ~hit; missed != 0)
      seen = select<S>(M::from_bits(hit), seen, behind(rays.direction, missed));
    colours.template store<S>(seen);
    return true;
  }

  /// Returns the colours of primary rays without a hit.
  V3<S> background(const RayPacket& rays, uint32_t lanes) {
    counters_.primary += count(lanes);
    return behind(rays.direction, lanes);
  }
  /// Returns the colour of `rays` primary rays without a hit in a frame without a sky.
  V3<S> background(uint32_t rays) {
    counters_.primary += rays;
    return splat3<S>(frame_.background);
  }

  /// Returns the lanes of node() with a hit; other lanes see the background.
  uint32_t take_hits() {
    return take_hits([](uint32_t) { return false; });
  }
  /// Returns the lanes of node() with a hit. If `waits(lanes)` is true for the lanes without a hit, the
  /// caller adds their background.
  template <class Waits> [[gnu::always_inline]] uint32_t take_hits(const Waits& waits) {
    scene_.spu().compute(scalar_work::kNode);
    if (has_atmosphere(frame_)) {
      scene_.spu().enter_module(modules::kAtmosphere);
      light_along<PathRadiance>(scene_, frame_, hits_, node_, light_[node_.target]);
      if ((frame_.light_features & light_feature::alpha) != 0) {
        scene_.spu().enter_module(modules::kSky);
        see_through(scene_, frame_, hits_, node_, *transparency_);
      }
    }
    const uint32_t hit = hit_lanes<S>(hits_, node_.lanes);
    const uint32_t missed = node_.lanes & ~hit;
    if (missed != 0 && !waits(missed)) add(missed, behind(node_.rays.direction, missed));
    return hit;
  }

  /// Returns the colours that rays of `lanes` see if they hit nothing.
  V3<S> behind(const VectorLanes& direction, uint32_t lanes) {
    V3<S> colour = splat3<S>(frame_.background);
    if (frame_.sky != kNoOffset) {
      scene_.spu().enter_module(modules::kSky);
      add_sky(scene_, frame_.sky, direction.template load<S>(), lanes, colour);
    }
    return colour;
  }
};

} // namespace celltrace::kernel

// What a tree of rays asks of the scene. Kernel dialect.
#pragma once

#include "kernel/accel/traversal.hpp"
#include "kernel/shading/lighting.hpp"

namespace celltrace::kernel {

/// Answers by a Traversal, but for light that is known.
template <class Spu, uint32_t kAccelerators = kAnyAccelerator> class Intersector {
public:
  using S = typename Spu::simd;

  Intersector(SceneAccess<Spu>& scene, const FrameBlock& frame) : traversal_(scene, frame) {}

  /// As Traversal's.
  void find_closest(const RayPacket& rays, uint32_t lanes, HitPacket& hits) {
    traversal_.find_closest(rays, lanes, hits);
  }
  /// Multiplies the colour of light `number` by what comes through to the surfaces that face it.
  void transmittance(const Surfaces<S>& surfaces, const IncidentLight<S>& light, uint32_t number,
                     VectorLanes& colour) {
    if (number < known_lights_) {
      colour = known_[number];
      return;
    }
    RayPacket rays;
    FloatLanes distance;
    make_shadow_rays(surfaces, light, rays, distance);
    traversal_.transmittance(rays, light.facing, distance, colour);
  }

  /// `light[i]` is what comes from light i to the surfaces that are asked for from now on.
  void know_light(const VectorLanes* light, uint32_t count) {
    known_ = light;
    known_lights_ = count;
  }
  void forget_light() { known_lights_ = 0; }

  Traversal<Spu, kAccelerators>& traversal() { return traversal_; }
  const TraversalCounters& counters() const { return traversal_.counters(); }
  void reset_counters() { traversal_.reset_counters(); }

private:
  Traversal<Spu, kAccelerators> traversal_;
  const VectorLanes* known_ = nullptr;
  uint32_t known_lights_ = 0;
};

} // namespace celltrace::kernel

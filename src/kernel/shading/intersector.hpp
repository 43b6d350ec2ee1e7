// What a tree of rays asks of the scene. Kernel dialect.
#pragma once

#include "kernel/accel/traversal.hpp"
#include "kernel/lights/area_shadow.hpp"
#include "kernel/shading/lighting.hpp"

namespace celltrace::kernel {

/// Answers by a Traversal, but for light that is known.
template <class Spu, uint32_t kAccelerators = kAnyAccelerator> class Intersector {
public:
  using S = typename Spu::simd;

  Intersector(SceneAccess<Spu>& scene, const FrameBlock& frame)
      : traversal_(scene, frame), scene_(scene), area_(allocate_area_shadow(scene.spu(), frame)) {}

  /// As Traversal's.
  void find_closest(const RayPacket& rays, uint32_t lanes, HitPacket& hits) {
    traversal_.find_closest(rays, lanes, hits);
  }
  /// Multiplies the colour of light `number` by what comes through to the surfaces that face it. Returns how
  /// many shadow rays there are.
  uint32_t transmittance(const LightRecord& source, const Surfaces<S>& surfaces,
                         const IncidentLight<S>& light, uint32_t number, VectorLanes& colour) {
    const auto rays_of_packet = static_cast<uint32_t>(__builtin_popcount(light.facing));
    if (number < 32 && (known_lights_ >> number & 1) != 0) {
      colour = known_[number];
      return rays_of_packet;
    }
    if (has_area(source)) return look_at_area(source, surfaces, light, colour);
    RayPacket rays;
    FloatLanes distance;
    make_shadow_rays(surfaces, light, rays, distance);
    traversal_.transmittance(rays, light.facing, distance, colour);
    return rays_of_packet;
  }

  /// `light[i]` is what comes from light i, if bit i of `lights` is set, to the surfaces that are asked for
  /// from now on.
  void know_light(const VectorLanes* light, uint32_t lights) {
    known_ = light;
    known_lights_ = lights;
  }
  void forget_light() { known_lights_ = 0; }

  Traversal<Spu, kAccelerators>& traversal() { return traversal_; }
  const TraversalCounters& counters() const { return traversal_.counters(); }
  void reset_counters() { traversal_.reset_counters(); }

private:
  /// Not inlined: few scenes have such lights.
  [[gnu::noinline]] uint32_t look_at_area(const LightRecord& source, const Surfaces<S>& surfaces,
                                          const IncidentLight<S>& light, VectorLanes& colour) {
    return sample_area(scene_.spu(), source, surfaces, light, *area_, colour, [&](AreaShadow<S>& shadow) {
      scene_.spu().compute(scalar_work::kBundleLight);
      traversal_.transmittance(shadow.rays, shadow.lanes, shadow.distance, shadow.light);
    });
  }

  Traversal<Spu, kAccelerators> traversal_;
  SceneAccess<Spu>& scene_;
  AreaShadow<S>* area_; ///< null if no light has an area
  const VectorLanes* known_ = nullptr;
  uint32_t known_lights_ = 0; ///< bits
};

} // namespace celltrace::kernel

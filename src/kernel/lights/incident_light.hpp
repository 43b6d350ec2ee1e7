// Light from a source as it reaches surfaces. Kernel dialect.
#pragma once

#include "kernel/lights/surfaces.hpp"

namespace celltrace::kernel {

/// The light of one source as it reaches surfaces if nothing occludes it.
template <class S> struct IncidentLight {
  V3<S> direction;        ///< unit vector toward the source
  typename S::F distance; ///< length of shadow rays
  typename S::F cosine;   ///< cosine of the angle between the direction and the normal
  V3<S> colour;
  uint32_t facing; ///< lanes that the light reaches

  IncidentLight() = default;
  /// Sets the colour alone.
  explicit IncidentLight(const float (&rgb)[3]) : colour(splat3<S>(rgb)) {}

  /// Sets direction and distance from the vector to the light.
  void set_ray(const V3<S>& to_light) {
    using F = typename S::F;
    distance = S::sqrt(dot<S>(to_light, to_light));
    direction = to_light * (F(1.0f) / S::max(distance, F(1e-30f)));
  }
  /// Sets the cosine and the lanes that face the light, from its direction. Light along a surface counts as
  /// light from behind it. POV-Ray's least cosine is 1e-10. In single precision rounding alone makes cosines
  /// of 1e-7, whose sign would speckle highlights, which do not fade toward that angle.
  void face(const Surfaces<S>& s, uint32_t lanes) {
    constexpr float kLeastCosine = 1e-6f;
    cosine = dot<S>(direction, s.normal);
    facing = ((cosine >= typename S::F(kLeastCosine)).bits() | s.any_side) & lanes;
  }
};

template <class Spu>
[[gnu::always_inline]] inline decltype(auto) part_of(const IncidentLight<typename Spu::simd>& light,
                                                     uint32_t first) {
  return whole_or<Spu>(
      light, [&]() __attribute__((always_inline)) {
        IncidentLight<typename Spu::rare_simd> part;
        part.direction = part_of<Spu>(light.direction, first);
        part.distance = part_of<Spu>(light.distance, first);
        part.cosine = part_of<Spu>(light.cosine, first);
        part.colour = part_of<Spu>(light.colour, first);
        part.facing = part_of<Spu>(light.facing, first);
        return part;
      });
}

/// Shadow rays toward a light, and their lengths.
struct ShadowRays {
  RayPacket rays;
  FloatLanes distance;
};
/// Makes shadow rays from points on objects.
template <class S>
void make_shadow_rays(const V3<S>& points, const WordLanes& objects, const IncidentLight<S>& light,
                      RayPacket& rays, FloatLanes& distance) {
  rays.origin.template store<S>(points);
  rays.direction.template store<S>(light.direction);
  rays.start_object = objects;
  light.distance.store(distance.lane);
}

} // namespace celltrace::kernel

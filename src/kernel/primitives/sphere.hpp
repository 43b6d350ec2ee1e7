// The sphere: centre and radius in the world. Kernel dialect.
#pragma once

#include "kernel/aabb.hpp"
#include "kernel/primitives/crossings.hpp"
#include "kernel/primitives/surface_coordinates.hpp"
#include "kernel/scalar.hpp"
#include "records/object.hpp"

namespace celltrace::kernel {

namespace detail {

/// Returns the crossings with a sphere at the distance `half_chord_centre` along the ray, plus and minus half
/// the chord, where `square` = (half chord)^2. A ray that starts on the sphere leaves it at exactly twice
/// that distance, whatever the rounding of its origin.
template <class S>
Crossings<S> chord(const typename S::F& half_chord_centre, const typename S::F& square,
                   const typename S::M& starts_here) {
  using F = typename S::F;
  const auto hits = square >= F(0.0f);
  const F half = S::sqrt(S::max(square, F(0.0f)));
  Crossings<S> c;
  c.near = half_chord_centre - half;
  c.far = S::select(starts_here, half_chord_centre + half_chord_centre, half_chord_centre + half);
  c.near_hit = hits & !starts_here;
  c.far_hit = hits | starts_here;
  c.u = F(0.0f);
  c.v = F(0.0f);
  return c;
}

} // namespace detail

/// Intersects a sphere by the geometric test (Haines, in Glassner, An Introduction to Ray Tracing).
template <class S>
Crossings<S> intersect_sphere(const V3<S>& origin, const V3<S>& direction, const typename S::M& starts_here,
                              const ObjectRecord& object) {
  using F = typename S::F;
  const V3<S> to_centre = splat3<S>(object.geometry) - origin;
  const F along = dot<S>(to_centre, direction);
  // The perpendicular is computed itself, not |to_centre|^2 - along^2: the difference of two large squares
  // loses small spheres that are far away.
  const V3<S> perpendicular = to_centre - direction * along;
  const F radius(object.geometry[3]);
  return detail::chord<S>(along, radius * radius - dot<S>(perpendicular, perpendicular), starts_here);
}

struct SpherePrimitive : ShapeTraits {
  static constexpr const char* kName = "sphere";
  static constexpr uint32_t kCrossingPairs = 1;
  static constexpr bool kHasParameters = false;
  static constexpr bool kHasCoordinates = true;

  template <class S>
  static void intersect(const RayPacket& rays, const ObjectRecord& object, const ExtraRecord&, uint32_t self,
                        Crossings<S>* crossings) {
    *crossings = intersect_sphere<S>(rays.origin.template load<S>(), rays.direction.template load<S>(),
                                     lanes_that_start_on<S>(rays, self), object);
  }

  template <class S>
  static typename S::M inside(const V3<S>& point, const ObjectRecord& object, const ExtraRecord&) {
    using F = typename S::F;
    const V3<S> from_centre = point - splat3<S>(object.geometry);
    const F radius(object.geometry[3]);
    return dot<S>(from_centre, from_centre) < radius * radius;
  }

  template <class S>
  [[gnu::always_inline]] static void coordinates(const SurfacePoint<S>& at, typename S::F& u,
                                                 typename S::F& v) {
    const float(&g)[12] = at.object.geometry;
    const V3<S> from = at.point - splat3<S>(g), x = splat3<S>(g + 4), y = splat3<S>(g + 7);
    map_sphere<S>({dot<S>(x, from), dot<S>(y, from), dot<S>(cross<S>(x, y), from) * typename S::F(g[10])}, u,
                  v);
  }

  static Aabb bounds(const ObjectRecord& object, const ExtraRecord&) {
    const float* g = object.geometry;
    Aabb box;
    for (int i = 0; i < 3; ++i) {
      box.min[i] = g[i] - g[3];
      box.max[i] = g[i] + g[3];
    }
    return box;
  }

  /// Returns true if the surface may touch a box: the box's nearest point is inside, its farthest point
  /// outside.
  static bool overlaps(const ObjectRecord& object, const ExtraRecord&, const Aabb& box) {
    const float* g = object.geometry;
    float nearest = 0.0f;
    float farthest = 0.0f;
    for (int i = 0; i < 3; ++i) {
      const float to_min = box.min[i] - g[i];
      const float to_max = g[i] - box.max[i];
      const float outside = larger(0.0f, larger(to_min, to_max));
      const float across = larger(magnitude(to_min), magnitude(to_max));
      nearest += outside * outside;
      farthest += across * across;
    }
    const float square = g[3] * g[3];
    return nearest <= square * 1.0001f && farthest >= square * 0.9999f;
  }
};

} // namespace celltrace::kernel

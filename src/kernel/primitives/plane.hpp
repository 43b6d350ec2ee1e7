// The plane: z = 0 of its space; the half-space z < 0 is inside. Kernel dialect.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/primitives/flat_shape.hpp"

namespace celltrace::kernel {

/// Intersects a plane, reading only the third row of the map: the unit normal, and minus the distance.
template <class S>
CELLTRACE_ONE_COPY void intersect_plane(const RayPacket& rays, const ObjectRecord& object, uint32_t self,
                                        Crossings<S>& c) {
  using F = typename S::F;
  const V3<S> normal = splat3<S>(object.geometry + 8);
  const F height = dot<S>(normal, rays.origin.template load<S>()) + F(object.geometry[11]);
  const F slope = dot<S>(normal, rays.direction.template load<S>());
  c.clear();
  c.near = -height * finite_inverse<S>(slope);
  // A ray that starts on a plane does not cross it again.
  c.near_hit = (S::abs(slope) > F(1e-10f)) & !lanes_that_start_on<S>(rays, self);
}

struct PlanePrimitive : FlatPrimitive<PlanePrimitive> {
  static constexpr const char* kName = "plane";
  static constexpr bool kHasParameters = false;
  static constexpr bool kHasFaces = false; // points need not be moved onto the plane
  static constexpr bool kIsBounded = false;

  template <class S>
  static void intersect_local(const LocalRays<S>& rays, const LocalParameters<S>&, Crossings<S>* crossings) {
    typename S::F x, y;
    // A ray that starts on a plane does not cross it again.
    crossings->near_hit = cross_plane<S>(rays, *crossings, x, y);
  }

  template <class S> static typename S::M inside_local(const V3<S>& p, const LocalParameters<S>&) {
    return p.z < typename S::F(0.0f);
  }

  /// Returns unlimited bounds: planes are not in the BVH, unless CSG bounds them.
  static LocalBounds local_bounds(float) { return {0.0f, 0.0f, kUnboundedRadius, true}; }
  static constexpr float kUnboundedRadius = 1e30f;
};

} // namespace celltrace::kernel

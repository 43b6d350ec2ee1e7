// Shapes where code takes no local store. Kernel dialect.
#pragma once

#include "kernel/direct/instance_rays.hpp"

namespace celltrace::kernel {

struct DirectShapes {
  /// Returns rays in the space of a shape. As in POV-Ray, a ray in the plane of a face counts as inside: its
  /// origin is moved off the face by as much as rounding.
  template <class S, class Shape>
  [[gnu::always_inline]] static LocalRays<S> off_faces(const LocalRays<S>& rays) {
    LocalRays<S> inside = rays;
    if constexpr (Shape::kHasFaces)
      inside.origin = Shape::template off_parallel_faces<S>(rays.origin, rays.direction, 1e-6f);
    return inside;
  }

  template <class Spu> using InstanceRays = kernel::InstanceRays<Spu>;
};

} // namespace celltrace::kernel

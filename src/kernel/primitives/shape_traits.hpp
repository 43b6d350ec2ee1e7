// Traits of shapes: the hooks that a shape may have, and their defaults. Kernel
// dialect.
#pragma once

#include "kernel/math.hpp"
#include "records/object.hpp"

namespace celltrace::kernel {

/// Points on the surface of one object, whose surface coordinates are asked for.
template <class S> struct SurfacePoint {
  const ObjectRecord& object;
  const ExtraRecord* extra;           ///< null: it has none, or the shape does not read it
  const V3<S>& point;                 ///< in the world
  const typename S::F &hit_u, &hit_v; ///< of the hits: a triangle's barycentric coordinates
};

struct ShapeTraits {
  static constexpr bool kIsLocal = false;  ///< its geometry is a map to a space of its own (local_shape.hpp)
  static constexpr bool kIsBounded = true; ///< it can be in the BVH by itself
  static constexpr bool kIsHeavy =
      false; ///< the code of its intersect() is large: it has a code module apart
  static constexpr bool kHasHeavyPoints = false; ///< that of its inside() and of its normals is: likewise
  static constexpr bool kHasFaces = false;       ///< flat ones: then it has off_face()
  /// It finds a ray's first pair of crossings, and the next one beyond rays.after() when it is asked again,
  /// as rays.asked->after says (crossing_sequence.hpp). Such shapes are heavy.
  static constexpr bool kGoesOn = false;
  /// Crossings of its plane count where its edges say (polygons_module.hpp).
  static constexpr bool kHasEdges = false;
  /// It has coordinates(surface_point, u, v). If not, they are x and y of the point.
  static constexpr bool kHasCoordinates = false;
  static constexpr bool kReadsExtraForCoordinates = false;
  /// It has may_hit(), crossed() and surely_crossed(), which tell what is in shadow where solving for its
  /// crossings would take longer. Where memory is direct they are asked (direct/shape_shadows.hpp). Such
  /// shapes are local, and have no parameter but the first.
  static constexpr bool kTellsShadows = false;
};

} // namespace celltrace::kernel

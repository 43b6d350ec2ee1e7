// Traits of shapes: the hooks that a shape may have, and their defaults. Kernel dialect.
#pragma once

#include "kernel/math.hpp"
#include "records/object.hpp"

namespace celltrace::kernel {

/// Points on the surface of one object whose surface coordinates are wanted.
template <class S> struct SurfacePoint {
  const ObjectRecord& object;
  const ExtraRecord* extra;           ///< null: the object has none, or the shape does not read it
  const V3<S>& point;                 ///< in the world
  const typename S::F &hit_u, &hit_v; ///< for triangles: barycentric coordinates of the hits
};

struct ShapeTraits {
  static constexpr bool kIsLocal = false;  ///< the geometry is a map to a space of its own (local_shape.hpp)
  static constexpr bool kIsBounded = true; ///< the shape can be in the BVH without CSG
  static constexpr bool kIsHeavy = false;  ///< intersect() is large and has a code module of its own
  static constexpr bool kHasHeavyPoints = false; ///< inside() and normals have a module of their own
  static constexpr bool kHasFaces = false;       ///< the shape has flat faces, and off_face()
  /// True if the shape finds a ray's first pair of crossings and, when called again, the next pair beyond
  /// rays.after() (crossing_sequence.hpp). Shapes with this trait are heavy.
  static constexpr bool kIsIncremental = false;
  /// True if the shape's ExtraRecord has ShapeData.
  static constexpr bool kHasData = false;
  /// True if the shape is made of its ShapeData: it has intersect_data() and inside_data() in a code module of
  /// its own (data_shapes.hpp). Such shapes are incremental, and their crossings bring their normals along.
  static constexpr bool kIsMadeOfData = false;
  /// True if crossings of the shape's plane count only inside its edges (polygons_module.hpp).
  static constexpr bool kHasEdges = false;
  /// True if the shape has coordinates(surface_point, u, v). Otherwise its surface coordinates are x and y of
  /// the point.
  static constexpr bool kHasCoordinates = false;
  static constexpr bool kReadsExtraForCoordinates = false;
  /// True if the shape has may_hit(), crossed() and surely_crossed(), which test shadow rays faster than
  /// solving for crossings would. Only direct memory uses them (direct/shape_shadows.hpp). Shapes with this
  /// trait are local, and have only the first parameter.
  static constexpr bool kHasShadowTest = false;
};

} // namespace celltrace::kernel

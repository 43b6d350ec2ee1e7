// Shapes in a space of their own, such as boxes, cylinders and tori under any affine transformation. Their
// records hold the map from the world to that space. Kernel dialect.
//
// A shape derives from LocalPrimitive<itself> and has
//   kName, kCrossingPairs, kHasParameters             as in list.hpp
//   intersect_local(rays, parameters, crossings)      finds crossings, in the shape's space
//   inside_local(point, parameters)                   returns the lanes inside
//   gradient(point, parameters)                       returns the outward normal, of any length
//   off_face(point, gradient, path)                   returns the distance from a face times |gradient|
//   off_parallel_faces(point, path, share)            moves a point toward the middle of faces along `path`
//   local_bounds(ratio)                               returns its LocalBounds
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/aabb.hpp"
#include "kernel/primitives/crossings.hpp"
#include "kernel/primitives/shape_traits.hpp"
#include "kernel/scalar.hpp"
#include "records/object.hpp"

namespace celltrace::kernel {

/// Parameters of a shape besides its map. All lanes have one shape, or each lane has its own.
template <class S> struct LocalParameters {
  typename S::F ratio;  ///< for a cone, torus, disc, box or cylinder; see there
  typename S::F second; ///< for a superellipsoid, box or cone; see there
  typename S::M open;   ///< cylinders and cones without caps
};

/// The intervals of rays inside a convex solid, and whether crossings inside or outside of it are wanted. For
/// rays that miss the solid, `enter` is beyond `leave`.
struct ClippedRays {
  FloatLanes enter, leave;
  bool keeps_inside;
};

/// The crossings of a ray that are wanted.
struct CrossingRequest {
  /// Distance beyond which one crossing suffices: the ray's other crossings may be left out.
  float enough = kEveryCrossing;
  /// By ray: crossings farther than this or behind the origin may be left out. nullptr: no limit.
  const FloatLanes* limit = nullptr;
  /// By ray, for kIsIncremental: crossings up to this distance are known; nullptr: up to the origin.
  const FloatLanes* after = nullptr;
};
inline constexpr CrossingRequest kAllCrossings;

/// Rays in a shape's space. Directions are not normalised, so that distances are those in the world.
template <class S> struct LocalRays {
  V3<S> origin, direction;
  typename S::M starts_here; ///< rays that start on this object
  const CrossingRequest* request = &kAllCrossings;
  uint32_t first = 0; ///< lane of the packet's first ray

  /// Return request->after (0 if it is null) and request->limit (kEveryCrossing if it is null) of these rays.
  typename S::F after() const { return of_these(request->after, 0.0f); }
  typename S::F limit() const { return of_these(request->limit, kEveryCrossing); }

private:
  typename S::F of_these(const FloatLanes* of_packet, float otherwise) const {
    return of_packet == nullptr ? typename S::F(otherwise) : S::F::load(of_packet->lane + first);
  }
};

/// Bounds of a shape: along the third axis from `low` to `high`; across it a disc, or a square, that extends
/// by `radius`.
struct LocalBounds {
  float low, high, radius;
  bool square;
};

/// Transforms a point (w = 1) or a direction (w = 0) to the space of a shape.
template <class S> V3<S> to_local(const float (&map)[12], const V3<S>& v, float w) {
  using F = typename S::F;
  const float* m = map;
  return {F(m[0]) * v.x + F(m[1]) * v.y + F(m[2]) * v.z + F(m[3] * w),
          F(m[4]) * v.x + F(m[5]) * v.y + F(m[6]) * v.z + F(m[7] * w),
          F(m[8]) * v.x + F(m[9]) * v.y + F(m[10]) * v.z + F(m[11] * w)};
}

/// Returns 1 / x, which is finite for x = 0.
template <class S> typename S::F finite_inverse(const typename S::F& x) {
  using F = typename S::F;
  const F least(1e-20f);
  return F(1.0f) / S::select(S::abs(x) > least, x, S::select(x < F(0.0f), -least, least));
}

/// Returns the rays that go into a shape from a point of its surface.
template <class Shape, class S>
[[gnu::always_inline]] inline typename S::M go_inward(const LocalRays<S>& rays,
                                                      const LocalParameters<S>& parameters) {
  return dot<S>(Shape::template gradient<S>(rays.origin, parameters), rays.direction) < typename S::F(0.0f);
}

/// Removes crossings of rays that start on a convex shape: such a ray does not enter the shape again, and
/// leaves it only if the ray goes inward. The crossing at the origin does not count, wherever rounding puts
/// it.
template <class Shape, class S>
void drop_start(const LocalRays<S>& rays, const LocalParameters<S>& parameters, Crossings<S>& c) {
  if (rays.starts_here.bits() == 0) return;
  c.near_hit = c.near_hit & !rays.starts_here;
  c.far_hit = c.far_hit & !(rays.starts_here & !go_inward<Shape, S>(rays, parameters));
}

/// Returns the coordinate `at` of a ray on an axis on which its direction is `along`. If the ray is parallel
/// to the planes across the axis, the coordinate is moved toward `middle` by a share of the distance.
template <class S>
[[gnu::always_inline]] inline typename S::F
off_parallel_plane(const typename S::F& at, const typename S::F& along, float middle, float share) {
  using F = typename S::F;
  constexpr float kLeastSlope = 1e-14f;
  return S::select(S::abs(along) < F(kLeastSlope), at + (F(middle) - at) * F(share), at);
}

/// The interval of rays between the planes z = low and z = high.
template <class S> struct SlabInterval {
  typename S::F enter, leave;

  SlabInterval(const typename S::F& enters, const typename S::F& leaves) : enter(enters), leave(leaves) {}
  SlabInterval(const typename S::F& origin, const typename S::F& direction, const typename S::F& low,
               const typename S::F& high) {
    const typename S::F inverse = finite_inverse<S>(direction);
    const typename S::F a = (low - origin) * inverse, b = (high - origin) * inverse;
    enter = S::min(a, b);
    leave = S::max(a, b);
  }
};

/// The inverse of a map without its translation, and the position of the space's origin in the world.
struct LocalToWorld {
  float row[3][3], origin[3];

  explicit LocalToWorld(const float (&g)[12])
      : row{{g[5] * g[10] - g[6] * g[9], g[2] * g[9] - g[1] * g[10], g[1] * g[6] - g[2] * g[5]},
            {g[6] * g[8] - g[4] * g[10], g[0] * g[10] - g[2] * g[8], g[2] * g[4] - g[0] * g[6]},
            {g[4] * g[9] - g[5] * g[8], g[1] * g[8] - g[0] * g[9], g[0] * g[5] - g[1] * g[4]}} {
    const float inverse = 1.0f / (g[0] * row[0][0] + g[1] * row[1][0] + g[2] * row[2][0]);
    for (int i = 0; i < 3; ++i) {
      origin[i] = 0.0f;
      for (int j = 0; j < 3; ++j) {
        row[i][j] *= inverse;
        origin[i] -= row[i][j] * g[j * 4 + 3];
      }
    }
  }
};

/// Returns the bounds of a shape in the world.
CELLTRACE_ONE_COPY inline Aabb bounds_in_world(const float (&map)[12], const LocalBounds& local) {
  const LocalToWorld world(map);
  Aabb box;
  for (int i = 0; i < 3; ++i) {
    const float* m = world.row[i];
    const float across =
        local.square ? magnitude(m[0]) + magnitude(m[1]) : square_root(m[0] * m[0] + m[1] * m[1]);
    const float half = (across * local.radius + magnitude(m[2]) * 0.5f * (local.high - local.low)) * 1.00001f;
    const float centre = world.origin[i] + m[2] * 0.5f * (local.low + local.high);
    box.min[i] = centre - half;
    box.max[i] = centre + half;
  }
  return box;
}

/// Returns the bounds of the unit sphere of a space in the world.
CELLTRACE_ONE_COPY inline Aabb round_bounds_in_world(const float (&map)[12]) {
  const LocalToWorld world(map);
  Aabb box;
  for (int i = 0; i < 3; ++i) {
    const float* m = world.row[i];
    const float half = square_root(m[0] * m[0] + m[1] * m[1] + m[2] * m[2]) * 1.00001f;
    box.min[i] = world.origin[i] - half;
    box.max[i] = world.origin[i] + half;
  }
  return box;
}

/// Returns true if a shape may overlap a box: conservatively tests the box, mapped to the space of the shape,
/// against a ball around the shape.
inline bool overlaps_in_world(const float (&g)[12], const LocalBounds& local, const Aabb& box) {
  const float half_height = 0.5f * (local.high - local.low);
  const float radius =
      square_root(local.radius * local.radius * (local.square ? 2.0f : 1.0f) + half_height * half_height);
  float distance = 0.0f;
  float reach = 0.0f;
  for (int row = 0; row < 3; ++row) {
    float centre = g[row * 4 + 3] - (row == 2 ? 0.5f * (local.low + local.high) : 0.0f);
    float extent = 0.0f;
    for (int i = 0; i < 3; ++i) {
      centre += g[row * 4 + i] * 0.5f * (box.min[i] + box.max[i]);
      extent += magnitude(g[row * 4 + i]) * 0.5f * (box.max[i] - box.min[i]);
    }
    distance += centre * centre;
    reach += extent * extent;
  }
  return square_root(distance) <= radius + square_root(reach) * 1.0001f;
}

template <class S>
[[gnu::always_inline]] inline LocalParameters<S> local_parameters(const ObjectRecord& object,
                                                                  const ExtraRecord& extra) {
  const bool open = (object.kind_and_flags & object_flag::open) != 0;
  return {typename S::F(extra.value[0]), typename S::F(extra.value[1]), open ? S::M::all() : S::M::none()};
}

/// Transforms rays of a packet to the space of an object whose offset is `self`. Takes as many lanes as S
/// has, from lane `first` on.
template <class S>
LocalRays<S> local_rays(const RayPacket& rays, const ObjectRecord& object, uint32_t self, uint32_t first = 0,
                        const CrossingRequest& request = kAllCrossings) {
  return {to_local<S>(object.geometry, rays.origin.template load_from<S>(first), 1.0f),
          to_local<S>(object.geometry, rays.direction.template load_from<S>(first), 0.0f),
          lanes_that_start_on<S>(rays, self, first), &request, first};
}

/// The interface between the rest of the kernel and a shape in a space of its own.
template <class Shape> struct LocalPrimitive : ShapeTraits {
  static constexpr bool kIsLocal = true;

  template <class S>
  [[gnu::always_inline]] static V3<S> off_parallel_faces(const V3<S>& point, const V3<S>&, float) {
    return point;
  }

  template <class S>
  static void intersect(const RayPacket& rays, const ObjectRecord& object, const ExtraRecord& extra,
                        uint32_t self, Crossings<S>* crossings) {
    Shape::template intersect_local<S>(local_rays<S>(rays, object, self), local_parameters<S>(object, extra),
                                       crossings);
  }

  template <class S>
  static typename S::M inside(const V3<S>& point, const ObjectRecord& object, const ExtraRecord& extra) {
    return Shape::template inside_local<S>(to_local<S>(object.geometry, point, 1.0f),
                                           local_parameters<S>(object, extra));
  }

  static Aabb bounds(const ObjectRecord& object, const ExtraRecord& extra) {
    return bounds_in_world(object.geometry, Shape::local_bounds(extra.value[0]));
  }
  static bool overlaps(const ObjectRecord& object, const ExtraRecord& extra, const Aabb& box) {
    return overlaps_in_world(object.geometry, Shape::local_bounds(extra.value[0]), box);
  }
};

} // namespace celltrace::kernel

// Where rays hit, and the surface there. Kernel dialect.
#pragma once

#include "kernel/intersect.hpp"
#include "kernel/scalar_work.hpp"
#include "kernel/scene_access.hpp"

namespace celltrace::kernel {

/// Points, unit normals flipped toward the viewer, and the records' words of sixteen hits.
template <class S> struct HitPoints {
  V3<S> point, normal;
  WordLanes material; ///< offset of a MaterialRecord, or of a BlendRecord in lanes of `blended`
  WordLanes interior;
  uint32_t blended = 0;
};

namespace detail {

/// The objects that rays of a packet hit, side by side.
template <class S> struct ObjectLanes {
  using F = typename S::F;

  F geometry[12]; ///< as ObjectRecord's
  F normals[9];   ///< as NormalsRecord's, of smooth triangles
  uint32_t of_kind[3]; ///< lanes by ObjectKind; each is of one
  uint32_t smooth;
};

template <class S> V3<S> at(const typename S::F* v) {
  return {v[0], v[1], v[2]};
}

template <class S> void surface_of_spheres(const ObjectLanes<S>& o, const V3<S>& along_ray, V3<S>& point,
                                           V3<S>& normal) {
  const V3<S> centre = at<S>(o.geometry);
  normal = normalise<S>(along_ray - centre);
  point = centre + normal * o.geometry[3];
}

template <class S> void surface_of_ellipsoids(const ObjectLanes<S>& o, const V3<S>& along_ray,
                                              V3<S>& point, V3<S>& normal) {
  const auto* const m = o.geometry;
  const auto row = [&](int r) {
    return m[4 * r] * along_ray.x + m[4 * r + 1] * along_ray.y + m[4 * r + 2] * along_ray.z + m[4 * r + 3];
  };
  // The gradient of |M p + t|^2: the transposed map applied to the point on the unit sphere.
  const V3<S> unit = normalise<S>({row(0), row(1), row(2)});
  const auto column = [&](int c) { return m[c] * unit.x + m[4 + c] * unit.y + m[8 + c] * unit.z; };
  normal = normalise<S>({column(0), column(1), column(2)});
  point = along_ray;
}

template <class S> void surface_of_triangles(const ObjectLanes<S>& o, const HitPacket& hits, V3<S>& point,
                                             V3<S>& normal) {
  using F = typename S::F;
  const F u = F::load(hits.u.lane);
  const F v = F::load(hits.v.lane);
  const V3<S> v0 = at<S>(o.geometry);
  const V3<S> edge1 = at<S>(o.geometry + 3) - v0;
  const V3<S> edge2 = at<S>(o.geometry + 6) - v0;
  point = v0 + edge1 * u + edge2 * v;
  normal = cross<S>(edge1, edge2);
  if (o.smooth != 0) {
    const F w = F(1.0f) - u - v;
    const V3<S> between = at<S>(o.normals) * w + at<S>(o.normals + 3) * u + at<S>(o.normals + 6) * v;
    normal = select<S>(S::M::from_bits(o.smooth), between, normal);
  }
  normal = normalise<S>(normal);
}

template <class S>
void surface_of(const ObjectLanes<S>& o, const V3<S>& along_ray, const HitPacket& hits, V3<S>& point,
                V3<S>& normal) {
  const uint32_t spheres = o.of_kind[0], ellipsoids = o.of_kind[1], triangles = o.of_kind[2];
  if (spheres != 0) surface_of_spheres<S>(o, along_ray, point, normal);
  const auto add = [&](uint32_t lanes, const V3<S>& p, const V3<S>& n) {
    const auto mask = S::M::from_bits(lanes);
    point = select<S>(mask, p, point);
    normal = select<S>(mask, n, normal);
  };
  V3<S> p, n;
  if (ellipsoids != 0) {
    surface_of_ellipsoids<S>(o, along_ray, p, n);
    add(ellipsoids, p, n);
  }
  if (triangles != 0) {
    surface_of_triangles<S>(o, hits, p, n);
    add(triangles, p, n);
  }
}

} // namespace detail

/// Those of `lanes` that hit something.
inline uint32_t hit_lanes(const HitPacket& hits, uint32_t lanes) {
  uint32_t hit = 0;
  for_each_lane(lanes, [&](uint32_t lane) {
    hit |= static_cast<uint32_t>(hits.object.lane[lane] != kNoOffset) << lane;
  });
  return hit;
}

/// Of the hits of `lanes`, all of which hit something. Points are computed from the object, not along the ray:
/// they lie on the surface to its own precision, however far away the ray began.
template <class Spu>
void find_hit_points(SceneAccess<Spu>& scene, const RayPacket& rays, const HitPacket& hits, uint32_t lanes,
                     HitPoints<typename Spu::simd>& points) {
  using S = typename Spu::simd;
  using F = typename S::F;
  using I = typename S::I;
  using M = typename S::M;
  detail::ObjectLanes<S> objects = {};
  I material = I::splat(0), interior = I::splat(0);
  bool first = true;
  points.blended = 0;
  for_each_value(hits.object, lanes, [&](uint32_t offset, uint32_t same) {
    scene.spu().compute(scalar_work::kHitObject);
    const ObjectRecord& object = *scene.object(offset);
    const uint32_t flags = object.kind_and_flags;
    const uint32_t normals = object.normals;
    // Lanes without a hit hold what the first has.
    const uint32_t of_object = first ? 0xFFFF : same;
    first = false;
    const M mask = M::from_bits(of_object);
    const auto put = [&](const float* values, uint32_t count, F* into) {
      for (uint32_t i = 0; i < count; ++i)
        into[i] = S::select(mask, F(values[i]), into[i]);
    };
    put(object.geometry, 12, objects.geometry);
    material = S::select(mask, I::splat(static_cast<int32_t>(object.material)), material);
    interior = S::select(mask, I::splat(static_cast<int32_t>(object.interior)), interior);
    for (uint32_t& of_kind : objects.of_kind)
      of_kind &= ~of_object;
    objects.of_kind[flags & object_flag::kind_mask] |= of_object;
    objects.smooth &= ~of_object;
    if ((flags & object_flag::blended) != 0) points.blended |= same;
    if ((flags & object_flag::smooth) != 0) {
      objects.smooth |= of_object;
      put(scene.normals(normals)->normal, 9, objects.normals);
    }
  });
  material.store(reinterpret_cast<int32_t*>(points.material.lane));
  interior.store(reinterpret_cast<int32_t*>(points.interior.lane));

  const V3<S> direction = rays.direction.template load<S>();
  detail::surface_of(objects, rays.origin.template load<S>() + direction * F::load(hits.distance.lane), hits,
                     points.point, points.normal);
  const auto away = dot<S>(direction, points.normal) > F(0.0f);
  const V3<S> opposite = {-points.normal.x, -points.normal.y, -points.normal.z};
  points.normal = select<S>(away, opposite, points.normal);
}

} // namespace celltrace::kernel

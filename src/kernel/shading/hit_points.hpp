// Where rays hit, and the surface there. Kernel dialect.
#pragma once

#include "kernel/primitives/intersect.hpp"
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
  V3<S> geometry[4];   ///< as ObjectRecord's
  V3<S> normals[3];    ///< as NormalsRecord's, of smooth triangles
  uint32_t of_kind[3]; ///< lanes by ObjectKind; each is of one
  uint32_t smooth;
};

template <class S>
void surface_of_spheres(const ObjectLanes<S>& o, const V3<S>& along_ray, V3<S>& point, V3<S>& normal) {
  const V3<S>& centre = o.geometry[0];
  normal = normalise<S>(along_ray - centre);
  point = centre + normal * o.geometry[1].x;
}

template <class S>
void surface_of_ellipsoids(const ObjectLanes<S>& o, const V3<S>& along_ray, V3<S>& point, V3<S>& normal) {
  using F = typename S::F;
  // Three rows of four.
  const V3<S>* const g = o.geometry;
  const F m[3][4] = {
      {g[0].x, g[0].y, g[0].z, g[1].x}, {g[1].y, g[1].z, g[2].x, g[2].y}, {g[2].z, g[3].x, g[3].y, g[3].z}};
  const auto row = [&](int r) {
    return m[r][0] * along_ray.x + m[r][1] * along_ray.y + m[r][2] * along_ray.z + m[r][3];
  };
  // The gradient of |M p + t|^2: the transposed map applied to the point on the unit sphere.
  const V3<S> unit = normalise<S>({row(0), row(1), row(2)});
  const auto column = [&](int c) { return m[0][c] * unit.x + m[1][c] * unit.y + m[2][c] * unit.z; };
  normal = normalise<S>({column(0), column(1), column(2)});
  point = along_ray;
}

template <class S>
void surface_of_triangles(const ObjectLanes<S>& o, const HitPacket& hits, V3<S>& point, V3<S>& normal) {
  using F = typename S::F;
  const F u = F::load(hits.u.lane);
  const F v = F::load(hits.v.lane);
  const V3<S>& v0 = o.geometry[0];
  const V3<S> edge1 = o.geometry[1] - v0;
  const V3<S> edge2 = o.geometry[2] - v0;
  point = v0 + edge1 * u + edge2 * v;
  normal = cross<S>(edge1, edge2);
  if (o.smooth != 0) {
    const F w = F(1.0f) - u - v;
    const V3<S> between = o.normals[0] * w + o.normals[1] * u + o.normals[2] * v;
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
template <class S> uint32_t hit_lanes(const HitPacket& hits, uint32_t lanes) {
  using I = typename S::I;
  const I objects = I::load(reinterpret_cast<const int32_t*>(hits.object.lane));
  return lanes & ~(objects == I::splat(static_cast<int32_t>(kNoOffset))).bits();
}

/// Of the hits of `lanes`, all of which hit something. Points are computed from the object, not along the
/// ray: they lie on the surface to its own precision, however far away the ray began.
template <class Spu>
void find_hit_points(SceneAccess<Spu>& scene, const RayPacket& rays, const HitPacket& hits, uint32_t lanes,
                     HitPoints<typename Spu::simd>& points) {
  using S = typename Spu::simd;
  using F = typename S::F;
  using I = typename S::I;
  using M = typename S::M;
  detail::ObjectLanes<S> objects;
  for (uint32_t& of_kind : objects.of_kind)
    of_kind = 0;
  objects.smooth = 0;
  I material = I::splat(0), interior = I::splat(0);
  bool is_first = true;
  points.blended = 0;
  for_each_value<S>(hits.object, lanes, [&](uint32_t offset, uint32_t same) {
    scene.spu().compute(scalar_work::kHitObject);
    const ObjectRecord& object = *scene.object(offset);
    const uint32_t flags = object.kind_and_flags;
    const uint32_t normals = object.normals;
    // Lanes without a hit hold what the first has.
    const bool first = is_first;
    const uint32_t of_object = first ? 0xFFFF : same;
    is_first = false;
    const M mask = M::from_bits(of_object);
    const auto put = [&](const float* values, V3<S>& into) { put_in_lanes<Spu>(first, mask, values, into); };
    const auto kind = static_cast<ObjectKind>(flags & object_flag::kind_mask);
    put(object.geometry, objects.geometry[0]);
    put(object.geometry + 3, objects.geometry[1]);
    if (kind != ObjectKind::sphere) put(object.geometry + 6, objects.geometry[2]);
    if (kind == ObjectKind::ellipsoid) put(object.geometry + 9, objects.geometry[3]);
    material = S::select(mask, I::splat(static_cast<int32_t>(object.material)), material);
    interior = S::select(mask, I::splat(static_cast<int32_t>(object.interior)), interior);
    for (uint32_t& of_kind : objects.of_kind)
      of_kind &= ~of_object;
    objects.of_kind[static_cast<uint32_t>(kind)] |= of_object;
    objects.smooth &= ~of_object;
    if ((flags & object_flag::blended) != 0) points.blended |= same;
    if ((flags & object_flag::smooth) != 0) {
      objects.smooth |= of_object;
      const float* const n = scene.normals(normals)->normal;
      put(n, objects.normals[0]);
      put(n + 3, objects.normals[1]);
      put(n + 6, objects.normals[2]);
    }
  });
  scene.spu().compute(scalar_work::kHitSurfaces);
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

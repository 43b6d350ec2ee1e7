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

/// The surface of one object under all lanes. Points are computed from the object, not along the ray: they
/// lie on the surface to its own precision, however far away the ray began.
template <class Spu>
void surface_of(SceneAccess<Spu>& scene, const ObjectRecord& object, const RayPacket& rays,
                const HitPacket& hits, V3<typename Spu::simd>& point, V3<typename Spu::simd>& normal) {
  using S = typename Spu::simd;
  using F = typename S::F;
  const V3<S> along_ray =
      rays.origin.template load<S>() + rays.direction.template load<S>() * F::load(hits.distance.lane);
  switch (static_cast<ObjectKind>(object.kind_and_flags & object_flag::kind_mask)) {
  case ObjectKind::sphere: {
    const V3<S> centre = splat3<S>(object.geometry);
    normal = normalise<S>(along_ray - centre);
    point = centre + normal * F(object.geometry[3]);
    return;
  }
  case ObjectKind::ellipsoid: {
    // The gradient of |M p + t|^2: the transposed map applied to the point on the unit sphere.
    const V3<S> unit = normalise<S>(to_unit_sphere<S>(object, along_ray, 1.0f));
    const float* m = object.geometry;
    point = along_ray;
    normal = normalise<S>({F(m[0]) * unit.x + F(m[4]) * unit.y + F(m[8]) * unit.z,
                           F(m[1]) * unit.x + F(m[5]) * unit.y + F(m[9]) * unit.z,
                           F(m[2]) * unit.x + F(m[6]) * unit.y + F(m[10]) * unit.z});
    return;
  }
  default: {
    const F u = F::load(hits.u.lane);
    const F v = F::load(hits.v.lane);
    const V3<S> v0 = splat3<S>(object.geometry);
    const V3<S> edge1 = splat3<S>(object.geometry + 3) - v0;
    const V3<S> edge2 = splat3<S>(object.geometry + 6) - v0;
    point = v0 + edge1 * u + edge2 * v;
    if ((object.kind_and_flags & object_flag::smooth) == 0) {
      normal = normalise<S>(cross<S>(edge1, edge2));
      return;
    }
    const float* n = scene.normals(object.normals)->normal;
    const F w = F(1.0f) - u - v;
    normal = normalise<S>(splat3<S>(n) * w + splat3<S>(n + 3) * u + splat3<S>(n + 6) * v);
    return;
  }
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

/// Of the hits of `lanes`, all of which hit something.
template <class Spu>
void find_hit_points(SceneAccess<Spu>& scene, const RayPacket& rays, const HitPacket& hits, uint32_t lanes,
                     HitPoints<typename Spu::simd>& points) {
  using S = typename Spu::simd;
  using F = typename S::F;
  using I = typename S::I;
  points.blended = 0;
  bool first = true;
  for_each_value(hits.object, lanes, [&](uint32_t offset, uint32_t same) {
    scene.spu().compute(scalar_work::kHitObject);
    // A copy: reading the normals may replace the object's line.
    const ObjectRecord object = *scene.object(offset);
    V3<S> point, normal;
    detail::surface_of(scene, object, rays, hits, point, normal);
    const auto take = S::M::from_bits(first ? 0xFFFF : same);
    first = false;
    const auto put = [&](uint32_t value, WordLanes& words) {
      auto* const at = reinterpret_cast<int32_t*>(words.lane);
      S::select(take, I::splat(static_cast<int32_t>(value)), I::load(at)).store(at);
    };
    points.point = select<S>(take, point, points.point);
    points.normal = select<S>(take, normal, points.normal);
    put(object.material, points.material);
    put(object.interior, points.interior);
    if ((object.kind_and_flags & object_flag::blended) != 0) points.blended |= same;
  });
  const V3<S> direction = rays.direction.template load<S>();
  const auto away = dot<S>(direction, points.normal) > F(0.0f);
  const V3<S> opposite = {-points.normal.x, -points.normal.y, -points.normal.z};
  points.normal = select<S>(away, opposite, points.normal);
}

} // namespace celltrace::kernel

// Hit points of rays, and the surface there. Kernel dialect.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/lights/surfaces.hpp"
#include "kernel/primitives/instances_module.hpp"
#include "kernel/primitives/shapes_module.hpp"
#include "kernel/scalar_work.hpp"
#include "kernel/scene_access.hpp"

namespace celltrace::kernel {

/// Sixteen hits: points, unit normals flipped toward the viewer, and words of the records.
template <class S> struct HitPoints {
  V3<S> point, normal;
  WordLanes material; ///< offset of a MaterialRecord, or of a BlendRecord in lanes of `blended`
  WordLanes interior;
  uint32_t blended = 0;
  uint32_t spawning = 0;  ///< lanes from which secondary rays may go on (material_word::spawns)
  uint32_t textured = 0;  ///< lanes with materials that are more than the constants of their records
  uint32_t disturbed = 0; ///< lanes with materials that disturb normals; also in `textured`
  uint32_t lit_behind = 0, lit_through = 0; ///< material_word::lit_behind, object_flag::lit_through

  uint32_t plain(uint32_t lanes) const { return lanes & ~(blended | textured); }
  /// Returns true if each of `lanes` has one material, and no secondary rays go on from there.
  bool ends(uint32_t lanes) const { return (lanes & (spawning | blended)) == 0; }

  /// Returns the surfaces as seen by rays along `direction` that hit `objects`.
  Surfaces<S> surfaces(const V3<S>& direction, const WordLanes& objects) const {
    return {point, normal, direction, &objects, lit_behind, lit_through};
  }
};

namespace detail {

constexpr uint32_t kOfSides = object_flag::two_sided | object_flag::inverse | object_flag::lit_through;

template <class S>
void surface_of_spheres(const ObjectLanes<S>& o, const V3<S>& along_ray, V3<S>& point, V3<S>& normal) {
  const V3<S>& centre = o.geometry[0];
  normal = normalise<S>(along_ray - centre);
  point = centre + normal * o.geometry[1].x;
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

template <class Spu>
[[gnu::always_inline]] inline void surface_of(Spu& spu, const ObjectLanes<typename Spu::simd>& o,
                                              const V3<typename Spu::simd>& path,
                                              const V3<typename Spu::simd>& along_ray, const HitPacket& hits,
                                              V3<typename Spu::simd>& point, V3<typename Spu::simd>& normal) {
  using S = typename Spu::simd;
  const uint32_t spheres = o.of_kind[kPrimitiveKind<SpherePrimitive>],
                 triangles = o.of_kind[kPrimitiveKind<TrianglePrimitive>],
                 planes = o.of_kind[kPrimitiveKind<PlanePrimitive>];
  uint32_t others = 0, heavy = 0;
  for (uint32_t kind = 0; kind < kPrimitives; ++kind)
    if (kind > kPrimitiveKind<PlanePrimitive>)
      (Primitives::has_heavy_points(kind) ? heavy : others) |= o.of_kind[kind];
  if (spheres != 0) surface_of_spheres<S>(o, along_ray, point, normal);
  const auto add = [&](uint32_t lanes, const V3<S>& p, const V3<S>& n) {
    const auto mask = S::M::from_bits(lanes);
    point = select<S>(mask, p, point);
    normal = select<S>(mask, n, normal);
  };
  V3<S> p, n;
  if ((others | heavy) != 0) {
    if (heavy != 0) spu.enter_module(modules::kHeavyPoints);
    p = along_ray;
    find_normals(spu, o, path, others, heavy, p, n);
    add(others | heavy, p, n);
  }
  if (planes != 0) {
    // The point is moved onto the plane to its own precision, as a pattern may have a step there.
    const V3<S> n_of_plane = {o.geometry[2].z, o.geometry[3].x, o.geometry[3].y};
    const typename S::F off = dot<S>(n_of_plane, along_ray) + o.geometry[3].z;
    add(planes, along_ray - n_of_plane * off, n_of_plane);
  }
  if (triangles != 0) {
    surface_of_triangles<S>(o, hits, p, n);
    add(triangles, p, n);
  }
}

/// Replaces the materials of surfaces that are seen from inside. If a surface has several materials, the
/// first one determines the material inside.
template <class Spu>
CELLTRACE_ONE_COPY void take_inside_materials(SceneAccess<Spu>& scene, uint32_t lanes,
                                              HitPoints<typename Spu::simd>& points) {
  using S = typename Spu::simd;
  scene.spu().run_in_module(modules::kFinishes);
  for_each_value<S>(points.material, lanes, [&](uint32_t outside, uint32_t same) {
    if ((same & points.blended) != 0) outside = scene.blend(outside)->material[0];
    const uint32_t inside = scene.material(outside)->inside;
    for_each_lane(same, [&](uint32_t lane) { points.material.lane[lane] = inside; });
  });
  points.blended &= ~lanes;
}

} // namespace detail

/// Returns the lanes of `lanes` that hit something.
template <class S> uint32_t hit_lanes(const HitPacket& hits, uint32_t lanes) {
  using I = typename S::I;
  const I objects = load_words<S>(hits.object);
  return lanes & ~(objects == I::splat(static_cast<int32_t>(kNoOffset))).bits();
}

/// Prefetches records with the normals that find_hit_points() will read for the hits of `lanes`.
template <class Spu> void hint_extras(SceneAccess<Spu>& scene, const HitPacket& hits, uint32_t lanes) {
  for_each_lane(lanes, [&](uint32_t lane) {
    if (is_instanced(hits.object.lane[lane])) return;
    const uint32_t extra = scene.object(hits.object.lane[lane])->extra;
    if (extra != kNoOffset) scene.cache().hint(extra);
  });
}

namespace detail {

/// The objects that rays hit, and further words of their records.
template <class S> struct HitObjects {
  using I = typename S::I;
  ObjectLanes<S> objects;
  I material = I::splat(0), interior = I::splat(0);
  uint32_t open = 0, two_sided = 0, inverse = 0; ///< lanes with the object_flag of the same name
};

/// Puts the objects that rays hit in their lanes, object by object. Lanes without a hit get the first object.
template <class Spu>
[[gnu::always_inline]] inline void gather_objects(SceneAccess<Spu>& scene, const WordLanes& offsets,
                                                  uint32_t lanes, HitObjects<typename Spu::simd>& o,
                                                  HitPoints<typename Spu::simd>& points) {
  using S = typename Spu::simd;
  using F = typename S::F;
  using I = typename S::I;
  using M = typename S::M;
  ObjectLanes<S>& objects = o.objects;
  for (uint32_t& of_kind : objects.of_kind)
    of_kind = 0;
  objects.smooth = 0;
  objects.parameters.ratio = objects.parameters.second = F(0.0f);
  uint32_t first_flags = 0, seen = 0;
  InstancedTriangle room;
  for_each_value<S>(
      offsets, lanes, [&](uint32_t offset, uint32_t same) __attribute__((always_inline)) {
        scene.spu().compute(scalar_work::kHitObject);
        const bool instanced = is_instanced(offset);
        if (instanced) {
          scene.spu().enter_module(modules::kInstances);
          module_instances::load(scene, offset, room);
        }
        const ObjectRecord& object = instanced ? room.object : *scene.object_apart(offset);
        const uint32_t flags = object.kind_and_flags;
        const uint32_t extra = object.extra;
        const bool first = seen == 0;
        seen |= same;
        if (first) first_flags = flags;
        const M mask = M::from_bits(first ? 0xFFFF : same);
        const auto put = [&](const float* values, V3<S>& into) __attribute__((always_inline)) {
          put_in_lanes<Spu>(first, mask, values, into);
        };
        const uint32_t kind = flags & object_flag::kind_mask;
        const bool is_local = kernel::is_local(kind);
        put(object.geometry, objects.geometry[0]);
        put(object.geometry + 3, objects.geometry[1]);
        if (kind != static_cast<uint32_t>(ObjectKind::sphere)) put(object.geometry + 6, objects.geometry[2]);
        if (is_local) put(object.geometry + 9, objects.geometry[3]);
        const uint32_t of_material = object.material & material_word::flags_mask;
        o.material = S::select(mask, I::splat(static_cast<int32_t>(material_word::offset(object.material))),
                               o.material);
        o.interior = S::select(mask, I::splat(static_cast<int32_t>(object.interior)), o.interior);
        objects.of_kind[kind] |= same;
        if ((flags & object_flag::blended) != 0) points.blended |= same;
        if ((of_material & material_word::spawns) != 0) points.spawning |= same;
        if ((of_material & material_word::textured) != 0) points.textured |= same;
        if ((of_material & material_word::disturbed) != 0) points.disturbed |= same;
        if ((of_material & material_word::lit_behind) != 0) points.lit_behind |= same;
        if ((flags & object_flag::smooth) != 0) {
          objects.smooth |= same;
          const float* const n = (instanced ? &room.extra : scene.extra(extra))->value;
          put(n, objects.normals[0]);
          put(n + 3, objects.normals[1]);
          put(n + 6, objects.normals[2]);
        } else if (is_local && extra != kNoOffset) {
          const ExtraRecord& values = *scene.extra(extra);
          const F ratio(values.value[0]), second(values.value[1]);
          LocalParameters<S>& p = objects.parameters;
          p.ratio = first ? ratio : S::select(mask, ratio, p.ratio);
          p.second = first ? second : S::select(mask, second, p.second);
        }
        if ((flags & kOfSides) != 0) {
          if ((flags & object_flag::two_sided) != 0) o.two_sided |= same;
          if ((flags & object_flag::inverse) != 0) o.inverse |= same;
          if ((flags & object_flag::lit_through) != 0) {
            points.lit_through |= same;
            points.lit_behind |= same;
          }
        }
        if ((flags & object_flag::open) != 0) o.open |= same;
      });
  const uint32_t rest = 0xFFFF & ~seen;
  objects.of_kind[first_flags & object_flag::kind_mask] |= rest;
  if ((first_flags & object_flag::smooth) != 0) objects.smooth |= rest;
  if ((first_flags & object_flag::open) != 0) o.open |= rest;
}

} // namespace detail

/// Finds the points of `lanes`, which must all have a hit. Points are computed from the object, not along the
/// ray: they lie on the surface to its own precision, however far away the ray began.
template <class Spu>
CELLTRACE_ONE_COPY void find_hit_points(SceneAccess<Spu>& scene, const RayPacket& rays, const HitPacket& hits,
                                        uint32_t lanes, HitPoints<typename Spu::simd>& points) {
  using S = typename Spu::simd;
  using F = typename S::F;
  using M = typename S::M;
  scene.spu().enter_module(modules::kHits);
  points.blended = points.spawning = points.textured = points.disturbed = 0;
  points.lit_behind = points.lit_through = 0;
  detail::HitObjects<S> o;
  detail::gather_objects(scene, hits.object, lanes, o, points);
  scene.spu().compute(scalar_work::kHitSurfaces);
  store_words<S>(points.material, o.material);
  store_words<S>(points.interior, o.interior);
  o.objects.parameters.open = M::from_bits(o.open);
  uint32_t of_data = 0; // crossings with these shapes bring their normals along
  for (uint32_t kind = 0; kind < kPrimitives; ++kind)
    if (Primitives::is_made_of_data(kind)) of_data |= o.objects.of_kind[kind];
  if (of_data != 0) {
    LocalParameters<S>& p = o.objects.parameters;
    p.ratio = S::select(M::from_bits(of_data), F::load(hits.u.lane), p.ratio);
    p.second = S::select(M::from_bits(of_data), F::load(hits.v.lane), p.second);
  }

  const V3<S> direction = rays.direction.template load<S>();
  const V3<S> path = direction * F::load(hits.distance.lane);
  const V3<S> along_ray = rays.origin.template load<S>() + path;
  detail::surface_of(scene.spu(), o.objects, path, along_ray, hits, points.point, points.normal);
  const auto away = dot<S>(direction, points.normal) > F(0.0f);
  if (const uint32_t seen_inside = o.two_sided & (away.bits() ^ o.inverse); seen_inside != 0) {
    scene.spu().enter_module(modules::kFinishes);
    detail::take_inside_materials(scene, seen_inside, points);
  }
  const V3<S> opposite = {-points.normal.x, -points.normal.y, -points.normal.z};
  points.normal = select<S>(away, opposite, points.normal);
}

} // namespace celltrace::kernel

// The code modules of shapes, and the functions by which the rest of the kernel calls them. Kernel dialect.
//
// Spheres and triangles that are not part of a CSG do not come here: their code is resident.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/modules.hpp"
#include "kernel/primitives/list.hpp"
#include "records/csg.hpp"

namespace celltrace::kernel {

/// The objects that rays of a packet hit, one in each lane.
template <class S> struct ObjectLanes {
  V3<S> geometry[4];             ///< as in ObjectRecord
  V3<S> normals[3];              ///< values of the ExtraRecords of smooth triangles
  LocalParameters<S> parameters; ///< for shapes in a space of their own
  uint32_t of_kind[kPrimitives]; ///< index: kind; lanes with objects of the kind
  uint32_t smooth;
};

template <class Spu>
[[gnu::always_inline]] inline decltype(auto) part_of(const ObjectLanes<typename Spu::simd>& o,
                                                     uint32_t first) {
  return whole_or<Spu>(
      o, [&]() __attribute__((always_inline)) {
        ObjectLanes<typename Spu::rare_simd> part;
        for (uint32_t i = 0; i < 4; ++i)
          part.geometry[i] = part_of<Spu>(o.geometry[i], first);
        for (uint32_t i = 0; i < 3; ++i)
          part.normals[i] = part_of<Spu>(o.normals[i], first);
        part.parameters.ratio = part_of<Spu>(o.parameters.ratio, first);
        part.parameters.second = part_of<Spu>(o.parameters.second, first);
        part.parameters.open = Spu::rare_simd::M::from_bits(part_of<Spu>(o.parameters.open.bits(), first));
        for (uint32_t kind = 0; kind < kPrimitives; ++kind)
          part.of_kind[kind] = part_of<Spu>(o.of_kind[kind], first);
        part.smooth = part_of<Spu>(o.smooth, first);
        return part;
      });
}

/// Returns true if a kind's geometry is a map to a space of its own.
constexpr bool is_local(uint32_t kind) {
  return kind != kPrimitiveKind<SpherePrimitive> && kind != kPrimitiveKind<TrianglePrimitive>;
}

/// Returns the unit normals of shapes in a space of their own, with heavy points if `kOfHeavy`, else without,
/// at points of their surfaces: the gradient there is transformed by the transposed map. If `kMoves`, `moved`
/// receives the points, moved onto flat faces; `path` is the path of each ray to its point.
template <class S, bool kOfHeavy, bool kMoves>
[[gnu::always_inline]] inline V3<S> normal_in_own_space(const ObjectLanes<S>& o, const V3<S>& point,
                                                        [[maybe_unused]] const V3<S>& path,
                                                        [[maybe_unused]] V3<S>* moved) {
  // The map is three rows of four.
  const V3<S>* const g = o.geometry;
  const V3<S> rows[3] = {{g[0].x, g[0].y, g[0].z}, {g[1].y, g[1].z, g[2].x}, {g[2].z, g[3].x, g[3].y}};
  const V3<S> local = {dot<S>(rows[0], point) + g[1].x, dot<S>(rows[1], point) + g[2].y,
                       dot<S>(rows[2], point) + g[3].z};
  V3<S> gradient = local;
  typename S::F off(0.0f);
  [[maybe_unused]] uint32_t of_data = 0; // lanes whose normals came along
  uint32_t kind = 0;
  Primitives::for_each([&](auto shape) {
    using Shape = decltype(shape);
    if constexpr (Shape::kIsMadeOfData) of_data |= o.of_kind[kind];
    if constexpr (Shape::kIsLocal && !Shape::kIsMadeOfData && Shape::kHasHeavyPoints == kOfHeavy)
      if (o.of_kind[kind] != 0) {
        const auto mask = S::M::from_bits(o.of_kind[kind]);
        V3<S> of_kind;
        if constexpr (kMoves && Shape::kHasFaces) {
          // A ray that is parallel to a face has not hit that face.
          const V3<S> local_path = {dot<S>(rows[0], path), dot<S>(rows[1], path), dot<S>(rows[2], path)};
          const V3<S> off_others = Shape::template off_parallel_faces<S>(local, local_path, 1.0f);
          of_kind = Shape::template gradient<S>(off_others, o.parameters);
          off = S::select(mask, Shape::template off_face<S>(local, of_kind, local_path), off);
        } else {
          of_kind = Shape::template gradient<S>(local, o.parameters);
        }
        gradient = select<S>(mask, of_kind, gradient);
      }
    ++kind;
  });
  if constexpr (kOfHeavy)
    if (of_data != 0)
      gradient = select<S>(S::M::from_bits(of_data),
                           FoldedDirection<S>{o.parameters.ratio, o.parameters.second}.unfolded(), gradient);
  const V3<S> outward = rows[0] * gradient.x + rows[1] * gradient.y + rows[2] * gradient.z;
  if constexpr (kMoves)
    *moved = point - outward * (off / S::max(dot<S>(outward, outward), typename S::F(1e-30f)));
  return normalise<S>(outward);
}

/// Finds the next crossing of each ray with a shape that is made of data.
template <class Spu>
CELLTRACE_ONE_COPY void intersect_made_of_data(SceneAccess<Spu>& scene, const RayPacket& rays,
                                               const ObjectRecord& object, const ExtraRecord& extra,
                                               uint32_t self, const CrossingRequest& request,
                                               Crossings<typename Spu::simd>& crossings) {
  Primitives::dispatch(object.kind_and_flags & object_flag::kind_mask, [&](auto shape) {
    using Shape = decltype(shape);
    if constexpr (Shape::kIsMadeOfData) {
      scene.spu().enter_module(Shape::module());
      intersect_data<Shape>(scene, rays, object, extra, self, request, crossings);
    }
  });
}
/// Returns the points of `lanes` that are inside a solid that is made of data.
template <class Spu>
CELLTRACE_ONE_COPY uint32_t inside_made_of_data(SceneAccess<Spu>& scene, const SolidRecord& solid,
                                                const V3<typename Spu::simd>& points, uint32_t lanes) {
  uint32_t inside = 0;
  Primitives::dispatch(solid.object.kind_and_flags & object_flag::kind_mask, [&](auto shape) {
    using Shape = decltype(shape);
    if constexpr (Shape::kIsMadeOfData) {
      scene.spu().enter_module(Shape::module());
      inside = inside_data<Shape>(scene, solid, points, lanes);
    }
  });
  return inside;
}

namespace module_heavy {

/// Intersects heavy shapes; see module_shapes::intersect(). Heavy shapes process as many lanes at a time as
/// rare code does, and take time for each crossing.
template <class Spu>
CELLTRACE_ONE_COPY uint32_t intersect(Spu& spu, const RayPacket& rays, const ObjectRecord& object,
                                      const ExtraRecord& extra, uint32_t self, const CrossingRequest& request,
                                      Crossings<typename Spu::simd>* crossings) {
  using R = typename Spu::rare_simd;
  spu.run_in_module(modules::kHeavyShapes);
  uint32_t pairs = 0;
  const auto intersect_part = [&](const auto& local, const auto& parameters, auto* of_part) {
    Primitives::dispatch(object.kind_and_flags & object_flag::kind_mask, [&](auto shape) {
      using Shape = decltype(shape);
      pairs = Shape::kCrossingPairs;
      if constexpr (Shape::kIsHeavy) Shape::template intersect_local<R>(local, parameters, of_part);
    });
  };
  if constexpr (kOnePart<Spu>) {
    intersect_part(local_rays<R>(rays, object, self, 0, request), local_parameters<R>(object, extra),
                   crossings);
  } else {
    uint32_t near_hit[kMaxCrossingPairs] = {}, far_hit[kMaxCrossingPairs] = {};
    for (uint32_t pair = 0; pair < kMaxCrossingPairs; ++pair)
      crossings[pair].clear();
    for_each_part<Spu>([&](uint32_t first) {
      Crossings<R> part[kMaxCrossingPairs];
      intersect_part(local_rays<R>(rays, object, self, first, request), local_parameters<R>(object, extra),
                     part);
      for (uint32_t pair = 0; pair < pairs; ++pair) {
        set_part<Spu>(crossings[pair].near, first, part[pair].near);
        set_part<Spu>(crossings[pair].far, first, part[pair].far);
        near_hit[pair] |= part[pair].near_hit.bits() << first;
        far_hit[pair] |= part[pair].far_hit.bits() << first;
      }
    });
    for (uint32_t pair = 0; pair < pairs; ++pair) {
      crossings[pair].near_hit = Spu::simd::M::from_bits(near_hit[pair]);
      crossings[pair].far_hit = Spu::simd::M::from_bits(far_hit[pair]);
    }
  }
  return pairs;
}

} // namespace module_heavy

/// Returns the points inside a heavy solid, with or without heavy points.
template <class Spu, bool kHeavyPoints>
[[gnu::always_inline]] inline uint32_t inside_heavy(const SolidRecord& solid,
                                                    const V3<typename Spu::simd>& points) {
  using R = typename Spu::rare_simd;
  const LocalParameters<R> parameters = local_parameters<R>(solid.object, solid.extra);
  uint32_t lanes = 0;
  for_each_part<Spu>([&](uint32_t first) {
    const V3<R> local = to_local<R>(solid.object.geometry, part_of<Spu>(points, first), 1.0f);
    Primitives::dispatch(solid.object.kind_and_flags & object_flag::kind_mask, [&](auto shape) {
      using Shape = decltype(shape);
      if constexpr (Shape::kIsHeavy && Shape::kHasHeavyPoints == kHeavyPoints)
        lanes |= Shape::template inside_local<R>(local, parameters).bits() << first;
    });
  });
  return lanes;
}

namespace module_heavy_points {

/// Returns the points inside a solid with heavy points; see module_shapes::inside().
template <class Spu>
CELLTRACE_ONE_COPY [[gnu::flatten]] uint32_t inside(Spu& spu, const SolidRecord& solid,
                                                    const V3<typename Spu::simd>& points) {
  spu.run_in_module(modules::kHeavyPoints);
  return inside_heavy<Spu, true>(solid, points);
}

/// Returns the normals of shapes with heavy points; see local_normal().
template <class Spu>
CELLTRACE_ONE_COPY V3<typename Spu::rare_simd> normal(Spu& spu, const ObjectLanes<typename Spu::rare_simd>& o,
                                                      const V3<typename Spu::rare_simd>& point) {
  spu.run_in_module(modules::kHeavyPoints);
  return normal_in_own_space<typename Spu::rare_simd, true, false>(o, point, point, nullptr);
}

} // namespace module_heavy_points

namespace module_shapes {

/// Finds the crossings of rays in the space of a shape that is not heavy.
template <class Spu, class Shape>
[[gnu::always_inline]] inline void intersect_local(const LocalRays<typename Spu::simd>& rays,
                                                   const LocalParameters<typename Spu::simd>& parameters,
                                                   Crossings<typename Spu::simd>* crossings) {
  using S = typename Spu::simd;
  Shape::template intersect_local<S>(Strategy<Spu>::template off_faces<S, Shape>(rays), parameters,
                                     crossings);
}

/// Finds the crossings of a packet with an object; returns the number of pairs. Rays are transformed in one
/// place for all shapes that need it, as local store is short.
template <class Spu>
CELLTRACE_ONE_COPY uint32_t intersect(Spu& spu, const RayPacket& rays, const ObjectRecord& object,
                                      const ExtraRecord& extra, uint32_t self,
                                      Crossings<typename Spu::simd>* crossings) {
  using S = typename Spu::simd;
  spu.run_in_module(modules::kShapes);
  const uint32_t kind = object.kind_and_flags & object_flag::kind_mask;
  uint32_t pairs = 1;
  if (!is_local(kind)) {
    if (kind == kPrimitiveKind<SpherePrimitive>)
      SpherePrimitive::intersect<S>(rays, object, extra, self, crossings);
    else
      TrianglePrimitive::intersect<S>(rays, object, extra, self, crossings);
    return pairs;
  }
  const LocalRays<S> local = local_rays<S>(rays, object, self);
  const LocalParameters<S> parameters = local_parameters<S>(object, extra);
  Primitives::dispatch(kind, [&](auto shape) {
    using Shape = decltype(shape);
    pairs = Shape::kCrossingPairs;
    if constexpr (Shape::kIsLocal && !Shape::kIsHeavy)
      intersect_local<Spu, Shape>(local, parameters, crossings);
  });
  return pairs;
}

/// Finds the crossings with a shape that is known at compile time, where there is room for code.
template <class Spu, class Shape>
[[gnu::always_inline]] inline void intersect_shape(const RayPacket& rays, const ObjectRecord& object,
                                                   const ExtraRecord& extra, uint32_t self,
                                                   Crossings<typename Spu::simd>* crossings) {
  using S = typename Spu::simd;
  if constexpr (Shape::kIsLocal)
    intersect_local<Spu, Shape>(local_rays<S>(rays, object, self), local_parameters<S>(object, extra),
                                crossings);
  else
    Shape::template intersect<S>(rays, object, extra, self, crossings);
}

/// Returns the points inside a solid without heavy points.
template <class Spu>
CELLTRACE_ONE_COPY uint32_t inside(Spu& spu, const SolidRecord& solid, const V3<typename Spu::simd>& points) {
  using S = typename Spu::simd;
  spu.run_in_module(modules::kShapes);
  const uint32_t kind = solid.object.kind_and_flags & object_flag::kind_mask;
  if (kind == kPrimitiveKind<SpherePrimitive>)
    return SpherePrimitive::inside<S>(points, solid.object, solid.extra).bits();
  if (Primitives::is_heavy(kind)) return inside_heavy<Spu, false>(solid, points);
  const V3<S> local = to_local<S>(solid.object.geometry, points, 1.0f);
  const LocalParameters<S> parameters = local_parameters<S>(solid.object, solid.extra);
  uint32_t lanes = 0;
  Primitives::dispatch(kind, [&](auto shape) {
    using Shape = decltype(shape);
    if constexpr (Shape::kIsLocal && !Shape::kIsHeavy)
      lanes = Shape::template inside_local<S>(local, parameters).bits();
  });
  return lanes;
}

} // namespace module_shapes

/// Returns the unit normals of shapes in a space of their own without heavy points.
template <class S> CELLTRACE_ONE_COPY V3<S> local_normal(const ObjectLanes<S>& o, const V3<S>& point) {
  return normal_in_own_space<S, false, false>(o, point, point, nullptr);
}
/// Returns the unit normals where there is room for more code, and moves `point` onto flat faces. A point
/// along a ray is only as exact as its distance, and a pattern may have a step on a flat face.
template <class S>
CELLTRACE_ONE_COPY V3<S> local_normal(const ObjectLanes<S>& o, const V3<S>& path, V3<S>& point) {
  const V3<S> along_ray = point;
  return normal_in_own_space<S, false, true>(o, along_ray, path, &point);
}

/// Finds the normals of objects other than spheres, triangles or planes, part by part. Points on flat faces
/// are moved onto them if a packet is one part; otherwise points stay.
template <class Spu>
[[gnu::always_inline]] inline void
find_normals(Spu& spu, const ObjectLanes<typename Spu::simd>& o,
             [[maybe_unused]] const V3<typename Spu::simd>& path, uint32_t others, uint32_t heavy,
             V3<typename Spu::simd>& point, V3<typename Spu::simd>& normal) {
  using R = typename Spu::rare_simd;
  const V3<typename Spu::simd> along_ray = point;
  for_each_part<Spu>([&](uint32_t first) {
    const auto& part = part_of<Spu>(o, first);
    const V3<R> at = part_of<Spu>(along_ray, first);
    V3<R> of_part = at;
    if constexpr (kOnePart<Spu>) {
      if (others != 0) of_part = local_normal<R>(part, path, point);
    } else {
      if (others != 0) of_part = local_normal<R>(part, at);
    }
    if (heavy != 0)
      of_part = select<R>(R::M::from_bits(part_of<Spu>(heavy, first)),
                          module_heavy_points::normal(spu, part, at), of_part);
    set_part<Spu>(normal, first, of_part);
  });
}

} // namespace celltrace::kernel

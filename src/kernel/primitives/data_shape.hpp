// Shapes that are made of any number of ShapeDataRecords, each with a code module of its own. Kernel dialect.
//
// Such a shape derives from DataPrimitive<itself>, lives in a space of its own (local_shape.hpp), and has
//   module()                                   returns its code module
//   intersect_data(rays, numbers, nearest)     offers the crossings of rays, all or those that may be next
//   inside_data(point, numbers)                returns the lanes inside
// A search finds one crossing of each ray, the nearest beyond rays.after(). The crossing brings its normal
// along in u and v, since the records that it comes from are not at hand when surfaces are shaded.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/modules.hpp"
#include "kernel/parts.hpp"
#include "kernel/primitives/local_shape.hpp"
#include "kernel/scene_access.hpp"
#include "records/csg.hpp"

namespace celltrace::kernel {

/// A direction as a point of a square: the sphere of all directions is folded to an octahedron, and the
/// octahedron to the square (Meyer et al. 2010).
template <class S> struct FoldedDirection {
  using F = typename S::F;
  F u, v;

  static FoldedDirection of(const V3<S>& d) {
    const F inverse = F(1.0f) / S::max(S::abs(d.x) + S::abs(d.y) + S::abs(d.z), F(1e-30f));
    const F x = d.x * inverse, y = d.y * inverse;
    const auto below = d.z < F(0.0f);
    return {S::select(below, (F(1.0f) - S::abs(y)) * sign(x), x),
            S::select(below, (F(1.0f) - S::abs(x)) * sign(y), y)};
  }
  V3<S> unfolded() const {
    const F z = F(1.0f) - S::abs(u) - S::abs(v);
    const F fold = S::max(-z, F(0.0f));
    return {u - sign(u) * fold, v - sign(v) * fold, z};
  }

private:
  static F sign(const F& x) { return S::select(x < F(0.0f), F(-1.0f), F(1.0f)); }
};

/// The records of one shape. `Spu` decides whether they are read in place or through the software cache.
template <class Spu> class ShapeNumbers {
public:
  ShapeNumbers(SceneAccess<Spu>& scene, const ExtraRecord& extra) : scene_(scene), data_(ShapeData::of(extra)) {}

  uint32_t count() const { return data_.count; }
  ShapeDataRecord at(uint32_t i) const {
    return *scene_.shape_data(data_.first + i * static_cast<uint32_t>(sizeof(ShapeDataRecord)));
  }

private:
  SceneAccess<Spu>& scene_;
  ShapeData data_;
};

/// The nearest crossing of each ray so far, in the space of a shape.
template <class S> struct NearestCrossing {
  using F = typename S::F;
  using M = typename S::M;

  F t = F(kEveryCrossing);
  M hit = M::none();
  V3<S> normal = {F(0.0f), F(0.0f), F(1.0f)};
  F after;

  explicit NearestCrossing(const LocalRays<S>& rays) : after(S::max(rays.after(), F(kMinHitDistance))) {}

  /// Takes a crossing if it is the nearest of those beyond `after`.
  [[gnu::always_inline]] void offer(const F& at, const M& lanes, const V3<S>& n) {
    const M nearer = lanes & (at > after) & (at < t);
    t = S::select(nearer, at, t);
    normal = select<S>(nearer, n, normal);
    hit = hit | nearer;
  }
  /// Takes a crossing as offer() does, unless it is the point of the surface where the ray starts: rounding
  /// has put this point up to kOff off the surface, in the space of a shape whose size is about 1.
  [[gnu::always_inline]] void offer_apart(const LocalRays<S>& rays, const F& at, const M& lanes,
                                          const V3<S>& n) {
    constexpr float kOff = 1e-5f, kNear = 0.05f;
    const F across = at * dot<S>(n, rays.direction), reach = F(kOff * kOff) * dot<S>(n, n);
    const M is_start = rays.starts_here & (across * across < reach) &
                       (at * at * dot<S>(rays.direction, rays.direction) < F(kNear * kNear));
    offer(at, lanes & !is_start, n);
  }
};

template <class Shape> struct DataPrimitive : LocalPrimitive<Shape> {
  static constexpr uint32_t kCrossingPairs = 1;
  static constexpr bool kHasParameters = true;
  static constexpr bool kHasData = true;
  static constexpr bool kIsMadeOfData = true;
  static constexpr bool kIsHeavy = true;
  static constexpr bool kIsIncremental = true;
  static constexpr bool kHasHeavyPoints = true;

  /// Returns true: any box within the shape's bounds may touch it.
  static bool overlaps(const ObjectRecord&, const ExtraRecord&, const Aabb&) { return true; }

  // The interface of shapes in a space of their own. Code that reads no records finds no crossings and no
  // inside; the scene image has no object whose shape is tested by such code.
  template <class S>
  static void intersect_local(const LocalRays<S>&, const LocalParameters<S>&, Crossings<S>* crossings) {
    crossings->clear();
  }
  template <class S> static typename S::M inside_local(const V3<S>&, const LocalParameters<S>&) {
    return S::M::none();
  }
  /// Returns the normal that the crossing brought along in place of parameters.
  template <class S>
  [[gnu::always_inline]] static V3<S> gradient(const V3<S>&, const LocalParameters<S>& parameters) {
    return FoldedDirection<S>{parameters.ratio, parameters.second}.unfolded();
  }
};

/// Finds the next crossing of each ray with a shape; see module_heavy::intersect().
template <class Shape, class Spu>
CELLTRACE_ONE_COPY void intersect_data(SceneAccess<Spu>& scene, const RayPacket& rays,
                                       const ObjectRecord& object, const ExtraRecord& extra, uint32_t self,
                                       const CrossingRequest& request,
                                       Crossings<typename Spu::simd>& crossings) {
  using R = typename Spu::rare_simd;
  scene.spu().run_in_module(Shape::module());
  const ShapeNumbers<Spu> numbers(scene, extra);
  crossings.clear();
  uint32_t hit = 0;
  for_each_part<Spu>([&](uint32_t first) {
    const LocalRays<R> local = local_rays<R>(rays, object, self, first, request);
    NearestCrossing<R> nearest(local);
    Shape::template intersect_data<R>(local, numbers, nearest);
    const auto normal = FoldedDirection<R>::of(nearest.normal);
    set_part<Spu>(crossings.near, first, nearest.t);
    set_part<Spu>(crossings.u, first, normal.u);
    set_part<Spu>(crossings.v, first, normal.v);
    hit |= nearest.hit.bits() << first;
  });
  crossings.near_hit = Spu::simd::M::from_bits(hit);
}

/// Returns the points of `lanes` that are inside a solid.
template <class Shape, class Spu>
CELLTRACE_ONE_COPY uint32_t inside_data(SceneAccess<Spu>& scene, const SolidRecord& record,
                                        const V3<typename Spu::simd>& points, uint32_t lanes) {
  using R = typename Spu::rare_simd;
  scene.spu().run_in_module(Shape::module());
  const Kept<Spu, SolidRecord> solid = record;
  const ShapeNumbers<Spu> numbers(scene, solid.extra);
  uint32_t inside = 0;
  for_each_part<Spu>([&](uint32_t first) {
    if (part_of<Spu>(lanes, first) == 0) return;
    const V3<R> local = to_local<R>(solid.object.geometry, part_of<Spu>(points, first), 1.0f);
    inside |= Shape::template inside_data<R>(local, numbers).bits() << first;
  });
  return inside & lanes;
}

} // namespace celltrace::kernel

// All shapes. The order determines their kinds, which are numbers in records. Kernel dialect.
//
// A shape P derives from ShapeTraits, or from LocalPrimitive (local_shape.hpp), and has
//   kName            for statistics
//   kCrossingPairs   number of pairs that intersect() fills, at most kMaxCrossingPairs
//   kHasParameters   true if it reads its ExtraRecord
//   intersect(rays, object, extra, self, crossings), inside(point, object, extra)
//   bounds(object, extra), overlaps(object, extra, box)
// and the functions that its traits require.
#pragma once

#include "kernel/primitives/blob.hpp"
#include "kernel/primitives/box.hpp"
#include "kernel/primitives/cone.hpp"
#include "kernel/primitives/cylinder.hpp"
#include "kernel/primitives/disc.hpp"
#include "kernel/primitives/ellipsoid.hpp"
#include "kernel/primitives/lathe.hpp"
#include "kernel/primitives/plane.hpp"
#include "kernel/primitives/polygon.hpp"
#include "kernel/primitives/polynomial.hpp"
#include "kernel/primitives/prism.hpp"
#include "kernel/primitives/quadric.hpp"
#include "kernel/primitives/sor.hpp"
#include "kernel/primitives/sphere.hpp"
#include "kernel/primitives/superellipsoid.hpp"
#include "kernel/primitives/torus.hpp"
#include "kernel/primitives/triangle.hpp"
#include "kernel/type_list.hpp"

namespace celltrace::kernel {

template <class... P> struct PrimitiveList : TypeList<P...> {
  static constexpr bool kSomeAreIncremental = (P::kIsIncremental || ...);
  static_assert(((P::kIsHeavy || !P::kIsIncremental) && ...), "module_heavy::intersect() says what is asked");
  static_assert(((P::kCrossingPairs == 1 || !P::kIsIncremental) && ...), "CrossingSequence takes one pair");
  template <class Q> static constexpr bool is(uint32_t kind) {
    return kind == TypeList<P...>::template number<Q>();
  }
  // Tell the traits of the shape of a kind; false for unknown kinds. GCC warns of && within folds.
  static constexpr bool is_incremental(uint32_t kind) {
    return ((P::kIsIncremental ? is<P>(kind) : false) || ...);
  }
  static constexpr bool is_heavy(uint32_t kind) { return ((P::kIsHeavy ? is<P>(kind) : false) || ...); }
  static constexpr bool has_shadow_test(uint32_t kind) {
    return ((P::kHasShadowTest ? is<P>(kind) : false) || ...);
  }
  static constexpr bool has_edges(uint32_t kind) { return ((P::kHasEdges ? is<P>(kind) : false) || ...); }
  static constexpr bool has_data(uint32_t kind) { return ((P::kHasData ? is<P>(kind) : false) || ...); }
  static constexpr bool is_made_of_data(uint32_t kind) {
    return ((P::kIsMadeOfData ? is<P>(kind) : false) || ...);
  }
  static constexpr bool has_heavy_points(uint32_t kind) {
    return ((P::kHasHeavyPoints ? is<P>(kind) : false) || ...);
  }
};

using Primitives = PrimitiveList<SpherePrimitive, TrianglePrimitive, PlanePrimitive, EllipsoidPrimitive,
                                 DiscPrimitive, BoxPrimitive, CylinderPrimitive, ConePrimitive,
                                 TorusPrimitive, QuadricPrimitive, PolygonPrimitive, SuperellipsoidPrimitive,
                                 PolynomialPrimitive, PrismPrimitive, LathePrimitive, SorPrimitive, BlobPrimitive>;
constexpr uint32_t kPrimitives = Primitives::kCount;
static_assert(kPrimitives <= kMaxPrimitives, "a counter for each in ReportRecord");

template <class P> constexpr uint32_t kPrimitiveKind = Primitives::number<P>();
static_assert(kPrimitiveKind<SpherePrimitive> == static_cast<uint32_t>(ObjectKind::sphere) &&
                  kPrimitiveKind<EllipsoidPrimitive> == static_cast<uint32_t>(ObjectKind::ellipsoid) &&
                  kPrimitiveKind<PlanePrimitive> == static_cast<uint32_t>(ObjectKind::plane) &&
                  kPrimitiveKind<TrianglePrimitive> == static_cast<uint32_t>(ObjectKind::triangle),
              "the kinds that have names");

/// Kind of objects that are no shapes: instances of meshes (instances_module.hpp).
constexpr uint32_t kInstanceKind = kPrimitives;
constexpr uint32_t kObjectKinds = kPrimitives + 1;
static_assert(kObjectKinds <= kMaxPrimitives, "a counter for each in ReportRecord");
constexpr bool is_instance(uint32_t kind_and_flags) {
  return (kind_and_flags & object_flag::kind_mask) == kInstanceKind;
}
constexpr const char* name_of_kind(uint32_t kind) {
  return kind == kInstanceKind ? "instance" : Primitives::kNames[kind];
}

} // namespace celltrace::kernel

// Values that the builder of the BVH processes: AABBs in SIMD lanes, and references to objects. Kernel
// dialect.
#pragma once

#include "kernel/accel/object_bounds.hpp"
#include "kernel/math.hpp"
#include "records/object.hpp"
#include "records/offsets.hpp"

#include <stdint.h>

namespace celltrace::kernel::bvh {

/// A reference to an object, or to a group of `weight` objects, by its AABB. Vectors loaded from the
/// coordinates have `value` or `weight` in lane 3, which is not used.
struct alignas(32) Reference {
  float min[3];
  uint32_t value; ///< offset of the ObjectRecord, or index of the group
  float max[3];
  uint32_t weight;
};
static_assert(sizeof(Reference) == 32, "four a line");

/// Number that is larger than any coordinate or cost.
constexpr float kHuge = 3e38f;
/// Least extent of centres on an axis that is split: the reciprocal of a smaller extent could overflow.
constexpr float kFlatExtent = 1e-30f;
/// 2^23. If a smaller, non-negative number is added, the low bits of the sum are that number rounded to an
/// integer. For other numbers and NaN these bits are arbitrary, but masked they are still a valid bin.
constexpr float kRoundToInteger = 8388608.0f;

/// An AABB whose coordinates are lanes 0 to 2; lane 3 is undefined.
template <class S> struct LaneAabb {
  using F4 = typename S::F4;
  F4 min, max;

  LaneAabb() = default;
  LaneAabb(const F4& low, const F4& high) : min(low), max(high) {}
  // Copies two vectors, as they were stored: a load that covers several stores cannot be forwarded from them
  // and stalls.
  LaneAabb(const LaneAabb& other) : min(other.min), max(other.max) {}
  LaneAabb& operator=(const LaneAabb& other) {
    min = other.min;
    max = other.max;
    return *this;
  }

  static LaneAabb empty() { return {F4::splat(kHuge), F4::splat(-kHuge)}; }
  static LaneAabb of(const Reference& reference) {
    return {F4::load(reference.min), F4::load(reference.max)};
  }

  void grow(const LaneAabb& other) {
    min = S::min(min, other.min);
    max = S::max(max, other.max);
  }
  /// Returns twice the centre, which is as good for bins.
  F4 centre() const { return min + max; }
  void grow(const F4& point) {
    min = S::min(min, point);
    max = S::max(max, point);
  }
  /// Returns half the surface area: only ratios of areas matter.
  float area() const {
    alignas(16) float e[4];
    (max - min).store(e);
    return e[0] * e[1] + (e[0] + e[1]) * e[2];
  }
};

/// Returns the AABB of an object of the scene image at `image`.
template <class S> LaneAabb<S> box_of(const ObjectRecord& object, const void* image) {
  using F4 = typename S::F4;
  constexpr uint32_t kPlainTriangle = static_cast<uint32_t>(ObjectKind::triangle);
  if ((object.kind_and_flags & (object_flag::kind_mask | object_flag::csg)) == kPlainTriangle) {
    alignas(16) float words[3][4];
    for (int vertex = 0; vertex < 3; ++vertex)
      __builtin_memcpy(words[vertex], object.geometry + 3 * vertex, sizeof words[0]);
    const F4 a = F4::load(words[0]), b = F4::load(words[1]), c = F4::load(words[2]);
    return {S::min(a, S::min(b, c)), S::max(a, S::max(b, c))};
  }
  const auto* extras = static_cast<const uint8_t*>(image);
  const Aabb box = object.extra == kNoOffset
                       ? bounding_box(object)
                       : bounding_box(object, *reinterpret_cast<const ExtraRecord*>(extras + object.extra));
  return {four<S>(box.min[0], box.min[1], box.min[2], 0.0f),
          four<S>(box.max[0], box.max[1], box.max[2], 0.0f)};
}

/// Copies a reference as two vectors, for the reason given at LaneAabb.
template <class S> void copy(const Reference& from, Reference& to) {
  const auto low = S::F4::load(from.min), high = S::F4::load(from.max);
  low.store(to.min); // includes `value`; `high` includes `weight`
  high.store(to.max);
}

/// The references [begin, end) of an array, with their weight and bounds.
template <class S> struct Range {
  uint32_t begin, end;
  uint32_t weight; ///< sum of the references' weights
  LaneAabb<S> box; ///< union of the references' bounds

  uint32_t count() const { return end - begin; }
};

template <class S> Range<S> range_of(const Reference* references, uint32_t begin, uint32_t end) {
  Range<S> range = {begin, end, 0, LaneAabb<S>::empty()};
  for (uint32_t i = begin; i < end; ++i) {
    range.box.grow(LaneAabb<S>::of(references[i]));
    range.weight += references[i].weight;
  }
  return range;
}

} // namespace celltrace::kernel::bvh

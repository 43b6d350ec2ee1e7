// What the builder of the BVH handles: boxes in SIMD lanes, and references to objects. Kernel dialect.
#pragma once

#include "kernel/math.hpp"
#include "kernel/primitives/overlap.hpp"
#include "kernel/records.hpp"

#include <stdint.h>

namespace celltrace::kernel::bvh {

/// An object, or a group of `weight` objects, by its bounding box. The words beside the coordinates come
/// along when the box is loaded, and mean nothing there.
struct alignas(32) Reference {
  float min[3];
  uint32_t value; ///< offset of the ObjectRecord, or index of the group
  float max[3];
  uint32_t weight;
};
static_assert(sizeof(Reference) == 32, "four a line");

constexpr float kHuge = 3e38f;
/// Along an axis where centres are no farther apart there is no cut.
constexpr float kFlatExtent = 1e-30f;
/// Adding this to a small number leaves that, rounded, in the low bits. Where a number is not small, or none,
/// something is in them.
constexpr float kRoundToInteger = 8388608.0f;

/// A box whose coordinates are lanes 0 to 2; lane 3 is undefined.
template <class S> struct LaneAabb {
  using F4 = typename S::F4;
  F4 min, max;

  LaneAabb() = default;
  LaneAabb(const F4& low, const F4& high) : min(low), max(high) {}
  // In the pieces in which it is made, so that a processor need not wait for it to be in memory.
  LaneAabb(const LaneAabb& other) : min(other.min), max(other.max) {}
  LaneAabb& operator=(const LaneAabb& other) {
    min = other.min;
    max = other.max;
    return *this;
  }

  static LaneAabb empty() { return {F4::splat(kHuge), F4::splat(-kHuge)}; }
  static LaneAabb of(const Reference& reference) { return {F4::load(reference.min), F4::load(reference.max)}; }

  void grow(const LaneAabb& other) {
    min = S::min(min, other.min);
    max = S::max(max, other.max);
  }
  /// Twice the centre.
  F4 centre() const { return min + max; }
  void grow(const F4& point) {
    min = S::min(min, point);
    max = S::max(max, point);
  }
  /// Half the surface.
  float area() const {
    alignas(16) float e[4];
    (max - min).store(e);
    return e[0] * e[1] + (e[0] + e[1]) * e[2];
  }
};

/// The box around an object.
template <class S> LaneAabb<S> box_of(const ObjectRecord& object) {
  using F4 = typename S::F4;
  if (static_cast<ObjectKind>(object.kind_and_flags & object_flag::kind_mask) == ObjectKind::triangle) {
    alignas(16) float words[3][4];
    for (int vertex = 0; vertex < 3; ++vertex)
      __builtin_memcpy(words[vertex], object.geometry + 3 * vertex, sizeof words[0]);
    const F4 a = F4::load(words[0]), b = F4::load(words[1]), c = F4::load(words[2]);
    return {S::min(a, S::min(b, c)), S::max(a, S::max(b, c))};
  }
  const Box box = bounding_box(object);
  return {four<S>(box.min[0], box.min[1], box.min[2], 0.0f),
          four<S>(box.max[0], box.max[1], box.max[2], 0.0f)};
}

/// In the pieces in which boxes are loaded and stored.
template <class S> void copy(const Reference& from, Reference& to) {
  const auto low = S::F4::load(from.min), high = S::F4::load(from.max);
  low.store(to.min); // and the words beside
  high.store(to.max);
}

/// References [begin, end) of a list.
template <class S> struct Range {
  uint32_t begin, end;
  uint32_t weight; ///< of all of them
  LaneAabb<S> box;  ///< around them

  uint32_t count() const { return end - begin; }
};

/// The range of `references` [begin, end), measured.
template <class S> Range<S> range_of(const Reference* references, uint32_t begin, uint32_t end) {
  Range<S> range = {begin, end, 0, LaneAabb<S>::empty()};
  for (uint32_t i = begin; i < end; ++i) {
    range.box.grow(LaneAabb<S>::of(references[i]));
    range.weight += references[i].weight;
  }
  return range;
}

} // namespace celltrace::kernel::bvh

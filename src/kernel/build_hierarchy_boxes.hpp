// What the builder of the hierarchy handles: boxes in SIMD lanes, and references to objects. Kernel dialect.
#pragma once

#include "kernel/records.hpp"

#include <stdint.h>

namespace celltrace::kernel::hierarchy {

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

/// A box whose coordinates are lanes 0 to 2; lane 3 is undefined.
template <class S> struct LaneBox {
  using F4 = typename S::F4;
  F4 min, max;

  static LaneBox empty() { return {F4::splat(kHuge), F4::splat(-kHuge)}; }
  static LaneBox of(const Reference& reference) { return {F4::load(reference.min), F4::load(reference.max)}; }

  void grow(const LaneBox& other) {
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

/// References [begin, end) of a list.
template <class S> struct Range {
  uint32_t begin, end;
  uint32_t weight;    ///< of all of them
  LaneBox<S> box;     ///< around them
  LaneBox<S> centres; ///< around the doubles of their centres

  uint32_t count() const { return end - begin; }
};

/// The range of `references` [begin, end), measured.
template <class S> Range<S> range_of(const Reference* references, uint32_t begin, uint32_t end) {
  Range<S> range = {begin, end, 0, LaneBox<S>::empty(), LaneBox<S>::empty()};
  for (uint32_t i = begin; i < end; ++i) {
    const LaneBox<S> box = LaneBox<S>::of(references[i]);
    range.box.grow(box);
    range.centres.grow(box.centre());
    range.weight += references[i].weight;
  }
  return range;
}

} // namespace celltrace::kernel::hierarchy

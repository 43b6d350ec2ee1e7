// Leaves of the BVH: decides which objects share a leaf. Kernel dialect.
#pragma once

#include "kernel/direct/build_bvh_subtree.hpp"
#include "kernel/primitives/list.hpp"
#include "kernel/tuning.hpp"

namespace celltrace::kernel::bvh {

using tuning::LeafRule;
/// Largest number of objects in a leaf.
constexpr uint32_t kMaxLeaf = 16;

inline LeafRule leaf_rule(bool large, bool copied) {
  if (large) return tuning::kLargeLeaves;
  return copied ? tuning::kCopiedLeaves : tuning::kSmallLeaves;
}
inline uint32_t weight_of(const ObjectRecord& object, const LeafRule& rule) {
  if (is_instance(object.kind_and_flags)) return rule.most; // an instance has a BVH of its own
  switch (static_cast<ObjectKind>(object.kind_and_flags & object_flag::kind_mask)) {
  case ObjectKind::triangle:
    return 1;
  case ObjectKind::sphere:
    return rule.sphere_weight;
  default:
    return rule.other_weight;
  }
}

/// The leaves at which a SubtreeBuilder over objects ends. The list of a leaf has the same position in the
/// BVH's list as the leaf's range has in the references.
template <class S> class Leaves {
public:
  static constexpr uint32_t kMaxSplitDepth = 32;

  /// Makes leaves of ranges of objects; ranges of fewer than `fewest` objects always are a leaf.
  Leaves(uint8_t* image, uint32_t list_offset, const Reference* references, const LeafRule& rule,
         uint32_t fewest)
      : image_(image), list_offset_(list_offset), references_(references), rule_(rule), fewest_(fewest) {}

  bool end(const Range<S>& range) const {
    const uint32_t count = range.count();
    return count < fewest_ || (range.weight == count && count <= rule_.certain);
  }

  bool end(const Range<S>& range, const Range<S> (&children)[kChildren]) const {
    if (range.weight > rule_.most || range.count() > kMaxLeaf) return false;
    const float area = range.box.area();
    float saved = area * static_cast<float>(range.weight);
    for (const Range<S>& child : children)
      if (child.count() != 0) saved -= child.box.area() * static_cast<float>(child.weight);
    return !(saved * rule_.cost > area);
  }

  void add(const Range<S>& range, const Place& place) {
    const Reference* const objects = references_ + range.begin;
    const int32_t step = step_of(objects, range.count());
    uint32_t first = objects[0].value;
    if (step == 0) {
      first = list_offset_ + range.begin * 4;
      uint32_t* list = reinterpret_cast<uint32_t*>(image_ + first);
      for (uint32_t i = 0; i < range.count(); ++i)
        list[i] = objects[i].value;
    }
    place.parent->child[place.slot] = first;
    place.parent->leaf[place.slot] = leaf_word::make(range.count(), step);
  }

private:
  /// Returns the distance between successive objects in the table, in objects, or 0 if distances differ.
  static int32_t step_of(const Reference* objects, uint32_t count) {
    if (count == 1) return 1;
    const uint32_t bytes = objects[1].value - objects[0].value;
    for (uint32_t i = 2; i < count; ++i)
      if (objects[i].value - objects[i - 1].value != bytes) return 0;
    const int32_t step = static_cast<int32_t>(bytes) / static_cast<int32_t>(sizeof(ObjectRecord));
    return step <= leaf_word::kMaxStep && step >= -leaf_word::kMaxStep ? step : 0;
  }

  uint8_t* image_;
  uint32_t list_offset_;
  const Reference* references_;
  LeafRule rule_;
  uint32_t fewest_;
};

} // namespace celltrace::kernel::bvh

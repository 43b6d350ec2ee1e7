// Triangles of leaves, a lane for each. Kernel dialect.
#pragma once

#include "kernel/accel/object_tests.hpp"

namespace celltrace::kernel {

/// The scalar product of lane `i` of one vector with each lane of another.
template <class S> typename S::F product(const VectorLanes& a, uint32_t i, const V3<S>& b) {
  using F = typename S::F;
  return F(a.x.lane[i]) * b.x + F(a.y.lane[i]) * b.y + F(a.z.lane[i]) * b.z;
}

template <class S> class LeafTriangles {
public:
  static constexpr uint32_t kMost = kSimdLanes;

  uint32_t count() const { return count_; }
  void clear() { count_ = 0; }
  uint32_t all() const { return (2u << (count_ - 1)) - 1; } ///< lanes; there is one
  /// Of triangle `i`, in the scene image.
  uint32_t offset(uint32_t i) const { return offsets_.lane[i]; }
  const WordLanes& offsets() const { return offsets_; }

  /// There is room for it; the record stays where it is.
  void add(uint32_t offset, const ObjectRecord& triangle) {
    offsets_.lane[count_] = offset;
    geometry_[count_++] = triangle.geometry;
  }

  /// Of all of them, at least one. Lanes without one hold the first.
  [[gnu::always_inline]] TriangleSides<S> sides() const {
    F numbers[12]; // the last three are nobody's
    for (uint32_t first = 0; first < 12; first += 4) {
      F* const four = numbers + first;
      for (uint32_t i = 0; i < 4; ++i)
        four[i] = S::join(words(i, first), words(i + 4, first), words(i + 8, first), words(i + 12, first));
      S::transpose_quads(four[0], four[1], four[2], four[3]);
    }
    const V3<S> v0 = {numbers[0], numbers[1], numbers[2]};
    return {v0, V3<S>{numbers[3], numbers[4], numbers[5]} - v0,
            V3<S>{numbers[6], numbers[7], numbers[8]} - v0};
  }

private:
  using F = typename S::F;
  using F4 = typename S::F4;

  F4 words(uint32_t i, uint32_t first) const { return F4::load(geometry_[i < count_ ? i : 0] + first); }

  WordLanes offsets_;
  const float* geometry_[kMost];
  uint32_t count_ = 0;
};

/// Adds those of a leaf's triangles that can be tested together, as far as there is room; what else is in the
/// leaf is for `visit`.
template <class Spu, class Visit>
[[gnu::always_inline]] inline void
collect_triangles(SceneAccess<Spu>& scene, const NodeRef& leaf, bool shadows,
                  LeafTriangles<typename Spu::simd>& triangles, Visit visit) {
  scene.for_each_object(leaf, [&](uint32_t self) {
    const ObjectRecord& object = *scene.object(self);
    const uint32_t flags = object.kind_and_flags;
    const bool fits = shadows
                          ? ObjectTests<Spu>::is_opaque_triangle(flags)
                          : static_cast<ObjectKind>(flags & object_flag::kind_mask) == ObjectKind::triangle;
    if (fits && triangles.count() < LeafTriangles<typename Spu::simd>::kMost)
      triangles.add(self, object);
    else
      visit(self);
    return false;
  });
}

} // namespace celltrace::kernel

// The triangles of leaves, one in each SIMD lane. Kernel dialect.
#pragma once

#include "kernel/accel/object_tests.hpp"
#include "kernel/direct/record_lanes.hpp"

namespace celltrace::kernel {

/// The scalar products of the vector in lane `i` of `a` with the vectors in all lanes of `b`.
template <class S> typename S::F product(const VectorLanes& a, uint32_t i, const V3<S>& b) {
  using F = typename S::F;
  return F(a.x.lane[i]) * b.x + F(a.y.lane[i]) * b.y + F(a.z.lane[i]) * b.z;
}

/// Triangles that are collected from leaves and tested at once.
template <class S> class LeafTriangles {
public:
  static constexpr uint32_t kMost = kSimdLanes;

  uint32_t count() const { return count_; }
  void clear() { count_ = 0; }
  uint32_t all() const { return (2u << (count_ - 1)) - 1; } ///< lanes in use; count() is not 0
  /// The offset of triangle `i` in the scene image.
  uint32_t offset(uint32_t i) const { return offsets_.lane[i]; }
  const WordLanes& offsets() const { return offsets_; }

  /// Adds a triangle, for which there is room. Its record must stay valid.
  void add(uint32_t offset, const ObjectRecord& triangle) {
    offsets_.lane[count_] = offset;
    geometry_[count_++] = triangle.geometry;
  }

  /// Loads all triangles, of which there is at least one. Unused lanes repeat the first.
  [[gnu::always_inline]] TriangleSides<S> sides() const {
    F numbers[12]; // a triangle's record has nine of them; the last three are unused
    const auto triangle = [&](uint32_t i) __attribute__((always_inline)) {
      return geometry_[i < count_ ? i : 0];
    };
    for (uint32_t first = 0; first < 12; first += 4)
      load_words<S>(triangle, first, *reinterpret_cast<F(*)[4]>(numbers + first));
    const V3<S> v0 = {numbers[0], numbers[1], numbers[2]};
    return {v0, V3<S>{numbers[3], numbers[4], numbers[5]} - v0,
            V3<S>{numbers[6], numbers[7], numbers[8]} - v0};
  }

private:
  using F = typename S::F;

  WordLanes offsets_;
  const float* geometry_[kMost];
  uint32_t count_ = 0;
};

/// Adds the triangles of a leaf, as far as there is room; for shadow rays only the opaque ones. Calls
/// `visit(offset)` for all other objects of the leaf.
template <class Spu, class Visit>
[[gnu::always_inline]] inline void
collect_triangles(SceneAccess<Spu>& scene, const NodeRef& leaf, bool shadows,
                  LeafTriangles<typename Spu::simd>& triangles, Visit visit) {
  scene.for_each_object(leaf, [&](uint32_t self) {
    const ObjectRecord& object = *scene.object(self);
    const uint32_t flags = object.kind_and_flags;
    const bool fits =
        shadows ? ObjectTests<Spu>::is_opaque_triangle(flags) : ObjectTests<Spu>::is_plain_triangle(flags);
    if (fits && triangles.count() < LeafTriangles<typename Spu::simd>::kMost)
      triangles.add(self, object);
    else
      visit(self);
    return false;
  });
}

} // namespace celltrace::kernel

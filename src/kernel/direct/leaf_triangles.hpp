// The triangles of leaves, one in each SIMD lane. Kernel dialect.
#pragma once

#include "kernel/accel/object_tests.hpp"
#include "kernel/direct/record_lanes.hpp"

namespace celltrace::kernel {

/// Returns the scalar products of the vector in lane `i` of `a` with the vectors in all lanes of `b`.
template <class S> typename S::F product(const VectorLanes& a, uint32_t i, const V3<S>& b) {
  using F = typename S::F;
  return F(a.x.lane[i]) * b.x + F(a.y.lane[i]) * b.y + F(a.z.lane[i]) * b.z;
}

/// Returns the triangles that are tested in lanes: for shadow rays only those that occlude all light.
constexpr ObjectFlags wanted_triangles(bool shadows) {
  return shadows ? kOpaqueTriangle : kPlainTriangle;
}

/// Triangles that are collected from leaves and tested at once.
template <class S> class LeafTriangles {
public:
  static constexpr uint32_t kMost = kSimdLanes;

  /// Makes a collection of triangles whose offsets begin at `image`.
  explicit LeafTriangles(const void* image) : image_(static_cast<const uint8_t*>(image)) {}

  uint32_t count() const { return count_; }
  void clear() { count_ = 0; }
  uint32_t all() const { return (2u << (count_ - 1)) - 1; } ///< lanes in use; count() must not be 0
  /// Returns the offset of triangle `i` in the scene image.
  uint32_t offset(uint32_t i) const { return offsets_[i]; }
  const uint32_t* offsets() const { return offsets_; } ///< 64-byte aligned
  bool has_room_for(const NodeRef& leaf) const { return count_ + leaf_word::count(leaf.leaf) <= kMost; }

  /// Adds a triangle, for which there must be room.
  void add(uint32_t offset) { offsets_[count_++] = offset; }

  /// Adds the objects of a leaf, for which there must be room, if the first of them is a `wanted` triangle.
  /// The other objects may be of any kind: see lanes_with().
  [[gnu::always_inline]] bool add(const NodeRef& leaf, const ObjectFlags& wanted) {
    // All lanes are set without a loop whose end could not be predicted; lanes beyond the leaf's objects are
    // not in use. A leaf without a list has an object at its offset, which is as long.
    uint32_t next[kMost];
    static_assert(sizeof next == leaf_word::kReadableBytes);
    __builtin_memcpy(next, image_ + leaf.child, sizeof next);
    const uint32_t step = leaf_word::step_bytes(leaf.leaf), listed = leaf_word::is_list(leaf.leaf) ? ~0u : 0u;
    for (uint32_t i = 0; i < kMost; ++i)
      next[i] = (next[i] & listed) | ((leaf.child + i * step) & ~listed);
    if (!wanted.are_in(record_at(next[0]).kind_and_flags)) return false;
    __builtin_memcpy(offsets_ + count_, next, sizeof next);
    count_ += leaf_word::count(leaf.leaf);
    return true;
  }

  /// Lets unused lanes repeat the first triangle, which must exist. The functions below are to be called
  /// after fill().
  [[gnu::always_inline]] void fill() {
    const uint32_t first = offsets_[0];
    for (uint32_t i = 0; i < kMost; ++i)
      offsets_[i] = i < count_ ? offsets_[i] : first;
  }
  /// Returns the lanes with `wanted` triangles.
  [[gnu::always_inline]] uint32_t lanes_with(const ObjectFlags& wanted) const {
    uint32_t differences = 0;
    for (uint32_t i = 0; i < kMost; ++i)
      differences |= record(i).kind_and_flags ^ wanted.value;
    if ((differences & wanted.mask) == 0) return all();
    uint32_t lanes = 0;
    for (uint32_t i = 0; i < count_; ++i)
      lanes |= static_cast<uint32_t>(wanted.are_in(record(i).kind_and_flags)) << i;
    return lanes;
  }

  /// Loads all triangles. Lanes with other objects are meaningless.
  [[gnu::always_inline]] TriangleSides<S> sides() const {
    return load_sides<S>([&](uint32_t i) __attribute__((always_inline)) { return record(i).geometry; });
  }

private:
  const ObjectRecord& record(uint32_t i) const { return record_at(offsets_[i]); }
  const ObjectRecord& record_at(uint32_t offset) const {
    return *reinterpret_cast<const ObjectRecord*>(image_ + offset);
  }

  const uint8_t* image_;
  alignas(64) uint32_t offsets_[2 * kMost]; ///< twice as long, as add() also writes beyond the triangles
  uint32_t count_ = 0;
};

/// Adds the `wanted` triangles of a leaf as long as there is room. Calls `visit(offset)` for all other
/// objects of the leaf.
template <class Spu, class Visit>
[[gnu::always_inline]] inline void
collect_triangles(SceneAccess<Spu>& scene, const NodeRef& leaf, const ObjectFlags& wanted,
                  LeafTriangles<typename Spu::simd>& triangles, Visit visit) {
  scene.for_each_object(leaf, [&](uint32_t self) {
    const uint32_t flags = scene.object(self)->kind_and_flags;
    if (wanted.are_in(flags) && triangles.count() < LeafTriangles<typename Spu::simd>::kMost)
      triangles.add(self);
    else
      visit(self);
    return false;
  });
}

} // namespace celltrace::kernel

// The triangles of a leaf, a lane for each. Kernel dialect.
#pragma once

#include "kernel/intersect.hpp"

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
  uint32_t all() const { return (2u << (count_ - 1)) - 1; } ///< lanes; there is one
  /// Of triangle `i`, in the scene image.
  uint32_t offset(uint32_t i) const { return offsets_.lane[i]; }
  const WordLanes& offsets() const { return offsets_; }

  /// There is room for it; the record stays where it is.
  void add(uint32_t offset, const ObjectRecord& triangle) {
    offsets_.lane[count_] = offset;
    geometry_[count_++] = triangle.geometry;
  }

  /// Of all of them, at least one. Lanes without one hold another one's.
  [[gnu::always_inline]] TriangleSides<S> sides() const {
    const V3<S> v0 = vertices(0);
    return {v0, vertices(3) - v0, vertices(6) - v0};
  }

private:
  using F4 = typename S::F4;

  V3<S> vertices(uint32_t k) const { return {numbers(k), numbers(k + 1), numbers(k + 2)}; }
  typename S::F numbers(uint32_t k) const {
    const F4 first = four_numbers(0, k);
    const F4 second = count_ > 4 ? four_numbers(4, k) : first;
    const F4 third = count_ > 8 ? four_numbers(8, k) : first;
    const F4 fourth = count_ > 12 ? four_numbers(12, k) : first;
    return S::join(first, second, third, fourth);
  }
  F4 four_numbers(uint32_t first, uint32_t k) const {
    const auto number = [&](uint32_t i) { return geometry_[i < count_ ? i : first][k]; };
    return four<S>(geometry_[first][k], number(first + 1), number(first + 2), number(first + 3));
  }

  WordLanes offsets_;
  const float* geometry_[kMost];
  uint32_t count_ = 0;
};

} // namespace celltrace::kernel

// Feature points: random points of space, one in each unit cell. Kernel dialect.
#pragma once

#include "kernel/math.hpp"
#include "kernel/scene_access.hpp"
#include "records/random_tables.hpp"

namespace celltrace::kernel {

/// Finds the unit cell with the point of `lane`, as coordinates modulo 2^32, and returns the lanes whose
/// points are in the same cell. `whole`: the coordinates of all lanes' cells; `of_lane`: the same, stored.
template <class S>
[[gnu::always_inline]] inline uint32_t find_cell(uint32_t lane, const typename S::I (&whole)[3],
                                                 const int32_t (&of_lane)[3][S::kLanes],
                                                 uint32_t (&cell)[3]) {
  auto same = S::M::all();
  for (uint32_t axis = 0; axis < 3; ++axis) {
    same = same & (whole[axis] == S::I::splat(of_lane[axis][lane]));
    cell[axis] = static_cast<uint32_t>(of_lane[axis][lane]);
  }
  return same.bits() | 1u << lane;
}

/// Calls `visit(lanes, cell, from)` for each unit cell that contains points: the lanes of the points in it,
/// its coordinates modulo 2^32, and the position of each lane's point in that point's own cell.
template <class S, class Visit>
[[gnu::always_inline]] inline void for_each_cell_of(const V3<S>& p, Visit visit) {
  typename S::I whole[3];
  const V3<S> from = {fraction<S>(p.x, whole[0]), fraction<S>(p.y, whole[1]), fraction<S>(p.z, whole[2])};
  alignas(64) int32_t of_lane[3][S::kLanes];
  for (uint32_t axis = 0; axis < 3; ++axis)
    whole[axis].store(of_lane[axis]);
  for (uint32_t left = (1u << S::kLanes) - 1; left != 0;) {
    const uint32_t first = static_cast<uint32_t>(__builtin_ctz(left));
    uint32_t cell[3];
    const uint32_t lanes = find_cell<S>(first, whole, of_lane, cell);
    left &= ~lanes;
    visit(lanes, cell, from);
  }
}

/// Returns the offset of the FeatureRecords that a pattern reads.
inline uint32_t features_of(const PatternRecord& r) {
  constexpr uint32_t kBytes = kFeatures * static_cast<uint32_t>(sizeof(FeatureRecord));
  return (r.kind_and_flags & pattern_flag::gradient_noise) != 0 ? r.table - kBytes : r.table;
}

/// The numbers of cells, and their feature points.
template <class Spu> class Features {
public:
  /// Reads the FeatureRecords at offset `table`.
  Features(SceneAccess<Spu>& scene, uint32_t table) : scene_(scene), table_(table) {}

  /// Hashes a coordinate into a number: first x with number 0, then y, then z.
  uint32_t number_after(uint32_t number, uint32_t coordinate) {
    return at(number ^ (coordinate & (kFeatures - 1))).hash;
  }
  uint32_t number_of(const uint32_t (&cell)[3]) {
    return number_after(number_after(number_after(0, cell[0]), cell[1]), cell[2]);
  }
  FeatureRecord at(uint32_t number) {
    return *scene_.template pattern_table<FeatureRecord>(
        table_ + (number & (kFeatures - 1)) * static_cast<uint32_t>(sizeof(FeatureRecord)));
  }

  /// Returns the words of all FeatureRecords; for direct memory only.
  const int32_t* words() {
    return reinterpret_cast<const int32_t*>(scene_.template pattern_table<FeatureRecord>(table_));
  }

  SceneAccess<Spu>& scene() { return scene_; }

private:
  SceneAccess<Spu>& scene_;
  uint32_t table_;
};

} // namespace celltrace::kernel

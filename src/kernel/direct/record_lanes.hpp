// Records of a packet's lanes, read in place. Kernel dialect.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/primitives/shapes_module.hpp"
#include "kernel/scene_access.hpp"

namespace celltrace::kernel {

/// Loads word `first`, a multiple of 4, and the three words that follow it from the record of each lane.
/// `record_of(lane)` returns the address of a record, a multiple of 16.
template <class S, class RecordOf>
[[gnu::always_inline]] inline void load_words(const RecordOf& record_of, uint32_t first,
                                              typename S::F (&words)[4]) {
  using F4 = typename S::F4;
  const auto four = [&](uint32_t lane) __attribute__((always_inline)) {
    return F4::load(record_of(lane) + first);
  };
  for (uint32_t i = 0; i < 4; ++i)
    words[i] = S::join(four(i), four(i + 4), four(i + 8), four(i + 12));
  S::transpose_quads(words[0], words[1], words[2], words[3]);
}

/// Loads triangles, one in each lane. `geometry_of(lane)` returns the geometry of the lane's record, which
/// has twelve words.
template <class S, class GeometryOf>
[[gnu::always_inline]] inline TriangleSides<S> load_sides(const GeometryOf& geometry_of) {
  typename S::F numbers[12]; // a triangle has nine numbers; the last three are unused
  for (uint32_t first = 0; first < 12; first += 4)
    load_words<S>(geometry_of, first, *reinterpret_cast<typename S::F(*)[4]>(numbers + first));
  const V3<S> v0 = {numbers[0], numbers[1], numbers[2]};
  return {v0, V3<S>{numbers[3], numbers[4], numbers[5]} - v0, V3<S>{numbers[6], numbers[7], numbers[8]} - v0};
}

/// Merges crossings of one ray with triangles in lanes into its closest hit; see keep_closest() in
/// crossings.hpp. `hit` are the lanes with crossings no farther than that hit. `number_of(i)` returns the
/// number that names the triangle in lane i.
template <class S, class NumberOf>
[[gnu::always_inline]] inline void keep_closest_of(const Crossings<S>& c, uint32_t hit, uint32_t lane,
                                                   const NumberOf& number_of, HitPacket& hits) {
  if (hit == 0) return;
  FloatLanes near, u, v;
  c.near.store(near.lane);
  c.u.store(u.lane);
  c.v.store(v.lane);
  for_each_lane(hit, [&](uint32_t i) {
    keep_closer({near.lane[i], u.lane[i], v.lane[i], number_of(i)}, lane, hits);
  });
}

} // namespace celltrace::kernel

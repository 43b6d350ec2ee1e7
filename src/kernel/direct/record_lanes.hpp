// Records of a packet's lanes side by side, read where they lie. Kernel dialect.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/primitives/shapes_module.hpp"
#include "kernel/scene_access.hpp"

namespace celltrace::kernel {

/// Of the record of each lane, the word `first`, a multiple of 4, and the three that follow it.
/// `record_of(lane)`: where a record is, a multiple of 16.
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

/// Likewise twelve words, as vectors one after the other.
template <class S, class RecordOf>
[[gnu::always_inline]] inline void load_vectors(const RecordOf& record_of, uint32_t first,
                                                V3<S> (&vectors)[4]) {
  typename S::F a[4], b[4], c[4];
  load_words<S>(record_of, first, a);
  load_words<S>(record_of, first + 4, b);
  load_words<S>(record_of, first + 8, c);
  vectors[0] = {a[0], a[1], a[2]};
  vectors[1] = {a[3], b[0], b[1]};
  vectors[2] = {b[2], b[3], c[0]};
  vectors[3] = {c[1], c[2], c[3]};
}

/// Triangles, one in each lane. `geometry_of(lane)`: that of its record, which has twelve words.
template <class S, class GeometryOf>
[[gnu::always_inline]] inline TriangleSides<S> load_sides(const GeometryOf& geometry_of) {
  typename S::F numbers[12]; // a triangle has nine of them; the last three are unused
  for (uint32_t first = 0; first < 12; first += 4)
    load_words<S>(geometry_of, first, *reinterpret_cast<typename S::F(*)[4]>(numbers + first));
  const V3<S> v0 = {numbers[0], numbers[1], numbers[2]};
  return {v0, V3<S>{numbers[3], numbers[4], numbers[5]} - v0, V3<S>{numbers[6], numbers[7], numbers[8]} - v0};
}

/// As keep_closest() of crossings.hpp, of one ray with the triangles in lanes, those in `hit` of which it
/// hits no farther than at its distance. `number_of(i)`: what names the triangle in lane i.
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

/// The words of ObjectRecords besides their geometry.
template <class S> struct ObjectWords {
  using I = typename S::I;
  I kind_and_flags, material, interior, extra;

  /// Returns the lanes that have some of `flags`: of object_flag, or of material_word.
  uint32_t lanes_with(uint32_t flags) const { return lanes_with(kind_and_flags, flags); }
  uint32_t lanes_with_material(uint32_t flags) const { return lanes_with(material, flags); }
  I material_offset() const { return material & I::splat(static_cast<int32_t>(~material_word::flags_mask)); }

private:
  static uint32_t lanes_with(const I& words, uint32_t flags) {
    const auto without = (words & I::splat(static_cast<int32_t>(flags))) == I::splat(0);
    return ~without.bits() & 0xFFFF;
  }
};

/// The objects at `offsets`, all at once: that takes less than each by itself where there are several.
template <class Spu>
CELLTRACE_ONE_COPY void load_objects(SceneAccess<Spu>& scene, const WordLanes& offsets,
                                     ObjectLanes<typename Spu::simd>& objects,
                                     ObjectWords<typename Spu::simd>& words) {
  using S = typename Spu::simd;
  using F = typename S::F;
  using I = typename S::I;
  using M = typename S::M;
  static_assert(offsetof(ObjectRecord, geometry) == 16 && offsetof(ExtraRecord, value) == 0);
  const auto record_at = [&](const WordLanes& at) {
    return [&](uint32_t lane) __attribute__((always_inline)) {
      return reinterpret_cast<const float*>(scene.object(at.lane[lane]));
    };
  };
  F four[4];
  load_words<S>(record_at(offsets), 0, four);
  words = {S::bits_of(four[0]), S::bits_of(four[1]), S::bits_of(four[2]), S::bits_of(four[3])};
  load_vectors<S>(record_at(offsets), 4, objects.geometry);

  const I kinds = words.kind_and_flags & I::splat(object_flag::kind_mask);
  uint32_t local = 0xFFFF;
  for (uint32_t kind = 0; kind < kPrimitives; ++kind) {
    objects.of_kind[kind] = (kinds == I::splat(static_cast<int32_t>(kind))).bits();
    if (!is_local(kind)) local &= ~objects.of_kind[kind];
  }
  objects.smooth = words.lanes_with(object_flag::smooth);
  objects.parameters.ratio = objects.parameters.second = F(0.0f);
  local &= ~(words.extra == I::splat(static_cast<int32_t>(kNoOffset))).bits();
  if ((objects.smooth | local) == 0) return;
  // Lanes that want no extra record read their object's words instead.
  WordLanes extras;
  S::select(M::from_bits(objects.smooth | local), words.extra,
            I::load(reinterpret_cast<const int32_t*>(offsets.lane)))
      .store(reinterpret_cast<int32_t*>(extras.lane));
  V3<S> values[4];
  load_vectors<S>(record_at(extras), 0, values);
  objects.parameters.ratio = S::select(M::from_bits(local), values[0].x, F(0.0f));
  objects.parameters.second = S::select(M::from_bits(local), values[0].y, F(0.0f));
  for (uint32_t i = 0; i < 3; ++i)
    objects.normals[i] = values[i];
}

} // namespace celltrace::kernel

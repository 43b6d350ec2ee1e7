// Records of a packet's lanes side by side, read where they lie. Kernel dialect.
#pragma once

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

/// The words of ObjectRecords besides their geometry.
template <class S> struct ObjectWords {
  typename S::I kind_and_flags, material, interior, extra;

  uint32_t lanes_with(uint32_t flags) const {
    using I = typename S::I;
    const auto without = (kind_and_flags & I::splat(static_cast<int32_t>(flags))) == I::splat(0);
    return ~without.bits() & 0xFFFF;
  }
};

/// The objects at `offsets`, all at once: that takes less than each by itself where there are several.
template <class Spu>
[[gnu::noinline]] void load_objects(SceneAccess<Spu>& scene, const WordLanes& offsets,
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
  V3<S>(&g)[4] = objects.geometry;
  load_words<S>(record_at(offsets), 4, four);
  g[0] = {four[0], four[1], four[2]};
  g[1].x = four[3];
  load_words<S>(record_at(offsets), 8, four);
  g[1].y = four[0];
  g[1].z = four[1];
  g[2].x = four[2];
  g[2].y = four[3];
  load_words<S>(record_at(offsets), 12, four);
  g[2].z = four[0];
  g[3] = {four[1], four[2], four[3]};

  const I kinds = words.kind_and_flags & I::splat(object_flag::kind_mask);
  uint32_t local = 0xFFFF;
  for (uint32_t kind = 0; kind < kPrimitives; ++kind) {
    objects.of_kind[kind] = (kinds == I::splat(static_cast<int32_t>(kind))).bits();
    if (!is_local(kind)) local &= ~objects.of_kind[kind];
  }
  objects.smooth = words.lanes_with(object_flag::smooth);
  objects.parameters.ratio = F(0.0f);
  local &= ~(words.extra == I::splat(static_cast<int32_t>(kNoOffset))).bits();
  if ((objects.smooth | local) == 0) return;
  // Lanes that want no extra record read their object's words instead.
  WordLanes extras;
  S::select(M::from_bits(objects.smooth | local), words.extra,
            I::load(reinterpret_cast<const int32_t*>(offsets.lane)))
      .store(reinterpret_cast<int32_t*>(extras.lane));
  V3<S>(&n)[3] = objects.normals;
  load_words<S>(record_at(extras), 0, four);
  objects.parameters.ratio = S::select(M::from_bits(local), four[0], F(0.0f));
  if (objects.smooth == 0) return;
  n[0] = {four[0], four[1], four[2]};
  n[1].x = four[3];
  load_words<S>(record_at(extras), 4, four);
  n[1].y = four[0];
  n[1].z = four[1];
  n[2].x = four[2];
  n[2].y = four[3];
  load_words<S>(record_at(extras), 8, four);
  n[2].z = four[0];
}

} // namespace celltrace::kernel

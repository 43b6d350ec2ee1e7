// Access to the scene: the tracer reads all records through this class and so through the software cache.
// Kernel dialect.
#pragma once

#include "celltrace/cache.hpp"
#include "kernel/scalar_work.hpp"
#include "kernel/strategy.hpp"
#include "kernel/traversal_stack.hpp"
#include "records/accelerator.hpp"
#include "records/atmosphere.hpp"
#include "records/csg.hpp"
#include "records/frame.hpp"
#include "records/function.hpp"
#include "records/instance.hpp"
#include "records/light.hpp"
#include "records/material.hpp"
#include "records/mesh.hpp"
#include "records/object.hpp"
#include "records/pattern.hpp"
#include "records/picture.hpp"
#include "records/report.hpp"

#include <stddef.h>

namespace celltrace::kernel {

/// A record that stays valid while other records are read: a reference if records are read in place,
/// otherwise a copy.
template <class Spu, class Record> using Kept = typename Strategy<Spu>::template Kept<Record>;
/// Returns `record`, valid while other records are read: copied to `room` if a copy is necessary.
template <class Spu, class Record>
[[gnu::always_inline]] inline const Record* keep(const Record* record, Record& room) {
  return Strategy<Spu>::keep(record, room);
}

/// Returns the configuration of the software cache for a frame.
inline CacheConfig cache_config(const FrameBlock& frame) {
  if (frame.cache_enabled == 0) return CacheConfig::off();
  return CacheConfig::of(frame.cache_ways, frame.cache_sets,
                         static_cast<CacheReplacement>(frame.cache_replacement));
}

/// Typed reads of the scene image by offset. A returned pointer is valid until the next read of any kind.
template <class Spu> class SceneAccess {
public:
  SceneAccess(Spu& spu, const CacheConfig& config, ea_t image) : cache_(spu, config, image) {}

  /// Returns the scene image where records are read in place, else null.
  const uint8_t* image() { return Strategy<Spu>::image(cache_); }
  const ObjectRecord* object(uint32_t offset) { return read<ObjectRecord>(offset, DataKind::object); }
  const ObjectRecord* object_apart(uint32_t offset) {
    return read_apart<ObjectRecord>(offset, DataKind::object);
  }
  const InstanceRecord* instance(uint32_t offset) {
    return read_apart<InstanceRecord>(offset, DataKind::object);
  }
  const ExtraRecord* extra(uint32_t offset) { return read_apart<ExtraRecord>(offset, DataKind::object); }
  const ShapeDataRecord* shape_data(uint32_t offset) {
    return read_apart<ShapeDataRecord>(offset, DataKind::object);
  }
  const PictureRecord* picture(uint32_t offset) {
    return read_apart<PictureRecord>(offset, DataKind::material);
  }
  const TexelTileRecord* texel_tile(uint32_t offset) {
    return read_apart<TexelTileRecord>(offset, DataKind::material);
  }
  const FunctionStepRecord* function_step(uint32_t offset) {
    return read_apart<FunctionStepRecord>(offset, DataKind::material);
  }
  const CsgRecord* csg(uint32_t offset) { return read_apart<CsgRecord>(offset, DataKind::object); }
  const CsgStep* csg_step(uint32_t offset) { return read_apart<CsgStep>(offset, DataKind::object); }
  const SolidRecord* solid(uint32_t offset) { return read_apart<SolidRecord>(offset, DataKind::object); }
  const MeshGridRecord* mesh_grid(uint32_t offset) {
    return read_apart<MeshGridRecord>(offset, DataKind::object);
  }
  const MeshTriangleRecord* mesh_triangle(uint32_t offset) {
    return read_apart<MeshTriangleRecord>(offset, DataKind::object);
  }
  const CrossedMeshRecord* crossed_mesh(uint32_t offset) {
    return read_apart<CrossedMeshRecord>(offset, DataKind::object);
  }
  const MaterialRecord* material(uint32_t offset) {
    return read_apart<MaterialRecord>(offset, DataKind::material);
  }
  const BlendRecord* blend(uint32_t offset) { return read_apart<BlendRecord>(offset, DataKind::material); }
  const InteriorRecord* interior(uint32_t offset) {
    return read_apart<InteriorRecord>(offset, DataKind::material);
  }
  const FinishRecord* finish(uint32_t offset) { return read_apart<FinishRecord>(offset, DataKind::material); }
  const FogRecord* fog(uint32_t offset) { return read_apart<FogRecord>(offset, DataKind::material); }
  const RainbowRecord* rainbow(uint32_t offset) {
    return read_apart<RainbowRecord>(offset, DataKind::material);
  }
  const PatternRecord* pattern(uint32_t offset) {
    return read_apart<PatternRecord>(offset, DataKind::material);
  }
  const SpaceStepRecord* space_step(uint32_t offset) {
    return read_apart<SpaceStepRecord>(offset, DataKind::material);
  }
  const MapEntryRecord* map_entry(uint32_t offset) {
    return read_apart<MapEntryRecord>(offset, DataKind::material);
  }
  /// Returns a record of one of the patterns' tables.
  template <class Record> const Record* pattern_table(uint32_t offset) {
    return read_apart<Record>(offset, DataKind::material);
  }
  const NormalRecord* normal(uint32_t offset) { return read_apart<NormalRecord>(offset, DataKind::material); }
  const LightRecord* light(uint32_t offset) { return read_apart<LightRecord>(offset, DataKind::light); }
  /// Returns a voxel by value, because reading the voxel's list would invalidate a pointer.
  CellRecord cell(const GridRecord& grid, uint32_t index) {
    return *read<CellRecord>(grid.cell_offset + index * static_cast<uint32_t>(sizeof(CellRecord)),
                             DataKind::list);
  }
  /// Returns the number of objects that each voxel of `lanes` lists.
  typename Spu::simd::I listed_in(const GridRecord& grid, const typename Spu::simd::I& cells,
                                  uint32_t lanes) {
    using I = typename Spu::simd::I;
    static_assert(sizeof(CellRecord) == 8);
    const uint32_t first = grid.cell_offset + static_cast<uint32_t>(offsetof(CellRecord, count));
    const I at = Spu::simd::template shift_left<3>(cells) + I::splat(static_cast<int32_t>(first));
    return cache_.words(at, lanes, DataKind::list);
  }
  const NodeRecord* node(uint32_t offset) { return read<NodeRecord>(offset, DataKind::list); }
  uint32_t list_word(uint32_t offset) { return *read<uint32_t>(offset, DataKind::list); }

  /// Calls `visit(offset)` for each object of a list until it returns true. The next object is fetched
  /// meanwhile.
  template <class Visit> void for_each_listed(uint32_t list, uint32_t count, const Visit& visit) {
    for_each_of({list, count, 0}, visit);
  }
  /// Calls `visit(offset)` for each object of a leaf, as for_each_listed() does.
  template <class Visit> void for_each_object(const NodeRef& leaf, const Visit& visit) {
    for_each_of({leaf.child, leaf_word::count(leaf.leaf), leaf_word::step_bytes(leaf.leaf)}, visit);
  }

  /// Prefetches a node or leaf of the BVH, as SoftwareCache::hint() does.
  void hint(const NodeRef& ref) {
    cache_.hint(ref.child);
    if (!ref.is_leaf())
      cache_.hint(ref.child + sizeof(NodeRecord) / 2); // a node has two of a PC's cache lines
    else if (leaf_word::count(ref.leaf) == 2)
      cache_.hint(ref.child + leaf_word::step_bytes(ref.leaf));
  }

  /// Returns the cache of results that patterns have computed for points.
  typename Strategy<Spu>::template PatternCaches<Spu>& pattern_caches() { return pattern_caches_; }

  SoftwareCache<Spu, DataKind>& cache() { return cache_; }
  Spu& spu() { return cache_.spu(); }

  /// A sequence of objects. Their offsets begin with `first` and are `step` bytes apart; if `step` is 0,
  /// `first` is the offset of a list of their offsets, one word each.
  struct Sequence {
    uint32_t first, count, step;
  };
  uint32_t offset_of(const Sequence& objects, uint32_t i) {
    return objects.step == 0 ? list_word(objects.first + i * 4) : objects.first + i * objects.step;
  }

private:
  template <class Visit> void for_each_of(const Sequence& objects, const Visit& visit) {
    if (objects.count == 0) return;
    uint32_t next = member(objects, 0);
    for (uint32_t i = 1;; ++i) {
      spu().compute(scalar_work::kListedObject);
      const uint32_t self = next;
      if (i < objects.count) next = member(objects, i);
      if (visit(self) || i == objects.count) return;
    }
  }
  /// Returns the offset of a member of a sequence and prefetches the member unless it is the first.
  uint32_t member(const Sequence& objects, uint32_t i) { return Strategy<Spu>::member(*this, objects, i); }

  template <class T> const T* read(uint32_t offset, DataKind kind) {
    return cache_.template get<T>(offset, kind);
  }
  /// Reads a record that the innermost loops do not use.
  template <class T> const T* read_apart(uint32_t offset, DataKind kind) {
    return Strategy<Spu>::template read_apart<T>(cache_, offset, kind);
  }

  SoftwareCache<Spu, DataKind> cache_;
  [[no_unique_address]] typename Strategy<Spu>::template PatternCaches<Spu> pattern_caches_;
};

} // namespace celltrace::kernel

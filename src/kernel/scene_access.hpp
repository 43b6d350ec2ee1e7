// Every read of the scene by the tracer goes through here, and so through the software cache. Kernel dialect.
#pragma once

#include "celltrace/cache.hpp"
#include "celltrace/spe/one_copy.hpp"
#include "kernel/direct/door.hpp"
#include "kernel/direct/feature_neighbours.hpp"
#include "kernel/records.hpp"
#include "kernel/scalar_work.hpp"
#include "kernel/traversal_stack.hpp"

#include <stddef.h>

#include <type_traits>

namespace celltrace::kernel {

/// A record that stays while others are read: itself where records are read in place, otherwise a copy.
template <class Spu, class Record>
using Kept = std::conditional_t<kReadsInPlace<Spu>, const Record&, const Record>;
/// The same of one record after the other, a copy of which has `room`.
template <class Spu, class Record>
[[gnu::always_inline]] inline const Record* keep(const Record* record, [[maybe_unused]] Record& room) {
  if constexpr (kReadsInPlace<Spu>) return record;
  room = *record;
  return &room;
}

/// The software cache that a frame asks for.
inline CacheConfig cache_config(const FrameBlock& frame) {
  if (frame.cache_enabled == 0) return CacheConfig::off();
  return CacheConfig::of(frame.cache_ways, frame.cache_sets,
                         static_cast<CacheReplacement>(frame.cache_replacement));
}

template <class S, uint32_t kPackets> class FractalValues;

/// Typed reads of the scene image by offset. A returned pointer is valid until the next read of any kind.
template <class Spu> class SceneAccess {
public:
  SceneAccess(Spu& spu, const CacheConfig& config, ea_t image) : cache_(spu, config, image) {}

  /// The scene image where records are read in place, else null.
  const uint8_t* image() {
    if constexpr (kReadsInPlace<Spu>) return read<uint8_t>(0, DataKind::object);
    return nullptr;
  }
  const ObjectRecord* object(uint32_t offset) { return read<ObjectRecord>(offset, DataKind::object); }
  const ObjectRecord* object_apart(uint32_t offset) {
    return read_apart<ObjectRecord>(offset, DataKind::object);
  }
  const InstanceRecord* instance(uint32_t offset) {
    return read_apart<InstanceRecord>(offset, DataKind::object);
  }
  const ExtraRecord* extra(uint32_t offset) { return read_apart<ExtraRecord>(offset, DataKind::object); }
  const PolygonEdgeRecord* polygon_edge(uint32_t offset) {
    return read_apart<PolygonEdgeRecord>(offset, DataKind::object);
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
  /// A record of one of the tables of patterns.
  template <class Record> const Record* pattern_table(uint32_t offset) {
    return read_apart<Record>(offset, DataKind::material);
  }
  const NormalRecord* normal(uint32_t offset) { return read_apart<NormalRecord>(offset, DataKind::material); }
  const LightRecord* light(uint32_t offset) { return read_apart<LightRecord>(offset, DataKind::light); }
  /// By value: a voxel's list is read while its record would have to stay.
  CellRecord cell(const GridRecord& grid, uint32_t index) {
    return *read<CellRecord>(grid.cell_offset + index * static_cast<uint32_t>(sizeof(CellRecord)),
                             DataKind::list);
  }
  /// How many objects each voxel of `lanes` lists.
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

  /// Calls `visit(offset)` for each object of a list until it returns true. The next object is on its way
  /// meanwhile.
  template <class Visit> void for_each_listed(uint32_t list, uint32_t count, const Visit& visit) {
    for_each_of({list, count, 0}, visit);
  }
  /// The same of a leaf.
  template <class Visit> void for_each_object(const NodeRef& leaf, const Visit& visit) {
    for_each_of({leaf.child, leaf_word::count(leaf.leaf), leaf_word::step_bytes(leaf.leaf)}, visit);
  }

  /// As the cache's, of a ref of the BVH.
  void hint(const NodeRef& ref) {
    cache_.hint(ref.child);
    if (!ref.is_leaf())
      cache_.hint(ref.child + sizeof(NodeRecord) / 2); // a node has two of a PC's lines
    else if (leaf_word::count(ref.leaf) == 2)
      cache_.hint(ref.child + leaf_word::step_bytes(ref.leaf));
  }

  /// What patterns know of points, where a ScopedCache keeps it, else null: random points for points that are
  /// close together; what fractals are at points that are about to be asked for.
  using Neighbours = NeighbourCache<typename Spu::rare_simd>;
  using Fractals = FractalValues<typename Spu::rare_simd, kBundlePackets<Spu>>;
  Neighbours* neighbours() const { return neighbours_; }
  Fractals* fractals() const { return fractals_.known; }
  void use(Neighbours* cache) { neighbours_ = cache; }
  void use(Fractals* cache) { fractals_.known = cache; }

  SoftwareCache<Spu, DataKind>& cache() { return cache_; }
  Spu& spu() { return cache_.spu(); }

private:
  /// Objects that follow each other by `step` bytes from `first` on, or if that is 0, whose offsets do, a
  /// word each.
  struct Sequence {
    uint32_t first, count, step;
  };
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
  /// The offset of one of them; of those after the first one, on its way.
  uint32_t member(const Sequence& objects, uint32_t i) {
    if constexpr (!kHasRoomForCode<Spu>) return member_through_cache(objects, i);
    const uint32_t object = offset_of(objects, i);
    if (i != 0) cache_.hint(object);
    return object;
  }
  /// One copy: local store is short.
  CELLTRACE_ONE_COPY uint32_t member_through_cache(const Sequence& objects, uint32_t i) {
    const uint32_t object = offset_of(objects, i);
    if (i != 0) cache_.prefetch(object);
    return object;
  }
  uint32_t offset_of(const Sequence& objects, uint32_t i) {
    return objects.step == 0 ? list_word(objects.first + i * 4) : objects.first + i * objects.step;
  }

  template <class T> const T* read(uint32_t offset, DataKind kind) {
    return cache_.template get<T>(offset, kind);
  }
  /// What is not read in the innermost loops: one copy of the code for all records, as local store is
  /// short.
  template <class T> const T* read_apart(uint32_t offset, DataKind kind) {
    if constexpr (kReadsInPlace<Spu>)
      return read<T>(offset, kind);
    else
      return reinterpret_cast<const T*>(read_bytes(offset, sizeof(T), kind));
  }
  CELLTRACE_ONE_COPY const uint8_t* read_bytes(uint32_t offset, uint32_t size, DataKind kind) {
    return cache_.bytes(offset, size, kind);
  }

  SoftwareCache<Spu, DataKind> cache_;
  Neighbours* neighbours_ = nullptr;
  struct KnownFractals {
    Fractals* known = nullptr;
  };
  [[no_unique_address]] Present<KnownFractals, kIteratesAhead<Spu>> fractals_;
};

/// As long as it lives, patterns have a cache, where memory is direct: one of SceneAccess's. On the stack, as
/// local store has no room for it.
template <class Spu, class Cache, bool kIsThere = kHasRoomForCode<Spu>> class ScopedCache {
public:
  /// Not inlined: GCC 12 would say that the pointer outlives the cache, whatever the destructor does.
  [[gnu::noinline]] explicit ScopedCache(SceneAccess<Spu>& scene) : scene_(scene) { scene.use(&cache_); }
  ~ScopedCache() { scene_.use(static_cast<Cache*>(nullptr)); }
  ScopedCache(const ScopedCache&) = delete;
  ScopedCache& operator=(const ScopedCache&) = delete;

private:
  SceneAccess<Spu>& scene_;
  Cache cache_;
};
template <class Spu, class Cache> class ScopedCache<Spu, Cache, false> {
public:
  explicit ScopedCache(SceneAccess<Spu>&) {}
};

} // namespace celltrace::kernel

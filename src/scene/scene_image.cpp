#include "scene/scene_image.hpp"

#include "celltrace/error.hpp"
#include "celltrace/spe/simd_host.hpp"
#include "kernel/direct/build_bvh_bounds.hpp"
#include "kernel/direct/build_bvh_plan.hpp"
#include "scene/image_fields.hpp"
#include "scene/light_sets.hpp"
#include "scene/mesh_instances.hpp"
#include "scene/parallel.hpp"
#include "scene/projectors.hpp"
#include "scene/scene_objects.hpp"
#include "scene/surface_records.hpp"
#include "scene/textures.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <new>

namespace celltrace {

using namespace kernel;

namespace {

using Simd = HostSimd<xsimd::sse2>;

/// What the accelerator that is most likely to be built needs.
std::size_t bvh_bytes(const ImageHeader& header) {
  const std::size_t nodes =
      bvh::most_nodes(header.object_count, header.group_count, header.prototype_count != 0);
  return nodes * sizeof(NodeRecord) + header.object_count * sizeof(std::uint32_t) + kLineBytes;
}

std::size_t round_up(std::size_t bytes) {
  return (bytes + kLineBytes - 1) / kLineBytes * kLineBytes;
}

/// Work memory for ordering objects.
struct OrderMemory {
  PlacedObject* objects;
  PlacedObject* spare;
  std::uint32_t* cells;

  OrderMemory(AlignedBlock& block, std::uint32_t count) {
    const std::size_t list = round_up(std::size_t{count} * sizeof(PlacedObject));
    block.reserve(2 * list + std::size_t{count} * sizeof(std::uint32_t));
    objects = reinterpret_cast<PlacedObject*>(block.data());
    spare = reinterpret_cast<PlacedObject*>(block.data() + list);
    cells = reinterpret_cast<std::uint32_t*>(block.data() + 2 * list);
  }
};

/// Writes those of the scene's objects that can be hit to `to`; in parts, which are brought together.
ObjectCensus place_all(const SceneObjects& objects, PlacedObject* to, unsigned threads) {
  std::vector<ObjectCensus> census(threads);
  for_each_part(threads, [&](unsigned part) {
    const HostPart mine(objects.count(), part, threads);
    census[part] = objects.place(mine.begin, mine.end, to + mine.begin);
  });
  for (unsigned part = 1; part < threads; ++part) {
    const PlacedObject* from = to + HostPart(objects.count(), part, threads).begin;
    std::copy(from, from + census[part].objects, to + census[0].objects);
    census[0].add(census[part]);
  }
  return census[0];
}

/// A box around everything, a little larger than it is.
Aabb bounds_of(Aabb all) {
  if (all.min[0] > all.max[0]) return {{0, 0, 0}, {1, 1, 1}};
  float largest = 0;
  for (int i = 0; i < 3; ++i)
    largest = std::max({largest, all.max[i] - all.min[i], std::abs(all.min[i]), std::abs(all.max[i])});
  for (int i = 0; i < 3; ++i) {
    all.min[i] -= largest * 1e-5f;
    all.max[i] += largest * 1e-5f;
  }
  return all;
}

/// Appends tables to a block whose size is known afterwards.
class Layout {
public:
  explicit Layout(std::size_t begin) : end_(begin) {}
  template <class Record>
  void place(std::size_t count, std::uint32_t& offset_field, std::uint32_t& count_field) {
    static_assert(consists_of_words<Record>(), "SharedImage converts tables word by word");
    offset_field = static_cast<std::uint32_t>(end_);
    count_field = static_cast<std::uint32_t>(count);
    end_ = round_up(end_ + count * sizeof(Record));
    if (end_ > std::numeric_limits<std::uint32_t>::max())
      throw InputError("the scene is too large: its image would pass 4 GB");
  }
  std::size_t end() const { return end_; }

private:
  std::size_t end_;
};

/// How many records are before those of other objects for ones without bounds: whole lines.
std::uint32_t room_of_unbounded(std::uint32_t count) {
  constexpr std::uint32_t kPerLine = kLineBytes / sizeof(ObjectRecord);
  return (count + kPerLine - 1) / kPerLine * kPerLine;
}

/// `has_blends`: some surfaces are of several materials.
std::uint32_t light_ways_of(const Scene& scene, const TextureTables& textures, bool has_blends) {
  std::uint32_t ways = scene.fogs.empty() && textures.rainbows.empty() ? 0 : light_way::atmosphere;
  for (const Interior& interior : scene.interiors) {
    const InteriorRecord r = make_record(interior);
    if (r.inverse_fade_distance != 0) ways |= light_way::fading | light_way::stepwise;
    if (r.caustics != 0) ways |= light_way::stepwise;
  }
  if (textures.has_clear_side || textures.filters_by_surface) ways |= light_way::stepwise;
  if (has_blends && textures.by_surface && textures.filters) ways |= light_way::stepwise;
  if (textures.by_surface) ways |= light_way::by_surface;
  for (const Light& light : scene.lights) {
    if (light.is_dimmed_by_fog && !scene.fogs.empty()) ways |= light_way::stepwise;
    if (light.projected_through) ways |= light_way::projectors;
  }
  return ways;
}

/// Of all objects, but for their bounds; `groups` are those of the objects that are no instances.
ImageHeader make_header(const Scene& scene, const LightSets& light_sets, const TextureTables& textures,
                        const SceneObjects& objects, const ObjectCensus& census,
                        std::span<const std::uint32_t> groups, const MeshInstances& instances) {
  ImageHeader header{};
  header.magic = kImageMagic;
  header.version = kImageVersion;
  Layout layout(sizeof(ImageHeader));
  layout.place<LightRecord>(scene.lights.size(), header.light_offset, header.light_count);
  header.light_set_count = light_sets.count();
  layout.place<std::uint32_t>(light_sets.words().size(), header.light_word_offset, header.light_word_count);
  layout.place<MaterialRecord>(textures.materials.size(), header.material_offset, header.material_count);
  layout.place<PatternRecord>(textures.patterns.size(), header.pattern_offset, header.pattern_count);
  layout.place<SpaceStepRecord>(textures.steps.size(), header.space_step_offset, header.space_step_count);
  layout.place<MapEntryRecord>(textures.entries.size(), header.map_entry_offset, header.map_entry_count);
  layout.place<NormalRecord>(textures.normals.size(), header.normal_offset, header.normal_count);
  layout.place<FeatureRecord>(textures.features.size(), header.feature_offset, header.feature_count);
  layout.place<GradientRecord>(textures.gradients.size(), header.gradient_offset, header.gradient_count);
  layout.place<WaveRecord>(textures.waves.size(), header.wave_offset, header.wave_count);
  layout.place<SlopeRecord>(textures.slopes.size(), header.slope_offset, header.slope_count);
  layout.place<BlendRecord>(census.blended, header.blend_offset, header.blend_count);
  layout.place<InteriorRecord>(scene.interiors.size(), header.interior_offset, header.interior_count);
  layout.place<FinishRecord>(textures.finishes.size(), header.finish_offset, header.finish_count);
  header.light_ways = light_ways_of(scene, textures, census.blended != 0);
  layout.place<FogRecord>(scene.fogs.size(), header.fog_offset, header.fog_count);
  layout.place<RainbowRecord>(textures.rainbows.size(), header.rainbow_offset, header.rainbow_count);
  const CsgParts& csg = objects.csg();
  layout.place<CsgRecord>(csg.conditions.size(), header.csg_offset, header.csg_count);
  layout.place<CsgStep>(csg.steps.size(), header.csg_step_offset, header.csg_step_count);
  layout.place<SolidRecord>(csg.solids.size(), header.solid_offset, header.solid_count);
  const MeshInsides& meshes = csg.meshes;
  layout.place<MeshGridRecord>(meshes.grids().size(), header.mesh_grid_offset, header.mesh_grid_count);
  layout.place<std::uint32_t>(meshes.words().size(), header.mesh_word_offset, header.mesh_word_count);
  layout.place<MeshTriangleRecord>(meshes.triangles().size(), header.mesh_triangle_offset,
                                   header.mesh_triangle_count);
  layout.place<PolygonEdgeRecord>(objects.polygons().edges().size(), header.polygon_edge_offset,
                                  header.polygon_edge_count);
  layout.place<ExtraRecord>(census.extras + objects.unbounded_extras(), header.extra_offset,
                            header.extra_count);
  const std::uint32_t room = room_of_unbounded(objects.unbounded_count() + objects.projector_count());
  layout.place<ObjectRecord>(std::size_t{census.objects} + room, header.object_offset, header.object_count);
  header.object_offset += room * std::uint32_t{sizeof(ObjectRecord)};
  header.object_count = census.objects;
  header.unbounded_count = objects.unbounded_count();
  header.projector_count = objects.projector_count();
  const std::size_t ordered = groups.empty() ? 0 : groups.size() - 1;
  layout.place<GroupRecord>(ordered + instances.group_count(), header.group_offset, header.group_count);
  layout.place<std::uint32_t>(instances.group_count() == 0 ? 0 : header.group_count, header.prototype_offset,
                              header.prototype_count);
  header.bytes = layout.end();
  header.sky = textures.sky == kNoOffset
                   ? kNoOffset
                   : header.material_offset + textures.sky * std::uint32_t{sizeof(MaterialRecord)};
  header.longest_group = instances.longest_group();
  for (std::size_t group = 0; group < ordered; ++group)
    header.longest_group = std::max(header.longest_group, groups[group + 1] - groups[group]);
  return header;
}

/// Puts the records of a scene where the header says.
class TableWriter {
public:
  TableWriter(std::byte* base, const ImageHeader& header, const Scene& scene, const TextureTables& textures,
              std::uint32_t unbounded_extras)
      : base_(base), header_(header), scene_(scene),
        unbounded_extras_(unbounded_extras), tables_{header.material_offset,
                                                     header.interior_offset,
                                                     header.extra_offset,
                                                     header.blend_offset,
                                                     header.csg_offset,
                                                     header.polygon_edge_offset,
                                                     table<ExtraRecord>(header.extra_offset),
                                                     table<BlendRecord>(header.blend_offset),
                                                     textures.object_flags} {
    // What lies between the tables is always the same.
    std::memset(base, 0, header.extra_offset);
    const std::size_t before_objects =
        kLineBytes +
        room_of_unbounded(header.unbounded_count + header.projector_count) * sizeof(ObjectRecord);
    std::memset(base + header.object_offset - before_objects, 0, before_objects);
    const std::size_t objects_end =
        header.object_offset + std::size_t{header.object_count} * sizeof(ObjectRecord);
    std::memset(base + objects_end, 0, header.bytes - objects_end);
    std::memcpy(base, &header, sizeof header);
  }

  void write_lights(const LightSets& sets, std::span<const std::uint32_t> projector_sizes) {
    std::uint32_t projector = first_projector();
    std::copy(sets.words().begin(), sets.words().end(), table<std::uint32_t>(header_.light_word_offset));
    for (std::size_t i = 0; i < scene_.lights.size(); ++i) {
      LightRecord record = make_record(scene_.lights[i]);
      if (const Index word = sets.first_words()[i]; word != kNoIndex) {
        record.kind_and_flags |= light_flag::selective;
        record.lit_sets = header_.light_word_offset + word * std::uint32_t{sizeof(std::uint32_t)};
      }
      if (scene_.lights[i].projected_through) {
        record.projector = projector;
        record.projector_count = projector_sizes.front();
        projector += projector_sizes.front() * std::uint32_t{sizeof(ObjectRecord)};
        projector_sizes = projector_sizes.subspan(1);
      }
      table<LightRecord>(header_.light_offset)[i] = record;
    }
  }

  void write_surfaces(TextureTables& textures) {
    textures.relocate(header_);
    const auto copy = [&](const auto& records, std::uint32_t offset) {
      std::copy(records.begin(), records.end(),
                table<typename std::decay_t<decltype(records)>::value_type>(offset));
    };
    copy(textures.materials, header_.material_offset);
    copy(textures.patterns, header_.pattern_offset);
    copy(textures.steps, header_.space_step_offset);
    copy(textures.entries, header_.map_entry_offset);
    copy(textures.normals, header_.normal_offset);
    copy(textures.finishes, header_.finish_offset);
    copy(textures.rainbows, header_.rainbow_offset);
    copy(textures.features, header_.feature_offset);
    copy(textures.gradients, header_.gradient_offset);
    copy(textures.waves, header_.wave_offset);
    copy(textures.slopes, header_.slope_offset);
    for (std::size_t i = 0; i < scene_.interiors.size(); ++i)
      table<InteriorRecord>(header_.interior_offset)[i] = make_record(scene_.interiors[i]);
    for (std::size_t i = 0; i < scene_.fogs.size(); ++i)
      table<FogRecord>(header_.fog_offset)[i] = make_record(scene_.fogs[i], scene_);
  }

  /// Indices become offsets.
  void write_csg(const CsgParts& csg) {
    const auto offset = [](std::uint32_t table, std::uint32_t index, std::size_t bytes) {
      return table + index * static_cast<std::uint32_t>(bytes);
    };
    for (std::size_t i = 0; i < csg.conditions.size(); ++i) {
      CsgRecord record = csg.conditions[i];
      record.next = record.next == kNoCondition ? kNoOffset
                                                : offset(header_.csg_offset, record.next, sizeof(CsgRecord));
      record.steps = offset(header_.csg_step_offset, record.steps, sizeof(CsgStep));
      table<CsgRecord>(header_.csg_offset)[i] = record;
    }
    for (std::size_t i = 0; i < csg.steps.size(); ++i) {
      CsgStep step = csg.steps[i];
      step.solid = offset(header_.solid_offset, step.solid, sizeof(SolidRecord));
      table<CsgStep>(header_.csg_step_offset)[i] = step;
    }
    for (std::size_t i = 0; i < csg.solids.size(); ++i) {
      SolidRecord solid = csg.solids[i];
      if (solid.object.kind_and_flags == kMeshSolid)
        solid.object.extra = offset(header_.mesh_grid_offset, solid.object.extra, sizeof(MeshGridRecord));
      table<SolidRecord>(header_.solid_offset)[i] = solid;
    }
    write_meshes(csg.meshes);
  }

  void write_polygons(const PolygonTable& polygons) {
    std::copy(polygons.edges().begin(), polygons.edges().end(),
              table<PolygonEdgeRecord>(header_.polygon_edge_offset));
  }

  void write_meshes(const MeshInsides& meshes) {
    constexpr auto kWord = static_cast<std::uint32_t>(sizeof(std::uint32_t));
    auto* words = table<std::uint32_t>(header_.mesh_word_offset);
    for (std::size_t i = 0; i < meshes.grids().size(); ++i) {
      MeshGridRecord grid = meshes.grids()[i];
      const std::uint32_t lists = grid.starts + grid.columns * grid.rows + 1;
      const std::uint32_t end = meshes.words()[lists - 1];
      for (std::uint32_t at = grid.starts; at < lists; ++at)
        words[at] = header_.mesh_word_offset + meshes.words()[at] * kWord;
      for (std::uint32_t at = lists; at < end; ++at)
        words[at] = header_.mesh_triangle_offset +
                    meshes.words()[at] * static_cast<std::uint32_t>(sizeof(MeshTriangleRecord));
      grid.starts = header_.mesh_word_offset + grid.starts * kWord;
      table<MeshGridRecord>(header_.mesh_grid_offset)[i] = grid;
    }
    std::copy(meshes.triangles().begin(), meshes.triangles().end(),
              table<MeshTriangleRecord>(header_.mesh_triangle_offset));
  }

  /// `before`: what the others have in tables.
  void write_unbounded(const SceneObjects& objects, const ObjectCensus& before) {
    objects.write_unbounded(tables_, before, table<ObjectRecord>(first_projector()));
  }

  /// `places` has room for a word per object.
  void write_objects(const SceneObjects& objects, std::span<const PlacedObject> placed, std::uint32_t* places,
                     unsigned threads) {
    // Without tables that grow with them objects are written in the scene's order: it takes fewer lines to
    // send records anywhere than to fetch triangles and vertices from there.
    const bool has_tables = header_.extra_count != 0 || header_.blend_count != 0;
    if (!has_tables) return send_objects(objects, placed, places, threads);
    std::vector<ObjectCensus> before(threads + 1);
    if (threads > 1)
      for_each_part(threads, [&](unsigned part) {
        before[part + 1] = objects.count_tables(part_of(placed, part, threads));
      });
    for (unsigned part = 1; part < threads; ++part)
      before[part].add(before[part - 1]);
    for_each_part(threads, [&](unsigned part) {
      const auto mine = part_of(placed, part, threads);
      objects.write(mine, tables_, before[part],
                    table<ObjectRecord>(header_.object_offset) + (mine.data() - placed.data()));
    });
  }

  /// Of objects that are no instances.
  void write_groups(std::span<const std::uint32_t> groups, unsigned threads) {
    if (groups.empty()) return;
    const auto* objects = table<ObjectRecord>(header_.object_offset);
    const auto count = static_cast<std::uint32_t>(groups.size()) - 1;
    if (header_.prototype_count != 0)
      std::fill_n(table<std::uint32_t>(header_.prototype_offset), count, kNoGroup);
    for_each_part(threads, [&](unsigned part) {
      const HostPart mine(count, part, threads);
      for (std::uint32_t group = mine.begin; group < mine.end; ++group) {
        auto lanes = bvh::LaneAabb<Simd>::empty();
        for (std::uint32_t i = groups[group]; i < groups[group + 1]; ++i)
          lanes.grow(bvh::box_of<Simd>(objects[i], base_));
        bvh::Reference box;
        lanes.min.store(box.min); // over the words beside
        lanes.max.store(box.max);
        table<GroupRecord>(header_.group_offset)[group] = {{box.min[0], box.min[1], box.min[2]},
                                                           groups[group],
                                                           {box.max[0], box.max[1], box.max[2]},
                                                           groups[group + 1] - groups[group]};
      }
    });
  }

  /// Behind everything else.
  void write_instances(const MeshInstances& instances, unsigned threads) {
    if (instances.group_count() == 0) return;
    const std::uint32_t first_object = header_.object_count - instances.census().objects;
    const std::uint32_t first_group = header_.group_count - instances.group_count();
    instances.write({tables_, table<ObjectRecord>(header_.object_offset) + first_object, first_object,
                     first_instance_extra(instances), table<GroupRecord>(header_.group_offset) + first_group,
                     table<std::uint32_t>(header_.prototype_offset) + first_group, first_group},
                    threads);
  }

  /// ExtraRecords lie as objects do: of loose ones, of instances, of unbounded ones.
  std::uint32_t first_instance_extra(const MeshInstances& instances) const {
    return header_.extra_count - unbounded_extras_ - instances.census().extras;
  }

  /// At last. `around`: objects that are no instances.
  void write_bounds(Aabb around) {
    if (header_.prototype_count != 0)
      for (const GroupRecord& group :
           std::span(table<GroupRecord>(header_.group_offset), header_.group_count))
        around = united(
            around, {{group.min[0], group.min[1], group.min[2]}, {group.max[0], group.max[1], group.max[2]}});
    const Aabb bounds = bounds_of(around);
    auto& header = *reinterpret_cast<ImageHeader*>(base_);
    std::copy(bounds.min, bounds.min + 3, header.bounds_min);
    std::copy(bounds.max, bounds.max + 3, header.bounds_max);
  }

private:
  std::uint32_t first_projector() const {
    return header_.object_offset -
           (header_.unbounded_count + header_.projector_count) * std::uint32_t{sizeof(ObjectRecord)};
  }

  void send_objects(const SceneObjects& objects, std::span<const PlacedObject> placed, std::uint32_t* places,
                    unsigned threads) {
    std::fill_n(places, objects.count(), SceneObjects::kNoPlace);
    for (std::uint32_t i = 0; i < placed.size(); ++i)
      places[placed[i].source] = i;
    for_each_part(threads, [&](unsigned part) {
      const HostPart mine(objects.count(), part, threads);
      objects.write_apart(mine.begin, mine.end, places, tables_, table<ObjectRecord>(header_.object_offset));
    });
  }

  template <class Record> Record* table(std::uint32_t offset) const {
    return reinterpret_cast<Record*>(base_ + offset);
  }
  static std::span<const PlacedObject> part_of(std::span<const PlacedObject> all, unsigned part,
                                               unsigned parts) {
    const HostPart mine(static_cast<std::uint32_t>(all.size()), part, parts);
    return all.subspan(mine.begin, mine.end - mine.begin);
  }

  std::byte* base_;
  const ImageHeader& header_;
  const Scene& scene_;
  std::uint32_t unbounded_extras_;
  RecordTables tables_;
};

} // namespace

SceneImage::SceneImage(const Scene& scene) {
  AlignedBlock work;
  assign(scene, work, 1);
}

void SceneImage::assign(const Scene& given, AlignedBlock& work, unsigned threads,
                        std::uint32_t objects_a_thread) {
  validate(given);
  const SceneWithProjectors with_projectors(given);
  const Scene& scene = with_projectors.scene();
  TextureTables textures(scene);
  const MeshInstances instances(scene, textures.object_flags, threads);
  const SceneObjects objects(scene, with_projectors.own_objects(), textures.objects, textures.object_flags,
                             instances, threads);
  const std::uint64_t all = std::uint64_t{objects.count()} + instances.census().objects;
  threads = static_cast<unsigned>(std::clamp<std::uint64_t>(all / objects_a_thread, 1, threads));
  const OrderMemory memory(work, objects.count());
  const ObjectCensus loose = place_all(objects, memory.objects, threads);
  std::vector<std::uint32_t> groups;
  if (loose.objects != 0 && (loose.objects >= kMinObjectsToOrder || instances.group_count() != 0))
    groups = order_along_curve(memory.objects, memory.spare, memory.cells, loose.objects, threads);
  ObjectCensus census = loose;
  census.add(instances.census());
  const LightSets light_sets(scene);
  const ImageHeader header = make_header(scene, light_sets, textures, objects, census, groups, instances);

  block_.reserve(header.bytes + bvh_bytes(header));
  TableWriter writer(block_.data(), header, scene, textures, objects.unbounded_extras());
  writer.write_lights(light_sets, objects.projector_sizes());
  writer.write_surfaces(textures);
  writer.write_csg(objects.csg());
  writer.write_polygons(objects.polygons());
  writer.write_objects(objects, {memory.objects, loose.objects}, memory.cells, threads);
  writer.write_groups(groups, threads);
  writer.write_instances(instances, threads);
  writer.write_unbounded(objects, census);
  writer.write_bounds(loose.around);
}

void SceneImage::reserve_accelerator(std::uint64_t table_bytes, std::uint32_t list_words) {
  const std::size_t begin = header().bytes;
  const std::size_t lists = round_up(begin + table_bytes);
  const std::size_t end = round_up(lists + std::size_t{list_words} * sizeof(std::uint32_t));
  if (end > std::numeric_limits<std::uint32_t>::max())
    throw InputError("the scene is too large: its image would pass 4 GB");
  if (end > block_.size()) {
    AlignedBlock larger = AlignedBlock::uninitialised(end);
    std::memcpy(larger.data(), block_.data(), begin);
    block_ = std::move(larger);
  }
  table_offset_ = static_cast<std::uint32_t>(begin);
  list_offset_ = static_cast<std::uint32_t>(lists);
  end_offset_ = static_cast<std::uint32_t>(end);
}

const ImageHeader& SceneImage::header() const noexcept {
  return *reinterpret_cast<const ImageHeader*>(block_.data());
}

} // namespace celltrace

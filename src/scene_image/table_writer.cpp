#include "scene_image/table_writer.hpp"

#include "celltrace/spe/simd_host.hpp"
#include "kernel/direct/build_bvh_bounds.hpp"
#include "scene/parallel.hpp"
#include "scene/progress_monitor.hpp"
#include "scene_image/image_layout.hpp"
#include "scene_image/surface_records.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <type_traits>
#include <vector>

namespace celltrace {

using namespace kernel;

namespace {

using Simd = HostSimd<BaselineArch>;

/// Returns slightly enlarged bounds, or a unit box if the bounds are empty.
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

std::span<const PlacedObject> part_of(std::span<const PlacedObject> all, unsigned part, unsigned parts) {
  const HostPart mine(static_cast<std::uint32_t>(all.size()), part, parts);
  return all.subspan(mine.begin, mine.end - mine.begin);
}

} // namespace

TableWriter::TableWriter(std::byte* base, const ImageHeader& header, const Scene& scene,
                         const TextureTables& textures, std::uint32_t other_extras)
    : base_(base), header_(header), scene_(scene),
      other_extras_(other_extras), tables_{scene,
                                           header.material_offset,
                                           header.interior_offset,
                                           header.extra_offset,
                                           header.blend_offset,
                                           header.csg_offset,
                                           header.shape_data_offset,
                                           header.instance_offset,
                                           table<ExtraRecord>(header.extra_offset),
                                           table<BlendRecord>(header.blend_offset),
                                           textures.object_flags} {
}

void TableWriter::write_header() {
  std::memset(base_, 0, header_.extra_offset);
  const std::size_t before_objects =
      kLineBytes +
      room_of_unbounded(header_.unbounded_count + header_.projector_count) * sizeof(ObjectRecord);
  std::memset(base_ + header_.object_offset - before_objects, 0, before_objects);
  const std::size_t objects_end =
      header_.object_offset + std::size_t{header_.object_count} * sizeof(ObjectRecord);
  std::memset(base_ + objects_end, 0, header_.bytes - objects_end);
  std::memcpy(base_, &header_, sizeof header_);
}

void TableWriter::write_lights(const LightSets& sets, std::span<const std::uint32_t> projector_sizes) {
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

void TableWriter::write_surfaces(TextureTables& textures) {
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
  copy(textures.function_steps, header_.function_step_offset);
  copy(textures.pictures, header_.picture_offset);
  copy(textures.texel_tiles, header_.texel_tile_offset);
  auto* const interiors = table<InteriorRecord>(header_.interior_offset);
  for (std::size_t i = 0; i < scene_.interiors.size(); ++i)
    interiors[i] = make_record(scene_.interiors[i]);
  std::fill(interiors + scene_.interiors.size(), interiors + header_.interior_count, make_record(Interior()));
  for (std::size_t i = 0; i < scene_.fogs.size(); ++i)
    table<FogRecord>(header_.fog_offset)[i] = make_record(scene_.fogs[i], scene_);
}

void TableWriter::write_csg(const CsgParts& csg) {
  const auto offset = [](std::uint32_t table, std::uint32_t index, std::size_t bytes) {
    return table + index * static_cast<std::uint32_t>(bytes);
  };
  for (std::size_t i = 0; i < csg.conditions.size(); ++i) {
    CsgRecord record = csg.conditions[i];
    record.next =
        record.next == kNoCondition ? kNoOffset : offset(header_.csg_offset, record.next, sizeof(CsgRecord));
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
    if (solid.object.kind_and_flags == kCrossedMeshSolid)
      solid.object.extra = offset(header_.crossed_mesh_offset, solid.object.extra, sizeof(CrossedMeshRecord));
    if (Primitives::is_made_of_data(solid.object.kind_and_flags & object_flag::kind_mask)) {
      ShapeData data = ShapeData::of(solid.extra);
      data.first = offset(header_.shape_data_offset, data.first, sizeof(ShapeDataRecord));
      data.put_in(solid.extra);
    }
    table<SolidRecord>(header_.solid_offset)[i] = solid;
  }
  write_meshes(csg.meshes);
  auto* crossed = table<CrossedMeshRecord>(header_.crossed_mesh_offset);
  for (CrossedMeshRecord record : csg.crossed_meshes.records()) {
    record.next = offset(header_.crossed_mesh_offset, record.next, sizeof record);
    *crossed++ = record;
  }
}

void TableWriter::write_shape_data(const ShapeDataTable& shape_data) {
  std::copy(shape_data.records().begin(), shape_data.records().end(),
            table<ShapeDataRecord>(header_.shape_data_offset));
}

void TableWriter::write_meshes(const MeshInsides& meshes) {
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

void TableWriter::write_unbounded(const SceneObjects& objects, const ObjectCounts& before) {
  objects.write_unbounded(tables_, before, table<ObjectRecord>(first_projector()));
}

void TableWriter::write_objects(const SceneObjects& objects, std::span<const PlacedObject> placed,
                                std::uint32_t* places, unsigned threads) {
  // If no other table depends on the order, objects are written in the order of the scene: writing records to
  // scattered places touches fewer cache lines than reading scattered triangles and vertices.
  const bool has_tables = header_.extra_count != 0 || header_.blend_count != 0;
  if (!has_tables) {
    std::fill_n(places, objects.count(), SceneObjects::kNoPlace);
    for (std::uint32_t i = 0; i < placed.size(); ++i) {
      ProgressMonitor::check_cancelled(i);
      places[placed[i].source] = i;
    }
    return send_objects(objects, {places, objects.count()}, threads);
  }
  std::vector<ObjectCounts> before(threads + 1);
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

void TableWriter::write_groups(std::span<const std::uint32_t> groups, unsigned threads) {
  if (groups.empty()) return;
  const auto* objects = table<ObjectRecord>(header_.object_offset);
  const auto count = static_cast<std::uint32_t>(groups.size()) - 1;
  if (header_.prototype_count != 0)
    std::fill_n(table<std::uint32_t>(header_.prototype_offset), count, kNoGroup);
  for_each_part(threads, [&](unsigned part) {
    const HostPart mine(count, part, threads);
    for (std::uint32_t group = mine.begin; group < mine.end; ++group) {
      ProgressMonitor::check_cancelled(group);
      auto lanes = bvh::LaneAabb<Simd>::empty();
      for (std::uint32_t i = groups[group]; i < groups[group + 1]; ++i)
        lanes.grow(bvh::box_of<Simd>(objects[i], base_));
      bvh::Reference box;
      lanes.min.store(box.min); // also writes the neighbouring words
      lanes.max.store(box.max);
      table<GroupRecord>(header_.group_offset)[group] = {{box.min[0], box.min[1], box.min[2]},
                                                         groups[group],
                                                         {box.max[0], box.max[1], box.max[2]},
                                                         groups[group + 1] - groups[group]};
    }
  });
}

void TableWriter::write_instances(const MeshInstances& instances, unsigned threads) {
  if (instances.group_count() == 0) return;
  const std::uint32_t first_object = header_.object_count - instances.counts().objects;
  const std::uint32_t first_group = header_.group_count - instances.group_count();
  instances.write({tables_, table<ObjectRecord>(header_.object_offset) + first_object, first_object,
                   first_instance_extra(instances), table<GroupRecord>(header_.group_offset) + first_group,
                   table<std::uint32_t>(header_.prototype_offset) + first_group, first_group},
                  threads);
}

void TableWriter::write_instanced(const InstancedMeshes& instanced) {
  instanced.write({tables_, table<InstanceRecord>(header_.instance_offset),
                   table<ObjectRecord>(header_.mesh_object_offset), header_.mesh_object_offset,
                   table<NodeRecord>(header_.mesh_node_offset), header_.mesh_node_offset,
                   header_.extra_count - instanced.extra_count()});
}

/// Returns the index of the instances' first ExtraRecord. The table has the ExtraRecords of ordinary objects
/// first, then of instances, of projectors and unbounded objects, and of meshes that instances share.
std::uint32_t TableWriter::first_instance_extra(const MeshInstances& instances) const {
  return header_.extra_count - other_extras_ - instances.counts().extras;
}

void TableWriter::write_bounds(Aabb around) {
  if (header_.prototype_count != 0)
    for (const GroupRecord& group : std::span(table<GroupRecord>(header_.group_offset), header_.group_count))
      around = united(
          around, {{group.min[0], group.min[1], group.min[2]}, {group.max[0], group.max[1], group.max[2]}});
  const Aabb bounds = bounds_of(around);
  auto& header = *reinterpret_cast<ImageHeader*>(base_);
  std::copy(bounds.min, bounds.min + 3, header.bounds_min);
  std::copy(bounds.max, bounds.max + 3, header.bounds_max);
}

std::uint32_t TableWriter::first_projector() const {
  return header_.object_offset -
         (header_.unbounded_count + header_.projector_count) * std::uint32_t{sizeof(ObjectRecord)};
}

std::optional<ObjectCounts> TableWriter::send_placed(const SceneObjects& objects,
                                                     std::span<const std::uint32_t> places,
                                                     std::uint32_t begin, std::uint32_t end) {
  return objects.write_placed(begin, end, places, tables_, table<ObjectRecord>(header_.object_offset));
}

void TableWriter::send_objects(const SceneObjects& objects, std::span<const std::uint32_t> places,
                               unsigned threads) {
  for_each_part(threads, [&](unsigned part) {
    const HostPart mine(objects.count(), part, threads);
    objects.write_apart(mine.begin, mine.end, places, tables_, table<ObjectRecord>(header_.object_offset));
  });
}

} // namespace celltrace

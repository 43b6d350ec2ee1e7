// Writes the tables of a scene image.
#pragma once

#include "celltrace/scene.hpp"
#include "records/image.hpp"
#include "scene_image/csg_parts.hpp"
#include "scene_image/instanced_meshes.hpp"
#include "scene_image/light_sets.hpp"
#include "scene_image/mesh_instances.hpp"
#include "scene_image/object_order.hpp"
#include "scene_image/object_records.hpp"
#include "scene_image/polygon_table.hpp"
#include "scene_image/scene_objects.hpp"
#include "scene_image/textures.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace celltrace {

/// Puts the records of a scene where the header says. Everything that it is given stays as it is as long as
/// it lives.
class TableWriter {
public:
  /// `other_extras`: ExtraRecords behind those of objects that an accelerator has.
  TableWriter(std::byte* base, const kernel::ImageHeader& header, const Scene& scene,
              const TextureTables& textures, std::uint32_t other_extras);

  /// The header, and zeros for all but objects: what lies between the tables is always the same.
  void write_header();
  void write_lights(const LightSets& sets, std::span<const std::uint32_t> projector_sizes);
  void write_surfaces(TextureTables& textures);
  /// Indices become offsets.
  void write_csg(const CsgParts& csg);
  void write_polygons(const PolygonTable& polygons);
  /// `before`: what the others have in tables.
  void write_unbounded(const SceneObjects& objects, const ObjectCensus& before);
  /// `placed`: those that are no instances, in the order of the image. `places` has room for a word per
  /// object.
  void write_objects(const SceneObjects& objects, std::span<const PlacedObject> placed, std::uint32_t* places,
                     unsigned threads);
  /// The same for objects without records in other tables. `places`: by object where it is among them, or
  /// kNoPlace.
  void send_objects(const SceneObjects& objects, std::span<const std::uint32_t> places, unsigned threads);
  /// Those of [begin, end) of the scene as they are counted: see SceneObjects::write_placed().
  std::optional<ObjectCensus> send_placed(const SceneObjects& objects, std::span<const std::uint32_t> places,
                                          std::uint32_t begin, std::uint32_t end);
  /// Of objects that are no instances.
  void write_groups(std::span<const std::uint32_t> groups, unsigned threads);
  void write_instanced(const InstancedMeshes& instanced);
  /// Behind everything else.
  void write_instances(const MeshInstances& instances, unsigned threads);
  /// At last. `around`: objects that are no instances.
  void write_bounds(kernel::Aabb around);

private:
  void write_meshes(const MeshInsides& meshes);
  std::uint32_t first_instance_extra(const MeshInstances& instances) const;
  std::uint32_t first_projector() const;
  template <class Record> Record* table(std::uint32_t offset) const {
    return reinterpret_cast<Record*>(base_ + offset);
  }

  std::byte* base_;
  const kernel::ImageHeader& header_;
  const Scene& scene_;
  std::uint32_t other_extras_;
  RecordTables tables_;
};

} // namespace celltrace

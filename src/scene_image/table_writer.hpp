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
#include "scene_image/shape_data_table.hpp"
#include "scene_image/scene_objects.hpp"
#include "scene_image/textures.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace celltrace {

/// Writes the records of a scene at the offsets in the header. The constructor's arguments must not change
/// while this object lives.
class TableWriter {
public:
  /// Begins an image at `base`. `other_extras` is the number of ExtraRecords behind those of objects in the
  /// accelerator.
  TableWriter(std::byte* base, const kernel::ImageHeader& header, const Scene& scene,
              const TextureTables& textures, std::uint32_t other_extras);

  /// Writes the header, and sets everything but objects to zero, so that the gaps between tables always hold
  /// the same bytes.
  void write_header();
  void write_lights(const LightSets& sets, std::span<const std::uint32_t> projector_sizes);
  void write_surfaces(TextureTables& textures);
  /// Writes the tables of CSG, in which offsets replace indices.
  void write_csg(const CsgParts& csg);
  void write_shape_data(const ShapeDataTable& shape_data);
  /// Writes projectors and objects without bounds; `before` counts the entries of other tables in front of
  /// theirs.
  void write_unbounded(const SceneObjects& objects, const ObjectCounts& before);
  /// Writes the objects `placed`, which are no instances, in the order of the image. `places` is work memory
  /// of one word per object.
  void write_objects(const SceneObjects& objects, std::span<const PlacedObject> placed, std::uint32_t* places,
                     unsigned threads);
  /// Writes the objects, which must need no other tables. `places` has for each object its place in the
  /// image, or kNoPlace.
  void send_objects(const SceneObjects& objects, std::span<const std::uint32_t> places, unsigned threads);
  /// Writes the objects of [begin, end) of the scene while it counts them: see SceneObjects::write_placed().
  std::optional<ObjectCounts> send_placed(const SceneObjects& objects, std::span<const std::uint32_t> places,
                                          std::uint32_t begin, std::uint32_t end);
  void write_groups(std::span<const std::uint32_t> groups, unsigned threads);
  void write_instanced(const InstancedMeshes& instanced);
  /// Writes the instances, which come behind all other objects.
  void write_instances(const MeshInstances& instances, unsigned threads);
  /// Writes the bounds of all objects, as the last step. `around` are the bounds of the objects that are no
  /// instances.
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

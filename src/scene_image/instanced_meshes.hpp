// Meshes that the scene image holds once, however many objects consist of them.
#pragma once

#include "celltrace/scene.hpp"
#include "records/accelerator.hpp"
#include "records/instance.hpp"
#include "records/object.hpp"
#include "scene_image/mesh_prototype.hpp"
#include "scene_image/object_records.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace celltrace {

/// The tables to which the records of shared meshes and their instances are written.
struct InstancedMeshTables {
  RecordTables records;
  kernel::InstanceRecord* instances;
  kernel::ObjectRecord* objects;
  std::uint32_t object_offset;
  kernel::NodeRecord* nodes;
  std::uint32_t node_offset;
  std::uint32_t first_extra; ///< index of the meshes' first record in the table of all extra records
};

class InstancedMeshes {
public:
  /// An object that consists of a shared mesh.
  struct Instance {
    const Object* object;
    std::uint32_t mesh;
    std::uint32_t first_number; ///< number of the instance's first triangle
    kernel::Aabb box;           ///< bounds in the world
  };

  /// Finds the instances among the first `objects` objects of `scene`, which must be valid and must not
  /// change while this object lives. There are instances only if copies of all meshes would have so many
  /// triangles that transforming rays to each mesh's space is cheaper. `material_flags` are the object flags
  /// of each material. Throws InputError if there are too many triangles, or if coordinates exceed the range
  /// of single precision.
  InstancedMeshes(const Scene& scene, std::size_t objects, const std::vector<std::uint32_t>& material_flags,
                  unsigned threads);

  /// Returns whether an object of the scene is an instance.
  bool contains(std::size_t object) const {
    return object < instance_of_.size() && instance_of_[object] != kNoIndex;
  }
  /// Returns the instance of an object of the scene; null if the object is no instance.
  const Instance* find(const Object& object) const {
    const auto index = static_cast<std::size_t>(&object - objects_);
    return contains(index) ? &instances_[instance_of_[index]] : nullptr;
  }

  std::uint32_t instance_count() const { return static_cast<std::uint32_t>(instances_.size()); }
  std::uint32_t object_count() const { return object_count_; }
  std::uint32_t extra_count() const { return extra_count_; }
  std::uint32_t node_count() const { return node_count_; }

  /// Returns the record of an instance's object, with the offset of its InstanceRecord and its box.
  /// `table_offset` is the offset of the first InstanceRecord.
  kernel::ExtraRecord extra_of(const Instance& instance, std::uint32_t table_offset) const;
  void write(const InstancedMeshTables& tables) const;

private:
  struct SharedMesh {
    MeshPrototype prototype;
    std::vector<kernel::NodeRecord> nodes;
    std::uint32_t first_object, first_extra, first_node;
  };

  void add_mesh(MeshPrototype&& prototype);
  void add_instance(const Object& object, std::uint32_t mesh);
  void write(const SharedMesh& mesh, const InstancedMeshTables& tables) const;
  kernel::InstanceRecord record_of(const Instance& instance, const InstancedMeshTables& tables) const;

  const Object* objects_;
  std::vector<SharedMesh> meshes_;
  std::vector<Instance> instances_;
  std::vector<Index> instance_of_; ///< index: object of the scene; index in instances_, or kNoIndex
  std::uint32_t object_count_ = 0, extra_count_ = 0, node_count_ = 0;
  std::uint32_t next_number_ = 1;
};

} // namespace celltrace

// Objects that are copies of one mesh: what depends on the mesh alone is worked out once.
#pragma once

#include "celltrace/scene.hpp"
#include "records/accelerator.hpp"
#include "records/object.hpp"
#include "scene_image/instanced_meshes.hpp"
#include "scene_image/mesh_prototype.hpp"
#include "scene_image/object_records.hpp"

#include <cstdint>
#include <vector>

namespace celltrace {

/// Where the records of instances go, and where they lie in the tables.
struct InstanceTables {
  RecordTables records;
  kernel::ObjectRecord* objects; ///< of instances
  std::uint32_t first_object;    ///< in the table of all
  std::uint32_t first_normals;
  kernel::GroupRecord* groups; ///< of instances
  std::uint32_t* prototypes;   ///< a word per group of instances
  std::uint32_t first_group;   ///< in the table of all
};

class MeshInstances {
public:
  /// Those of `scene`, which is valid and stays as it is as long as this lives, that are not among
  /// `instanced`: meshes that are worth while to share, placed at least twice, such that each triangle with
  /// an area keeps one, and whose materials do not ask for surface coordinates that the mesh has. None in a
  /// scene of few triangles. `material_flags`: what objects have that consist of a material. Throws
  /// InputError if an object's coordinates leave what single precision can hold, or if there are too many
  /// objects.
  MeshInstances(const Scene& scene, const InstancedMeshes& instanced,
                const std::vector<std::uint32_t>& material_flags, unsigned threads);

  /// Whether an object of the scene is among them.
  bool contains(std::size_t object) const { return !is_instance_.empty() && is_instance_[object]; }
  /// What all of them have, but for the box around.
  const ObjectCensus& census() const { return census_; }
  std::uint32_t group_count() const { return group_count_; }
  std::uint32_t longest_group() const { return longest_group_; }

  /// Appends the object of the scene that each of their records is of, in the order of write().
  void append_owners(std::vector<Index>& owners) const;

  /// Makes the records of all of them, instance by instance in the order of the scene, and group by group.
  void write(const InstanceTables& tables, unsigned threads) const;

private:
  struct Instance {
    const Object* object;
    std::uint32_t prototype;
    bool is_sound;                                          ///< keeps_areas()
    std::uint32_t first_object, first_normals, first_group; ///< among those of all instances
  };
  class Writer;

  void find(const Scene& scene, const InstancedMeshes& instanced,
            const std::vector<std::uint32_t>& material_flags, unsigned threads);
  bool keeps_areas(const Instance& instance) const;
  bool are_tangled() const;
  void number();

  const Scene& scene_;
  std::vector<MeshPrototype> prototypes_;
  std::vector<Instance> instances_;
  std::vector<std::uint32_t> first_group_of_; ///< by prototype: of its first instance
  std::vector<bool> is_instance_;             ///< by object
  ObjectCensus census_;
  std::uint32_t group_count_ = 0;
  std::uint32_t longest_group_ = 0;
};

} // namespace celltrace

// Objects that are copies of one mesh. Values that depend on the mesh alone are computed once for all copies.
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

/// The tables to which the records of instances are written, and the places of the records in these tables.
struct InstanceTables {
  RecordTables records;
  kernel::ObjectRecord* objects; ///< records of instances
  std::uint32_t first_object;    ///< index of `objects` in the table of all objects
  std::uint32_t first_normals;
  kernel::GroupRecord* groups; ///< groups of instances
  std::uint32_t* prototypes;   ///< for each group of instances, the index of the group that it copies
  std::uint32_t first_group;   ///< index of `groups` in the table of all groups
};

class MeshInstances {
public:
  /// Finds the instances in `scene`, which must be valid and must not change while this object lives; objects
  /// in `instanced` are not among them. An instance is an object with a mesh that is large enough to be
  /// shared and that at least two objects have. The mesh's triangles must keep their areas in the object's
  /// place, and its materials must not read surface coordinates that the mesh has. A scene of few triangles
  /// has no instances. `material_flags` are the object flags of each material. Throws InputError if an
  /// object's coordinates exceed the range of single precision, or if there are too many objects.
  MeshInstances(const Scene& scene, const InstancedMeshes& instanced,
                const std::vector<std::uint32_t>& material_flags, unsigned threads);

  /// Returns whether an object of the scene is an instance.
  bool contains(std::size_t object) const { return !is_instance_.empty() && is_instance_[object]; }
  /// Returns the counts of all instances' records, without bounds.
  const ObjectCounts& counts() const { return counts_; }
  std::uint32_t group_count() const { return group_count_; }
  std::uint32_t longest_group() const { return longest_group_; }

  /// Appends for each record, in the order of write(), the index of the scene's object that it belongs to.
  void append_owners(std::vector<Index>& owners) const;

  /// Writes the records of all instances, in the order of the scene, and each instance group by group.
  void write(const InstanceTables& tables, unsigned threads) const;

private:
  struct Instance {
    const Object* object;
    std::uint32_t prototype;
    bool is_sound;                                          ///< result of preserves_areas()
    std::uint32_t first_object, first_normals, first_group; ///< indices among the records of all instances
  };
  class Writer;

  void find(const Scene& scene, const InstancedMeshes& instanced,
            const std::vector<std::uint32_t>& material_flags, unsigned threads);
  bool preserves_areas(const Instance& instance) const;
  bool are_tangled() const;
  void number();

  const Scene& scene_;
  std::vector<MeshPrototype> prototypes_;
  std::vector<Instance> instances_;
  std::vector<std::uint32_t> first_group_of_; ///< index: prototype; the first group of its first instance
  std::vector<bool> is_instance_;             ///< index: object of the scene
  ObjectCounts counts_;
  std::uint32_t group_count_ = 0;
  std::uint32_t longest_group_ = 0;
};

} // namespace celltrace

#include "scene_image/mesh_instances.hpp"

#include "celltrace/error.hpp"
#include "celltrace/spe/simd_host.hpp"
#include "geometry/triangles.hpp"
#include "kernel/direct/build_bvh_bounds.hpp"
#include "scene/parallel.hpp"
#include "scene/progress_monitor.hpp"
#include "scene_image/csg_parts.hpp"
#include "scene_image/object_order.hpp"
#include "scene_image/world_box.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <unordered_map>

#include <glm/common.hpp>

namespace celltrace {

using namespace kernel;

namespace {

using Simd = HostSimd<BaselineArch>;
using LaneAabb = bvh::LaneAabb<Simd>;

constexpr std::uint32_t kInstancesPerThread = 64;

/// Returns the mesh that an object consists of; null for any other object.
const Mesh* mesh_of(const Object& object) {
  if (CsgParts::contains(object)) return nullptr;
  const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&object.shape);
  return mesh != nullptr ? mesh->get() : nullptr;
}

/// Returns whether a material of a mesh reads surface coordinates that the mesh has.
bool has_mapped_triangles(const Mesh& mesh, Index material, const std::vector<std::uint32_t>& flags) {
  const auto asks = [&](Index index) {
    return (flags[index == kNoIndex ? material : index] & object_flag::by_surface) != 0;
  };
  return !mesh.coordinates.empty() &&
         std::any_of(mesh.triangles.begin(), mesh.triangles.end(),
                     [&](const Mesh::Triangle& triangle) { return asks(triangle.material[0]); });
}

Vec3f in_world(const Transform& transform, const Vec3f& vertex) {
  return Vec3f(transform.point(Vec3(vertex)));
}

/// Returns the number of objects in the image of a scene if all triangles have an area, else an upper bound.
std::uint64_t objects_of(const Scene& scene, const InstancedMeshes& instanced) {
  std::uint64_t count = 0;
  for (const Object& object : scene.objects) {
    const Mesh* mesh = instanced.find(object) == nullptr ? mesh_of(object) : nullptr;
    count += mesh != nullptr ? mesh->triangles.size() : 1;
  }
  return count;
}

} // namespace

MeshInstances::MeshInstances(const Scene& scene, const InstancedMeshes& instanced,
                             const std::vector<std::uint32_t>& material_flags, unsigned threads)
    : scene_(scene) {
  if (objects_of(scene, instanced) < kMinObjectsToOrder) return;
  find(scene, instanced, material_flags, threads);
  const auto count = static_cast<std::uint32_t>(instances_.size());
  const unsigned parts = std::clamp(count / kInstancesPerThread, 1u, threads);
  for_each_part(parts, [&](unsigned part) {
    const HostPart mine(count, part, parts);
    for (std::uint32_t i = mine.begin; i < mine.end; ++i) {
      ProgressMonitor::check_cancelled();
      instances_[i].is_sound = preserves_areas(instances_[i]);
    }
  });
  const auto is_unsound = [](const Instance& instance) { return !instance.is_sound; };
  instances_.erase(std::remove_if(instances_.begin(), instances_.end(), is_unsound), instances_.end());
  if (are_tangled()) instances_.clear();
  number();
}

void MeshInstances::find(const Scene& scene, const InstancedMeshes& instanced,
                         const std::vector<std::uint32_t>& material_flags, unsigned threads) {
  constexpr std::uint32_t kUnknown = 0xFFFFFFFF, kNone = 0xFFFFFFFE;
  struct Uses {
    std::uint32_t count = 0;
    std::uint32_t prototype = kUnknown;
  };
  std::unordered_map<const Mesh*, Uses> uses;
  for (const Object& object : scene.objects)
    if (const Mesh* mesh = mesh_of(object);
        mesh != nullptr && MeshPrototype::is_large_enough(*mesh) && instanced.find(object) == nullptr)
      ++uses[mesh].count;
  for (const Object& object : scene.objects) {
    if (instanced.find(object) != nullptr) continue;
    const auto found = uses.find(mesh_of(object));
    if (found == uses.end() || found->second.count < 2) continue;
    const Mesh& mesh = *found->first;
    if (has_mapped_triangles(mesh, object.material, material_flags)) continue;
    std::uint32_t& prototype = found->second.prototype;
    if (prototype == kUnknown) {
      prototype = kNone;
      if (MeshPrototype::can_be_made(mesh)) {
        prototype = static_cast<std::uint32_t>(prototypes_.size());
        prototypes_.emplace_back(mesh, threads);
      }
    }
    if (prototype != kNone) instances_.push_back({&object, prototype, false, 0, 0, 0});
  }
}

/// Returns whether all triangles of an instance keep an area. Throws InputError if single precision cannot
/// hold the coordinates.
bool MeshInstances::preserves_areas(const Instance& instance) const {
  const MeshPrototype& prototype = prototypes_[instance.prototype];
  const Transform& transform = instance.object->transform;
  if (prototype.surely_preserves_areas(transform)) return true;
  std::vector<Vec3f> world;
  for (const Vec3f& vertex : prototype.vertices()) {
    const Vec3f at = in_world(transform, vertex);
    check_size({{at.x, at.y, at.z}, {at.x, at.y, at.z}},
               static_cast<std::size_t>(instance.object - scene_.objects.data()));
    world.push_back(at);
  }
  const auto has_area_in_world = [&](const MeshPrototype::Triangle& triangle) {
    return has_area(world[triangle.vertex[0]], world[triangle.vertex[1]], world[triangle.vertex[2]]);
  };
  return std::all_of(prototype.triangles().begin(), prototype.triangles().end(), has_area_in_world);
}

/// Returns whether groups of instances overlap so much that rays become slow: the BVH does not split a group
/// where others reach into it. A ray hits about the cube root of n AABBs that fill a space without overlap,
/// and fewer AABBs if they lie on surfaces.
bool MeshInstances::are_tangled() const {
  constexpr double kMost = 1.5;
  double areas = 0;
  std::size_t groups = 0;
  WorldBox all;
  for (const Instance& instance : instances_) {
    for (const Aabb& group : prototypes_[instance.prototype].group_bounds()) {
      const WorldBox box(group, instance.object->transform);
      areas += box.area();
      all.grow(box);
    }
    groups += prototypes_[instance.prototype].group_count();
  }
  // `areas` and all.area() are halves of surfaces: by Crofton's formula their quotient is the mean number of
  // AABBs that a ray through the whole box hits.
  return groups != 0 && areas > kMost * std::cbrt(static_cast<double>(groups)) * all.area();
}

/// Counts the records of all instances, and sets the place of each instance's records.
void MeshInstances::number() {
  constexpr std::uint32_t kNone = 0xFFFFFFFF;
  is_instance_.resize(scene_.objects.size());
  first_group_of_.resize(prototypes_.size(), kNone);
  for (Instance& instance : instances_) {
    const MeshPrototype& prototype = prototypes_[instance.prototype];
    is_instance_[static_cast<std::size_t>(instance.object - scene_.objects.data())] = true;
    instance.first_object = counts_.objects;
    instance.first_normals = counts_.extras;
    instance.first_group = group_count_;
    std::uint32_t& first_group = first_group_of_[instance.prototype];
    if (first_group == kNone) {
      first_group = group_count_;
      for (std::uint32_t group = 0; group < prototype.group_count(); ++group)
        longest_group_ = std::max(longest_group_, prototype.groups()[group + 1] - prototype.groups()[group]);
    }
    const auto objects = static_cast<std::uint32_t>(prototype.triangles().size());
    if (objects > std::numeric_limits<std::uint32_t>::max() - counts_.objects)
      throw InputError("the scene is too large: it has more objects than 32 bits can count");
    counts_.objects += objects;
    counts_.extras += prototype.smooth();
    group_count_ += prototype.group_count();
  }
}

class MeshInstances::Writer {
  /// A vertex, padded with a word of 0.
  struct alignas(16) Vertex {
    float at[4];
  };

public:
  Writer(const MeshInstances& instances, const InstanceTables& tables)
      : instances_(instances), tables_(tables) {}

  void write(const Instance& instance) {
    const MeshPrototype& prototype = instances_.prototypes_[instance.prototype];
    start(instance, prototype);
    ObjectRecord* to = tables_.objects + instance.first_object;
    for (std::uint32_t group = 0; group < prototype.group_count(); ++group) {
      ProgressMonitor::check_cancelled(group);
      const std::uint32_t begin = prototype.groups()[group], end = prototype.groups()[group + 1];
      LaneAabb around = LaneAabb::empty();
      for (std::uint32_t i = begin; i < end; ++i)
        write(prototype.triangles()[i], to[i], around);
      const std::uint32_t number = instance.first_group + group;
      bvh::Reference box;
      around.min.store(box.min); // also writes the neighbouring words, which are set next
      around.max.store(box.max);
      tables_.groups[number] = {{box.min[0], box.min[1], box.min[2]},
                                tables_.first_object + instance.first_object + begin,
                                {box.max[0], box.max[1], box.max[2]},
                                end - begin};
      tables_.prototypes[number] =
          tables_.first_group + instances_.first_group_of_[instance.prototype] + group;
    }
  }

private:
  void start(const Instance& instance, const MeshPrototype& prototype) {
    object_ = instance.object;
    vertices_.clear();
    for (const Vec3f& vertex : prototype.vertices()) {
      ProgressMonitor::check_cancelled(vertices_.size());
      const Vec3f at = in_world(object_->transform, vertex);
      vertices_.push_back({{at.x, at.y, at.z, 0.0f}});
    }
    next_extra_ = tables_.first_normals + instance.first_normals;
    normals_.clear();
    if (!prototype.unit_normals().empty()) {
      const NormalTransform to_world(object_->transform);
      for (const Vec3& unit : prototype.unit_normals())
        normals_.push_back(to_world(unit));
    }
    set_material(kNoIndex);
  }

  void set_material(Index material) {
    material_ = material;
    head_ = start_record(*object_, static_cast<std::uint32_t>(ObjectKind::triangle), tables_.records);
    tables_.records.set_material(head_, material != kNoIndex ? material : object_->material);
    RecordTables::change_sides(head_, *object_);
  }

  void write(const MeshPrototype::Triangle& triangle, ObjectRecord& to, LaneAabb& around) {
    if (triangle.material != material_) set_material(triangle.material);
    to = head_;
    for (int corner = 0; corner < 3; ++corner) {
      const float(&at)[4] = vertices_[triangle.vertex[corner]].at;
      std::memcpy(to.geometry + 3 * corner, at,
                  sizeof at); // also writes the next word, where the next corner begins
      const auto lanes = Simd::F4::load(at);
      around.grow(lanes);
    }
    if (triangle.normal[0] != kNoIndex) write_normals(triangle, to);
    if (object_->is_hidden) {
      const float(&at)[4] = vertices_[triangle.vertex[0]].at;
      hide(to, {at[0], at[1], at[2]});
    }
  }

  void write_normals(const MeshPrototype::Triangle& triangle, ObjectRecord& to) {
    to.kind_and_flags |= object_flag::smooth;
    RecordTables::change_sides(to, *object_); // back: the outside is where the triangle's normals point
    to.extra = tables_.records.offset_of_extra(next_extra_);
    ExtraRecord record{};
    for (int corner = 0; corner < 3; ++corner)
      std::memcpy(record.value + 3 * corner, &normals_[triangle.normal[corner]], sizeof(Vec3f));
    tables_.records.extras[next_extra_++] = record;
  }

  const MeshInstances& instances_;
  const InstanceTables& tables_;
  const Object* object_ = nullptr;
  std::vector<Vertex> vertices_; ///< in the world
  std::vector<Vec3f> normals_;   ///< in the world
  std::uint32_t next_extra_ = 0;
  Index material_ = kNoIndex; ///< material of head_, as triangles name it
  ObjectRecord head_;         ///< record of a triangle with this material, without geometry
};

void MeshInstances::append_owners(std::vector<Index>& owners) const {
  for (const Instance& instance : instances_)
    owners.insert(owners.end(), prototypes_[instance.prototype].triangles().size(),
                  static_cast<Index>(instance.object - scene_.objects.data()));
}

void MeshInstances::write(const InstanceTables& tables, unsigned threads) const {
  for_each_part(threads, [&](unsigned part) {
    const HostPart mine(static_cast<std::uint32_t>(instances_.size()), part, threads);
    Writer writer(*this, tables);
    for (std::uint32_t i = mine.begin; i < mine.end; ++i) {
      ProgressMonitor::check_cancelled();
      writer.write(instances_[i]);
    }
  });
}

} // namespace celltrace

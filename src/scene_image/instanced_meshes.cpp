#include "scene_image/instanced_meshes.hpp"

#include "celltrace/error.hpp"
#include "geometry/triangles.hpp"
#include "scene/progress_monitor.hpp"
#include "scene_image/csg_parts.hpp"
#include "scene_image/mesh_bvh.hpp"
#include "scene_image/object_records.hpp"
#include "scene_image/shapes.hpp"
#include "scene_image/world_box.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>
#include <unordered_map>
#include <utility>

#include <glm/geometric.hpp>

namespace celltrace {

using namespace kernel;

namespace {

/// Limit on triangles in copies of meshes, not counting one copy of each mesh; scenes with more triangles
/// share meshes. Copies give rays tighter bounds and cheaper tests, but each copied triangle takes about 100
/// bytes, and 0.1 to 0.3 microseconds before the first ray. Larger: faster frames of scenes with some
/// instances. Smaller: less memory and a faster first frame of such scenes, and faster later frames where
/// instances reach into each other. Measure 'first frame' and 'trace time' of scenes with instances.
constexpr std::uint64_t kMostCopies = 500'000;
/// Least number of triangles of a shared mesh. Smaller meshes are always copied: transforming rays to their
/// space would be most of the work.
constexpr std::size_t kFewestTrianglesToShare = 128;

/// Returns the mesh of an object that is one large mesh, visible to all rays and lit by all global lights;
/// else null.
const Mesh* plain_mesh_of(const Object& object) {
  if (CsgParts::contains(object)) return nullptr;
  if (object.no_shadow || object.no_image || object.no_reflection || object.is_lit_through ||
      object.light_group != kNoIndex)
    return nullptr;
  const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&object.shape);
  return mesh != nullptr && (*mesh)->triangles.size() >= kFewestTrianglesToShare ? mesh->get() : nullptr;
}

/// Returns whether rays can be transformed to the mesh's space: the determinants of its triangles neither
/// vanish nor overflow there.
bool has_moderate_size(const MeshPrototype& mesh, const Transform& transform) {
  constexpr float kFarthest = 1e8f;
  constexpr double kLeastFactor = 1e-5, kMostFactor = 1e5;
  const auto is_near = [](float x) { return std::abs(x) < kFarthest; };
  const auto is_moderate = [&](const Vec3& axis) {
    const double factor = glm::length(axis);
    return factor > kLeastFactor && factor < kMostFactor;
  };
  return std::all_of(transform.rows, transform.rows + 3, is_moderate) &&
         std::all_of(mesh.group_bounds().begin(), mesh.group_bounds().end(), [&](const Aabb& box) {
           return std::all_of(box.min, box.min + 3, is_near) && std::all_of(box.max, box.max + 3, is_near);
         });
}

/// Returns slightly enlarged bounds, since rays and the geometry that they hit are rounded.
Aabb around(const WorldBox& box) {
  Aabb result{};
  for (int axis = 0; axis < 3; ++axis) {
    const double low = box.min()[axis], high = box.max()[axis];
    const double margin = 1e-6 * std::max({std::abs(low), std::abs(high), high - low});
    result.min[axis] = static_cast<float>(low - margin);
    result.max[axis] = static_cast<float>(high + margin);
  }
  return result;
}

Aabb bounds_of_triangle(const MeshPrototype& mesh, const MeshPrototype::Triangle& triangle) {
  const Vec3f &a = mesh.vertices()[triangle.vertex[0]], &b = mesh.vertices()[triangle.vertex[1]],
              &c = mesh.vertices()[triangle.vertex[2]];
  const Vec3f low = glm::min(a, glm::min(b, c)), high = glm::max(a, glm::max(b, c));
  return {{low.x, low.y, low.z}, {high.x, high.y, high.z}};
}

std::uint32_t sum_of(std::uint32_t a, std::size_t b) {
  if (b > std::numeric_limits<std::int32_t>::max() - a)
    throw InputError("the scene is too large: its meshes and their instances have more triangles than 31 "
                     "bits can count");
  return a + static_cast<std::uint32_t>(b);
}

/// The uses of a mesh: how many objects consist of it, and whether they share it.
struct MeshUses {
  std::uint32_t count = 0;
  bool is_shared = false;
  Index mesh = kNoIndex; ///< index in meshes_ if the mesh is shared
};

} // namespace

InstancedMeshes::InstancedMeshes(const Scene& scene, std::size_t objects,
                                 const std::vector<std::uint32_t>& material_flags, unsigned threads)
    : objects_(scene.objects.data()) {
  std::unordered_map<const Mesh*, MeshUses> uses;
  const auto mesh_of = [&](const Object& object) {
    const Mesh* const mesh = plain_mesh_of(object);
    return mesh != nullptr && is_plain(material_flags[object.material]) ? mesh : nullptr;
  };
  std::uint64_t triangles = 0;
  for (std::size_t i = 0; i < objects; ++i)
    if (const Mesh* mesh = mesh_of(scene.objects[i]); mesh != nullptr && ++uses[mesh].count > 1)
      triangles += mesh->triangles.size();
  if (triangles <= kMostCopies) return;

  const auto suits = [&](const Mesh::Triangle& triangle) {
    const Index material = triangle.material[0];
    return material == kNoIndex || is_plain(material_flags[material]);
  };
  triangles = 0;
  for (auto& [mesh, use] : uses) {
    use.is_shared = use.count > 1 && MeshPrototype::can_be_made(*mesh) &&
                    std::all_of(mesh->triangles.begin(), mesh->triangles.end(), suits);
    if (use.is_shared) triangles += std::uint64_t{use.count - 1} * mesh->triangles.size();
  }
  if (triangles <= kMostCopies) return;
  instance_of_.assign(objects, kNoIndex);
  for (std::size_t i = 0; i < objects; ++i) {
    ProgressMonitor::check_cancelled(i);
    const Object& object = scene.objects[i];
    const auto found = uses.find(mesh_of(object));
    if (found == uses.end() || !found->second.is_shared) continue;
    MeshUses& use = found->second;
    if (use.mesh == kNoIndex) {
      use.mesh = static_cast<Index>(meshes_.size());
      add_mesh(MeshPrototype(*found->first, threads));
    }
    const MeshPrototype& prototype = meshes_[use.mesh].prototype;
    if (prototype.triangles().empty() || !has_moderate_size(prototype, object.transform) ||
        !prototype.surely_preserves_areas(object.transform))
      continue;
    instance_of_[i] = instance_count();
    add_instance(object, use.mesh);
  }
}

void InstancedMeshes::add_mesh(MeshPrototype&& prototype) {
  std::vector<Aabb> bounds;
  bounds.reserve(prototype.triangles().size());
  for (const MeshPrototype::Triangle& triangle : prototype.triangles())
    bounds.push_back(bounds_of_triangle(prototype, triangle));
  SharedMesh mesh = {std::move(prototype), {}, object_count_, extra_count_, node_count_};
  if (!bounds.empty()) mesh.nodes = build_mesh_bvh(bounds);
  object_count_ = sum_of(object_count_, mesh.prototype.triangles().size());
  extra_count_ += mesh.prototype.smooth();
  node_count_ += static_cast<std::uint32_t>(mesh.nodes.size());
  meshes_.push_back(std::move(mesh));
}

void InstancedMeshes::add_instance(const Object& object, std::uint32_t mesh) {
  const MeshPrototype& prototype = meshes_[mesh].prototype;
  WorldBox box;
  for (const Aabb& group : prototype.group_bounds())
    box.grow(WorldBox(group, object.transform));
  instances_.push_back({&object, mesh, next_number_, around(box)});
  check_size(instances_.back().box, static_cast<std::size_t>(&object - objects_));
  next_number_ = sum_of(next_number_, prototype.triangles().size());
}

ExtraRecord InstancedMeshes::extra_of(const Instance& instance, std::uint32_t table_offset) const {
  ExtraRecord extra{};
  const auto number = static_cast<std::uint32_t>(&instance - instances_.data());
  const std::uint32_t offset = table_offset + number * std::uint32_t{sizeof(InstanceRecord)};
  std::memcpy(extra.value, &offset, sizeof offset);
  extra.csg = kNoOffset;
  std::copy(instance.box.min, instance.box.min + 3, extra.bounds);
  std::copy(instance.box.max, instance.box.max + 3, extra.bounds + 3);
  return extra;
}

InstanceRecord InstancedMeshes::record_of(const Instance& instance, const InstancedMeshTables& tables) const {
  const SharedMesh& mesh = meshes_[instance.mesh];
  const Object& object = *instance.object;
  ObjectRecord head = start_record(object, static_cast<std::uint32_t>(ObjectKind::triangle), tables.records);
  tables.records.set_material(head, object.material);
  InstanceRecord r{};
  write_map(object.transform, r.to_world);
  const NormalTransform to_world(object.transform);
  for (int column = 0; column < 3; ++column) {
    Vec3 axis(0);
    axis[column] = 1;
    const Vec3f to = to_world(axis);
    for (int row = 0; row < 3; ++row)
      r.normal_to_world[row * 3 + column] = to[row];
  }
  r.first_number = instance.first_number;
  r.triangle_count = static_cast<std::uint32_t>(mesh.prototype.triangles().size());
  r.first_triangle = tables.object_offset + mesh.first_object * std::uint32_t{sizeof(ObjectRecord)};
  r.root = tables.node_offset + mesh.first_node * std::uint32_t{sizeof(NodeRecord)};
  r.kind_and_flags = head.kind_and_flags;
  r.material = head.material;
  r.interior = head.interior;
  r.owner = static_cast<std::uint32_t>(&object - objects_);
  return r;
}

void InstancedMeshes::write(const SharedMesh& mesh, const InstancedMeshTables& tables) const {
  const MeshPrototype& prototype = mesh.prototype;
  ObjectRecord* to = tables.objects + mesh.first_object;
  std::uint32_t extra = tables.first_extra + mesh.first_extra;
  for (const MeshPrototype::Triangle& triangle : prototype.triangles()) {
    ProgressMonitor::check_cancelled(static_cast<std::size_t>(&triangle - prototype.triangles().data()));
    ObjectRecord r{};
    r.kind_and_flags = static_cast<std::uint32_t>(ObjectKind::triangle);
    r.material = r.extra = kNoOffset;
    if (triangle.material != kNoIndex) tables.records.set_material(r, triangle.material);
    for (int corner = 0; corner < 3; ++corner)
      std::memcpy(r.geometry + 3 * corner, &prototype.vertices()[triangle.vertex[corner]], sizeof(Vec3f));
    if (triangle.normal[0] != kNoIndex) {
      r.kind_and_flags |= object_flag::smooth;
      r.extra = tables.records.offset_of_extra(extra);
      ExtraRecord normals{};
      for (int corner = 0; corner < 3; ++corner) {
        const Vec3f normal(prototype.unit_normals()[triangle.normal[corner]]);
        std::memcpy(normals.value + 3 * corner, &normal, sizeof normal);
      }
      tables.records.extras[extra++] = normals;
    }
    *to++ = r;
  }
  NodeRecord* node = tables.nodes + mesh.first_node;
  for (const NodeRecord& from : mesh.nodes) {
    *node = from;
    for (std::size_t i = 0; i < std::size(from.child); ++i)
      if (from.leaf[i] != 0)
        node->child[i] =
            tables.object_offset + (mesh.first_object + from.child[i]) * std::uint32_t{sizeof(ObjectRecord)};
      else if (from.child[i] != 0)
        node->child[i] =
            tables.node_offset + (mesh.first_node + from.child[i]) * std::uint32_t{sizeof(NodeRecord)};
    ++node;
  }
}

void InstancedMeshes::write(const InstancedMeshTables& tables) const {
  for (const SharedMesh& mesh : meshes_)
    write(mesh, tables);
  for (std::size_t i = 0; i < instances_.size(); ++i)
    tables.instances[i] = record_of(instances_[i], tables);
}

} // namespace celltrace

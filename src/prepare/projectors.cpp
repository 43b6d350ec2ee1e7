#include "prepare/projectors.hpp"

#include "celltrace/error.hpp"

#include <algorithm>
#include <memory>
#include <variant>

namespace celltrace {

namespace {

const Mesh* mesh_of(const Object& object) {
  const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&object.shape);
  return mesh ? mesh->get() : nullptr;
}

bool has_meshes(const Object& object) {
  if (mesh_of(object)) return true;
  if (object.clipped_by && std::any_of(object.clipped_by->begin(), object.clipped_by->end(), has_meshes))
    return true;
  const auto* csg = std::get_if<std::shared_ptr<const Csg>>(&object.shape);
  return csg && *csg && std::any_of((*csg)->parts.begin(), (*csg)->parts.end(), has_meshes);
}

std::vector<Object> triangles_of(const Object& object, const Mesh& mesh) {
  std::vector<Object> triangles;
  for (const Mesh::Triangle& triangle : mesh.triangles) {
    auto polygon = std::make_shared<Polygon>();
    polygon->loops.resize(1);
    for (const Index vertex : triangle.vertex) {
      if (vertex >= mesh.vertices.size())
        throw InputError("a light is projected through a mesh with an index that is out of range");
      polygon->loops[0].push_back(Vec3(mesh.vertices[vertex]));
    }
    triangles.push_back(object);
    triangles.back().shape = std::shared_ptr<const Polygon>(std::move(polygon));
    triangles.back().transform = Transform();
  }
  return triangles;
}

/// Returns a projector's object without meshes, with this material, and with an interior of its own.
Object taken(const Object& object, Index material) {
  Object result = object;
  result.material = material;
  result.interior = kNoIndex;
  result.light_group = kNoIndex;
  result.no_image = result.no_reflection = false;
  const auto* csg = std::get_if<std::shared_ptr<const Csg>>(&object.shape);
  const bool is_union = csg && *csg && (*csg)->operation == Csg::Operation::union_ && !object.inverse;
  if (const Mesh* mesh = mesh_of(object); mesh && !object.clipped_by) {
    result.shape = std::make_shared<const Csg>(Csg{Csg::Operation::union_, triangles_of(result, *mesh)});
  } else if (csg && *csg) {
    auto parts = std::make_shared<Csg>(**csg);
    for (Object& part : parts->parts) {
      if ((!is_union || object.clipped_by) && has_meshes(part))
        throw InputError("a light is projected through a CSG that has a mesh");
      part = taken(part, material);
    }
    result.shape = std::shared_ptr<const Csg>(std::move(parts));
  } else if (has_meshes(object)) {
    throw InputError("a light is projected through a mesh that is clipped, or through what a mesh clips");
  }
  return result;
}

} // namespace

std::optional<Scene> add_projectors(const Scene& scene, const PassContext&) {
  std::optional<Scene> copy;
  Index material = kNoIndex;
  for (const Light& light : scene.lights) {
    if (!light.projected_through) continue;
    if (!copy) {
      copy = scene;
      material = copy->add(Material{});
    }
    copy->objects.push_back(taken(*light.projected_through, material));
  }
  return copy;
}

} // namespace celltrace

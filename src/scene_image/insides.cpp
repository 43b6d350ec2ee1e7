#include "scene_image/insides.hpp"

#include "geometry/mesh_geometry.hpp"
#include "geometry/shape_geometry.hpp"
#include "scene_image/interior_records.hpp"
#include "scene_image/shapes.hpp"
#include "scene_image/surface_records.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <unordered_map>

#include <glm/geometric.hpp>

namespace celltrace {

using namespace kernel;

namespace {

constexpr float kFar = std::numeric_limits<float>::max();
constexpr Aabb kUnbounded = {{-kFar, -kFar, -kFar}, {kFar, kFar, kFar}};

/// Whether a point is in the box of a sphere: hardly any of a million spheres is worth an inverse.
bool is_near(const Sphere& sphere, const Transform& transform, const Vec3& point) {
  const Vec3 away = point - transform.point(sphere.centre);
  constexpr double kRoundedUp = 1.000001;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 reach(transform.rows[0][axis], transform.rows[1][axis], transform.rows[2][axis]);
    if (away[axis] * away[axis] > glm::dot(reach, reach) * sphere.radius * sphere.radius * kRoundedUp)
      return false;
  }
  return true;
}

/// `part`: one of the CSG's own.
bool is_taken_away(const Object& part, const Csg& csg) {
  return csg.operation == Csg::Operation::difference && &part != &csg.parts.front();
}

/// `around`: the transformation of the CSG that it is a part of. `is_turned`: that turns its inside out,
/// which leaves its clips as they are: as in POV-Ray, nothing is inside beyond these.
bool is_inside(const Object& object, const Transform& around, const Vec3& point, bool is_turned);

/// `is_inverse`: an inverse union is the intersection of its parts' inverses, and the other way round.
bool is_inside(const Csg& csg, const Transform& transform, const Vec3& point, bool is_inverse) {
  const auto in = [&](const Object& part) {
    return is_inside(part, transform, point, is_inverse != is_taken_away(part, csg));
  };
  const bool is_union = csg.operation == Csg::Operation::union_ || csg.operation == Csg::Operation::merge;
  return is_union != is_inverse ? std::any_of(csg.parts.begin(), csg.parts.end(), in)
                                : !csg.parts.empty() && std::all_of(csg.parts.begin(), csg.parts.end(), in);
}

bool is_inside(const Object& object, const Transform& around, const Vec3& point, bool is_turned) {
  const Transform transform = object.transform.then(around);
  if (object.clipped_by)
    for (const Object& clip : *object.clipped_by)
      if (!is_inside(clip, around, point, false)) return false;
  const bool is_inverse = object.inverse != is_turned;
  bool inside = false;
  const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&object.shape);
  const auto* sphere = std::get_if<Sphere>(&object.shape);
  if (mesh != nullptr && !(*mesh)->has_inside()) return false;
  if (std::holds_alternative<std::shared_ptr<const Polygon>>(object.shape)) return false;
  if (const auto* csg = std::get_if<std::shared_ptr<const Csg>>(&object.shape))
    return is_inside(**csg, transform, point, is_inverse);
  if (sphere == nullptr || is_near(*sphere, transform, point))
    inside = geometry::is_inside(object.shape, transform.inverse().point(point));
  return inside != is_inverse;
}

/// Whether what a ray is in can make a difference where it hits the material. Maps are taken for ones with
/// such entries.
bool asks_for_interiors(const Material& material) {
  if (material.map) return true;
  for (const Material* layer = &material; layer != nullptr; layer = layer->below.get())
    if (layer->pigment.map || !is_opaque(layer->pigment) || layer->finish.reflection_fresnel) return true;
  return false;
}

/// What the parts of a CSG have that have no interior of their own, or else the first one's.
std::optional<Index> interior_of(const Object& object) {
  const auto* csg = std::get_if<std::shared_ptr<const Csg>>(&object.shape);
  if (csg == nullptr) return object.interior;
  for (const Object& part : (*csg)->parts)
    if (const std::optional<Index> interior = interior_of(part)) return interior;
  return std::nullopt;
}

bool may_have_inside(const Object& object) {
  if (std::holds_alternative<std::shared_ptr<const Polygon>>(object.shape)) return false;
  if (const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&object.shape))
    return (*mesh)->has_inside();
  const auto* sphere = std::get_if<Sphere>(&object.shape);
  return sphere == nullptr || sphere->radius != 0;
}

/// Extents of meshes in their own spaces, of which instances share one.
class MeshExtents {
public:
  const Extent& of(const Mesh& mesh) {
    const auto [known, is_new] = extents_.try_emplace(&mesh);
    if (is_new) known->second = geometry::extent_of(mesh);
    return known->second;
  }

private:
  std::unordered_map<const Mesh*, Extent> extents_;
};

Aabb box_of(const Object& object, const Transform& around, MeshExtents& meshes);

/// Of what all parts of an intersection or difference have in common. What is inverse does not limit it, nor
/// what is taken away, which counts as inverse. Nothing is a point, as in POV-Ray.
Aabb common_box(const Csg& csg, const Transform& transform, MeshExtents& meshes) {
  Aabb box = kUnbounded;
  for (const Object& part : csg.parts)
    if (part.inverse == is_taken_away(part, csg)) box = intersected(box, box_of(part, transform, meshes));
  for (int axis = 0; axis < 3; ++axis)
    if (box.min[axis] > box.max[axis]) return {{0, 0, 0}, {0, 0, 0}};
  return box;
}

/// Of an object that is not clipped. `transform`: all of its own.
Aabb box_of_shape(const Object& object, const Transform& transform, MeshExtents& meshes) {
  if (const auto* csg = std::get_if<std::shared_ptr<const Csg>>(&object.shape)) {
    using Operation = Csg::Operation;
    const Operation operation = (*csg)->operation;
    if (operation == Operation::intersection || operation == Operation::difference)
      return common_box(**csg, transform, meshes);
    Aabb box = {{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};
    for (const Object& part : (*csg)->parts)
      box = united(box, box_of(part, transform, meshes));
    return box;
  }
  if (const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&object.shape)) {
    const Extent extent = meshes.of(**mesh).moved(transform);
    Aabb box;
    for (int axis = 0; axis < 3; ++axis) {
      box.min[axis] = static_cast<float>(extent.min[axis]);
      box.max[axis] = static_cast<float>(extent.max[axis]);
    }
    return box;
  }
  Object shape = object;
  shape.inverse = false;
  shape.transform = transform;
  if (!has_bounds(shape)) return kUnbounded;
  const PlacedShape placed = place_shape(shape);
  return placed.is_empty || !placed.is_bounded ? kUnbounded : placed.bounds();
}

/// Around what POV-Ray takes for the object when it asks what the camera is in: what is inverse counts as if
/// it were not, in merges too. As far as it is worth finding out.
Aabb box_of(const Object& object, const Transform& around, MeshExtents& meshes) {
  Aabb box = box_of_shape(object, object.transform.then(around), meshes);
  if (object.clipped_by)
    for (const Object& clip : *object.clipped_by)
      if (!clip.inverse) box = intersected(box, box_of(clip, around, meshes));
  return box;
}

/// As the former; a sphere of its own is not worth a box, of which there may be a million.
Aabb box_around(const Object& object, MeshExtents& meshes) {
  if (std::holds_alternative<Sphere>(object.shape) && !object.inverse && !object.clipped_by)
    return kUnbounded;
  return box_of(object, Transform(), meshes);
}

} // namespace

bool Medium::contains(const Vec3& point) const {
  for (int axis = 0; axis < 3; ++axis) {
    const double slack = 1e-6 * (1 + std::abs(point[axis]));
    if (point[axis] < box.min[axis] - slack || point[axis] > box.max[axis] + slack) return false;
  }
  return is_inside(object, Transform(), point, false);
}

double Medium::volume() const {
  if (const auto* sphere = std::get_if<Sphere>(&object.shape); sphere != nullptr && !object.inverse)
    return std::abs(object.transform.determinant()) * std::pow(std::abs(sphere->radius), 3) *
           (4 * std::numbers::pi / 3);
  double product = 1;
  for (int axis = 0; axis < 3; ++axis)
    product *= double{box.max[axis]} - double{box.min[axis]};
  return product;
}

std::vector<Medium> media_of(const Scene& scene) {
  if (scene.fogs.empty() && std::none_of(scene.materials.begin(), scene.materials.end(), asks_for_interiors))
    return {};
  std::vector<Medium> media;
  MeshExtents meshes;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const Object& object = scene.objects[i];
    const std::optional<Index> interior = interior_of(object);
    if (interior && !object.is_hidden && may_have_inside(object))
      media.push_back({object, interior_or_own(*interior, scene, i), box_around(object, meshes)});
  }
  return media;
}

} // namespace celltrace

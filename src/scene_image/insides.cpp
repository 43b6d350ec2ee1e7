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

/// Returns whether a point is in the AABB of a sphere. In a scene of a million spheres this test rejects
/// almost all of them without inverting their transformations.
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

/// Returns whether a CSG subtracts a part, which must be one of the CSG's own parts.
bool is_subtracted(const Object& part, const Csg& csg) {
  return csg.operation == Csg::Operation::difference && &part != &csg.parts.front();
}

/// Returns whether a point is inside of an object. `around` is the transformation of the CSG that contains
/// the object. `is_turned` tells whether this CSG inverts the object. It does not invert the objects that
/// clip it: as in POV-Ray, nothing beyond them is inside.
bool is_inside(const Object& object, const Transform& around, const Vec3& point, bool is_turned);

/// Returns whether a point is inside of a CSG or, if `is_inverse` is true, of its inverse: the inverse of a
/// union is the intersection of its parts' inverses, and vice versa.
bool is_inside(const Csg& csg, const Transform& transform, const Vec3& point, bool is_inverse) {
  const auto in = [&](const Object& part) {
    return is_inside(part, transform, point, is_inverse != is_subtracted(part, csg));
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

/// Returns whether a hit on a material depends on the object that the ray is in. A material with a map counts
/// as dependent.
bool needs_interiors(const Material& material) {
  if (material.map) return true;
  for (const Material* layer = &material; layer != nullptr; layer = layer->below.get())
    if (layer->pigment.map || !is_opaque(layer->pigment) || layer->finish.reflection_fresnel) return true;
  return false;
}

/// Returns the interior of an object or, if it is a CSG, of the CSG's first part that is no CSG: kNoIndex if
/// this object has no interior of its own. Returns nothing if a CSG has no parts.
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

/// The extents of meshes in their own spaces, each computed once.
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

/// Returns bounds of the region that all parts of an intersection or difference share. Inverse parts do not
/// limit this region; subtracting a part inverts it. An empty region becomes a point, as in POV-Ray.
Aabb common_box(const Csg& csg, const Transform& transform, MeshExtents& meshes) {
  Aabb box = kUnbounded;
  for (const Object& part : csg.parts)
    if (part.inverse == is_subtracted(part, csg)) box = intersected(box, box_of(part, transform, meshes));
  for (int axis = 0; axis < 3; ++axis)
    if (box.min[axis] > box.max[axis]) return {{0, 0, 0}, {0, 0, 0}};
  return box;
}

/// Returns bounds of an object, ignoring the objects that clip it. `transform` takes its own space to the
/// world.
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

/// Returns bounds of an object as POV-Ray uses them to find the objects around the camera: inverse objects
/// count as not inverse, in merges too. Where tighter bounds are not worth computing, they are wider than
/// POV-Ray's.
Aabb box_of(const Object& object, const Transform& around, MeshExtents& meshes) {
  Aabb box = box_of_shape(object, object.transform.then(around), meshes);
  if (object.clipped_by)
    for (const Object& clip : *object.clipped_by)
      if (!clip.inverse) box = intersected(box, box_of(clip, around, meshes));
  return box;
}

/// Returns bounds as box_of() does, but infinite bounds for a sphere by itself: there may be a million
/// spheres.
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
  if (scene.fogs.empty() && std::none_of(scene.materials.begin(), scene.materials.end(), needs_interiors))
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

#include "pov/object_queries.hpp"

#include <algorithm>
#include <vector>

#include <glm/geometric.hpp>

#include "geometry/mesh_geometry.hpp"
#include "geometry/shape_geometry.hpp"
#include "pov/finite.hpp"
#include "pov/patterns.hpp"
#include "pov/session.hpp"

namespace celltrace::pov {

namespace {

using geometry::Crossing;
using geometry::Crossings;
using geometry::Ray;
using Operation = Csg::Operation;

/// Nearer crossings count as the origin of the ray.
constexpr double kNearest = 1e-6;
constexpr double kFarthest = 1e7;
/// Limit on shape tests in all calls together.
constexpr std::uint64_t kMostTests = 10'000'000'000;

struct Query {
  Session& session;
  const Location& where;
  std::uint64_t& tests;

  void count(std::uint64_t shapes) const {
    tests += shapes;
    if (tests > kMostTests) session.fail(where, "the scene asks too much about its objects");
  }
};

const Mesh* mesh_of(const Query& query, const ObjectDefinition& object) {
  const auto* mesh = std::get_if<std::shared_ptr<MeshDefinition>>(&object.shape);
  return mesh ? &query.session.builder.mesh_of(*mesh) : nullptr;
}

/// Returns the triangles near a ray in an object's mesh.
std::vector<std::uint32_t> triangles_along(const Query& query, const ObjectDefinition& object,
                                           const Ray& ray) {
  auto& tree = std::get<std::shared_ptr<MeshDefinition>>(object.shape)->tree;
  if (!tree) tree = std::make_unique<geometry::TriangleTree>(*mesh_of(query, object));
  std::vector<std::uint32_t> triangles = tree->along(ray);
  query.count(triangles.size());
  return triangles;
}

const Compound* compound_of(const ObjectDefinition& object) {
  const auto* compound = std::get_if<std::shared_ptr<const Compound>>(&object.shape);
  return compound ? compound->get() : nullptr;
}

const TriangleDefinition* triangle_of(const ObjectDefinition& object) {
  const auto* triangle = std::get_if<std::shared_ptr<TriangleDefinition>>(&object.shape);
  return triangle ? triangle->get() : nullptr;
}

/// Returns whether the object is a supported shape and no light.
bool is_solid(const Query& query, const ObjectDefinition& object) {
  return query.session.diagnostics.supports(object.missing, query.where) && !object.light();
}

ObjectDefinition limiting(const Limit& limit) {
  ObjectDefinition object = *limit.object;
  object.apply(limit.transform);
  return object;
}

Transform back(const Query& query, const ObjectDefinition& object) {
  if (is_singular(object.transform))
    query.session.fail(query.where, "this object's transformation is singular: it has no inverse");
  return object.transform.inverse();
}

bool contains(const Query& query, const ObjectDefinition& object, const Vec3& point);

bool contains(const Query& query, const Compound& compound, const Vec3& p) {
  const auto has = [&](const ObjectPtr& part) { return is_solid(query, *part) && contains(query, *part, p); };
  const auto& parts = compound.parts;
  if (compound.operation == Operation::intersection)
    return std::all_of(parts.begin(), parts.end(),
                       [&](const ObjectPtr& part) { return !is_solid(query, *part) || has(part); });
  if (compound.operation == Operation::difference)
    return has(parts.front()) && std::none_of(parts.begin() + 1, parts.end(), has);
  return std::any_of(parts.begin(), parts.end(), has);
}

bool contains(const Query& query, const ObjectDefinition& object, const Vec3& point) {
  query.count(1);
  if (!is_finite(object.transform)) return false;
  for (const Limit& limit : object.clipped_by)
    if (!contains(query, limiting(limit), point)) return false;
  const Vec3 p = back(query, object).point(point);
  bool is_inside = false;
  if (const Compound* compound = compound_of(object)) {
    is_inside = contains(query, *compound, p);
  } else if (const Mesh* mesh = mesh_of(query, object)) {
    if (mesh->has_inside())
      is_inside = geometry::is_inside(*mesh, triangles_along(query, object, {p, mesh->inside_vector}), p);
  } else if (const auto* shape = std::get_if<Shape>(&object.shape)) {
    if (std::holds_alternative<std::shared_ptr<const Polygon>>(*shape)) return false;
    is_inside = geometry::is_inside(*shape, p);
  }
  return is_inside != object.inverse;
}

void cross(const Query& query, const ObjectDefinition& object, const Ray& ray, Crossings& found);

/// Finds the crossings with the surface of a CSG, among those with its parts.
void cross(const Query& query, const Compound& compound, const Ray& ray, Crossings& found) {
  const auto& parts = compound.parts;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (!is_solid(query, *parts[i])) continue;
    const bool is_subtracted = compound.operation == Operation::difference && i > 0;
    Crossings own;
    cross(query, *parts[i], ray, own);
    for (Crossing& crossing : own) {
      if (is_subtracted) crossing.normal = -crossing.normal;
      bool is_surface = true;
      for (std::size_t j = 0; j < parts.size() && is_surface && compound.operation != Operation::union_;
           ++j) {
        if (j == i || !is_solid(query, *parts[j])) continue;
        const bool is_inside = contains(query, *parts[j], ray.at(crossing.t));
        const bool must_be_inside = compound.operation == Operation::intersection ||
                                    (compound.operation == Operation::difference && j == 0);
        is_surface = is_inside == must_be_inside;
      }
      if (is_surface) found.push_back(crossing);
    }
  }
}

void cross(const Query& query, const ObjectDefinition& object, const Ray& ray, Crossings& found) {
  query.count(1);
  if (!is_finite(object.transform)) return;
  const Transform inverse = back(query, object);
  const Ray local{inverse.point(ray.origin), inverse.direction(ray.direction)};
  Crossings own;
  if (const Compound* compound = compound_of(object)) {
    cross(query, *compound, local, own);
  } else if (const Mesh* mesh = mesh_of(query, object)) {
    geometry::find_crossings(*mesh, triangles_along(query, object, local), local, own);
  } else if (const TriangleDefinition* triangle = triangle_of(object)) {
    const Vec3* normals = triangle->is_smooth ? triangle->normals.data() : nullptr;
    geometry::cross_triangle(triangle->vertices, normals, local, own);
  } else if (const auto* shape = std::get_if<Shape>(&object.shape)) {
    geometry::find_crossings(*shape, local, own);
  }
  std::vector<ObjectDefinition> clips;
  for (const Limit& limit : object.clipped_by)
    clips.push_back(limiting(limit));
  for (Crossing& crossing : own) {
    if (!(crossing.t > kNearest && crossing.t < kFarthest)) continue;
    const Vec3 point = ray.at(crossing.t);
    if (!std::all_of(clips.begin(), clips.end(),
                     [&](const ObjectDefinition& clip) { return contains(query, clip, point); }))
      continue;
    crossing.normal = object.transform.normal(crossing.normal);
    if (object.inverse) crossing.normal = -crossing.normal;
    found.push_back(crossing);
  }
}

Extent extent(const Query& query, const ObjectDefinition& object);

Extent extent(const Query& query, const Compound& compound) {
  std::vector<Extent> extents;
  for (std::size_t i = 0; i < compound.parts.size(); ++i) {
    const ObjectDefinition& part = *compound.parts[i];
    if (!query.session.diagnostics.supports(part.missing, query.where)) continue;
    if (compound.operation != Operation::intersection && compound.operation != Operation::difference) {
      extents.push_back(extent(query, part));
      continue;
    }
    const bool is_inverse = part.inverse != (compound.operation == Operation::difference && i > 0);
    const auto* shape = std::get_if<Shape>(&part.shape);
    const auto* plane = shape ? std::get_if<Plane>(shape) : nullptr;
    if (plane && is_singular(part.transform))
      extents.push_back(Extent::everywhere());
    else if (plane)
      extents.push_back(geometry::half_space(*plane, part.transform, is_inverse));
    else if (!is_inverse)
      extents.push_back(extent(query, part));
  }
  if (extents.empty()) return Extent::everywhere();
  Extent result = extents.front();
  for (const Extent& one : extents)
    if (compound.operation == Operation::intersection || compound.operation == Operation::difference)
      result = result.common(one);
    else
      result = result.joined(one);
  return result;
}

Extent extent(const Query& query, const ObjectDefinition& object) {
  query.count(1);
  if (!query.session.diagnostics.supports(object.missing, query.where)) return {};
  Extent result = Extent::everywhere();
  if (const Compound* compound = compound_of(object))
    result = extent(query, *compound).moved(object.transform);
  else if (const Mesh* mesh = mesh_of(query, object))
    result = geometry::extent_of(*mesh).moved(object.transform);
  else if (const TriangleDefinition* triangle = triangle_of(object))
    result = Extent::around({object.transform.point(triangle->vertices[0]),
                             object.transform.point(triangle->vertices[1]),
                             object.transform.point(triangle->vertices[2])});
  else if (const auto* shape = std::get_if<Shape>(&object.shape))
    result = geometry::extent_of(*shape, object.transform);
  // Objects that clip or bound the object replace its extent if theirs is smaller.
  for (const auto* limits : {&object.clipped_by, &object.bounded_by})
    for (const Limit& limit : *limits) {
      if (limit.object->inverse) continue;
      const Extent other = extent(query, limiting(limit));
      if (other.volume() < result.volume()) result = other;
    }
  return result;
}

} // namespace

std::optional<ObjectHit> trace(Session& session, const ObjectDefinition& object, const Vec3& origin,
                               const Vec3& direction, const Location& where) {
  const double length = glm::length(direction);
  if (!(length > 0)) return std::nullopt;
  const Query query{session, where, session.shape_tests};
  if (!is_solid(query, object)) return std::nullopt;
  Crossings found;
  const Ray ray{origin, direction / length};
  cross(query, object, ray, found);
  const auto nearest = std::min_element(found.begin(), found.end(),
                                        [](const Crossing& a, const Crossing& b) { return a.t < b.t; });
  if (nearest == found.end()) return std::nullopt;
  const double size = glm::length(nearest->normal);
  const Vec3 normal = size > 0 ? nearest->normal / size : nearest->normal;
  return ObjectHit{ray.at(nearest->t), normal + Vec3(0)}; // turns negative zeros into zeros
}

bool contains(Session& session, const ObjectDefinition& object, const Vec3& point, const Location& where) {
  const Query query{session, where, session.shape_tests};
  return is_solid(query, object) && contains(query, object, point);
}

Extent extent_of(Session& session, const ObjectDefinition& object, const Location& where) {
  return extent({session, where, session.shape_tests}, object);
}

} // namespace celltrace::pov

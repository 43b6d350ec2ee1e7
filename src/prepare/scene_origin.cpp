#include "prepare/scene_origin.hpp"

#include "geometry/shape_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace celltrace {

namespace {

/// Limit on objects, and on vertices of a mesh, that are examined. Examining more would take time and hardly
/// move the median.
constexpr std::size_t kMostExamined = 256;

double largest(const Vec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

std::size_t stride(std::size_t count) {
  return count / kMostExamined + 1;
}

/// A box, at first without points.
struct Bounds {
  Extent box;
  bool is_empty = true;

  void add(const Extent& other) {
    box = is_empty ? other : box.joined(other);
    is_empty = false;
  }
};

void add_extent(const Object& object, const Transform& around, int depth, Bounds& bounds);

void add_extent(const std::shared_ptr<const Mesh>& mesh, const Transform& transform, int, Bounds& bounds) {
  if (!mesh) return;
  for (std::size_t i = 0; i < mesh->vertices.size(); i += stride(mesh->vertices.size())) {
    const Vec3 vertex = transform.point(Vec3(mesh->vertices[i]));
    bounds.add({vertex, vertex});
  }
}
void add_extent(const std::shared_ptr<const Csg>& csg, const Transform& transform, int depth,
                Bounds& bounds) {
  if (!csg || depth > kDeepestCsg) return;
  for (std::size_t i = 0; i < csg->parts.size(); i += stride(csg->parts.size()))
    add_extent(csg->parts[i], transform, depth + 1, bounds);
}
void add_extent(const std::shared_ptr<const Polygon>& polygon, const Transform& transform, int,
                Bounds& bounds) {
  if (!polygon) return;
  for (const std::vector<Vec3>& loop : polygon->loops)
    for (const Vec3& point : loop)
      bounds.add({transform.point(point), transform.point(point)});
}
void add_extent(const Plane&, const Transform&, int, Bounds&) {
}
template <class Shape> void add_extent(const Shape& shape, const Transform& transform, int, Bounds& bounds) {
  const Extent extent = geometry::extent_of(shape, transform);
  constexpr double kFarthest = 1e12; // greater numbers stand for infinity
  if (std::max(largest(extent.min), largest(extent.max)) < kFarthest && !extent.is_everywhere())
    bounds.add(extent);
}

void add_extent(const Object& object, const Transform& around, int depth, Bounds& bounds) {
  if (object.inverse) return;
  const Transform transform = object.transform.then(around);
  std::visit([&](const auto& shape) { add_extent(shape, transform, depth, bounds); }, object.shape);
}

/// Returns the median; if the number of values is even, the lower one of the two middle values.
double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Moves the parts of a scene. Maps that several materials share stay shared.
class Mover {
public:
  explicit Mover(const Vec3& origin) : move_(Transform::translate(-origin)) {}

  Object moved(Object object) {
    object.transform = object.transform.then(move_);
    if (object.clipped_by) {
      auto clips = *object.clipped_by;
      for (Object& clip : clips)
        clip = moved(std::move(clip));
      object.clipped_by = std::make_shared<const std::vector<Object>>(std::move(clips));
    }
    return object;
  }

  Material moved(Material material) {
    material.pigment.map = once(material.pigment.map);
    material.map = once(material.map);
    material.normal = once(material.normal);
    material.below = once(material.below);
    material.inside = once(material.inside);
    return material;
  }

  Light moved(Light light) {
    light.location = move_.point(light.location);
    light.point_at = move_.point(light.point_at);
    if (light.projected_through)
      light.projected_through = std::make_shared<const Object>(moved(*light.projected_through));
    return light;
  }

  Fog moved(Fog fog) {
    fog.offset += glm::dot(fog.up, move_.rows[3]);
    fog.turbulence_origin = move_.point(fog.turbulence_origin);
    return fog;
  }

private:
  /// Moves the pattern of a map. Patterns inside of a map are in the space of this pattern, so that they move
  /// with it.
  template <class T> PatternMap<T> moved(PatternMap<T> map) {
    move(map.pattern);
    return map;
  }
  Normal moved(Normal normal) {
    if (normal.map)
      normal.map = once(normal.map);
    else
      move(normal.pattern);
    return normal;
  }
  void move(Pattern& pattern) {
    if (!pattern.uv_mapping) pattern.space.emplace_back(move_);
  }

  template <class T> std::shared_ptr<const T> once(const std::shared_ptr<const T>& shared) {
    if (!shared) return nullptr;
    std::shared_ptr<const void>& known = moved_[shared.get()];
    if (!known) known = std::make_shared<const T>(moved(*shared));
    return std::static_pointer_cast<const T>(moved_[shared.get()]);
  }

  const Transform move_;
  std::unordered_map<const void*, std::shared_ptr<const void>> moved_; ///< key: address of the original
};

} // namespace

namespace {

struct Middle {
  Vec3 place{0, 0, 0}; ///< middle of most objects
  double size = 0;     ///< distance from `place` within which most objects lie; 0 if there are no objects
};

/// Adds the places and sizes of objects that have been moved, for scenes in which no object has bounds.
void add_moved(const Scene& scene, std::vector<Vec3>& places, std::vector<double>& sizes) {
  for (const Object& object : scene.objects) {
    const Transform& transform = object.transform;
    const double size =
        std::max({largest(transform.rows[0]), largest(transform.rows[1]), largest(transform.rows[2])});
    if (transform.rows[3] == Vec3(0) || !std::isfinite(largest(transform.rows[3]) + size)) continue;
    places.push_back(transform.rows[3]);
    sizes.push_back(size);
  }
}

Middle middle_of(const Scene& scene) {
  std::vector<Vec3> places;
  std::vector<double> sizes;
  for (std::size_t i = 0; i < scene.objects.size(); i += stride(scene.objects.size())) {
    Bounds bounds;
    add_extent(scene.objects[i], Transform(), 0, bounds);
    const Vec3 place = (bounds.box.min + bounds.box.max) * 0.5;
    const double size = largest(bounds.box.max - bounds.box.min) * 0.5;
    if (bounds.is_empty || !std::isfinite(largest(place) + size)) continue;
    places.push_back(place);
    sizes.push_back(size);
  }
  Middle middle;
  if (places.empty()) add_moved(scene, places, sizes);
  if (places.empty()) return middle;
  std::vector<double> values(places.size());
  for (int axis = 0; axis < 3; ++axis) {
    std::transform(places.begin(), places.end(), values.begin(), [axis](const Vec3& v) { return v[axis]; });
    middle.place[axis] = median(values);
  }
  for (std::size_t i = 0; i < places.size(); ++i)
    values[i] = largest(places[i] - middle.place) + sizes[i];
  middle.size = median(values);
  return middle;
}

/// Least distance, in sizes of the scene, at which the scene gets an origin of its own: there single
/// precision still resolves a 65,536th of the scene's size.
constexpr double kFar = 256;

} // namespace

Vec3 origin_for(const Scene& scene) {
  const Middle middle = middle_of(scene);
  if (!(middle.size > 0) || largest(middle.place) <= kFar * middle.size) return Vec3(0);
  // Returns an origin with few digits, so that coordinates relative to it lose no digits.
  const double step = std::exp2(std::floor(std::log2(middle.size)));
  return glm::round(middle.place / step) * step;
}

double largest_coordinate_from_afar(const Scene& scene, const Vec3& location) {
  const double distance = largest(location);
  const Middle middle = middle_of(scene);
  if (!(middle.size > 0) || distance <= kFar * middle.size) return 0;
  double reach = 0;
  for (const Object& object : scene.objects) {
    Bounds bounds;
    add_extent(object, Transform(), 0, bounds);
    reach = std::max({reach, largest(bounds.box.min), largest(bounds.box.max)});
  }
  return distance > kFar * reach ? reach : 0;
}

Camera moved_to(const Vec3& origin, Camera camera) {
  camera.location -= origin;
  return camera;
}

std::optional<Scene> moved_to(const Vec3& origin, const Scene& scene) {
  if (origin == Vec3(0)) return std::nullopt;
  validate(scene);
  std::optional<Scene> result = scene;
  Scene& moved = *result;
  Mover mover(origin);
  const auto move_all = [&](auto& all) {
    for (auto& one : all)
      one = mover.moved(std::move(one));
  };
  moved.camera = moved_to(origin, scene.camera);
  move_all(moved.objects);
  move_all(moved.materials);
  move_all(moved.lights);
  move_all(moved.fogs);
  return result;
}

} // namespace celltrace

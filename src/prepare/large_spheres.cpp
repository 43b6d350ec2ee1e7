#include "prepare/large_spheres.hpp"

#include "prepare/csg_leaves.hpp"
#include "records/object.hpp"

#include <cmath>
#include <cstdint>
#include <utility>
#include <variant>

#include <glm/geometric.hpp>

namespace celltrace {

namespace {

/// Limit on quadrics in place of spheres: they have no bounds, so that each ray is tested against all of
/// them.
constexpr std::size_t kMostSpheres = most_of(PictureLimit::large_spheres);

class LargeSpheres {
public:
  explicit LargeSpheres(const PassContext& context)
      : context_(context), eye_(context.eye), material_flags_(context.material_flags) {}

  /// Returns the object with large spheres replaced, also in its parts; nothing if it has no large sphere.
  std::optional<Object> changed(const Object& object) {
    const auto is_sphere = [](const Object& leaf, bool) {
      return std::holds_alternative<Sphere>(leaf.shape);
    };
    if (!has_leaf(object, false, is_sphere)) return {};
    const auto change = [this](const Object& leaf, const LeafPlace& place) -> std::optional<Object> {
      const auto* const sphere = std::get_if<Sphere>(&leaf.shape);
      if (sphere == nullptr) return {};
      return about_nearest_point(leaf, *sphere, place.transform);
    };
    return with_leaves_changed(object, LeafPlace(), change);
  }

private:
  std::optional<Object> about_nearest_point(const Object& object, const Sphere& sphere,
                                            const Transform& transform) {
    if (object.inverse || object.clipped_by != nullptr) return {};
    if (object.material < material_flags_.size() &&
        (material_flags_[object.material] & kernel::object_flag::by_surface) != 0)
      return {};
    if (!eye_.is_near_surface(sphere, transform)) return {};
    if (count_ == kMostSpheres) {
      context_.pass(PictureLimit::large_spheres);
      return {};
    }
    ++count_;
    const double radius = std::abs(sphere.radius);
    const Vec3 eye = eye_.location();
    const Vec3 from_centre = (transform.is_identity() ? eye : transform.inverse().point(eye)) - sphere.centre;
    const Vec3 normal = from_centre / glm::length(from_centre);
    Object quadric = object;
    Quadric shape;
    shape.linear = normal * (2 * radius);
    shape.constant = 0;
    quadric.shape = shape;
    quadric.transform = Transform::translate(sphere.centre + normal * radius).then(object.transform);
    return quadric;
  }

  const PassContext& context_;
  const Eye& eye_;
  std::span<const std::uint32_t> material_flags_;
  std::size_t count_ = 0;
};

} // namespace

std::optional<Scene> centre_large_spheres(const Scene& scene, const PassContext& context) {
  LargeSpheres spheres(context);
  return with_objects_changed(scene, [&](const Object& object) { return spheres.changed(object); });
}

} // namespace celltrace

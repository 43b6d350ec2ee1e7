#include "scene_image/near_surfaces.hpp"

#include "geometry/object_extents.hpp"
#include "kernel/primitives/crossings.hpp"
#include "records/object.hpp"
#include "scene/progress_monitor.hpp"

#include <algorithm>

namespace celltrace {

namespace {

class TranslucentBoxes {
public:
  explicit TranslucentBoxes(const std::vector<std::uint32_t>& material_flags)
      : material_flags_(material_flags) {}

  void add(const Object& object, const Transform& around) {
    if (object.is_hidden || object.no_shadow) return;
    const auto* const csg = std::get_if<std::shared_ptr<const Csg>>(&object.shape);
    if (csg != nullptr && (*csg)->operation == Csg::Operation::union_) {
      const Transform transform = object.transform.then(around);
      for (const Object& part : (*csg)->parts)
        add(part, transform);
      return;
    }
    if (is_translucent(object)) boxes_.push_back({extent_of(object, around), is_flat(object)});
  }

  /// Returns whether any object is thin, or close to another object; true if there are too many to find out.
  bool any_near() {
    constexpr double kNear = kernel::kShadowEpsilon;
    constexpr std::size_t kMostBoxes = 1 << 18, kMostPairs = 1 << 22; // more would take too long to find out
    if (boxes_.size() > kMostBoxes) return true;
    std::sort(boxes_.begin(), boxes_.end(),
              [](const Box& a, const Box& b) { return a.extent.min.x < b.extent.min.x; });
    std::size_t pairs = 0;
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      const Extent& a = boxes_[i].extent;
      const Vec3 size = a.max - a.min;
      if (!boxes_[i].is_flat && std::min({size.x, size.y, size.z}) <= kNear) return true;
      for (std::size_t k = i + 1; k < boxes_.size() && boxes_[k].extent.min.x <= a.max.x + kNear; ++k) {
        const Extent& b = boxes_[k].extent;
        if (++pairs > kMostPairs) return true;
        if (b.min.y <= a.max.y + kNear && a.min.y <= b.max.y + kNear && b.min.z <= a.max.z + kNear &&
            a.min.z <= b.max.z + kNear)
          return true;
      }
    }
    return false;
  }

private:
  struct Box {
    Extent extent;
    bool is_flat; ///< true if the object's surfaces count as one surface
  };

  static bool is_flat(const Object& object) {
    return std::holds_alternative<std::shared_ptr<const Mesh>>(object.shape) ||
           std::holds_alternative<std::shared_ptr<const Polygon>>(object.shape) ||
           std::holds_alternative<Disc>(object.shape);
  }
  bool is_translucent(Index material) const {
    return (material_flags_[material] & kernel::object_flag::opaque) == 0;
  }
  bool is_translucent(const Object& object) const {
    if (const auto* const csg = std::get_if<std::shared_ptr<const Csg>>(&object.shape))
      return std::any_of((*csg)->parts.begin(), (*csg)->parts.end(),
                         [this](const Object& part) { return is_translucent(part); });
    if (const auto* const mesh = std::get_if<std::shared_ptr<const Mesh>>(&object.shape))
      for (const Mesh::Triangle& triangle : (*mesh)->triangles)
        for (const Index material : triangle.material)
          if (material != kNoIndex && is_translucent(material)) return true;
    return is_translucent(object.material);
  }

  const std::vector<std::uint32_t>& material_flags_;
  std::vector<Box> boxes_;
};

} // namespace

bool has_near_surfaces(const Scene& scene, const std::vector<std::uint32_t>& material_flags) {
  const auto is_opaque = [](std::uint32_t flags) { return (flags & kernel::object_flag::opaque) != 0; };
  if (std::all_of(material_flags.begin(), material_flags.end(), is_opaque)) return false;
  TranslucentBoxes boxes(material_flags);
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    ProgressMonitor::check_cancelled(i);
    boxes.add(scene.objects[i], Transform());
  }
  return boxes.any_near();
}

} // namespace celltrace

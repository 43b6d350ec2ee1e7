#include "scene_image/polygon_table.hpp"

#include "geometry/polygons.hpp"

#include <memory>
#include <optional>
#include <utility>
#include <variant>

namespace celltrace {

using namespace kernel;

void PolygonTable::add(const Object& object) {
  if (const auto* polygon = std::get_if<std::shared_ptr<const Polygon>>(&object.shape)) {
    if (!known_.contains(polygon->get())) add(**polygon);
  } else if (const auto* csg = std::get_if<std::shared_ptr<const Csg>>(&object.shape)) {
    for (const Object& part : (*csg)->parts)
      add(part);
  }
}

void PolygonTable::add(const Polygon& polygon) {
  PolygonEdges& own = known_[&polygon];
  own = {static_cast<std::uint32_t>(edges_.size()), 0};
  const std::optional<Transform> frame = frame_of(polygon);
  if (!frame) return;
  const Transform to_frame = frame->inverse();
  for (const std::vector<Vec3>& loop : polygon.loops)
    for (std::size_t i = 0; i < loop.size(); ++i) {
      Vec3 low = to_frame.point(loop[i]), high = to_frame.point(loop[i + 1 == loop.size() ? 0 : i + 1]);
      if (low.y > high.y) std::swap(low, high);
      const PolygonEdgeRecord edge = {static_cast<float>(low.y), static_cast<float>(high.y),
                                      static_cast<float>(low.x),
                                      static_cast<float>((high.x - low.x) / (high.y - low.y))};
      if (edge.low < edge.high) edges_.push_back(edge);
    }
  // A table that is too long is rejected when the image is laid out.
  own.count = static_cast<std::uint32_t>(edges_.size()) - own.first;
}

} // namespace celltrace

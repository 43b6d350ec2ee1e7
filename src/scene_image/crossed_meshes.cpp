#include "scene_image/crossed_meshes.hpp"

#include "geometry/triangles.hpp"
#include "scene/progress_monitor.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>

#include <glm/common.hpp>

namespace celltrace {

using namespace kernel;

namespace {

/// Limit on triangles in the lowest boxes; a box around fewer triangles is not worth its test.
constexpr std::size_t kMostInBox = 4;

struct Corners {
  Vec3f corner[3];

  Vec3f least() const { return glm::min(glm::min(corner[0], corner[1]), corner[2]); }
  Vec3f greatest() const { return glm::max(glm::max(corner[0], corner[1]), corner[2]); }
  /// Returns twice the middle of the triangle's box.
  Vec3f middle() const { return least() + greatest(); }
};

void copy(const Vec3f& from, float (&to)[3]) {
  for (int axis = 0; axis < 3; ++axis)
    to[axis] = from[axis];
}

class TreeWriter {
public:
  explicit TreeWriter(std::vector<CrossedMeshRecord>& records) : records_(records) {}

  /// Appends a box around the triangles, followed by the box's contents: triangles if they are few, else the
  /// boxes of two halves, which are divided along the axis with the largest extent.
  void add(std::span<Corners> triangles) {
    ProgressMonitor::check_cancelled(records_.size());
    const std::size_t box = records_.size();
    Vec3f least(std::numeric_limits<float>::max()), greatest = -least, nearest = least, farthest = greatest;
    for (const Corners& triangle : triangles) {
      least = glm::min(least, triangle.least());
      greatest = glm::max(greatest, triangle.greatest());
      nearest = glm::min(nearest, triangle.middle());
      farthest = glm::max(farthest, triangle.middle());
    }
    CrossedMeshRecord record{};
    copy(least, record.corner[0]);
    copy(greatest, record.corner[1]);
    records_.push_back(record);
    if (triangles.size() <= kMostInBox) {
      for (const Corners& triangle : triangles)
        add(triangle);
    } else {
      const Vec3f extent = farthest - nearest;
      const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
      const std::size_t half = triangles.size() / 2;
      std::nth_element(
          triangles.begin(), triangles.begin() + static_cast<std::ptrdiff_t>(half), triangles.end(),
          [axis](const Corners& a, const Corners& b) { return a.middle()[axis] < b.middle()[axis]; });
      add(triangles.first(half));
      add(triangles.subspan(half));
    }
    records_[box].next = static_cast<std::uint32_t>(records_.size());
  }

private:
  void add(const Corners& triangle) {
    CrossedMeshRecord record{};
    for (int i = 0; i < 3; ++i)
      copy(triangle.corner[i], record.corner[i]);
    record.is_triangle = 1;
    record.next = static_cast<std::uint32_t>(records_.size() + 1);
    records_.push_back(record);
  }

  std::vector<CrossedMeshRecord>& records_;
};

} // namespace

std::uint32_t CrossedMeshes::of(const Mesh& mesh) {
  const auto [known, is_new] = first_.try_emplace(&mesh, static_cast<std::uint32_t>(records_.size()));
  if (!is_new) return known->second;
  std::vector<Corners> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const Mesh::Triangle& triangle : mesh.triangles) {
    const Corners corners = {{mesh.vertices[triangle.vertex[0]], mesh.vertices[triangle.vertex[1]],
                              mesh.vertices[triangle.vertex[2]]}};
    if (has_area(corners.corner[0], corners.corner[1], corners.corner[2])) triangles.push_back(corners);
  }
  TreeWriter(records_).add(triangles);
  return known->second;
}

} // namespace celltrace

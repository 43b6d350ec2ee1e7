#include "geometry/triangle_tree.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include <glm/common.hpp>

namespace celltrace::geometry {

namespace {

constexpr std::uint32_t kMostOfLeaf = 4;
/// Distance, relative to the largest coordinate, by which rounding may move a crossing beyond the edge of its
/// triangle.
constexpr double kRounding = 1e-9;

double largest(const Vec3& v) {
  const Vec3 size = glm::abs(v);
  return std::max({size.x, size.y, size.z});
}

bool hits(const Vec3f& min, const Vec3f& max, double padding, const Ray& ray) {
  double enter = -std::numeric_limits<double>::infinity(), leave = -enter;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = static_cast<double>(min[axis]) - padding - ray.origin[axis];
    const double high = static_cast<double>(max[axis]) + padding - ray.origin[axis];
    if (ray.direction[axis] == 0) {
      if (low > 0 || high < 0) return false;
      continue;
    }
    const double a = low / ray.direction[axis], b = high / ray.direction[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter <= leave;
}

} // namespace

TriangleTree::TriangleTree(const Mesh& mesh) : order_(mesh.triangles.size()) {
  std::iota(order_.begin(), order_.end(), 0u);
  std::vector<Vec3> centres; // sums of the corners: centres times three
  for (const Mesh::Triangle& triangle : mesh.triangles)
    centres.push_back(Vec3(mesh.vertices[triangle.vertex[0]]) + Vec3(mesh.vertices[triangle.vertex[1]]) +
                      Vec3(mesh.vertices[triangle.vertex[2]]));
  for (const Vec3f& vertex : mesh.vertices)
    size_ = std::max(size_, largest(Vec3(vertex)));
  nodes_.reserve(order_.size());
  if (!order_.empty()) build(mesh, centres, 0, static_cast<std::uint32_t>(order_.size()));
}

/// Builds the node of the triangles [begin, end) and the nodes below it. Halves the triangles along the axis
/// in which their centres are farthest apart. Returns the node's index.
std::uint32_t TriangleTree::build(const Mesh& mesh, const std::vector<Vec3>& centres, std::uint32_t begin,
                                  std::uint32_t end) {
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  Vec3f min(std::numeric_limits<float>::infinity()), max = -min;
  Vec3 nearest(min), farthest(max);
  for (std::uint32_t i = begin; i < end; ++i) {
    for (const Index vertex : mesh.triangles[order_[i]].vertex) {
      min = glm::min(min, mesh.vertices[vertex]);
      max = glm::max(max, mesh.vertices[vertex]);
    }
    nearest = glm::min(nearest, centres[order_[i]]);
    farthest = glm::max(farthest, centres[order_[i]]);
  }
  nodes_.push_back({min, max, begin, end, 0});
  if (end - begin <= kMostOfLeaf) return index;
  const Vec3 extent = farthest - nearest;
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  const std::uint32_t middle = begin + (end - begin) / 2;
  const auto at = [&](std::uint32_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(middle), at(end),
                   [&](std::uint32_t a, std::uint32_t b) { return centres[a][axis] < centres[b][axis]; });
  build(mesh, centres, begin, middle);
  nodes_[index].right = build(mesh, centres, middle, end);
  return index;
}

std::vector<std::uint32_t> TriangleTree::along(const Ray& ray) const {
  std::vector<std::uint32_t> found, below;
  if (!nodes_.empty()) below.push_back(0);
  const double padding = kRounding * (size_ + largest(ray.origin));
  while (!below.empty()) {
    const std::uint32_t index = below.back();
    below.pop_back();
    const Node& node = nodes_[index];
    if (!hits(node.min, node.max, padding, ray)) continue;
    if (node.right == 0) {
      found.insert(found.end(), order_.begin() + node.begin, order_.begin() + node.end);
    } else {
      below.push_back(node.right);
      below.push_back(index + 1);
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

} // namespace celltrace::geometry

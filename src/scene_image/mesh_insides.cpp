#include "scene_image/mesh_insides.hpp"

#include "geometry/basis.hpp"
#include "scene/progress_monitor.hpp"
#include "scene_image/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace celltrace {

using namespace kernel;

namespace {

/// Limit on list entries per triangle; a grid with more entries gets fewer cells.
constexpr std::uint64_t kMostEntriesPerTriangle = 16;

/// Returns the transformation to a space whose third axis is along the mesh's inside vector, and in which the
/// mesh lies between 0 and 1. `extent` becomes the size of that cube in the mesh's own space.
Transform unit_space(const Mesh& mesh, Vec3& extent) {
  const Vec3 magnitude = glm::abs(mesh.inside_vector);
  const Vec3 along = glm::normalize(mesh.inside_vector / std::max({magnitude.x, magnitude.y, magnitude.z}));
  Vec3 axes[3];
  complete_basis(along, axes[0], axes[1]);
  axes[2] = along;
  Vec3 low(1e300), high(-1e300);
  for (const Mesh::Triangle& triangle : mesh.triangles)
    for (const Index index : triangle.vertex) {
      const Vec3 vertex(mesh.vertices[index]);
      const Vec3 at(glm::dot(axes[0], vertex), glm::dot(axes[1], vertex), glm::dot(axes[2], vertex));
      low = glm::min(low, at);
      high = glm::max(high, at);
    }
  if (mesh.triangles.empty()) low = high = Vec3(0);
  extent = high - low;
  // Keeps the extent of a flat mesh above zero.
  const double largest = std::max({extent.x, extent.y, extent.z});
  extent = glm::max(extent, Vec3(largest > 0 ? largest * 1e-6 : 1));
  Transform transform;
  for (int i = 0; i < 3; ++i) {
    for (int row = 0; row < 3; ++row)
      transform.rows[row][i] = axes[i][row] / extent[i];
    transform.rows[3][i] = -low[i] / extent[i];
  }
  return transform;
}

/// Returns a grid that has about as many cells as there are triangles; its cells are as square as possible.
MeshGridRecord make_grid(std::size_t triangles, const Vec3& extent) {
  const double density = std::sqrt(static_cast<double>(triangles) / (extent.x * extent.y));
  const auto side = [&](double length) {
    return static_cast<std::uint32_t>(
        std::clamp(length * density, 1.0, static_cast<double>(kMaxMeshGridSide)));
  };
  return {0, side(extent.x), side(extent.y), 0};
}

float slope(const Vec3f& from, const Vec3f& to) {
  constexpr float kMost = 1e30f; // with a slope this large, no point lies between the two rows
  const float quotient = (to.x - from.x) / (to.y - from.y);
  return std::isnan(quotient) ? 0.0f : std::clamp(quotient, -kMost, kMost);
}

/// Returns the record of a triangle. Each corner is a column, a row and a height; sorts the corners by row.
MeshTriangleRecord make_triangle(Vec3f (&corners)[3]) {
  std::sort(corners, corners + 3, [](const Vec3f& a, const Vec3f& b) { return a.y < b.y; });
  const auto& [a, b, c] = corners;
  MeshTriangleRecord r{};
  r.least_height = std::min({a.z, b.z, c.z});
  r.greatest_height = std::max({a.z, b.z, c.z});
  for (int i = 0; i < 3; ++i)
    r.row[i] = corners[i].y;
  for (int i = 0; i < 2; ++i)
    r.column[i] = corners[i].x;
  r.slope[0] = slope(a, b);
  r.slope[1] = slope(b, c);
  r.slope[2] = slope(a, c);
  r.height = a.z;
  const Vec3 normal = glm::cross(Vec3(b) - Vec3(a), Vec3(c) - Vec3(a));
  const double gradient[2] = {-normal.x / normal.z, -normal.y / normal.z};
  constexpr double kSteep = 1e15;
  if (std::abs(gradient[0]) < kSteep && std::abs(gradient[1]) < kSteep)
    std::transform(gradient, gradient + 2, r.gradient, [](double g) { return static_cast<float>(g); });
  else
    r.height = 0.5f * (r.least_height + r.greatest_height);
  return r;
}

/// The cells in which a triangle may be, with a margin for the rounding of points on its edges.
struct CellRange {
  std::uint32_t column[2], row[2]; ///< first and last

  CellRange(const MeshTriangleRecord& triangle, const MeshGridRecord& grid) {
    constexpr float kSlack = 1e-3f;
    const float last = triangle.column[0] + (triangle.row[2] - triangle.row[0]) * triangle.slope[2];
    const auto [least, greatest] = std::minmax({triangle.column[0], triangle.column[1], last});
    column[0] = cell(least - kSlack, grid.columns);
    column[1] = cell(greatest + kSlack, grid.columns);
    row[0] = cell(triangle.row[0] - kSlack, grid.rows);
    row[1] = cell(triangle.row[2] + kSlack, grid.rows);
  }
  std::uint64_t count() const { return std::uint64_t{column[1] - column[0] + 1} * (row[1] - row[0] + 1); }
  template <class Visit> void for_each(const MeshGridRecord& grid, Visit visit) const {
    for (std::uint32_t j = row[0]; j <= row[1]; ++j)
      for (std::uint32_t i = column[0]; i <= column[1]; ++i)
        visit(j * grid.columns + i);
  }

private:
  static std::uint32_t cell(float at, std::uint32_t count) {
    return static_cast<std::uint32_t>(std::clamp(at, 0.0f, static_cast<float>(count - 1)));
  }
};

} // namespace

const MeshInsides::Inside& MeshInsides::of(const Mesh& mesh) {
  const auto [known, is_new] = insides_.try_emplace(&mesh);
  if (is_new) known->second = add(mesh);
  return known->second;
}

MeshInsides::Inside MeshInsides::add(const Mesh& mesh) {
  Vec3 extent;
  const Transform to_unit = unit_space(mesh, extent);
  MeshGridRecord grid = make_grid(std::max<std::size_t>(mesh.triangles.size(), 1), extent);
  const auto first = static_cast<std::uint32_t>(triangles_.size());
  for (;; grid.columns = (grid.columns + 1) / 2, grid.rows = (grid.rows + 1) / 2) {
    const Transform to_grid = to_unit.then(
        Transform::scale({static_cast<double>(grid.columns), static_cast<double>(grid.rows), 1}));
    triangles_.resize(first);
    std::uint64_t entries = 0;
    for (const Mesh::Triangle& triangle : mesh.triangles) {
      ProgressMonitor::check_cancelled(static_cast<std::size_t>(&triangle - mesh.triangles.data()));
      Vec3f corners[3];
      for (int i = 0; i < 3; ++i)
        corners[i] = Vec3f(to_grid.point(Vec3(mesh.vertices[triangle.vertex[i]])));
      const MeshTriangleRecord record = make_triangle(corners);
      if (record.row[0] == record.row[2]) continue; // no point lies below the triangle
      triangles_.push_back(record);
      entries += CellRange(record, grid).count();
    }
    if (entries > kMostEntriesPerTriangle * mesh.triangles.size() && std::max(grid.columns, grid.rows) > 1)
      continue;
    add_lists(grid, first);
    grids_.push_back(grid);
    return {static_cast<std::uint32_t>(grids_.size()) - 1, to_grid};
  }
}

/// Appends the words of a grid, with lists made by a counting sort, and sets grid.starts.
void MeshInsides::add_lists(MeshGridRecord& grid, std::uint32_t first_triangle) {
  const std::uint32_t cells = grid.columns * grid.rows;
  const auto triangle_count = static_cast<std::uint32_t>(triangles_.size());
  std::vector<std::uint32_t> ends(cells);
  for (std::uint32_t i = first_triangle; i < triangle_count; ++i) {
    ProgressMonitor::check_cancelled(i);
    CellRange(triangles_[i], grid).for_each(grid, [&](std::uint32_t cell) { ++ends[cell]; });
  }
  grid.starts = static_cast<std::uint32_t>(words_.size());
  std::uint32_t at = grid.starts + cells + 1;
  words_.push_back(at);
  for (std::uint32_t& end : ends) {
    at += end;
    end = at;
    words_.push_back(at);
  }
  words_.resize(at);
  for (std::uint32_t i = triangle_count; i-- > first_triangle;) {
    ProgressMonitor::check_cancelled(i);
    CellRange(triangles_[i], grid).for_each(grid, [&](std::uint32_t cell) { words_[--ends[cell]] = i; });
  }
}

} // namespace celltrace

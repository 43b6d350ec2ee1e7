#include "scene_image/mesh_prototype.hpp"

#include "celltrace/spe/simd_host.hpp"
#include "geometry/triangles.hpp"
#include "kernel/direct/build_bvh_split.hpp"
#include "scene/progress_monitor.hpp"
#include "scene_image/object_order.hpp"
#include "scene_image/record_vectors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace celltrace {

using namespace kernel;
using bvh::Reference;

namespace {

using Simd = HostSimd<BaselineArch>;
using Range = bvh::Range<Simd>;

/// Least number of triangles of a mesh that is shared; with fewer, placing each instance's groups in the BVH
/// takes longer than building the BVH anew.
constexpr std::size_t kFewestTriangles = 32;
constexpr std::uint32_t kTrianglesPerThread = 8192;
constexpr std::uint32_t kTrianglesPerRun = 128;
static_assert(kTrianglesPerRun <= kMaxCopiedObjects);
/// Number of triangles below which the order does not matter: about as many as in a leaf of the BVH.
constexpr std::uint32_t kTrianglesPerLeaf = 4;

Reference reference_to(std::uint32_t number, const Mesh& mesh) {
  const Index(&vertex)[3] = mesh.triangles[number].vertex;
  const Vec3f &a = mesh.vertices[vertex[0]], &b = mesh.vertices[vertex[1]], &c = mesh.vertices[vertex[2]];
  Reference reference;
  copy(glm::min(a, glm::min(b, c)), reference.min);
  copy(glm::max(a, glm::max(b, c)), reference.max);
  reference.value = number;
  reference.weight = 1;
  return reference;
}

/// Orders references by dividing the whole range down to small parts.
class Divider {
public:
  explicit Divider(std::vector<Reference>& references) : references_(references), spare_(references.size()) {}

  /// Calls `part(range)`, and if that returns true, divides the range in two and does the same with both
  /// parts, in order.
  template <class Part> void divide(std::uint32_t begin, std::uint32_t end, Part part) {
    if (begin == end) return;
    std::vector<Range> open = {bvh::range_of<Simd>(references_.data(), begin, end)};
    while (!open.empty()) {
      ProgressMonitor::check_cancelled(checks_++);
      const Range range = open.back();
      open.pop_back();
      if (!part(range) || range.count() < 2) continue;
      Range left, right;
      bvh::split_range(references_.data(), spare_.data(), range, left, right);
      open.push_back(right);
      open.push_back(left);
    }
  }

private:
  std::vector<Reference>& references_;
  std::vector<Reference> spare_;
  std::size_t checks_ = 0;
};

/// Returns references to the triangles with an area, in the order of the mesh.
std::vector<Reference> references_to_triangles(const Mesh& mesh) {
  std::vector<Reference> references;
  references.reserve(mesh.triangles.size());
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    ProgressMonitor::check_cancelled(i);
    const Index(&vertex)[3] = mesh.triangles[i].vertex;
    if (has_area(mesh.vertices[vertex[0]], mesh.vertices[vertex[1]], mesh.vertices[vertex[2]]))
      references.push_back(reference_to(i, mesh));
  }
  return references;
}

/// Orders references along a curve, and returns one reference to each group that the curve makes.
std::vector<Reference> order_coarsely(std::vector<Reference>& references, unsigned threads) {
  const auto count = static_cast<std::uint32_t>(references.size());
  std::vector<PlacedObject> placed(count), spare(count);
  std::vector<std::uint32_t> cells(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    const Reference& r = references[i];
    placed[i] = {{r.min[0] + r.max[0], r.min[1] + r.max[1], r.min[2] + r.max[2]}, i};
  }
  const std::vector<std::uint32_t> begins = order_along_curve(
      placed.data(), spare.data(), cells.data(), count, std::clamp(count / kTrianglesPerThread, 1u, threads));
  std::vector<Reference> ordered(count);
  for (std::uint32_t i = 0; i < count; ++i)
    ordered[i] = references[placed[i].source];
  references = std::move(ordered);
  std::vector<Reference> groups(begins.size() - 1);
  for (std::size_t group = 0; group < groups.size(); ++group) {
    const Range range = bvh::range_of<Simd>(references.data(), begins[group], begins[group + 1]);
    range.box.min.store(groups[group].min); // also writes the neighbouring words
    range.box.max.store(groups[group].max);
    groups[group].value = range.begin;
    groups[group].weight = range.count();
  }
  return groups;
}

/// Orders references so that any few consecutive groups are neighbours in space. Returns the begins of the
/// parts that are to be divided further, followed by the number of references.
std::vector<std::uint32_t> order_groups(std::vector<Reference>& references, unsigned threads) {
  const auto count = static_cast<std::uint32_t>(references.size());
  if (count < kMinObjectsToOrder) return {0, count};
  std::vector<Reference> groups = order_coarsely(references, threads);
  std::vector<Reference> ordered;
  ordered.reserve(count);
  std::vector<std::uint32_t> begins;
  Divider(groups).divide(0, static_cast<std::uint32_t>(groups.size()), [&](const Range& range) {
    if (range.weight > kTrianglesPerRun && range.count() > 1) return true;
    begins.push_back(static_cast<std::uint32_t>(ordered.size()));
    for (std::uint32_t group = range.begin; group < range.end; ++group) {
      const auto first = references.begin() + groups[group].value;
      ordered.insert(ordered.end(), first, first + groups[group].weight);
    }
    return false;
  });
  begins.push_back(count);
  references = std::move(ordered);
  return begins;
}

Aabb bounds_of_references(const std::vector<Reference>& references, std::uint32_t begin, std::uint32_t end) {
  const Range range = bvh::range_of<Simd>(references.data(), begin, end);
  Reference around;
  range.box.min.store(around.min); // also writes the neighbouring words
  range.box.max.store(around.max);
  return {{around.min[0], around.min[1], around.min[2]}, {around.max[0], around.max[1], around.max[2]}};
}

/// Orders references down to the leaves. Returns the begins of the groups, followed by the number of
/// references.
std::vector<std::uint32_t> order_by_run(std::vector<Reference>& references, unsigned threads) {
  const std::vector<std::uint32_t> parts = order_groups(references, threads);
  std::vector<std::uint32_t> groups;
  Divider divider(references);
  for (std::size_t part = 0; part + 1 < parts.size(); ++part) {
    std::uint32_t run_end = parts[part];
    divider.divide(parts[part], parts[part + 1], [&](const Range& range) {
      if (range.begin >= run_end && range.count() <= kTrianglesPerRun) {
        groups.push_back(range.begin);
        run_end = range.end;
      }
      return range.count() > kTrianglesPerLeaf;
    });
  }
  groups.push_back(static_cast<std::uint32_t>(references.size()));
  return groups;
}

/// Numbers points in the order in which they are requested; equal points get one number.
class PointTable {
public:
  /// Takes the points of a mesh with this many triangles. If it has fewer points than triangles, they are
  /// shared already.
  PointTable(const std::vector<Vec3f>& points, std::size_t triangles)
      : points_(points), first_like_(points.size()), number_(points.size(), kNoIndex) {
    std::iota(first_like_.begin(), first_like_.end(), Index{0});
    if (points.size() > triangles) find_equal();
  }

  Index number_of(Index point) {
    Index& number = number_[first_like_[point]];
    if (number == kNoIndex) {
      number = static_cast<Index>(used_.size());
      used_.push_back(points_[point]);
    }
    return number;
  }
  std::vector<Vec3f> take_used() { return std::move(used_); }

private:
  void find_equal() {
    std::vector<Index> order = first_like_;
    std::size_t checks = 0;
    const auto less = [&](Index a, Index b) {
      ProgressMonitor::check_cancelled(checks++);
      const Vec3f &p = points_[a], &q = points_[b];
      return p.x != q.x ? p.x < q.x : p.y != q.y ? p.y < q.y : p.z < q.z;
    };
    std::sort(order.begin(), order.end(), less);
    for (std::size_t i = 1; i < order.size(); ++i)
      if (!less(order[i - 1], order[i])) first_like_[order[i]] = first_like_[order[i - 1]];
  }

  const std::vector<Vec3f>& points_;
  std::vector<Index> first_like_; ///< index: point; the first point that is equal to it
  std::vector<Index> number_;     ///< index: first of several equal points
  std::vector<Vec3f> used_;
};

} // namespace

bool MeshPrototype::is_large_enough(const Mesh& mesh) {
  return mesh.triangles.size() >= kFewestTriangles;
}

bool MeshPrototype::can_be_made(const Mesh& mesh) {
  const auto one_material = [](const Mesh::Triangle& triangle) { return same(triangle.material); };
  return is_large_enough(mesh) && std::all_of(mesh.triangles.begin(), mesh.triangles.end(), one_material);
}

MeshPrototype::MeshPrototype(const Mesh& mesh, unsigned threads) {
  std::vector<Reference> references = references_to_triangles(mesh);
  groups_ = order_by_run(references, threads);
  for (std::size_t group = 0; group + 1 < groups_.size(); ++group)
    group_bounds_.push_back(bounds_of_references(references, groups_[group], groups_[group + 1]));
  PointTable vertices(mesh.vertices, mesh.triangles.size());
  PointTable normals(mesh.normals, mesh.triangles.size());
  triangles_.reserve(references.size());
  for (const Reference& reference : references) {
    ProgressMonitor::check_cancelled(triangles_.size());
    const Mesh::Triangle& from = mesh.triangles[reference.value];
    Triangle triangle = {{0, 0, 0}, {kNoIndex, kNoIndex, kNoIndex}, from.material[0]};
    for (int corner = 0; corner < 3; ++corner) {
      triangle.vertex[corner] = vertices.number_of(from.vertex[corner]);
      if (is_smooth(from)) triangle.normal[corner] = normals.number_of(from.normal[corner]);
    }
    smooth_ += is_smooth(from);
    triangles_.push_back(triangle);
  }
  vertices_ = vertices.take_used();
  measure();
  for (const Vec3f& normal : normals.take_used())
    unit_normals_.push_back(unit_normal(normal));
}

void MeshPrototype::measure() {
  if (vertices_.empty()) return;
  min_ = max_ = vertices_.front();
  for (const Vec3f& vertex : vertices_) {
    min_ = glm::min(min_, vertex);
    max_ = glm::max(max_, vertex);
  }
  least_height_ = std::numeric_limits<double>::max();
  for (const Triangle& triangle : triangles_) {
    ProgressMonitor::check_cancelled(static_cast<std::size_t>(&triangle - triangles_.data()));
    const Vec3 a(vertices_[triangle.vertex[0]]);
    const Vec3 u = Vec3(vertices_[triangle.vertex[1]]) - a;
    const Vec3 v = Vec3(vertices_[triangle.vertex[2]]) - a;
    const double longest = std::max({glm::length(u), glm::length(v), glm::length(u - v)});
    least_height_ = std::min(least_height_, glm::length(glm::cross(u, v)) / longest);
  }
}

bool MeshPrototype::surely_preserves_areas(const Transform& transform) const {
  constexpr double kMost = 1e17;
  double farthest = 0; // greatest absolute coordinate of a corner of the box around all triangles
  for (unsigned corner = 0; corner < 8; ++corner) {
    const auto of = [corner, this](int axis) { return (corner >> axis & 1) != 0 ? max_[axis] : min_[axis]; };
    const Vec3 at = transform.point(Vec3(of(0), of(1), of(2)));
    for (int axis = 0; axis < 3; ++axis) {
      if (!(std::abs(at[axis]) < kMost)) return false;
      farthest = std::max(farthest, std::abs(at[axis]));
    }
  }
  // The product of the factors along the three axes of stretching is the determinant, and the sum of the
  // squares of the two largest factors is at most `squares`: no direction shrinks by more than the quotient.
  double squares = 0;
  for (int row = 0; row < 3; ++row)
    squares += glm::dot(transform.rows[row], transform.rows[row]);
  const double least_factor = std::abs(transform.determinant()) / squares;
  // Rounding moves a corner by a ten millionth of `farthest`.
  return least_height_ * least_factor > 1e-6 * farthest + 1e-35;
}

} // namespace celltrace

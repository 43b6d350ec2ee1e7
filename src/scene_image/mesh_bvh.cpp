#include "scene_image/mesh_bvh.hpp"

#include "records/instance.hpp"
#include "scene/progress_monitor.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace celltrace {

using namespace kernel;

namespace {

/// Limit on triangles in a leaf; a packet tests about as many triangles in the time of one node.
constexpr std::uint32_t kMostInLeaf = 4;
/// Limit on places at which the surface area heuristic tries to split a range; in short ranges it tries all
/// places.
constexpr std::uint32_t kMostPlaces = 64;

constexpr float kBeyond = 3e38f;

float half_area(const Aabb& box) {
  const float x = box.max[0] - box.min[0], y = box.max[1] - box.min[1], z = box.max[2] - box.min[2];
  return x * y + (x + y) * z;
}

struct TriangleRange {
  std::uint32_t begin = 0, end = 0;
  Aabb box{};

  std::uint32_t count() const { return end - begin; }
};

class MeshBvhBuilder {
public:
  explicit MeshBvhBuilder(std::span<const Aabb> bounds) : bounds_(bounds) {}

  std::vector<NodeRecord> build() {
    add_node(range(0, static_cast<std::uint32_t>(bounds_.size())), kMaxMeshLevels);
    return std::move(nodes_);
  }

private:
  TriangleRange range(std::uint32_t begin, std::uint32_t end) const {
    TriangleRange all = {begin, end, bounds_[begin]};
    for (std::uint32_t i = begin + 1; i < end; ++i)
      all.box = united(all.box, bounds_[i]);
    return all;
  }

  /// Returns how many triangles fit into a tree of `levels` levels.
  static std::uint64_t room_of(std::uint32_t levels) { return std::uint64_t{kMostInLeaf} << (2 * levels); }

  /// Adds a node for a range, and the nodes below it; together these have at most `levels` levels. Returns
  /// the node's index.
  std::uint32_t add_node(const TriangleRange& all, std::uint32_t levels) {
    ProgressMonitor::check_cancelled(nodes_.size());
    std::array<TriangleRange, 4> children = {all};
    std::size_t count = 1;
    // Splits ranges that do not fit into the levels below first, then the most expensive range.
    const std::uint64_t room = room_of(levels - 1);
    const auto urgency = [room](const TriangleRange& r) {
      const float cost = r.count() > kMostInLeaf ? half_area(r.box) * static_cast<float>(r.count()) : -1.0f;
      return std::pair(r.count() > room, cost);
    };
    while (count < children.size()) {
      TriangleRange* const most = std::max_element(
          children.begin(), children.begin() + static_cast<std::ptrdiff_t>(count),
          [&](const TriangleRange& a, const TriangleRange& b) { return urgency(a) < urgency(b); });
      if (most->count() <= kMostInLeaf) break;
      children[count++] = split(*most, room);
    }
    const auto number = static_cast<std::uint32_t>(nodes_.size());
    nodes_.emplace_back();
    for (std::size_t i = 0; i < children.size(); ++i) {
      const bool is_there = i < count;
      const TriangleRange& child = children[i];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        nodes_[number].bounds[2 * axis][i] = is_there ? child.box.min[axis] : kBeyond;
        nodes_[number].bounds[2 * axis + 1][i] = is_there ? child.box.max[axis] : -kBeyond;
      }
      if (!is_there) continue;
      const bool is_leaf = child.count() <= kMostInLeaf;
      const std::uint32_t at = is_leaf ? child.begin : add_node(child, levels - 1);
      nodes_[number].child[i] = at;
      nodes_[number].leaf[i] = is_leaf ? leaf_word::make(child.count(), 1) : 0;
    }
    return number;
  }

  /// Splits `left` in two, keeps the first part in it and returns the second part. Neither part has more than
  /// `most` triangles; if there is no such place, splits the range in the middle.
  TriangleRange split(TriangleRange& left, std::uint64_t most) {
    const std::uint32_t count = left.count(), places = std::min(count, kMostPlaces);
    const auto place = [&](std::uint32_t i) {
      return left.begin + static_cast<std::uint32_t>(std::uint64_t{count} * i / places);
    };
    parts_.resize(places);
    for (std::uint32_t i = 0; i < places; ++i)
      parts_[i] = range(place(i), place(i + 1));
    behind_.resize(places);
    behind_[places - 1] = parts_[places - 1].box;
    for (std::uint32_t i = places - 1; i-- > 0;)
      behind_[i] = united(parts_[i].box, behind_[i + 1]);
    std::uint32_t best = 0;
    float least = 0;
    Aabb before = parts_[0].box, box = before;
    for (std::uint32_t i = 1; i < places; ++i) {
      const std::uint32_t in_left = place(i) - left.begin, in_right = count - in_left;
      const float cost = half_area(before) * static_cast<float>(in_left) +
                         half_area(behind_[i]) * static_cast<float>(in_right);
      const bool has_room = std::max(in_left, in_right) <= most;
      if (has_room && (best == 0 || cost < least)) {
        best = i;
        least = cost;
        box = before;
      }
      before = united(before, parts_[i].box);
    }
    const std::uint32_t end = left.end, middle = best != 0 ? place(best) : left.begin + count / 2;
    TriangleRange right = best != 0 ? TriangleRange{middle, end, behind_[best]} : range(middle, end);
    left = best != 0 ? TriangleRange{left.begin, middle, box} : range(left.begin, middle);
    return right;
  }

  std::span<const Aabb> bounds_;
  std::vector<NodeRecord> nodes_;
  std::vector<TriangleRange> parts_; ///< parts between the places at which a range may be split
  std::vector<Aabb> behind_;         ///< bounds of each part together with all parts behind it
};

} // namespace

std::vector<NodeRecord> build_mesh_bvh(std::span<const Aabb> bounds) {
  return MeshBvhBuilder(bounds).build();
}

} // namespace celltrace

#include "render/single_ray_bvh.hpp"

#include "celltrace/error.hpp"
#include "kernel/primitives/triangle.hpp"

#include <algorithm>
#include <array>
#include <deque>
#include <limits>
#include <span>

namespace celltrace {

using namespace kernel;

namespace {

constexpr std::uint32_t kBlock = 4;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// What may become a child of a node: something of the image's BVH, or some triangles of one of its leaves.
struct Part {
  Aabb box;
  const NodeRecord* node = nullptr;        ///< if it is a node
  std::span<std::uint32_t> triangles = {}; ///< if it is some of them; offsets
  std::span<std::uint32_t> others = {};    ///< if it is other objects; offsets
};

float half_area(const Aabb& box) {
  const float x = box.max[0] - box.min[0], y = box.max[1] - box.min[1], z = box.max[2] - box.min[2];
  return x * y + y * z + z * x;
}

Aabb empty_box() {
  return {{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
}

void grow(Aabb& box, const Aabb& by) {
  for (int axis = 0; axis < 3; ++axis) {
    box.min[axis] = std::min(box.min[axis], by.min[axis]);
    box.max[axis] = std::max(box.max[axis], by.max[axis]);
  }
}

bool is_plain_triangle(const ObjectRecord& object) {
  constexpr std::uint32_t kAsked = object_flag::kind_mask | object_flag::csg | object_flag::selective;
  return (object.kind_and_flags & kAsked) == static_cast<std::uint32_t>(ObjectKind::triangle);
}

} // namespace

class SingleRayBvh::Builder {
public:
  Builder(SingleRayBvh& bvh, const SceneImage& image) : bvh_(bvh), image_(image) {}

  void build(std::uint32_t root) {
    std::vector<Part> parts;
    add_children(record<NodeRecord>(root), parts);
    make_node(std::move(parts));
  }

private:
  template <class Record> const Record& record(std::uint32_t offset) const {
    return *reinterpret_cast<const Record*>(image_.base() + offset);
  }
  Aabb box_of(std::uint32_t triangle) const {
    return TrianglePrimitive::bounds(record<ObjectRecord>(triangle), {});
  }

  void add_children(const NodeRecord& node, std::vector<Part>& parts) {
    for (int i = 0; i < 4; ++i) {
      Part part;
      for (int axis = 0; axis < 3; ++axis) {
        part.box.min[axis] = node.bounds[2 * axis][i];
        part.box.max[axis] = node.bounds[2 * axis + 1][i];
      }
      if (!(part.box.min[0] <= part.box.max[0])) continue;
      if (node.leaf[i] == 0) {
        part.node = &record<NodeRecord>(node.child[i]);
        parts.push_back(part);
      } else {
        add_leaf(node.child[i], node.leaf[i], part, parts);
      }
    }
  }

  /// Triangles and other objects of a leaf are two parts.
  void add_leaf(std::uint32_t first, std::uint32_t word, const Part& leaf, std::vector<Part>& parts) {
    const std::uint32_t count = leaf_word::count(word), step = leaf_word::step_bytes(word);
    std::vector<std::uint32_t>& members = members_.emplace_back(count);
    for (std::uint32_t i = 0; i < count; ++i)
      members[i] = leaf_word::is_list(word) ? record<std::uint32_t>(first + i * 4) : first + i * step;
    const auto middle = std::partition(members.begin(), members.end(), [this](std::uint32_t offset) {
      return is_plain_triangle(record<ObjectRecord>(offset));
    });
    Part part = leaf;
    part.triangles = {members.begin(), middle};
    part.others = {};
    if (!part.triangles.empty()) parts.push_back(part);
    part.triangles = {};
    part.others = {middle, members.end()};
    if (!part.others.empty()) parts.push_back(part);
  }

  /// Of two halves of the triangles of a leaf, along the longest side of the box around their middles.
  void halve(const Part& leaf, std::vector<Part>& parts) const {
    Aabb middles = empty_box();
    for (const std::uint32_t triangle : leaf.triangles) {
      const Aabb box = box_of(triangle);
      for (int axis = 0; axis < 3; ++axis) {
        middles.min[axis] = std::min(middles.min[axis], box.min[axis] + box.max[axis]);
        middles.max[axis] = std::max(middles.max[axis], box.min[axis] + box.max[axis]);
      }
    }
    int axis = 0;
    for (int other = 1; other < 3; ++other)
      if (middles.max[other] - middles.min[other] > middles.max[axis] - middles.min[axis]) axis = other;
    const std::size_t blocks = (leaf.triangles.size() + kBlock - 1) / kBlock;
    const std::size_t half = (blocks + 1) / 2 * kBlock;
    std::nth_element(leaf.triangles.begin(), leaf.triangles.begin() + static_cast<std::ptrdiff_t>(half),
                     leaf.triangles.end(), [&](std::uint32_t a, std::uint32_t b) {
                       const Aabb of_a = box_of(a), of_b = box_of(b);
                       return of_a.min[axis] + of_a.max[axis] < of_b.min[axis] + of_b.max[axis];
                     });
    for (const std::span<std::uint32_t> triangles :
         {leaf.triangles.first(half), leaf.triangles.subspan(half)}) {
      Part part;
      part.box = empty_box();
      for (const std::uint32_t triangle : triangles)
        grow(part.box, box_of(triangle));
      for (int i = 0; i < 3; ++i) {
        part.box.min[i] = std::max(part.box.min[i], leaf.box.min[i]);
        part.box.max[i] = std::min(part.box.max[i], leaf.box.max[i]);
      }
      part.triangles = triangles;
      parts.push_back(part);
    }
  }

  /// Returns its index. Of what there is, the largest that has parts is divided, as long as there is room.
  std::uint32_t make_node(std::vector<Part> parts) {
    for (;;) {
      const auto divides = [&](const Part& part) {
        const std::size_t more = part.node != nullptr ? 3 : 1;
        return parts.size() + more <= QueryNode::kWidth &&
               (part.node != nullptr || part.triangles.size() > kBlock);
      };
      const Part* largest = nullptr;
      for (const Part& part : parts)
        if (divides(part) && (largest == nullptr || half_area(part.box) > half_area(largest->box)))
          largest = &part;
      if (largest == nullptr) break;
      const Part whole = *largest;
      parts.erase(parts.begin() + (largest - parts.data()));
      if (whole.node != nullptr)
        add_children(*whole.node, parts);
      else
        halve(whole, parts);
    }
    const auto index = static_cast<std::uint32_t>(bvh_.nodes_.size());
    bvh_.nodes_.emplace_back();
    std::array<std::uint32_t, QueryNode::kWidth> children{};
    for (std::size_t i = 0; i < parts.size(); ++i)
      children[i] = make_ref(parts[i]);
    QueryNode& node = bvh_.nodes_[index];
    for (std::size_t i = 0; i < QueryNode::kWidth; ++i) {
      const Aabb box = i < parts.size() ? parts[i].box : empty_box();
      for (std::size_t axis = 0; axis < 3; ++axis) {
        node.bounds[2 * axis][i] = box.min[axis];
        node.bounds[2 * axis + 1][i] = box.max[axis];
      }
      node.child[i] = children[i];
    }
    return index;
  }

  std::uint32_t make_ref(const Part& part) {
    if (part.node != nullptr) {
      std::vector<Part> parts;
      add_children(*part.node, parts);
      return query_ref::make(query_ref::node, make_node(std::move(parts)));
    }
    if (!part.others.empty()) {
      const auto index = static_cast<std::uint32_t>(bvh_.others_.size());
      bvh_.others_.insert(bvh_.others_.end(), part.others.begin(), part.others.end());
      bvh_.others_.push_back(kNoOffset);
      return query_ref::make(query_ref::others, index);
    }
    if (part.triangles.size() <= kBlock)
      return query_ref::make(query_ref::triangles, make_blocks(part.triangles));
    std::vector<Part> halves;
    halve(part, halves);
    return query_ref::make(query_ref::node, make_node(std::move(halves)));
  }

  std::uint32_t make_blocks(std::span<const std::uint32_t> triangles) {
    const auto index = static_cast<std::uint32_t>(bvh_.blocks_.size());
    TriangleBlock& block = bvh_.blocks_.emplace_back();
    for (std::size_t lane = 0; lane < kBlock; ++lane) {
      const std::uint32_t offset = triangles[lane < triangles.size() ? lane : 0];
      const float* const g = record<ObjectRecord>(offset).geometry;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        block.v0[axis][lane] = g[axis];
        block.edge1[axis][lane] = g[3 + axis] - g[axis];
        block.edge2[axis][lane] = g[6 + axis] - g[axis];
      }
      block.offset[lane] = offset;
    }
    return index;
  }

  SingleRayBvh& bvh_;
  const SceneImage& image_;
  std::deque<std::vector<std::uint32_t>> members_; ///< of leaves, where spans point to
};

SingleRayBvh::SingleRayBvh(const SceneImage& image, std::uint32_t root) {
  nodes_.reserve(image.header().object_count / 8 + 1);
  blocks_.reserve(image.header().object_count / 2 + 1);
  Builder(*this, image).build(root);
}

} // namespace celltrace

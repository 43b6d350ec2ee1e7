#include "render/single_ray_bvh.hpp"

#include "celltrace/error.hpp"
#include "kernel/primitives/triangle.hpp"
#include "memory/huge_pages.hpp"
#include "records/accelerator.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace celltrace {

using namespace kernel;

namespace {

constexpr std::uint32_t kBlock = 4;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// The contents of a leaf of the image's BVH: a triangle, or a list of other objects.
struct Reference {
  Aabb box;
  std::uint32_t index; ///< offset of the triangle, or index of the list's first entry
  bool is_triangle;

  /// Returns twice the middle of the box along an axis.
  float middle(int axis) const { return box.min[axis] + box.max[axis]; }
};
using References = std::span<Reference>;

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

} // namespace

class SingleRayBvh::Builder {
public:
  Builder(SingleRayBvh& bvh, const SceneImage& image) : bvh_(bvh), image_(image) {}

  void build(std::uint32_t root) {
    references_.reserve(image_.header().object_count);
    collect(record<NodeRecord>(root));
    bvh_.nodes_.emplace_back();
    fill_node(0, references_, 0);
  }

private:
  struct Part {
    References references;
    Aabb box;
  };
  struct Split {
    float cost = kInfinity;
    std::size_t left = 0; ///< number of references to the left
    int axis = 0;
    float middle = 0; ///< twice the place of the split: references with a lower middle go to the left
  };

  /// Limit on levels at which nodes are split by cost. Below, nodes are split into equal halves, so that the
  /// stack of a traversal is bounded.
  static constexpr int kFreeLevels = 32;
  static constexpr std::size_t kBins = 32;

  template <class Record> const Record& record(std::uint32_t offset) const {
    return *reinterpret_cast<const Record*>(image_.base() + offset);
  }

  void collect(const NodeRecord& node) {
    for (int i = 0; i < 4; ++i) {
      Aabb box;
      for (int axis = 0; axis < 3; ++axis) {
        box.min[axis] = node.bounds[2 * axis][i];
        box.max[axis] = node.bounds[2 * axis + 1][i];
      }
      if (!(box.min[0] <= box.max[0])) continue;
      if (node.leaf[i] == 0)
        collect(record<NodeRecord>(node.child[i]));
      else
        add_leaf(node.child[i], node.leaf[i], box);
    }
  }

  void add_leaf(std::uint32_t first, std::uint32_t word, const Aabb& box) {
    const std::uint32_t count = leaf_word::count(word), step = leaf_word::step_bytes(word);
    const auto list = static_cast<std::uint32_t>(bvh_.others_.size());
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t offset =
          leaf_word::is_list(word) ? record<std::uint32_t>(first + i * 4) : first + i * step;
      if (!kPlainTriangle.are_in(record<ObjectRecord>(offset).kind_and_flags)) {
        bvh_.others_.push_back(offset);
        continue;
      }
      // A reference's box has only the part of a triangle that is in the reference's leaf.
      Aabb part = TrianglePrimitive::bounds(record<ObjectRecord>(offset), {});
      for (int axis = 0; axis < 3; ++axis) {
        part.min[axis] = std::max(part.min[axis], box.min[axis]);
        part.max[axis] = std::min(part.max[axis], box.max[axis]);
      }
      references_.push_back({part, offset, true});
    }
    if (bvh_.others_.size() == list) return;
    bvh_.others_.push_back(kNoOffset);
    references_.push_back({box, list, false});
  }

  static Aabb box_of(References references) {
    Aabb box = empty_box();
    for (const Reference& reference : references)
      grow(box, reference.box);
    return box;
  }
  static bool is_leaf(References references) {
    return references.size() == 1 ||
           (references.size() <= kBlock && std::all_of(references.begin(), references.end(),
                                                       [](const Reference& r) { return r.is_triangle; }));
  }
  /// Returns the cost of testing this many triangles: the number of their blocks.
  static float blocks(std::size_t count) { return static_cast<float>((count + kBlock - 1) / kBlock); }

  /// Finds the best split by the surface area heuristic, among places between bins of equal width along each
  /// axis.
  static Split best_split(References references) {
    Aabb middles = empty_box();
    for (const Reference& reference : references)
      for (int axis = 0; axis < 3; ++axis) {
        middles.min[axis] = std::min(middles.min[axis], reference.middle(axis));
        middles.max[axis] = std::max(middles.max[axis], reference.middle(axis));
      }
    Split best;
    for (int axis = 0; axis < 3; ++axis) {
      const float low = middles.min[axis], width = middles.max[axis] - low;
      const float scale = static_cast<float>(kBins) * 0.9999f / width;
      if (!(width > 0) || !std::isfinite(scale)) continue;
      std::array<Aabb, kBins> bounds;
      bounds.fill(empty_box());
      std::array<std::size_t, kBins> counts{};
      for (const Reference& reference : references) {
        const auto bin = static_cast<std::size_t>((reference.middle(axis) - low) * scale);
        grow(bounds[bin], reference.box);
        ++counts[bin];
      }
      std::array<float, kBins> right{}; // cost of each bin together with the bins after it
      Aabb box = empty_box();
      std::size_t count = 0;
      for (std::size_t bin = kBins; bin-- > 1;) {
        grow(box, bounds[bin]);
        count += counts[bin];
        right[bin] = count == 0 ? kInfinity : half_area(box) * blocks(count);
      }
      box = empty_box();
      count = 0;
      for (std::size_t bin = 1; bin < kBins; ++bin) {
        grow(box, bounds[bin - 1]);
        count += counts[bin - 1];
        if (count == 0) continue;
        const float cost = half_area(box) * blocks(count) + right[bin];
        if (cost < best.cost) best = {cost, count, axis, low + static_cast<float>(bin) / scale};
      }
    }
    return best;
  }

  /// Divides references into two parts, neither of them empty.
  static std::pair<Part, Part> divide(References references, int level) {
    std::size_t left = references.size() / 2;
    if (const Split split = best_split(references); split.cost < kInfinity && level < kFreeLevels) {
      const auto middle =
          std::partition(references.begin(), references.end(), [&](const Reference& reference) {
            return reference.middle(split.axis) < split.middle;
          });
      const auto below = static_cast<std::size_t>(middle - references.begin());
      if (below != 0 && below != references.size()) left = below;
    }
    const References first = references.first(left), second = references.subspan(left);
    return {{first, box_of(first)}, {second, box_of(second)}};
  }

  /// Divides the largest part of a node as long as the node has room for another part.
  void fill_node(std::uint32_t index, References references, int level) {
    std::array<Part, QueryNode::kWidth> parts;
    parts[0] = {references, box_of(references)};
    std::size_t count = references.empty() ? 0 : 1;
    while (count > 0 && count < parts.size()) {
      Part* largest = nullptr;
      for (std::size_t i = 0; i < count; ++i)
        if (!is_leaf(parts[i].references) &&
            (largest == nullptr || half_area(parts[i].box) > half_area(largest->box)))
          largest = &parts[i];
      if (largest == nullptr) break;
      std::tie(*largest, parts[count]) = divide(largest->references, level);
      ++count;
    }
    std::array<std::uint32_t, QueryNode::kWidth> children{};
    for (std::size_t i = 0; i < count; ++i)
      children[i] = make_ref(parts[i].references);
    QueryNode& node = bvh_.nodes_[index];
    for (std::size_t i = 0; i < QueryNode::kWidth; ++i) {
      const Aabb box = i < count ? parts[i].box : empty_box();
      for (std::size_t axis = 0; axis < 3; ++axis) {
        node.bounds[2 * axis][i] = box.min[axis];
        node.bounds[2 * axis + 1][i] = box.max[axis];
      }
      node.child[i] = children[i];
    }
    for (std::size_t i = 0; i < count; ++i)
      if (query_ref::kind(children[i]) == query_ref::node)
        fill_node(query_ref::index(children[i]), parts[i].references, level + 1);
  }

  /// Returns a reference to a leaf or to a new node, which is filled later.
  std::uint32_t make_ref(References references) {
    if (!is_leaf(references)) {
      bvh_.nodes_.emplace_back();
      return query_ref::make(query_ref::node, static_cast<std::uint32_t>(bvh_.nodes_.size() - 1));
    }
    if (!references[0].is_triangle) return query_ref::make(query_ref::others, references[0].index);
    return query_ref::make(query_ref::triangles, make_block(references));
  }

  std::uint32_t make_block(References triangles) {
    const auto index = static_cast<std::uint32_t>(bvh_.blocks_.size());
    TriangleBlock& block = bvh_.blocks_.emplace_back();
    for (std::size_t lane = 0; lane < kBlock; ++lane) {
      const std::uint32_t offset = triangles[lane < triangles.size() ? lane : 0].index;
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
  std::vector<Reference> references_;
};

SingleRayBvh::SingleRayBvh(const SceneImage& image, std::uint32_t root) {
  nodes_.reserve(image.header().object_count / 8 + 1);
  blocks_.reserve(image.header().object_count / 2 + 1);
  // Rays access these tables in random order.
  use_huge_pages(nodes_.data(), nodes_.capacity() * sizeof(QueryNode));
  use_huge_pages(blocks_.data(), blocks_.capacity() * sizeof(TriangleBlock));
  Builder(*this, image).build(root);
}

} // namespace celltrace

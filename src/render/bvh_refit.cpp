#include "render/bvh_refit.hpp"

#include "celltrace/spe/simd_host.hpp"
#include "kernel/direct/build_bvh_subtree.hpp"
#include "scene/build_watch.hpp"
#include "scene/parallel.hpp"

#include <algorithm>

namespace celltrace {

using namespace kernel;

namespace {

using Simd = HostSimd<BaselineArch>;
using LaneAabb = bvh::LaneAabb<Simd>;

/// With fewer, starting threads takes longer than they save.
constexpr std::uint32_t kNodesAThread = 8192;
constexpr std::uint32_t kChildren = bvh::kChildren;

NodeRecord* nodes_of(std::byte* base, const BvhRecord& bvh) {
  return reinterpret_cast<NodeRecord*>(base + bvh.node_offset);
}

bool is_leaf(const NodeRecord& node, std::uint32_t slot) {
  return node.leaf[slot] != 0;
}
/// Neither a leaf nor a node: the offset of a node is never 0.
bool is_empty(const NodeRecord& node, std::uint32_t slot) {
  return node.leaf[slot] == 0 && node.child[slot] == 0;
}

LaneAabb bounds_of_leaf(const std::byte* base, std::uint32_t first, std::uint32_t word) {
  const std::uint32_t step = leaf_word::step_bytes(word);
  LaneAabb bounds = LaneAabb::empty();
  for (std::uint32_t i = 0; i < leaf_word::count(word); ++i) {
    const std::uint32_t object = leaf_word::is_list(word)
                                     ? *reinterpret_cast<const std::uint32_t*>(base + first + i * 4)
                                     : first + i * step;
    bounds.grow(bvh::box_of<Simd>(*reinterpret_cast<const ObjectRecord*>(base + object), base));
  }
  return bounds;
}

void store(const LaneAabb& bounds, bvh::Reference& to) {
  bounds.min.store(to.min); // over the words beside, which are not used
  bounds.max.store(to.max);
}

/// The sum over its children of their areas, each times what a ray that hits it is tested against: objects or
/// four bounds.
double cost_of(const NodeRecord& node) {
  using F4 = Simd::F4;
  const auto extent = [&](int axis) {
    return F4::load(node.bounds[2 * axis + 1]) - F4::load(node.bounds[2 * axis]);
  };
  const F4 x = extent(0), y = extent(1), z = extent(2);
  alignas(16) float areas[kChildren];
  (x * y + (x + y) * z).store(areas);
  double cost = 0;
  for (std::uint32_t slot = 0; slot < kChildren; ++slot)
    if (!is_empty(node, slot))
      cost += double{areas[slot]} * (is_leaf(node, slot) ? leaf_word::count(node.leaf[slot]) : kChildren);
  return cost;
}

} // namespace

void BvhRefit::forget() {
  nodes_.clear();
}

double BvhRefit::decay() const {
  return first_cost_ > 0 ? cost_ / first_cost_ : 1;
}

void BvhRefit::refit(std::byte* base, const BvhRecord& bvh, unsigned threads) {
  NodeRecord* const nodes = nodes_of(base, bvh);
  if (nodes_.empty()) find_nodes(base, bvh);
  const auto count = static_cast<std::uint32_t>(nodes_.size());
  threads = std::clamp(count / kNodesAThread, 1u, threads);
  if (threads > 1)
    for_each_part(threads, [&](unsigned part) {
      const HostPart mine(count, part, threads);
      for (std::uint32_t i = mine.begin; i < mine.end; ++i) {
        BuildWatch::look_at(i);
        bound_leaves(base, nodes[nodes_[i]], nodes_[i]);
      }
    });
  cost_ = 0;
  for (std::uint32_t i = count; i-- > 0;) {
    BuildWatch::look_at(i);
    const std::uint32_t number = nodes_[i];
    if (threads == 1) bound_leaves(base, nodes[number], number);
    cost_ += bound_node(nodes[number], number);
  }
}

void BvhRefit::find_nodes(std::byte* base, const BvhRecord& bvh) {
  const NodeRecord* nodes = nodes_of(base, bvh);
  constexpr std::uint32_t kGap = 0xFFFFFFFF;
  parents_.assign(bvh.node_count, kGap);
  bounds_.resize(std::size_t{bvh.node_count} * kChildren);
  first_cost_ = 0;
  parents_[0] = 0; // has none
  for (std::uint32_t number = 0; number < bvh.node_count; ++number) {
    BuildWatch::look_at(number);
    if (parents_[number] == kGap) continue;
    nodes_.push_back(number);
    const NodeRecord& node = nodes[number];
    first_cost_ += cost_of(node);
    for (std::uint32_t slot = 0; slot < kChildren; ++slot) {
      if (is_leaf(node, slot) || is_empty(node, slot)) continue;
      const auto child =
          (node.child[slot] - bvh.node_offset) / static_cast<std::uint32_t>(sizeof(NodeRecord));
      parents_[child] = number * kChildren + slot;
    }
  }
}

void BvhRefit::bound_leaves(std::byte* base, const NodeRecord& node, std::uint32_t number) {
  for (std::uint32_t slot = 0; slot < kChildren; ++slot) {
    bvh::Reference& bounds = bounds_[std::size_t{number} * kChildren + slot];
    if (is_leaf(node, slot))
      store(bounds_of_leaf(base, node.child[slot], node.leaf[slot]), bounds);
    else if (is_empty(node, slot))
      store(LaneAabb::empty(), bounds);
  }
}

double BvhRefit::bound_node(NodeRecord& node, std::uint32_t number) {
  const bvh::Reference* const bounds = &bounds_[std::size_t{number} * kChildren];
  LaneAabb children[kChildren];
  LaneAabb whole = LaneAabb::empty();
  for (std::uint32_t slot = 0; slot < kChildren; ++slot) {
    children[slot] = LaneAabb::of(bounds[slot]);
    whole.grow(children[slot]);
  }
  bvh::set_child_bounds<Simd>(node, children);
  if (number != 0) store(whole, bounds_[parents_[number]]);
  return cost_of(node);
}

} // namespace celltrace

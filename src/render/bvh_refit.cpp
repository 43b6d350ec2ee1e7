#include "render/bvh_refit.hpp"

#include "celltrace/spe/simd_host.hpp"
#include "kernel/direct/build_bvh_subtree.hpp"
#include "scene/parallel.hpp"
#include "scene/progress_monitor.hpp"

#include <algorithm>

namespace celltrace {

using namespace kernel;

namespace {

using Simd = HostSimd<BaselineArch>;
using LaneAabb = bvh::LaneAabb<Simd>;

/// Least number of objects per thread; with fewer, starting threads takes longer than they save.
constexpr std::uint32_t kObjectsAThread = 65536;
/// Number of objects by which prefetching is ahead of reading.
constexpr std::size_t kAhead = 16;
constexpr std::uint32_t kChildren = bvh::kChildren;

bool is_leaf(const NodeRecord& node, std::uint32_t slot) {
  return node.leaf[slot] != 0;
}
/// Returns whether a slot holds neither a leaf nor a node; the offset of a node is never 0.
bool is_empty(const NodeRecord& node, std::uint32_t slot) {
  return node.leaf[slot] == 0 && node.child[slot] == 0;
}

void store(const LaneAabb& bounds, bvh::Reference& to) {
  bounds.min.store(to.min); // also writes the neighbouring words, which are not used
  bounds.max.store(to.max);
}

/// Returns the sum, over a node's children, of a child's area times the number of tests that a ray needs if
/// it hits the child.
double cost_of(const NodeRecord& node, const float* tests) {
  using F4 = Simd::F4;
  const auto extent = [&](int axis) {
    return F4::load(node.bounds[2 * axis + 1]) - F4::load(node.bounds[2 * axis]);
  };
  const F4 x = extent(0), y = extent(1), z = extent(2);
  alignas(16) float areas[kChildren];
  (x * y + (x + y) * z).store(areas);
  double cost = 0;
  for (std::uint32_t slot = 0; slot < kChildren; ++slot)
    if (tests[slot] != 0) cost += double{areas[slot]} * tests[slot];
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
  if (nodes_.empty()) find_nodes(base, bvh);
  threads = std::clamp(static_cast<std::uint32_t>(members_.size()) / kObjectsAThread, 1u, threads);
  for (bvh::Reference& bounds : bounds_)
    store(LaneAabb::empty(), bounds);
  for_each_part(threads, [&](unsigned part) { bound_leaves(base, members_of(part, threads)); });
  auto* const nodes = reinterpret_cast<NodeRecord*>(base + bvh.node_offset);
  cost_ = 0;
  for (auto i = static_cast<std::uint32_t>(nodes_.size()); i-- > 0;) {
    ProgressMonitor::check_cancelled(i);
    cost_ += bound_node(nodes[nodes_[i]], i);
  }
}

void BvhRefit::find_nodes(const std::byte* base, const BvhRecord& bvh) {
  const auto* const nodes = reinterpret_cast<const NodeRecord*>(base + bvh.node_offset);
  constexpr std::uint32_t kGap = 0xFFFFFFFF;
  std::vector<std::uint32_t> place_of(bvh.node_count, kGap);
  places_.clear();
  members_.clear();
  tests_.clear();
  first_cost_ = 0;
  place_of[0] = 0; // any number but kGap: the root has no place
  for (std::uint32_t number = 0; number < bvh.node_count; ++number) {
    ProgressMonitor::check_cancelled(number);
    if (place_of[number] == kGap) continue;
    nodes_.push_back(number);
    places_.push_back(place_of[number]);
    const NodeRecord& node = nodes[number];
    for (std::uint32_t slot = 0; slot < kChildren; ++slot) {
      const auto place = static_cast<std::uint32_t>(tests_.size());
      if (is_leaf(node, slot)) {
        add_leaf(base, node.child[slot], node.leaf[slot], place);
        tests_.push_back(static_cast<float>(leaf_word::count(node.leaf[slot])));
      } else if (is_empty(node, slot)) {
        tests_.push_back(0);
      } else {
        place_of[(node.child[slot] - bvh.node_offset) / std::uint32_t{sizeof(NodeRecord)}] = place;
        tests_.push_back(kChildren);
      }
    }
    first_cost_ += cost_of(node, &tests_[tests_.size() - kChildren]);
  }
  bounds_.resize(tests_.size());
}

void BvhRefit::add_leaf(const std::byte* base, std::uint32_t first, std::uint32_t word, std::uint32_t slot) {
  for (std::uint32_t i = 0; i < leaf_word::count(word); ++i)
    members_.push_back({leaf_word::is_list(word)
                            ? *reinterpret_cast<const std::uint32_t*>(base + first + i * 4)
                            : first + i * leaf_word::step_bytes(word),
                        slot});
}

std::span<const BvhRefit::Member> BvhRefit::members_of(unsigned part, unsigned parts) const {
  const HostPart mine(static_cast<std::uint32_t>(members_.size()), part, parts);
  const auto whole_leaf = [&](std::uint32_t end) {
    while (end != 0 && end != members_.size() && members_[end].slot == members_[end - 1].slot)
      ++end;
    return end;
  };
  const std::uint32_t begin = whole_leaf(mine.begin);
  return {members_.data() + begin, whole_leaf(mine.end) - begin};
}

/// Computes the bounds of leaves in a single loop over all members: the end of a loop for each leaf would be
/// mispredicted.
void BvhRefit::bound_leaves(const std::byte* base, std::span<const Member> members) {
  bvh::Reference* const all = bounds_.data();
  for (std::size_t i = 0; i < members.size(); ++i) {
    ProgressMonitor::check_cancelled(i);
    if (members.size() - i > kAhead) __builtin_prefetch(base + members[i + kAhead].object);
    bvh::Reference& leaf = all[members[i].slot];
    LaneAabb bounds = LaneAabb::of(leaf);
    bounds.grow(bvh::box_of<Simd>(*reinterpret_cast<const ObjectRecord*>(base + members[i].object), base));
    store(bounds, leaf);
  }
}

double BvhRefit::bound_node(NodeRecord& node, std::uint32_t i) {
  const bvh::Reference* const bounds = &bounds_[std::size_t{i} * kChildren];
  LaneAabb children[kChildren];
  LaneAabb whole = LaneAabb::empty();
  for (std::uint32_t slot = 0; slot < kChildren; ++slot) {
    children[slot] = LaneAabb::of(bounds[slot]);
    whole.grow(children[slot]);
  }
  bvh::set_child_bounds<Simd>(node, children);
  if (i != 0) store(whole, bounds_[places_[i]]);
  return cost_of(node, &tests_[std::size_t{i} * kChildren]);
}

} // namespace celltrace

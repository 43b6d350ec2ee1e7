#include "geometry/bounding_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

namespace celltrace {

namespace {

/// A binary heap that orders equal keys as POV-Ray's does.
class Queue {
public:
  bool empty() const { return entries_.empty(); }
  void push(double distance, std::size_t node) {
    entries_.emplace_back(distance, node);
    for (std::size_t i = entries_.size(); i > 1 && at(i).first < at(i / 2).first; i /= 2)
      std::swap(at(i), at(i / 2));
  }
  std::size_t pop() {
    const std::size_t first = at(1).second;
    at(1) = entries_.back();
    entries_.pop_back();
    const std::size_t size = entries_.size();
    for (std::size_t i = 1; 2 * i <= size;) {
      const std::size_t left = 2 * i;
      const std::size_t next = left == size || at(left).first < at(left + 1).first ? left : left + 1;
      if (!(at(i).first > at(next).first)) break;
      std::swap(at(i), at(next));
      i = next;
    }
    return first;
  }

private:
  using Entry = std::pair<double, std::size_t>;
  Entry& at(std::size_t number) { return entries_[number - 1]; } // numbers begin with 1

  std::vector<Entry> entries_;
};

/// Returns half of a box's surface.
double area(const float (&low)[3], const float (&high)[3]) {
  const float x = high[0] - low[0], y = high[1] - low[1], z = high[2] - low[2];
  return static_cast<double>(x * (y + z) + y * z);
}

/// Returns the distance, at least 0, at which a ray enters a box; nothing if the ray misses the box.
std::optional<double> entry(const float (&low)[3], const float (&size)[3], const geometry::Ray& ray) {
  double enter = 0, leave = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    const double from = static_cast<double>(low[axis]) - ray.origin[axis];
    const double to = from + static_cast<double>(size[axis]);
    if (ray.direction[axis] == 0) {
      if (from > 0 || to < 0) return std::nullopt;
      continue;
    }
    const double a = from / ray.direction[axis], b = to / ray.direction[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  if (enter > leave) return std::nullopt;
  return enter;
}

} // namespace

BoundingTree::BoundingTree(const std::vector<Extent>& objects, std::size_t lights) {
  constexpr std::size_t kFewest = 3;
  constexpr double kLongest = 1e6; // objects that are longer have no box in the tree
  is_list_ = objects.size() + lights < kFewest;
  std::vector<std::size_t> finite;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const Vec3 size = objects[i].max - objects[i].min;
    is_infinite_.push_back(objects[i].is_everywhere() || std::max({size.x, size.y, size.z}) > kLongest);
    Node& leaf = nodes_.emplace_back();
    leaf.object = i;
    for (int axis = 0; axis < 3; ++axis) {
      leaf.box.low[axis] = static_cast<float>(objects[i].min[axis]);
      leaf.box.size[axis] = static_cast<float>(size[axis]);
    }
    if (!is_infinite_.back()) finite.push_back(i);
  }
  ranks_.resize(objects.size());
  std::size_t rank = 0;
  for (std::size_t i = 0; i < objects.size(); ++i)
    if (is_list_ || is_infinite_[i]) ranks_[i] = rank++;
  if (is_list_ || finite.empty()) return;
  build(finite);
  std::vector<std::size_t> below = {nodes_.size() - 1};
  while (!below.empty()) {
    const Node& node = nodes_[below.back()];
    below.pop_back();
    if (node.children.empty()) ranks_[node.object] = rank++;
    below.insert(below.end(), node.children.rbegin(), node.children.rend());
  }
}

BoundingTree::Box BoundingTree::around(const Box& a, const Box& b) {
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    box.low[axis] = std::min(a.low[axis], b.low[axis]);
    box.size[axis] = std::max(a.low[axis] + a.size[axis], b.low[axis] + b.size[axis]) - box.low[axis];
  }
  return box;
}

/// Builds the tree level by level: the parents of all nodes of a level are appended after the level's last
/// node.
void BoundingTree::build(std::vector<std::size_t>& nodes) {
  for (std::size_t first = 0, last = nodes.size();; first = last, last = nodes.size()) {
    std::vector<std::pair<std::size_t, std::size_t>> parts = {{first, last}};
    while (!parts.empty()) {
      const auto [begin, end] = parts.back();
      parts.pop_back();
      const std::size_t cut = sort_and_cut(nodes, begin, end);
      if (cut == end) {
        add_parent(nodes, begin, end);
      } else {
        parts.emplace_back(cut, end);
        parts.emplace_back(begin, cut);
      }
    }
    if (nodes.size() == last + 1) return;
  }
}

void BoundingTree::add_parent(std::vector<std::size_t>& nodes, std::size_t first, std::size_t last) {
  Node parent;
  parent.box = nodes_[nodes[first]].box;
  for (std::size_t i = first; i < last; ++i) {
    parent.box = around(parent.box, nodes_[nodes[i]].box);
    parent.children.push_back(nodes[i]);
  }
  nodes.push_back(nodes_.size());
  nodes_.push_back(std::move(parent));
}

/// Sorts [first, last) and returns where to cut this range in two; `last` if all nodes get one parent.
std::size_t BoundingTree::sort_and_cut(std::vector<std::size_t>& nodes, std::size_t first,
                                       std::size_t last) const {
  constexpr std::size_t kMostOfNode = 4;
  const std::size_t count = last - first;
  const auto begin = nodes.begin() + static_cast<std::ptrdiff_t>(first);
  const auto end = nodes.begin() + static_cast<std::ptrdiff_t>(last);
  // Sorts along the longest axis. As in POV-Ray, the far end of the range is the low side of the box that
  // reached beyond all boxes before it, which need not be the true end of the range.
  int axis = 0;
  float longest = -std::numeric_limits<float>::infinity();
  for (int candidate = 0; candidate < 3; ++candidate) {
    float low = std::numeric_limits<float>::infinity(), high = -low;
    std::for_each(begin, end, [&](std::size_t node) {
      const Box& box = nodes_[node].box;
      low = std::min(low, box.low[candidate]);
      if (box.low[candidate] + box.size[candidate] > high) high = box.low[candidate];
    });
    if (high - low > longest) {
      longest = high - low;
      axis = candidate;
    }
  }
  std::stable_sort(begin, end, [&](std::size_t a, std::size_t b) {
    const Box &left = nodes_[a].box, &right = nodes_[b].box;
    return 2 * left.low[axis] + left.size[axis] < 2 * right.low[axis] + right.size[axis];
  });
  // Areas of the boxes around all nodes up to each place, and around all nodes from each place on.
  std::vector<double> left(count), right(count);
  const auto fill = [&](std::vector<double>& areas, bool backwards) {
    float low[3], high[3];
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t place = backwards ? count - 1 - i : i;
      const Box& box = nodes_[nodes[first + place]].box;
      for (int k = 0; k < 3; ++k) {
        low[k] = i == 0 ? box.low[k] : std::min(low[k], box.low[k]);
        high[k] = i == 0 ? box.low[k] + box.size[k] : std::max(high[k], box.low[k] + box.size[k]);
      }
      areas[place] = area(low, high);
    }
  };
  fill(left, false);
  fill(right, true);
  double best = right[0] * (static_cast<double>(count) - 3);
  std::size_t after = count; // count: no cut
  for (std::size_t i = 0; i + 1 < count; ++i) {
    const double cost =
        static_cast<double>(i + 1) * left[i] + static_cast<double>(count - 1 - i) * right[i + 1];
    if (cost < best) {
      best = cost;
      after = i;
    }
  }
  return count > kMostOfNode && after != count ? first + after + 1 : last;
}

bool BoundingTree::tests_first(std::size_t a, std::size_t b, const geometry::Ray& ray) const {
  if (is_list_ || (is_infinite_[a] && is_infinite_[b])) return a < b;
  if (is_infinite_[a] || is_infinite_[b]) return is_infinite_[a];
  Queue queue;
  const auto enter = [&](std::size_t node) {
    if (const auto distance = entry(nodes_[node].box.low, nodes_[node].box.size, ray))
      queue.push(*distance, node);
  };
  enter(nodes_.size() - 1);
  while (!queue.empty()) {
    const std::size_t number = queue.pop();
    const Node& node = nodes_[number];
    for (const std::size_t child : node.children)
      enter(child);
    if (node.children.empty() && (node.object == a || node.object == b)) return node.object == a;
  }
  return a < b;
}

} // namespace celltrace

// The upper part of a large hierarchy: objects are sorted into the cells of a grid, and nodes are made above
// the cells until few enough objects are left for a treelet (after Garanzha, Pantaleoni and McAllister,
// Simpler and faster HLBVH with work queues, 2011, with a grid in place of the Morton code). Kernel dialect.
#pragma once

#include "kernel/build_hierarchy_subtree.hpp"

namespace celltrace::kernel::hierarchy {

/// A grid over the doubles of centres.
template <class S> class CellGrid {
public:
  using F4 = typename S::F4;

  CellGrid(const LaneBox<S>& centres, uint32_t max_cells) {
    alignas(16) float low[4];
    alignas(16) float extent[4];
    centres.min.store(low);
    (centres.max - centres.min).store(extent);
    low[3] = -1.0f; // as in Places
    extent[3] = 0.0f;
    choose_counts(extent, max_cells);
    alignas(16) float scale[4];
    for (int axis = 0; axis < 3; ++axis)
      scale[axis] = extent[axis] > 1e-30f ? static_cast<float>(cells_[axis] - 1) / extent[axis] : 0.0f;
    scale[3] = 0.0f;
    base_ = F4::load(low);
    scale_ = F4::load(scale);
  }

  uint32_t count() const { return cells_[0] * cells_[1] * cells_[2]; }

  uint32_t cell_of(const Reference& reference) const {
    constexpr float kRounder = 8388608.0f; // as in Places
    constexpr uint32_t kRounderBits = 0x4B000000;
    alignas(16) float place[4];
    ((LaneBox<S>::of(reference).centre() - base_) * scale_ + F4::splat(kRounder)).store(place);
    uint32_t at[3];
    for (int axis = 0; axis < 3; ++axis) {
      uint32_t bits;
      __builtin_memcpy(&bits, &place[axis], sizeof bits);
      bits -= kRounderBits;
      at[axis] = bits < cells_[axis] ? bits : cells_[axis] - 1;
    }
    return (at[2] * cells_[1] + at[1]) * cells_[0] + at[0];
  }

private:
  /// Cells about as long as they are wide, as far as `max_cells` allows: doubles the number along the axis
  /// where they are longest.
  void choose_counts(const float (&extent)[4], uint32_t max_cells) {
    for (uint32_t total = 2; total <= max_cells; total *= 2) {
      int longest = 0;
      for (int axis = 1; axis < 3; ++axis)
        if (extent[axis] / static_cast<float>(cells_[axis]) >
            extent[longest] / static_cast<float>(cells_[longest]))
          longest = axis;
      cells_[longest] *= 2;
    }
  }

  uint32_t cells_[3] = {1, 1, 1};
  F4 base_, scale_;
};

/// Part of a hierarchy that is built by itself: over the objects of the cells whose references are [begin,
/// end).
struct Treelet {
  Place place;
  uint32_t begin, end;
  uint32_t first; ///< of its objects in the order of the list
  uint32_t count;
  uint32_t first_node; ///< counted from the first of all treelets
  uint32_t unused;
};
static_assert(sizeof(void*) != 8 || sizeof(Treelet) == 40, "part of the work memory");

/// Ends nodes over cells at treelets.
template <class S> class Treelets {
public:
  static constexpr uint32_t kMaxDepthOfCuts = 16;
  static constexpr uint32_t kObjects = 256;

  explicit Treelets(Treelet* treelets) : treelets_(treelets) {}

  bool end(const Range<S>& range) const { return range.weight <= kObjects || range.count() < kChildren; }
  bool end(const Range<S>&, const Range<S> (&)[kChildren]) const { return false; }
  void add(const Range<S>& range, const Place& place) {
    treelets_[count_++] = {place, range.begin, range.end, objects_, range.weight, nodes_, 0};
    objects_ += range.weight;
    nodes_ += (range.weight - 1) / 3; // of four children each, above an object or more a leaf
  }
  uint32_t count() const { return count_; }
  /// Nodes that all of them have at most.
  uint32_t nodes() const { return nodes_; }

private:
  Treelet* treelets_;
  uint32_t count_ = 0;
  uint32_t objects_ = 0;
  uint32_t nodes_ = 0;
};

} // namespace celltrace::kernel::hierarchy

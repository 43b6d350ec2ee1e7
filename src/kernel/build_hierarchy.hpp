// Builds the hierarchy of boxes, for memory that can be dereferenced. Kernel dialect.
#pragma once

#include "kernel/build_hierarchy_cells.hpp"
#include "kernel/build_hierarchy_leaves.hpp"
#include "kernel/overlap.hpp"

namespace celltrace::kernel {

namespace hierarchy {

/// Work memory, in pairs of each sort buffer, for each object.
constexpr uint32_t kPairsPerObject = 5;
/// Fewer objects are built without cells.
constexpr uint32_t kMinObjectsForCells = 4096;
constexpr uint32_t kObjectsPerCell = 16;
constexpr uint32_t kMaxCells = 1u << 18;

/// The steps of a build.
template <class Spu> class Builder {
public:
  using S = typename Spu::simd;

  Builder(Spu& spu, const FrameBlock& frame)
      : frame_(frame), count_(frame.object_count), image_(pointer<uint8_t>(frame.image)),
        objects_(reinterpret_cast<const ObjectRecord*>(image_ + frame.object_offset)),
        nodes_(reinterpret_cast<NodeRecord*>(image_ + frame.hierarchy.node_offset)),
        references_(pointer<Reference>(frame.sort_buffer[0])),
        sorted_(pointer<Reference>(frame.sort_buffer[1])), cells_(sorted_ + count_),
        cell_begin_(reinterpret_cast<uint32_t*>(cells_ + max_cells())),
        counts_(reinterpret_cast<uint32_t*>(references_ + count_)), spare_cells_(references_ + count_),
        treelets_(reinterpret_cast<Treelet*>(spare_cells_ + max_cells())),
        top_stack_(spu.template allocate<typename TopBuilder::Task>(TopBuilder::kStackTasks)),
        treelet_stack_(spu.template allocate<typename TreeletBuilder::Task>(TreeletBuilder::kStackTasks)) {}

  uint32_t build() {
    const Range<S> all = make_references();
    if (count_ < kChildren) return build_leaf(all);
    if (count_ < kMinObjectsForCells || frame_.sort_capacity / kPairsPerObject < count_)
      return static_cast<uint32_t>(build_treelet(references_, sorted_, all, {nullptr, 0, 0}, nodes_) -
                                   nodes_);
    const Range<S> cells = sort_into_cells(all);
    return build_over_cells(cells);
  }

private:
  using TopBuilder = SubtreeBuilder<S, Treelets<S>>;
  using TreeletBuilder = SubtreeBuilder<S, Leaves<S>>;

  template <class T> static T* pointer(ea_t ea) { return reinterpret_cast<T*>(static_cast<uintptr_t>(ea)); }
  uint32_t max_cells() const {
    const uint32_t cells = count_ / kObjectsPerCell;
    return cells < kMaxCells ? cells : kMaxCells;
  }

  Range<S> make_references() {
    Range<S> all = {0, count_, count_, LaneBox<S>::empty(), LaneBox<S>::empty()};
    for (uint32_t i = 0; i < count_; ++i) {
      const Box box = bounding_box(objects_[i]);
      const uint32_t offset = frame_.object_offset + i * static_cast<uint32_t>(sizeof(ObjectRecord));
      references_[i] = {
          {box.min[0], box.min[1], box.min[2]}, offset, {box.max[0], box.max[1], box.max[2]}, 1};
      const LaneBox<S> lanes = LaneBox<S>::of(references_[i]);
      all.box.grow(lanes);
      all.centres.grow(lanes.centre());
    }
    return all;
  }

  /// Sorts the references by cell, stably, and makes references to the cells that have some.
  Range<S> sort_into_cells(const Range<S>& all) {
    const CellGrid<S> grid(all.centres, max_cells());
    const uint32_t cells = grid.count();
    for (uint32_t c = 0; c < cells; ++c)
      counts_[c] = 0;
    for (uint32_t i = 0; i < count_; ++i)
      ++counts_[grid.cell_of(references_[i])];
    uint32_t sum = 0;
    uint32_t used = 0;
    for (uint32_t c = 0; c < cells; ++c) {
      const uint32_t size = counts_[c];
      counts_[c] = sum;
      if (size != 0) cell_begin_[used++] = sum;
      sum += size;
    }
    for (uint32_t i = 0; i < count_; ++i)
      sorted_[counts_[grid.cell_of(references_[i])]++] = references_[i];
    Range<S> range = {0, used, count_, all.box, LaneBox<S>::empty()};
    for (uint32_t c = 0; c < used; ++c) {
      const uint32_t end = c + 1 < used ? cell_begin_[c + 1] : count_;
      const Range<S> cell = range_of<S>(sorted_, cell_begin_[c], end);
      cell.box.min.store(cells_[c].min);
      cell.box.max.store(cells_[c].max);
      cells_[c].value = cell_begin_[c];
      cells_[c].weight = cell.count();
      range.centres.grow(cell.box.centre());
    }
    return range;
  }

  uint32_t build_over_cells(const Range<S>& cells) {
    Treelets<S> treelets(treelets_);
    TopBuilder top(image_, cells_, spare_cells_, treelets, top_stack_);
    NodeRecord* node = top.build(cells, {nullptr, 0, 0}, nodes_);
    for (uint32_t t = 0; t < treelets.count(); ++t)
      gather(treelets_[t]);
    for (uint32_t t = 0; t < treelets.count(); ++t) {
      const Treelet& treelet = treelets_[t];
      const Range<S> range = range_of<S>(references_, treelet.first, treelet.first + treelet.count);
      build_treelet(references_, sorted_, range, treelet.place, node);
      node += max_nodes(treelet.count);
    }
    return static_cast<uint32_t>(node - nodes_);
  }

  /// Brings the references of a treelet together.
  void gather(const Treelet& treelet) {
    Reference* to = references_ + treelet.first;
    for (uint32_t c = treelet.begin; c < treelet.end; ++c) {
      const Reference* from = sorted_ + cells_[c].value;
      for (uint32_t i = 0; i < cells_[c].weight; ++i)
        *to++ = from[i];
    }
  }

  NodeRecord* build_treelet(Reference* references, Reference* spare, const Range<S>& range,
                            const Place& place, NodeRecord* next) {
    Leaves<S> leaves(image_, frame_.hierarchy.list_offset, references);
    return TreeletBuilder(image_, references, spare, leaves, treelet_stack_).build(range, place, next);
  }

  /// The root above fewer than four objects.
  uint32_t build_leaf(const Range<S>& all) {
    const LaneBox<S> empty = LaneBox<S>::empty();
    const Range<S> nothing = {0, 0, 0, empty, empty};
    set_boxes<S>(*nodes_, {all, nothing, nothing, nothing});
    for (uint32_t i = 0; i < kChildren; ++i)
      nodes_->child[i] = nodes_->count[i] = 0;
    if (count_ != 0) Leaves<S>(image_, frame_.hierarchy.list_offset, references_).add(all, {nodes_, 0, 0});
    return 1;
  }

  const FrameBlock& frame_;
  uint32_t count_;
  uint8_t* image_;
  const ObjectRecord* objects_;
  NodeRecord* nodes_;
  Reference* references_; ///< in the order of objects, later of treelets
  Reference* sorted_;     ///< by cell, later spare
  Reference* cells_;      ///< `value`: the first of its references
  uint32_t* cell_begin_;
  uint32_t* counts_;       ///< of references by cell, then where the next one goes
  Reference* spare_cells_; ///< once the counts are used
  Treelet* treelets_;
  typename TopBuilder::Task* top_stack_;
  typename TreeletBuilder::Task* treelet_stack_;
};

} // namespace hierarchy

/// Writes the nodes and the list that `frame.hierarchy` has room for, from the objects of the scene image,
/// and returns the number of nodes, with gaps between those that are used. The sort buffers have room for
/// hierarchy::kPairsPerObject pairs an object. A node lies at most hierarchy::kMaxDepth below the root. What
/// is built depends on the objects alone.
template <class Spu> uint32_t build_hierarchy(Spu& spu, const FrameBlock& frame) {
  static_assert(Spu::direct_memory, "the builder follows pointers to main memory");
  uint8_t* const marked = spu.mark();
  const uint32_t nodes = hierarchy::Builder<Spu>(spu, frame).build();
  spu.release(marked);
  return nodes;
}

} // namespace celltrace::kernel

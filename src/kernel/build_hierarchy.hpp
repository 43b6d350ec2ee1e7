// Builds the hierarchy of boxes, for memory that can be dereferenced, on any number of SPEs. Kernel dialect.
#pragma once

#include "kernel/build_hierarchy_leaves.hpp"
#include "kernel/build_hierarchy_memory.hpp"
#include "kernel/overlap.hpp"

namespace celltrace::kernel {

namespace hierarchy {

/// A part of [0, count).
struct Part {
  uint32_t begin, end;

  Part(uint32_t count, uint32_t part, uint32_t parts)
      : begin(static_cast<uint32_t>(uint64_t{count} * part / parts)),
        end(static_cast<uint32_t>(uint64_t{count} * (part + 1) / parts)) {}
};

/// The work of one SPE in a build, step by step; every step needs what all have done in those before. What
/// comes out does not depend on how many there are.
template <class Spu> class Builder {
public:
  using S = typename Spu::simd;

  /// SPE `self` of `builders`.
  Builder(Spu& spu, const FrameBlock& frame, uint32_t self, uint32_t builders)
      : frame_(frame), memory_(spu, frame), self_(self), builders_(builders), count_(frame.object_count),
        image_(WorkMemory::pointer<uint8_t>(frame.image)),
        nodes_(reinterpret_cast<NodeRecord*>(image_ + frame.hierarchy.node_offset)),
        top_stack_(spu.template allocate<typename TopBuilder::Task>(TopBuilder::kStackTasks)),
        treelet_stack_(spu.template allocate<typename TreeletBuilder::Task>(TreeletBuilder::kStackTasks)),
        spare_(spu.template allocate<Reference>(Treelets<S>::kObjects)) {}

  static constexpr uint32_t kSteps = hierarchy::kSteps;
  void run(uint32_t step) {
    if (step == 0) return make_references();
    if (count_ < kMinObjectsForCells || memory_.max_cells == 0) {
      if (step == 1 && self_ == 0) build_whole();
      return;
    }
    switch (step) {
    case 1:
      return count_cells();
    case 2:
      return add_counts();
    case 3:
      return place_cells();
    case 4:
      return sort();
    case 5:
      return measure_cells();
    case 6:
      if (self_ == 0) build_top();
      return;
    case 7:
      return for_each_treelet(memory_.team->next_to_gather, [&](const Treelet& treelet) { gather(treelet); });
    default:
      return for_each_treelet(memory_.team->next_to_build, [&](const Treelet& treelet) { build(treelet); });
    }
  }
  /// After the last step.
  uint32_t nodes() const { return memory_.team->nodes; }

private:
  using TopBuilder = SubtreeBuilder<S, Treelets<S>>;
  using TreeletBuilder = SubtreeBuilder<S, Leaves<S>>;
  using F4 = typename S::F4;

  Part part_of(uint32_t count) const { return Part(count, self_, builders_); }
  uint32_t* counts_of(uint32_t builder) const {
    return memory_.counts + uint64_t{builder} * memory_.max_cells;
  }

  void make_references() {
    const auto* objects = reinterpret_cast<const ObjectRecord*>(image_ + frame_.object_offset);
    LaneBox<S> around = LaneBox<S>::empty(), centres = LaneBox<S>::empty();
    const Part part = part_of(count_);
    for (uint32_t i = part.begin; i < part.end; ++i) {
      const Box box = bounding_box(objects[i]);
      const uint32_t offset = frame_.object_offset + i * static_cast<uint32_t>(sizeof(ObjectRecord));
      memory_.references[i] = {
          {box.min[0], box.min[1], box.min[2]}, offset, {box.max[0], box.max[1], box.max[2]}, 1};
      const LaneBox<S> lanes = LaneBox<S>::of(memory_.references[i]);
      around.grow(lanes);
      centres.grow(lanes.centre());
    }
    tell(around, centres);
  }

  /// Tells the others what is around the objects or cells of this SPE.
  void tell(const LaneBox<S>& box, const LaneBox<S>& centres) {
    BuilderRecord& record = memory_.builders[self_];
    box.min.store(record.box_min);
    box.max.store(record.box_max);
    centres.min.store(record.centres_min);
    centres.max.store(record.centres_max);
  }
  /// A range around what all have told.
  Range<S> around_all(uint32_t references) const {
    Range<S> all = {0, references, count_, LaneBox<S>::empty(), LaneBox<S>::empty()};
    for (uint32_t b = 0; b < builders_; ++b) {
      const BuilderRecord& record = memory_.builders[b];
      all.box.grow({F4::load(record.box_min), F4::load(record.box_max)});
      all.centres.grow({F4::load(record.centres_min), F4::load(record.centres_max)});
    }
    return all;
  }
  CellGrid<S> grid() const { return CellGrid<S>(around_all(count_).centres, memory_.max_cells); }

  void count_cells() {
    const CellGrid<S> cells = grid();
    uint32_t* counts = counts_of(self_);
    for (uint32_t c = 0; c < cells.count(); ++c)
      counts[c] = 0;
    const Part part = part_of(count_);
    for (uint32_t i = part.begin; i < part.end; ++i)
      ++counts[cells.cell_of(memory_.references[i])];
  }

  uint32_t objects_in(uint32_t cell) const {
    uint32_t sum = 0;
    for (uint32_t b = 0; b < builders_; ++b)
      sum += counts_of(b)[cell];
    return sum;
  }

  void add_counts() {
    BuilderRecord& record = memory_.builders[self_];
    record.objects = record.used_cells = 0;
    const Part part = part_of(grid().count());
    for (uint32_t c = part.begin; c < part.end; ++c) {
      const uint32_t objects = objects_in(c);
      record.objects += objects;
      record.used_cells += objects != 0;
    }
  }

  /// Where the objects of each cell go, and of each SPE within; and where the reference to the cell goes.
  void place_cells() {
    uint32_t cell = 0;
    uint32_t place = 0;
    for (uint32_t b = 0; b < self_; ++b) {
      cell += memory_.builders[b].used_cells;
      place += memory_.builders[b].objects;
    }
    const Part part = part_of(grid().count());
    for (uint32_t c = part.begin; c < part.end; ++c) {
      const uint32_t first = place;
      for (uint32_t b = 0; b < builders_; ++b) {
        uint32_t& count = counts_of(b)[c];
        const uint32_t objects = count;
        count = place;
        place += objects;
      }
      if (place == first) continue;
      memory_.cells[cell].value = first;
      memory_.cells[cell].weight = place - first;
      ++cell;
    }
  }

  /// The references by cell, stably.
  void sort() {
    const CellGrid<S> cells = grid();
    uint32_t* next = counts_of(self_);
    const Part part = part_of(count_);
    for (uint32_t i = part.begin; i < part.end; ++i)
      memory_.sorted[next[cells.cell_of(memory_.references[i])]++] = memory_.references[i];
  }

  uint32_t used_cells() const {
    uint32_t sum = 0;
    for (uint32_t b = 0; b < builders_; ++b)
      sum += memory_.builders[b].used_cells;
    return sum;
  }

  void measure_cells() {
    LaneBox<S> around = LaneBox<S>::empty(), centres = LaneBox<S>::empty();
    const Part part = part_of(used_cells());
    for (uint32_t c = part.begin; c < part.end; ++c) {
      Reference& cell = memory_.cells[c];
      const uint32_t first = cell.value;
      const uint32_t objects = cell.weight;
      const LaneBox<S> box = range_of<S>(memory_.sorted, first, first + objects).box;
      box.min.store(cell.min); // over the words beside
      box.max.store(cell.max);
      cell.value = first;
      cell.weight = objects;
      around.grow(box);
      centres.grow(box.centre());
    }
    tell(around, centres);
  }

  void build_top() {
    Treelets<S> treelets(memory_.treelets);
    TopBuilder top(image_, memory_.cells, memory_.spare_cells, treelets, top_stack_);
    const NodeRecord* end = top.build(around_all(used_cells()), {nullptr, 0, 0}, nodes_);
    const auto top_nodes = static_cast<uint32_t>(end - nodes_);
    *memory_.team = {treelets.count(), top_nodes, top_nodes + treelets.nodes(), 0, 0, {}};
  }

  /// Those that no other SPE takes.
  template <class Visit> void for_each_treelet(uint32_t& next, Visit visit) {
    constexpr uint32_t kTaken = 8;
    const uint32_t treelets = memory_.team->treelets;
    for (;;) {
      const uint32_t first = __atomic_fetch_add(&next, kTaken, __ATOMIC_RELAXED);
      if (first >= treelets) return;
      for (uint32_t t = first; t < treelets && t < first + kTaken; ++t)
        visit(memory_.treelets[t]);
    }
  }

  /// Brings the references of a treelet together.
  void gather(const Treelet& treelet) {
    Reference* to = memory_.references + treelet.first;
    for (uint32_t c = treelet.begin; c < treelet.end; ++c) {
      const Reference* from = memory_.sorted + memory_.cells[c].value;
      for (uint32_t i = 0; i < memory_.cells[c].weight; ++i)
        *to++ = from[i];
    }
  }

  void build(const Treelet& treelet) {
    NodeRecord* first = nodes_ + memory_.team->top_nodes + treelet.first_node;
    build(range_of<S>(memory_.references, treelet.first, treelet.first + treelet.count), treelet.place,
          first);
  }
  NodeRecord* build(const Range<S>& range, const Place& place, NodeRecord* first) {
    Leaves<S> leaves(image_, frame_.hierarchy.list_offset, memory_.references);
    Reference* spare = range.count() <= Treelets<S>::kObjects ? spare_ : memory_.sorted + range.begin;
    return TreeletBuilder(image_, memory_.references, spare, leaves, treelet_stack_)
        .build(range, place, first);
  }

  /// Few objects, without cells.
  void build_whole() {
    const Range<S> all = around_all(count_);
    const NodeRecord* end = count_ < kChildren ? add_root(all) : build(all, {nullptr, 0, 0}, nodes_);
    memory_.team->nodes = static_cast<uint32_t>(end - nodes_);
  }
  /// The root above fewer than four objects.
  NodeRecord* add_root(const Range<S>& all) {
    const LaneBox<S> empty = LaneBox<S>::empty();
    const Range<S> nothing = {0, 0, 0, empty, empty};
    set_boxes<S>(*nodes_, {all, nothing, nothing, nothing});
    for (uint32_t i = 0; i < kChildren; ++i)
      nodes_->child[i] = nodes_->count[i] = 0;
    if (count_ != 0)
      Leaves<S>(image_, frame_.hierarchy.list_offset, memory_.references).add(all, {nodes_, 0, 0});
    return nodes_ + 1;
  }

  const FrameBlock& frame_;
  const WorkMemory memory_;
  uint32_t self_, builders_;
  uint32_t count_;
  uint8_t* image_;
  NodeRecord* nodes_;
  typename TopBuilder::Task* top_stack_;
  typename TreeletBuilder::Task* treelet_stack_;
  Reference* spare_; ///< for usual treelets; large ones use what was sorted
};

} // namespace hierarchy

/// Writes the nodes and the list that `frame.hierarchy` has room for, from the objects of the scene image,
/// and returns the number of nodes, with gaps between those that are used. The sort buffers have room for
/// hierarchy::work_pairs(). A node lies at most hierarchy::kMaxDepth below the root. What is built depends on
/// the objects alone.
///
/// All SPEs of a team call it at a time. `team`: its size(), the index() of this one in it, and wait(), which
/// returns when all have called it and makes visible what they have written.
template <class Spu, class Team> uint32_t build_hierarchy(Spu& spu, const FrameBlock& frame, Team&& team) {
  static_assert(Spu::direct_memory, "the builder follows pointers to main memory");
  using Builder = hierarchy::Builder<Spu>;
  const uint32_t builders = team.size() < hierarchy::kMaxBuilders ? team.size() : hierarchy::kMaxBuilders;
  uint8_t* const marked = spu.mark();
  Builder builder(spu, frame, team.index(), builders);
  for (uint32_t step = 0; step < Builder::kSteps; ++step) {
    if (team.index() < builders) builder.run(step);
    team.wait();
  }
  spu.release(marked);
  return builder.nodes();
}

/// On this SPE alone.
template <class Spu> uint32_t build_hierarchy(Spu& spu, const FrameBlock& frame) {
  struct Alone {
    uint32_t size() const { return 1; }
    uint32_t index() const { return 0; }
    void wait() const {}
  };
  return build_hierarchy(spu, frame, Alone());
}

} // namespace celltrace::kernel

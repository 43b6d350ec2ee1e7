// Builds the BVH, for memory that can be dereferenced, on any number of SPEs. Kernel dialect.
#pragma once

#include "kernel/direct/build_bvh_leaves.hpp"
#include "kernel/direct/build_bvh_memory.hpp"
#include "kernel/primitives/overlap.hpp"

namespace celltrace::kernel {

namespace bvh {

/// The work of one SPE in a build, step by step. What comes out does not depend on how many there are.
template <class Spu> class Builder {
public:
  using S = typename Spu::simd;

  /// SPE `self` of a team.
  Builder(Spu& spu, const FrameBlock& frame, uint32_t self)
      : frame_(frame), memory_(frame), prototypes_(frame), self_(self),
        image_(WorkMemory::pointer<uint8_t>(frame.image)),
        objects_(reinterpret_cast<const ObjectRecord*>(image_ + frame.object_offset)),
        runs_(reinterpret_cast<const GroupRecord*>(image_ + frame.group_offset)),
        nodes_(reinterpret_cast<NodeRecord*>(image_ + frame.bvh.node_offset)),
        top_stack_(spu.template allocate<typename TopBuilder::Task>(TopBuilder::kStackTasks)),
        treelet_stack_(spu.template allocate<typename TreeletBuilder::Task>(TreeletBuilder::kStackTasks)),
        references_(spu.template allocate<Reference>(kLocalReferences)),
        spare_(spu.template allocate<Reference>(kLocalReferences)) {}

  void run(uint32_t step) {
    if (step == 0 && self_ == 0) build_top();
    if (step == 1 && frame_.group_count != 0) build_treelets();
    if (step == 2 && prototypes_.any()) copy_treelets();
  }
  /// After the last step.
  uint32_t nodes() const { return memory_.team->nodes; }

private:
  using TopBuilder = SubtreeBuilder<S, Treelets<S>>;
  using TreeletBuilder = SubtreeBuilder<S, Leaves<S>>;
  using F4 = typename S::F4;
  /// Treelets that an SPE takes at a time.
  static constexpr uint32_t kTaken = 8;

  void build_top() {
    const uint32_t runs = frame_.group_count;
    if (runs == 0) return build_whole();
    static_assert(sizeof(Reference) == sizeof(GroupRecord), "a run is referred to by its box");
    for (uint32_t i = 0; i < runs; ++i) {
      __builtin_memcpy(static_cast<void*>(&memory_.runs[i]), &runs_[i], sizeof(Reference));
      memory_.runs[i].value = i;
    }
    Treelets<S> treelets(memory_.runs, prototypes_, memory_.treelets);
    TopBuilder top(image_, memory_.runs, memory_.spare_runs, treelets, top_stack_);
    const NodeRecord* end = top.build(range_of<S>(memory_.runs, 0, runs), {nullptr, 0, 0}, nodes_);
    const auto top_nodes = static_cast<uint32_t>(end - nodes_);
    const uint32_t built = top_nodes + treelets.nodes();
    *memory_.team = {treelets.count(), top_nodes, built, built, 0, 0, {}};
    if (prototypes_.any()) find_prototypes(treelets.count());
  }

  /// The deepest copy says how deep a prototype may become.
  void find_prototypes(uint32_t treelets) {
    for (uint32_t t = 0; t < treelets; ++t)
      if (!is_copy(memory_.treelets[t])) memory_.treelet_of[run_of(memory_.treelets[t])] = t;
    for (uint32_t t = 0; t < treelets; ++t) {
      const Treelet& treelet = memory_.treelets[t];
      if (!is_copy(treelet)) continue;
      Place& place = prototype_of(treelet).place;
      if (place.depth < treelet.place.depth) place.depth = treelet.place.depth;
    }
  }
  /// The first of its runs.
  uint32_t run_of(const Treelet& treelet) const { return memory_.runs[treelet.begin].value; }
  bool is_copy(const Treelet& treelet) const { return prototypes_.is_copy(run_of(treelet)); }
  Treelet& prototype_of(const Treelet& copy) const {
    return memory_.treelets[memory_.treelet_of[prototypes_.of(run_of(copy))]];
  }

  /// Those that no other SPE takes.
  void build_treelets() {
    const uint32_t treelets = memory_.team->treelets;
    for (;;) {
      const uint32_t first = __atomic_fetch_add(&memory_.team->next, kTaken, __ATOMIC_RELAXED);
      if (first >= treelets) return;
      const uint32_t end = treelets - first < kTaken ? treelets : first + kTaken;
      for (uint32_t t = first; t < end; ++t) {
        if (t + 1 < end) prefetch_objects(memory_.treelets[t + 1]);
        if (!is_copy(memory_.treelets[t])) build(memory_.treelets[t]);
      }
    }
  }

  /// Copies those that no other SPE takes. Their nodes lie one after the other in the order of the treelets.
  void copy_treelets() {
    const uint32_t treelets = memory_.team->treelets;
    NodeRecord* next = nodes_ + memory_.team->built_nodes;
    uint32_t seen = 0;
    const auto pass = [&](uint32_t end, bool mine) {
      for (; seen < end && seen < treelets; ++seen) {
        const Treelet& treelet = memory_.treelets[seen];
        if (!is_copy(treelet)) continue;
        const Treelet& prototype = prototype_of(treelet);
        if (mine) {
          if (seen + 1 < treelets) prefetch_objects(memory_.treelets[seen + 1]);
          copy(prototype, treelet, next);
        }
        next += prototype.nodes;
      }
    };
    while (seen < treelets) {
      const uint32_t first = __atomic_fetch_add(&memory_.team->next_copy, kTaken, __ATOMIC_RELAXED);
      pass(first, false);
      pass(first + kTaken, true);
    }
    if (self_ == 0) memory_.team->nodes = static_cast<uint32_t>(next - nodes_);
  }

  /// Who made the image may have been another processor, and treelets lie anywhere in it. A compiler drops
  /// calls of what only prefetches.
  [[gnu::always_inline]] void prefetch_objects(const Treelet& treelet) const {
    for (uint32_t r = treelet.begin; r < treelet.end; ++r) {
      const GroupRecord& run = runs_[memory_.runs[r].value];
      for (uint32_t i = 0; i < run.count; ++i)
        __builtin_prefetch(objects_ + run.first + i);
    }
  }

  /// What the copy of a leaf adds to offsets, modulo 2^32.
  struct Move {
    uint32_t objects, list;
  };

  /// Gives a treelet the nodes and the lists of its prototype, with boxes around its own objects.
  void copy(const Treelet& prototype, const Treelet& treelet, NodeRecord* nodes) {
    const NodeRecord* from = nodes_ + memory_.team->top_nodes + prototype.first_node;
    const Move move = {(runs_[run_of(treelet)].first - runs_[run_of(prototype)].first) *
                           static_cast<uint32_t>(sizeof(ObjectRecord)),
                       (treelet.first - prototype.first) * 4};
    const Place& place = treelet.place;
    uint32_t& child = place.parent->child[place.slot];
    uint32_t& leaf = place.parent->leaf[place.slot];
    child = offset_of(nodes);
    leaf = 0;
    if (prototype.nodes == 0) {
      const Place& original = prototype.place;
      leaf = original.parent->leaf[original.slot];
      child = copy_leaf(original.parent->child[original.slot], leaf, move);
    }

    Reference* boxes = spare_;                     // of the nodes
    for (uint32_t n = prototype.nodes; n-- > 0;) { // children come after their parents
      LaneAabb<S> children[kChildren];
      LaneAabb<S> whole = LaneAabb<S>::empty();
      for (uint32_t i = 0; i < kChildren; ++i) {
        const uint32_t word = nodes[n].leaf[i] = from[n].leaf[i];
        if (word == 0) {
          const uint32_t below = from[n].child[i] - offset_of(from);
          nodes[n].child[i] = below + offset_of(nodes);
          children[i] = LaneAabb<S>::of(boxes[below / sizeof(NodeRecord)]);
        } else {
          nodes[n].child[i] = copy_leaf(from[n].child[i], word, move);
          children[i] = box_around(nodes[n].child[i], word);
        }
        whole.grow(children[i]);
      }
      set_child_bounds<S>(nodes[n], children);
      whole.min.store(boxes[n].min); // over the words beside
      whole.max.store(boxes[n].max);
    }
  }
  uint32_t offset_of(const NodeRecord* node) const {
    return static_cast<uint32_t>(reinterpret_cast<const uint8_t*>(node) - image_);
  }
  uint32_t copy_leaf(uint32_t first, uint32_t word, const Move& move) const {
    if (!leaf_word::is_list(word)) return first + move.objects;
    for (uint32_t i = 0; i < leaf_word::count(word); ++i)
      word_at(first + move.list + i * 4) = word_at(first + i * 4) + move.objects;
    return first + move.list;
  }
  uint32_t& word_at(uint32_t offset) const { return *reinterpret_cast<uint32_t*>(image_ + offset); }
  /// As in NodeRecord.
  LaneAabb<S> box_around(uint32_t first, uint32_t word) const {
    const uint32_t step = leaf_word::step_bytes(word);
    LaneAabb<S> box = LaneAabb<S>::empty();
    for (uint32_t i = 0; i < leaf_word::count(word); ++i) {
      const uint32_t object = step == 0 ? word_at(first + i * 4) : first + i * step;
      box.grow(box_of<S>(*reinterpret_cast<const ObjectRecord*>(image_ + object)));
    }
    return box;
  }

  void build(Treelet& treelet) {
    Reference* references = references_;
    Reference* spare = spare_;
    if (treelet.count > kLocalReferences) {
      references = memory_.references + treelet.first;
      spare = memory_.spare_references + treelet.first;
    }
    const LeafRule rule = leaf_rule(frame_.wide_leaves != 0, prototypes_.of(run_of(treelet)) != kNoGroup);
    Range<S> all = {0, 0, 0, LaneAabb<S>::empty()};
    for (uint32_t r = treelet.begin; r < treelet.end; ++r) {
      const GroupRecord& run = runs_[memory_.runs[r].value];
      add_references(run.first, run.count, rule, references, all);
    }
    NodeRecord* nodes = nodes_ + memory_.team->top_nodes + treelet.first_node;
    const NodeRecord* end = build(all, treelet.place, nodes, references, spare, treelet.first, rule);
    treelet.nodes = static_cast<uint32_t>(end - nodes);
  }

  /// Adds references to objects that are neighbours in the table.
  void add_references(uint32_t first, uint32_t count, const LeafRule& rule, Reference* references,
                      Range<S>& range) const {
    for (uint32_t i = first; i < first + count; ++i) {
      Reference& reference = references[range.end++];
      const LaneAabb<S> lanes = box_of<S>(objects_[i]);
      lanes.min.store(reference.min); // over the words beside
      lanes.max.store(reference.max);
      reference.value = frame_.object_offset + i * static_cast<uint32_t>(sizeof(ObjectRecord));
      const uint32_t kind = objects_[i].kind_and_flags & object_flag::kind_mask;
      reference.weight = static_cast<ObjectKind>(kind) == ObjectKind::triangle ? 1 : rule.weight_else;
      range.weight += reference.weight;
      range.box.grow(lanes);
    }
  }

  /// A subtree over the objects from place `first` of the list on.
  NodeRecord* build(const Range<S>& range, const Place& place, NodeRecord* next, Reference* references,
                    Reference* spare, uint32_t first, const LeafRule& rule) {
    Leaves<S> leaves(image_, frame_.bvh.list_offset + first * 4, references, rule);
    return TreeletBuilder(image_, references, spare, leaves, treelet_stack_).build(range, place, next);
  }

  /// Few objects, which have no runs.
  void build_whole() {
    const uint32_t count = frame_.object_count;
    const bool local = count <= kLocalReferences;
    Reference* references = local ? references_ : memory_.references;
    const LeafRule rule = leaf_rule(frame_.wide_leaves != 0, false);
    Range<S> all = {0, 0, 0, LaneAabb<S>::empty()};
    add_references(0, count, rule, references, all);
    const NodeRecord* end = all.weight <= rule.certain
                                ? add_root(all, references, rule)
                                : build(all, {nullptr, 0, 0}, nodes_, references,
                                        local ? spare_ : memory_.spare_references, 0, rule);
    memory_.team->nodes = static_cast<uint32_t>(end - nodes_);
  }
  /// The root above objects that are one leaf.
  NodeRecord* add_root(const Range<S>& all, const Reference* references, const LeafRule& rule) {
    const LaneAabb<S> empty = LaneAabb<S>::empty();
    set_child_bounds<S>(*nodes_, {all.box, empty, empty, empty});
    for (uint32_t i = 0; i < kChildren; ++i)
      nodes_->child[i] = nodes_->leaf[i] = 0;
    if (all.count() != 0)
      Leaves<S>(image_, frame_.bvh.list_offset, references, rule).add(all, {nodes_, 0, 0});
    return nodes_ + 1;
  }

  const FrameBlock& frame_;
  const WorkMemory memory_;
  const Prototypes prototypes_;
  uint32_t self_;
  uint8_t* image_;
  const ObjectRecord* objects_;
  const GroupRecord* runs_;
  NodeRecord* nodes_;
  typename TopBuilder::Task* top_stack_;
  typename TreeletBuilder::Task* treelet_stack_;
  Reference* references_; ///< of a usual treelet
  Reference* spare_;
};

} // namespace bvh

/// Writes the nodes and the list that `frame.bvh` has room for, from the objects of the scene image,
/// and returns the number of nodes, with gaps between those that are used. The sort buffers have room for
/// bvh::WorkSize::pairs(). A node lies at most bvh::kMaxDepth below the root. What is built
/// depends on the objects alone.
///
/// All SPEs of a team call it at a time. `team`: its size(), the index() of this one in it, and wait(), which
/// returns when all have called it and makes visible what they have written.
template <class Spu, class Team> uint32_t build_bvh(Spu& spu, const FrameBlock& frame, Team&& team) {
  static_assert(Spu::direct_memory, "the builder follows pointers to main memory");
  using Builder = bvh::Builder<Spu>;
  const uint32_t builders = team.size() < bvh::kMaxBuilders ? team.size() : bvh::kMaxBuilders;
  uint8_t* const marked = spu.mark();
  Builder builder(spu, frame, team.index());
  for (uint32_t step = 0; step < bvh::kSteps; ++step) {
    if (team.index() < builders) builder.run(step);
    team.wait();
  }
  spu.release(marked);
  return builder.nodes();
}

/// On this SPE alone.
template <class Spu> uint32_t build_bvh(Spu& spu, const FrameBlock& frame) {
  struct Alone {
    uint32_t size() const { return 1; }
    uint32_t index() const { return 0; }
    void wait() const {}
  };
  return build_bvh(spu, frame, Alone());
}

} // namespace celltrace::kernel

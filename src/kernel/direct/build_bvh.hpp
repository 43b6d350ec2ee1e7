// Builder of the BVH in direct memory, on any number of SPEs. Kernel dialect.
#pragma once

#include "kernel/accel/object_bounds.hpp"
#include "kernel/direct/build_bvh_leaves.hpp"
#include "kernel/direct/build_bvh_memory.hpp"
#include "kernel/strategy.hpp"
#include "records/frame.hpp"

namespace celltrace::kernel {

namespace bvh {

/// The work of one SPE in a build, step by step. The result does not depend on the number of SPEs.
template <class Spu> class Builder {
public:
  using S = typename Spu::simd;

  /// Makes the builder of SPE `self` of a team.
  Builder(Spu& spu, const FrameBlock& frame, uint32_t self)
      : frame_(frame), memory_(frame), prototypes_(frame), self_(self),
        image_(WorkMemory::pointer<uint8_t>(frame.image)),
        objects_(reinterpret_cast<const ObjectRecord*>(image_ + frame.object_offset)),
        groups_(reinterpret_cast<const GroupRecord*>(image_ + frame.group_offset)),
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
  /// Returns the number of nodes of the BVH, valid after the last step.
  uint32_t nodes() const { return memory_.team->nodes; }

private:
  using TopBuilder = SubtreeBuilder<S, Treelets<S>>;
  using TreeletBuilder = SubtreeBuilder<S, Leaves<S>>;
  using F4 = typename S::F4;
  static constexpr uint32_t kBatch = tuning::kTreeletsAtATime;

  /// Step 0: builds the top levels, which end at treelets.
  void build_top() {
    const uint32_t groups = frame_.group_count;
    if (groups == 0) return build_whole();
    static_assert(sizeof(Reference) == sizeof(GroupRecord), "a group is referred to by its bounds");
    for (uint32_t i = 0; i < groups; ++i) {
      __builtin_memcpy(static_cast<void*>(&memory_.groups[i]), &groups_[i], sizeof(Reference));
      memory_.groups[i].value = i;
    }
    Treelets<S> treelets(memory_.groups, prototypes_, memory_.treelets);
    TopBuilder top(image_, memory_.groups, memory_.spare_groups, treelets, top_stack_);
    const NodeRecord* end = top.build(range_of<S>(memory_.groups, 0, groups), {nullptr, 0, 0}, nodes_);
    const auto top_nodes = static_cast<uint32_t>(end - nodes_);
    const uint32_t built = top_nodes + treelets.nodes();
    *memory_.team = {treelets.count(), top_nodes, built, built, 0, 0, {}};
    if (prototypes_.any()) find_prototypes(treelets.count());
  }

  /// Registers the treelets of prototypes. A prototype takes the depth of its deepest copy, so that its nodes
  /// stay within kMaxDepth in every copy.
  void find_prototypes(uint32_t treelets) {
    for (uint32_t t = 0; t < treelets; ++t)
      if (!is_copy(memory_.treelets[t])) memory_.treelet_of[group_of(memory_.treelets[t])] = t;
    for (uint32_t t = 0; t < treelets; ++t) {
      const Treelet& treelet = memory_.treelets[t];
      if (!is_copy(treelet)) continue;
      Place& place = prototype_of(treelet).place;
      if (place.depth < treelet.place.depth) place.depth = treelet.place.depth;
    }
  }
  /// Returns the index of a treelet's first group.
  uint32_t group_of(const Treelet& treelet) const { return memory_.groups[treelet.begin].value; }
  bool is_copy(const Treelet& treelet) const { return prototypes_.is_copy(group_of(treelet)); }
  Treelet& prototype_of(const Treelet& copy) const {
    return memory_.treelets[memory_.treelet_of[prototypes_.of(group_of(copy))]];
  }

  /// Step 1: takes treelets that no other SPE has taken, and builds those that are no copies.
  void build_treelets() {
    const uint32_t treelets = memory_.team->treelets;
    for (;;) {
      const uint32_t first = __atomic_fetch_add(&memory_.team->next, kBatch, __ATOMIC_RELAXED);
      if (first >= treelets) return;
      const uint32_t end = treelets - first < kBatch ? treelets : first + kBatch;
      for (uint32_t t = first; t < end; ++t) {
        if (t + 1 < end) prefetch_objects(memory_.treelets[t + 1]);
        if (!is_copy(memory_.treelets[t])) build(memory_.treelets[t]);
      }
    }
  }

  /// Step 2: takes treelets that no other SPE has taken, and makes the copies among them. Nodes of copies
  /// follow each other in the order of the treelets without gaps; therefore each SPE also counts the nodes of
  /// the copies that others make.
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
      const uint32_t first = __atomic_fetch_add(&memory_.team->next_copy, kBatch, __ATOMIC_RELAXED);
      pass(first, false);
      pass(first + kBatch, true);
    }
    if (self_ == 0) memory_.team->nodes = static_cast<uint32_t>(next - nodes_);
  }

  /// Prefetches the objects of a treelet: they may be in the cache of another core that wrote them, and the
  /// objects of the next treelet lie elsewhere in the image. Inlined, because compilers drop calls of
  /// functions that only prefetch.
  [[gnu::always_inline]] void prefetch_objects(const Treelet& treelet) const {
    for (uint32_t r = treelet.begin; r < treelet.end; ++r) {
      const GroupRecord& group = groups_[memory_.groups[r].value];
      for (uint32_t i = 0; i < group.count; ++i)
        __builtin_prefetch(objects_ + group.first + i);
    }
  }

  /// Differences between the offsets in a copied leaf and in the original, modulo 2^32.
  struct Relocation {
    uint32_t objects, list;
  };

  /// Copies the nodes and lists of a prototype to a treelet, with the bounds of the treelet's own objects.
  void copy(const Treelet& prototype, const Treelet& treelet, NodeRecord* nodes) {
    const NodeRecord* from = nodes_ + memory_.team->top_nodes + prototype.first_node;
    const Relocation relocation = {(groups_[group_of(treelet)].first - groups_[group_of(prototype)].first) *
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
      child = copy_leaf(original.parent->child[original.slot], leaf, relocation);
    }

    Reference* node_bounds = spare_;               // of finished nodes
    for (uint32_t n = prototype.nodes; n-- > 0;) { // children have higher indices
      LaneAabb<S> children[kChildren];
      LaneAabb<S> whole = LaneAabb<S>::empty();
      for (uint32_t i = 0; i < kChildren; ++i) {
        const uint32_t word = nodes[n].leaf[i] = from[n].leaf[i];
        if (word == 0) {
          const uint32_t below = from[n].child[i] - offset_of(from);
          nodes[n].child[i] = below + offset_of(nodes);
          children[i] = LaneAabb<S>::of(node_bounds[below / sizeof(NodeRecord)]);
        } else {
          nodes[n].child[i] = copy_leaf(from[n].child[i], word, relocation);
          children[i] = leaf_bounds(nodes[n].child[i], word);
        }
        whole.grow(children[i]);
      }
      set_child_bounds<S>(nodes[n], children);
      whole.min.store(node_bounds[n].min); // lane 3 overwrites `value` and `weight`, which are unused
      whole.max.store(node_bounds[n].max);
    }
  }
  uint32_t offset_of(const NodeRecord* node) const {
    return static_cast<uint32_t>(reinterpret_cast<const uint8_t*>(node) - image_);
  }
  uint32_t copy_leaf(uint32_t first, uint32_t word, const Relocation& relocation) const {
    if (!leaf_word::is_list(word)) return first + relocation.objects;
    for (uint32_t i = 0; i < leaf_word::count(word); ++i)
      word_at(first + relocation.list + i * 4) = word_at(first + i * 4) + relocation.objects;
    return first + relocation.list;
  }
  uint32_t& word_at(uint32_t offset) const { return *reinterpret_cast<uint32_t*>(image_ + offset); }
  /// Returns the bounds of the objects in a leaf, which is encoded as in NodeRecord.
  LaneAabb<S> leaf_bounds(uint32_t first, uint32_t word) const {
    const uint32_t step = leaf_word::step_bytes(word);
    LaneAabb<S> bounds = LaneAabb<S>::empty();
    for (uint32_t i = 0; i < leaf_word::count(word); ++i) {
      const uint32_t object = step == 0 ? word_at(first + i * 4) : first + i * step;
      bounds.grow(box_of<S>(*reinterpret_cast<const ObjectRecord*>(image_ + object), image_));
    }
    return bounds;
  }

  /// Builds a treelet, with its references in local store if they fit.
  void build(Treelet& treelet) {
    Reference* references = references_;
    Reference* spare = spare_;
    if (treelet.count > kLocalReferences) {
      references = memory_.references + treelet.first;
      spare = memory_.spare_references + treelet.first;
    }
    const LeafRule rule = leaf_rule(frame_.large_leaves != 0, prototypes_.of(group_of(treelet)) != kNoGroup);
    Range<S> all = {0, 0, 0, LaneAabb<S>::empty()};
    for (uint32_t r = treelet.begin; r < treelet.end; ++r) {
      const GroupRecord& group = groups_[memory_.groups[r].value];
      add_references(group.first, group.count, rule, references, all);
    }
    NodeRecord* nodes = nodes_ + memory_.team->top_nodes + treelet.first_node;
    Leaves<S> leaves(image_, list_offset(treelet.first), references, rule, kChildren);
    const NodeRecord* end =
        TreeletBuilder(image_, references, spare, leaves, treelet_stack_).build(all, treelet.place, nodes);
    treelet.nodes = static_cast<uint32_t>(end - nodes);
  }

  /// Appends references to the `count` objects from index `first` on.
  void add_references(uint32_t first, uint32_t count, const LeafRule& rule, Reference* references,
                      Range<S>& range) const {
    for (uint32_t i = first; i < first + count; ++i) {
      Reference& reference = references[range.end++];
      const LaneAabb<S> lanes = box_of<S>(objects_[i], image_);
      lanes.min.store(reference.min); // lane 3 overwrites `value` and `weight`, which are set below
      lanes.max.store(reference.max);
      reference.value = frame_.object_offset + i * static_cast<uint32_t>(sizeof(ObjectRecord));
      reference.weight = weight_of(objects_[i], rule);
      range.weight += reference.weight;
      range.box.grow(lanes);
    }
  }

  /// Returns the offset in the image of a word of the BVH's list.
  uint32_t list_offset(uint32_t word) const { return frame_.bvh.list_offset + word * 4; }

  /// Builds the BVH of a scene with few objects, which are not in groups. Nodes need not be full, as their
  /// memory is insignificant.
  void build_whole() {
    const uint32_t count = frame_.object_count;
    const bool local = count <= kLocalReferences;
    Reference* references = local ? references_ : memory_.references;
    const LeafRule rule = leaf_rule(frame_.large_leaves != 0, false);
    Range<S> all = {0, 0, 0, LaneAabb<S>::empty()};
    add_references(0, count, rule, references, all);
    Leaves<S> leaves(image_, list_offset(0), references, rule, 2);
    NodeRecord* end = nodes_ + 1;
    if (leaves.end(all)) {
      add_root(all, leaves);
    } else {
      Reference* spare = local ? spare_ : memory_.spare_references;
      end = TreeletBuilder(image_, references, spare, leaves, treelet_stack_)
                .build(all, {nullptr, 0, 0}, nodes_);
    }
    memory_.team->nodes = static_cast<uint32_t>(end - nodes_);
  }
  /// Makes the root of a BVH that is a single leaf.
  void add_root(const Range<S>& all, Leaves<S>& leaves) {
    const LaneAabb<S> empty = LaneAabb<S>::empty();
    set_child_bounds<S>(*nodes_, {all.box, empty, empty, empty});
    for (uint32_t i = 0; i < kChildren; ++i)
      nodes_->child[i] = nodes_->leaf[i] = 0;
    if (all.count() != 0) leaves.add(all, {nodes_, 0, 0});
  }

  const FrameBlock& frame_;
  const WorkMemory memory_;
  const Prototypes prototypes_;
  uint32_t self_;
  uint8_t* image_;
  const ObjectRecord* objects_;
  const GroupRecord* groups_;
  NodeRecord* nodes_;
  typename TopBuilder::Task* top_stack_;
  typename TreeletBuilder::Task* treelet_stack_;
  Reference* references_; ///< references in local store: room for most treelets
  Reference* spare_;
};

} // namespace bvh

/// Builds the BVH of the objects in the scene image, in the memory that `frame.bvh` describes. Returns the
/// number of nodes, including unused gaps. The work memory needs room for bvh::WorkSize::pairs(). No node is
/// deeper than bvh::kMaxDepth. The result depends on the objects only.
///
/// All SPEs of a team call this at the same time. `team` provides its size(), the index() of this SPE, and a
/// barrier wait(), which also makes the writes of all of them visible.
template <class Spu, class Team> uint32_t build_bvh(Spu& spu, const FrameBlock& frame, Team&& team) {
  static_assert(std::is_same_v<Strategy<Spu>, DirectStrategy>, "the builder follows pointers to main memory");
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

/// Builds the BVH on this SPE only.
template <class Spu> uint32_t build_bvh(Spu& spu, const FrameBlock& frame) {
  struct Alone {
    uint32_t size() const { return 1; }
    uint32_t index() const { return 0; }
    void wait() const {}
  };
  return build_bvh(spu, frame, Alone());
}

} // namespace celltrace::kernel

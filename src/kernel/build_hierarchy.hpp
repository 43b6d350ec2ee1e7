// Builds the hierarchy of boxes, for memory that can be dereferenced. Kernel dialect.
#pragma once

#include "kernel/build_hierarchy_subtree.hpp"
#include "kernel/overlap.hpp"

namespace celltrace::kernel {

/// Writes the nodes and the list that `frame.hierarchy` has room for, from the objects of the scene image,
/// and returns the number of nodes. Each sort buffer has room for 4 pairs an object. A node lies at most
/// hierarchy::kMaxDepth below the root; what is built depends on the objects alone.
template <class Spu> uint32_t build_hierarchy(Spu& spu, const FrameBlock& frame) {
  static_assert(Spu::direct_memory, "the builder follows pointers to main memory");
  using namespace hierarchy;
  using S = typename Spu::simd;
  const auto at = [](ea_t ea) { return reinterpret_cast<uint8_t*>(static_cast<uintptr_t>(ea)); };
  uint8_t* const image = at(frame.image);
  const auto* objects = reinterpret_cast<const ObjectRecord*>(image + frame.object_offset);
  auto* references = reinterpret_cast<Reference*>(at(frame.sort_buffer[0]));
  auto* spare = reinterpret_cast<Reference*>(at(frame.sort_buffer[1]));
  auto* root = reinterpret_cast<NodeRecord*>(image + frame.hierarchy.node_offset);

  for (uint32_t i = 0; i < frame.object_count; ++i) {
    const Box box = bounding_box(objects[i]);
    const uint32_t offset = frame.object_offset + i * static_cast<uint32_t>(sizeof(ObjectRecord));
    references[i] = {{box.min[0], box.min[1], box.min[2]}, offset, {box.max[0], box.max[1], box.max[2]}, 1};
  }
  using Builder = SubtreeBuilder<S>;
  uint8_t* const marked = spu.mark();
  Builder builder({image, frame.hierarchy.list_offset, root},
                  spu.template allocate<typename Builder::Task>(Builder::kStackTasks));
  builder.build_root(references, spare, range_of<S>(references, 0, frame.object_count));
  spu.release(marked);
  return static_cast<uint32_t>(builder.next_node() - root);
}

} // namespace celltrace::kernel

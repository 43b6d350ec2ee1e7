// The loop of all traversals of the BVH: of a packet, of a bundle, and of a bundle's frustum alone. Kernel
// dialect.
#pragma once

#include "kernel/traversal_stack.hpp"

namespace celltrace::kernel {

/// Traverses the nodes on the stack, and before them the node or leaf `ref` if `has_ref`. A Visitor has:
///
///   bool expand(NodeRef& ref)     pushes the children of a node that are hit; a single child that is hit may
///                                 become `ref` instead, and the result is true
///   void test(const NodeRef& ref) tests the objects of a leaf, or defers it
///   bool next(NodeRef& ref)       pops the next node or leaf; false if there is none
///   bool pauses()                 true if the traversal is suspended before `ref`
///
/// Returns true if the traversal was suspended; a call with the same `ref` continues it.
template <class Visitor>
[[gnu::always_inline]] inline bool traverse_nodes(Visitor& visitor, NodeRef& ref, bool has_ref = true) {
  // next() is called in one place: on an SPE it is inlined, and code takes local store.
  for (bool pops = !has_ref;; pops = false) {
    if (!pops) {
      if (ref.is_leaf()) {
        visitor.test(ref);
      } else if (visitor.expand(ref)) {
        if (visitor.pauses()) return true;
        continue;
      }
    }
    if (!visitor.next(ref)) return false;
    if (visitor.pauses()) return true;
  }
}

} // namespace celltrace::kernel

// The loop of every traversal of the BVH: of a packet, of a bundle, and of a bundle's frustum alone. Kernel
// dialect.
#pragma once

#include "kernel/traversal_stack.hpp"

namespace celltrace::kernel {

/// Traverses what is on the stack, and before that, if it `has_ref`, what is below `ref`. A Visitor says what
/// is traversed:
///
///   bool expand(NodeRef& ref)     pushes the children of a node that are hit. If that is one child only, it
///                                 may become `ref` instead, and the result is true.
///   void test(const NodeRef& ref) tests the objects of a leaf, or defers it
///   bool next(NodeRef& ref)       pops the next node or leaf; false if there is none
///   bool pauses()                 whether the traversal is suspended before `ref`
///
/// Returns whether it was suspended; called again with the same `ref`, it goes on.
template <class Visitor>
[[gnu::always_inline]] inline bool traverse_nodes(Visitor& visitor, NodeRef& ref, bool has_ref = true) {
  // One call of next(): on an SPE it is inlined, and code takes local store.
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

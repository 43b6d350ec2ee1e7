// The layout of the work memory of a BVH build, which the frame block refers to. Kernel dialect.
#pragma once

#include "kernel/direct/build_bvh_plan.hpp"
#include "kernel/direct/build_bvh_treelets.hpp"
#include "records/frame.hpp"

namespace celltrace::kernel::bvh {

/// Pointers to the parts of the work memory.
struct WorkMemory {
  TeamRecord* team;
  Reference* groups; ///< `value`: index of the GroupRecord; `weight`: number of objects
  Reference* spare_groups;
  Treelet* treelets;
  Reference* references; ///< objects of treelets that exceed kLocalReferences; by position in the list
  Reference* spare_references;
  uint32_t* treelet_of; ///< index: group; defined for prototypes

  explicit WorkMemory(const FrameBlock& frame) {
    const WorkSize size(frame.object_count, frame.group_count, frame.longest_group);
    team = pointer<TeamRecord>(frame.work_memory[0]);
    groups = reinterpret_cast<Reference*>(team + 1);
    references = groups + size.groups;
    treelets = reinterpret_cast<Treelet*>(references + size.references);
    spare_groups = pointer<Reference>(frame.work_memory[1]);
    spare_references = spare_groups + size.groups;
    treelet_of = reinterpret_cast<uint32_t*>(spare_references + size.references);
  }
  template <class T> static T* pointer(ea_t ea) { return reinterpret_cast<T*>(static_cast<uintptr_t>(ea)); }
};

} // namespace celltrace::kernel::bvh

// The work memory of the builder of the BVH, which lies in the sort buffers. Kernel dialect.
#pragma once

#include "kernel/direct/build_bvh_plan.hpp"
#include "kernel/direct/build_bvh_treelets.hpp"

namespace celltrace::kernel::bvh {

/// Where what lies.
struct WorkMemory {
  TeamRecord* team;
  Reference* runs; ///< `value`: index of the GroupRecord; `weight`: objects
  Reference* spare_runs;
  Treelet* treelets;
  Reference* references; ///< of the objects of treelets too large for an SPE, in the order of the list
  Reference* spare_references;
  uint32_t* treelet_of; ///< by run, if that is a prototype

  explicit WorkMemory(const FrameBlock& frame) {
    const WorkSize size(frame.object_count, frame.group_count, frame.longest_group);
    team = pointer<TeamRecord>(frame.sort_buffer[0]);
    runs = reinterpret_cast<Reference*>(team + 1);
    references = runs + size.runs;
    treelets = reinterpret_cast<Treelet*>(references + size.references);
    spare_runs = pointer<Reference>(frame.sort_buffer[1]);
    spare_references = spare_runs + size.runs;
    treelet_of = reinterpret_cast<uint32_t*>(spare_references + size.references);
  }
  template <class T> static T* pointer(ea_t ea) { return reinterpret_cast<T*>(static_cast<uintptr_t>(ea)); }
};

} // namespace celltrace::kernel::bvh

// The work memory of the builder of the hierarchy, which lies in the sort buffers. Kernel dialect.
#pragma once

#include "kernel/build_hierarchy_cells.hpp"
#include "kernel/build_hierarchy_plan.hpp"

namespace celltrace::kernel::hierarchy {

constexpr uint32_t kObjectsPerCell = 16;
constexpr uint32_t kMaxCells = 1u << 18;

/// What SPEs tell each other during a build. A line for each, and one for all.
struct alignas(128) BuilderRecord {
  float box_min[4], box_max[4];         ///< around its objects, later its cells
  float centres_min[4], centres_max[4]; ///< around the doubles of their centres
  uint32_t objects, used_cells;         ///< in its cells
  uint32_t unused[14];
};
static_assert(sizeof(BuilderRecord) == 128, "one line");

struct alignas(128) TeamRecord {
  uint32_t treelets;
  uint32_t top_nodes;
  uint32_t nodes;
  uint32_t next_to_gather, next_to_build; ///< treelets nobody has taken
  uint32_t unused[27];
};
static_assert(sizeof(TeamRecord) == 128, "one line");

/// Where what lies. Of 40 bytes an object in each buffer, 32 are its reference and the rest is for cells, of
/// which there is one for kObjectsPerCell objects at most.
struct WorkMemory {
  BuilderRecord* builders;
  TeamRecord* team;
  Reference* references;  ///< in the order of objects, later by treelet
  Reference* sorted;      ///< by cell, later spare
  uint32_t* counts;       ///< a table for each builder: objects by cell, then where the next one goes
  Reference* spare_cells; ///< once the counts are used
  Treelet* treelets;
  Reference* cells;   ///< `value`: the first of its references
  uint32_t max_cells; ///< 0: no room for any

  template <class Spu> WorkMemory(Spu& spu, const FrameBlock& frame) {
    if (frame.sort_capacity < work_pairs(frame.object_count))
      use_little(spu, frame);
    else
      use_all(frame);
  }
  void use_all(const FrameBlock& frame) {
    const uint32_t objects = frame.object_count;
    max_cells = objects / kObjectsPerCell < kMaxCells ? objects / kObjectsPerCell : kMaxCells;
    builders = pointer<BuilderRecord>(frame.sort_buffer[0]);
    references = reinterpret_cast<Reference*>(builders + kMaxBuilders);
    counts = reinterpret_cast<uint32_t*>(references + objects);
    spare_cells = references + objects;
    treelets = reinterpret_cast<Treelet*>(spare_cells + max_cells);
    team = pointer<TeamRecord>(frame.sort_buffer[1]);
    sorted = reinterpret_cast<Reference*>(team + 1);
    cells = sorted + objects;
  }
  template <class Spu> void use_little(Spu& spu, const FrameBlock& frame) {
    max_cells = 0;
    builders = spu.template allocate<BuilderRecord>();
    team = spu.template allocate<TeamRecord>();
    references = pointer<Reference>(frame.sort_buffer[0]);
    sorted = pointer<Reference>(frame.sort_buffer[1]);
  }
  template <class T> static T* pointer(ea_t ea) { return reinterpret_cast<T*>(static_cast<uintptr_t>(ea)); }
};
static_assert(kMaxBuilders * 4 <= 8 * kObjectsPerCell, "room for the counts");
static_assert(sizeof(Reference) + sizeof(Treelet) <= 8 * kObjectsPerCell,
              "room for spare cells and treelets");

} // namespace celltrace::kernel::hierarchy

// Constructive solid geometry: which crossings with parts of objects count. Kernel dialect.
#pragma once

#include "records/object.hpp"

#include <stdint.h>

namespace celltrace::kernel {

// Constructive solid geometry. Surfaces of its parts are objects; a crossing with one counts where the
// condition of the part holds: in all other parts of an intersection, in no other part of a merge, at each
// level of the tree. As in POV-Ray, parts of a merge that a ray does not see hide nothing from it.

/// The condition of a part, at one level. Its program says of a point whether it is in the other parts; steps
/// [skip_begin, skip_end) are of the part itself.
struct alignas(32) CsgRecord {
  uint32_t next;  ///< offset of the condition at the next level, or kNoOffset
  uint32_t steps; ///< offset of the first CsgStep
  uint32_t count; ///< of steps
  uint32_t skip_begin, skip_end;
  uint32_t unused[3];
};
static_assert(sizeof(CsgRecord) == 32, "four a line");

/// A step: where to go on, by number, if the point is in a solid or not. Steps only go forward.
struct alignas(16) CsgStep {
  uint32_t solid; ///< offset of a SolidRecord
  uint32_t if_inside, if_outside;
  /// Flags of object_flag::selective. If there are any, the solid is not asked: rays that do not see what has
  /// these flags go on at `if_outside`, others at `if_inside`.
  uint32_t unseen_by;
};
static_assert(sizeof(CsgStep) == 16, "eight a line");
constexpr uint32_t kCsgAccept = 0xFFFFFFFFu;
constexpr uint32_t kCsgReject = 0xFFFFFFFEu;

/// A shape of which only the inside matters.
struct alignas(128) SolidRecord {
  ObjectRecord object; ///< kind and geometry; kEmptySolid: nothing is inside
  ExtraRecord extra;
};
static_assert(sizeof(SolidRecord) == 128, "one a line");
constexpr uint32_t kEmptySolid = object_flag::kind_mask;

} // namespace celltrace::kernel

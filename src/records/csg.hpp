// Constructive solid geometry: records that decide which crossings with the surfaces of CSG parts count.
// Kernel dialect.
#pragma once

#include "records/object.hpp"

#include <stdint.h>

namespace celltrace::kernel {

// The surfaces of CSG parts are objects. A crossing with a part's surface counts if the part's condition
// holds at each level of the CSG tree: inside all other parts of an intersection, outside all other parts of
// a merge. As in POV-Ray, parts of a merge that are invisible to a ray do not hide other parts from it.

/// The condition of a part at one level of the CSG tree. Its program, a sequence of CsgSteps, decides whether
/// a point is inside the other parts; steps [skip_begin, skip_end) belong to the part itself and are skipped.
struct alignas(32) CsgRecord {
  uint32_t next;  ///< offset of the condition at the next level up, or kNoOffset
  uint32_t steps; ///< offset of the first CsgStep
  uint32_t count; ///< number of steps
  uint32_t skip_begin, skip_end;
  uint32_t unused[3];
};
static_assert(sizeof(CsgRecord) == 32, "four a line");

/// A step of a condition's program: tests a solid and names the next step, which is always a later one or
/// kCsgAccept or kCsgReject.
struct alignas(16) CsgStep {
  uint32_t solid; ///< offset of a SolidRecord
  uint32_t if_inside, if_outside;
  /// Flags of object_flag::selective. If any is set, the solid is not tested: rays to which objects with
  /// these flags are invisible continue at `if_outside`, others at `if_inside`.
  uint32_t unseen_by;
};
static_assert(sizeof(CsgStep) == 16, "eight a line");
constexpr uint32_t kCsgAccept = 0xFFFFFFFFu;
constexpr uint32_t kCsgReject = 0xFFFFFFFEu;

/// A shape of which only the inside is used.
struct alignas(128) SolidRecord {
  ObjectRecord object; ///< kind and geometry; kEmptySolid: contains no point
  ExtraRecord extra;
};
static_assert(sizeof(SolidRecord) == 128, "one a line");
constexpr uint32_t kEmptySolid = object_flag::kind_mask;

} // namespace celltrace::kernel

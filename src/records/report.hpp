// What SPEs report, and the words between PPE and SPE. Kernel dialect.
#pragma once

#include "records/object.hpp"

#include <stdint.h>

namespace celltrace::kernel {

/// What an SPE did in a frame.
struct alignas(128) ReportRecord {
  uint64_t primary_rays, shadow_rays, reflection_rays, refraction_rays;
  uint64_t tests[kMaxPrimitives];          ///< packet against object, by kind
  uint64_t accelerator_visits;             ///< voxels by rays, or nodes by beams
  uint64_t cache_hits[4], cache_misses[4]; ///< by DataKind
  uint64_t dropped_rays;                   ///< rays beyond the depth of the interior stack
  uint32_t packets;                        ///< rendered
  uint32_t exchanges;                      ///< balance exchanges that brought this SPE units
  uint32_t units_received;
  uint32_t busy_ticks; ///< of the decrementer, in which the SPE did not wait for work
  uint32_t spilled_nodes;
  uint32_t list_entries; ///< PREPARE FRAME
  uint64_t pixel_bytes;  ///< that left as pixels were traced
  uint64_t block_error;  ///< of pixels in blocks: squared differences, summed over red, green and blue
  uint32_t unused[26];
};
static_assert(sizeof(ReportRecord) == 640, "five lines");

/// Kinds of data that the cache counts separately.
enum class DataKind : uint32_t { list = 0, object = 1, material = 2, light = 3 };
constexpr uint32_t kDataKinds = 4;

// --- words between PPE and SPE ---

/// Bits of signal 1, PPE to SPE. The register is in logical-OR mode. Each but quit fetches the frame block
/// anew, so that a camera that moved needs no command of its own.
namespace command {
constexpr uint32_t prepare_frame = 0x1;
constexpr uint32_t render_frame = 0x2;
constexpr uint32_t synchronize = 0x4;
constexpr uint32_t quit = 0x8;
} // namespace command

/// Outbound mailbox, SPE to PPE: kind in the top four bits, a count below.
enum class ReportKind : uint32_t {
  prepared = 1, ///< count: 0
  needs_memory =
      2, ///< PREPARE FRAME ran out of room for pairs; the report's list_entries says how many there are
  progress = 3, ///< count: units completed in this frame so far
  idle = 4,     ///< as progress, and nothing left to do
  finished = 5, ///< left the frame; the report record is written
  synchronised = 6,
  unit = 7, ///< count: the number of a unit that is completed
};
constexpr uint32_t make_report(ReportKind kind, uint32_t count) {
  return (static_cast<uint32_t>(kind) << 28) | count;
}
constexpr ReportKind report_kind(uint32_t word) {
  return static_cast<ReportKind>(word >> 28);
}
constexpr uint32_t report_count(uint32_t word) {
  return word & 0x0FFFFFFFu;
}

} // namespace celltrace::kernel

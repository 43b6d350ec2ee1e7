// Reports of SPEs, and the words exchanged by PPE and SPEs. Kernel dialect.
#pragma once

#include "records/object.hpp"

#include <stdint.h>

namespace celltrace::kernel {

/// Statistics of an SPE in a frame.
struct alignas(128) ReportRecord {
  uint64_t primary_rays, shadow_rays, reflection_rays, refraction_rays;
  uint64_t tests[kMaxPrimitives];          ///< packet-object tests by kind
  uint64_t accelerator_visits;             ///< visits of voxels by rays, or of nodes by beams
  uint64_t cache_hits[4], cache_misses[4]; ///< index: DataKind
  uint64_t dropped_rays;                   ///< rays beyond the depth of the interior stack
  uint32_t packets;                        ///< packets rendered
  uint32_t exchanges;                      ///< balance exchanges that brought this SPE units
  uint32_t units_received;
  uint32_t busy_ticks; ///< decrementer ticks in which the SPE did not wait for work
  uint32_t spilled_nodes;
  uint32_t list_entries; ///< PREPARE FRAME: entries of the lists of a grid, or nodes of a BVH
  uint64_t pixel_bytes;  ///< bytes of pixels written to main memory during tracing
  uint64_t block_error;  ///< for pixels in blocks: squared differences, summed over red, green and blue
  uint32_t unused[26];
};
static_assert(sizeof(ReportRecord) == 640, "five lines");

/// Kinds of data that the cache counts separately.
enum class DataKind : uint32_t { list = 0, object = 1, material = 2, light = 3 };
constexpr uint32_t kDataKinds = 4;

// --- words between PPE and SPE ---

/// Bits of signal 1, from PPE to SPE, whose register is in logical-OR mode. Each command but `quit` fetches
/// the frame block again, so that a moved camera needs no command of its own.
namespace command {
constexpr uint32_t prepare_frame = 0x1;
constexpr uint32_t render_frame = 0x2;
constexpr uint32_t synchronize = 0x4;
constexpr uint32_t quit = 0x8;
} // namespace command

/// Kind of a word in the outbound mailbox, from SPE to PPE: the kind is in the top four bits, the count
/// below.
enum class ReportKind : uint32_t {
  prepared = 1,     ///< count: 0
  needs_memory = 2, ///< PREPARE FRAME lacks memory for pairs; list_entries is their number
  progress = 3,     ///< count: units completed so far in this frame
  idle = 4,         ///< count as with `progress`; no work is left
  finished = 5,     ///< the SPE has left the frame; its report record is written
  synchronised = 6,
  unit = 7, ///< count: number of a completed unit
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

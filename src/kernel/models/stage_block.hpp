// Orders of the PPE to an SPE of a pipeline, and the SPE's report. The fields of the records are listed in
// render/models/stage_fields.hpp. Kernel dialect.
#pragma once

#include "celltrace/spe/types.hpp"
#include "kernel/packet.hpp"

namespace celltrace::kernel::models {

/// Largest number of contexts of a pipeline: each is a bit of signal 2.
constexpr uint32_t kMaxContexts = 28;

/// Bits of signal 2 besides the contexts. A context's bit hands its job to the receiver.
namespace bell {
constexpr uint32_t contexts = (1u << kMaxContexts) - 1;
constexpr uint32_t stop = 1u << 30; ///< from the PPE to SPEs that generate or shade: no new packets or rays
constexpr uint32_t quit = 1u << 31; ///< from the PPE: the frame is over
} // namespace bell

/// Bits for the tasks of an SPE.
namespace task {
constexpr uint32_t generate = 0x1;    ///< makes primary rays
constexpr uint32_t search = 0x2;      ///< walks and tests
constexpr uint32_t walk = 0x4;        ///< walks rays through the grid
constexpr uint32_t test = 0x8;        ///< tests the objects of voxels
constexpr uint32_t shade = 0x10;      ///< shades surfaces, and asks for secondary and shadow rays
constexpr uint32_t dispatch = 0x20;   ///< hands jobs to any searcher that is free
constexpr uint32_t by_mailbox = 0x40; ///< receives jobs by mailbox, as bits
} // namespace task

/// The argument of a stage's program.
struct alignas(128) StageBlock {
  ea_t frame;           ///< FrameBlock
  ea_t jobs;            ///< JobRecord of context 0
  ea_t report;          ///< StageReport of this SPE
  ea_t ray_stack;       ///< spill area of context 0
  uint32_t job_bytes;   ///< distance from one context's job to the next one's
  uint32_t stack_nodes; ///< capacity of the spill area of a context, in nodes
  uint32_t tasks;
  uint32_t contexts;                  ///< generator: contexts of its shaders; shader: its own contexts
  uint32_t announced;                 ///< generator: the first context of every shader
  uint32_t generator;                 ///< SPE that takes contexts back
  uint32_t first_row, row_step;       ///< rows of packets of this pipeline
  uint32_t first_searcher, searchers; ///< SPEs to dispatch to
  uint8_t searcher[32], tester[32], shader[32]; ///< SPEs by context
  uint32_t unused[22];
};
static_assert(sizeof(StageBlock) == 256, "fetched by one DMA command");

/// Statistics of a stage in a frame, in addition to its ReportRecord.
struct alignas(128) StageReport {
  uint64_t jobs; ///< number of jobs, of one or more searches: completed by a searcher, or sent by a generator
                 ///< or shader
  uint64_t searches;     ///< number of completed searches
  uint64_t primary_hits; ///< primary rays that hit something
  /// Primary rays sent back for traversal at least once, and how many of them hit something.
  uint64_t primary_returned, primary_hits_returned;
  uint64_t returns; ///< number of times that a ray was sent back
  uint64_t unused[10];
};
static_assert(sizeof(StageReport) == 128, "crosses DMA");

} // namespace celltrace::kernel::models

// What the PPE has to know of how a hierarchy is built: by how many SPEs, in how many steps, in what memory.
// Kernel dialect.
#pragma once

#include "celltrace/spe/types.hpp"

#include <stdint.h>

namespace celltrace::kernel::hierarchy {

/// SPEs that build at a time.
constexpr uint32_t kMaxBuilders = 32;
/// Steps that several SPEs take one after the other; each needs what all have done in those before.
constexpr uint32_t kSteps = 9;
/// Fewer objects are built by one SPE, without cells.
constexpr uint32_t kMinObjectsForCells = 4096;

/// Pairs of 8 bytes that each of the two sort buffers should have room for: five an object, and a line for
/// every SPE and one for all. A single SPE makes do with 4 an object, and takes longer.
constexpr uint64_t work_pairs(uint32_t objects) {
  return uint64_t{5} * objects + (kMaxBuilders + 1) * kLineBytes / 8;
}

} // namespace celltrace::kernel::hierarchy

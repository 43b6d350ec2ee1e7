// The result of building an accelerator. Kernel dialect.
#pragma once

#include <stdint.h>

namespace celltrace::kernel {

/// The result of PREPARE FRAME. `entries` counts (voxel, object) pairs of a grid or nodes of a BVH. If memory
/// did not suffice for all entries, nothing was built.
struct PrepareResult {
  uint32_t entries;
  bool built;
};

} // namespace celltrace::kernel

// What PREPARE FRAME has to say about an accelerator. Kernel dialect.
#pragma once

#include <stdint.h>

namespace celltrace::kernel {

/// `entries`: (voxel, object) pairs of a grid, nodes of a BVH. If there was no room for so many,
/// nothing was built.
struct PrepareResult {
  uint32_t entries;
  bool built;
};

} // namespace celltrace::kernel

// The data that the PPE passes to a kernel compiled for the SPU. Freestanding C++17.
#pragma once

#include "celltrace/spe/types.hpp"

#include <stdint.h>

namespace celltrace {

/// Arguments of a kernel. The program's main() gets the effective address of a ControlBlock, 16-byte aligned,
/// and fetches it by DMA. Big-endian, like everything that a PPE writes.
struct alignas(16) ControlBlock {
  ea_t argument;  ///< argument of the kernel
  ea_t addresses; ///< array of `count` SpeAddresses, 16-byte aligned
  uint32_t id;
  uint32_t count; ///< 1..256
  ea_t image;     ///< the program's ELF file, 16-byte aligned, for programs with code modules
};
static_assert(sizeof(ControlBlock) == 32, "ControlBlock crosses DMA");

} // namespace celltrace

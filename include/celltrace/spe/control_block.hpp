// What the PPE hands to a kernel that was compiled for the SPU. Freestanding C++17.
#pragma once

#include "celltrace/spe/types.hpp"

#include <stdint.h>

namespace celltrace {

/// The argument of the program's main() is the effective address of one of these, 16-byte aligned, which the
/// program fetches by DMA. Big-endian, like everything that a PPE writes.
struct alignas(16) ControlBlock {
  ea_t argument;  ///< of the kernel
  ea_t addresses; ///< `count` records of SpeAddresses, 16-byte aligned
  uint32_t id;
  uint32_t count; ///< 1..256
  ea_t image;     ///< of the program's ELF file, 16-byte aligned, for programs with code modules
};
static_assert(sizeof(ControlBlock) == 32, "ControlBlock crosses DMA");

} // namespace celltrace

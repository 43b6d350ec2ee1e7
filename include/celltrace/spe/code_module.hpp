// Code modules: groups of functions that are fetched into local store when they are called (overlays).
// Freestanding C++17.
//
// Modules share regions of local store: a call into a module that is not in its region fetches the module
// from main memory, in place of the module that is there. On an SPU the linker puts a module's functions into
// an overlay section, and calls of these functions go through backends/spu/modules.S; on cell_emu, SpuBase's
// enter_module() counts the fetch and its time; where memory is direct, a module is ordinary code.
//
// A module's functions may call each other and resident code, but no functions of another module in the same
// region.
#pragma once

#include <stdint.h>

namespace celltrace {

struct CodeModule {
  const char* name;
  uint32_t number; ///< number of the module in its program, from 1
  uint32_t region; ///< region of local store, 0..kMaxModuleRegions - 1
  uint32_t bytes;  ///< largest size that the module may have when it is compiled for the SPU
};
constexpr uint32_t kMaxModuleRegions = 4;

} // namespace celltrace

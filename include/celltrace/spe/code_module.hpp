// Code that is not always in local store. Freestanding C++17.
//
// A module is some of a program's functions. Modules share regions of local store: calling one that is not
// there fetches it from main memory, in place of the one that is. On an SPU the linker puts a module's
// functions into an overlay section, and calls of them go through backends/spu/modules.S; on cell_emu,
// SpuBase's enter_module() takes the time and counts; where memory is direct, a module is code like any
// other.
//
// A module's functions call each other and resident code, but no other module of the same region.
#pragma once

#include <stdint.h>

namespace celltrace {

struct CodeModule {
  const char* name;
  uint32_t number; ///< from 1, one for each module of a program
  uint32_t region; ///< from 0 up to kMaxModuleRegions
  uint32_t bytes;  ///< what the real SPU's build takes, at most
};
constexpr uint32_t kMaxModuleRegions = 4;

} // namespace celltrace

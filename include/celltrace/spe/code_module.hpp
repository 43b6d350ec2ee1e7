// Code modules: overlays of code in local store. Freestanding C++17.
//
// A module is a set of a program's functions. Modules share regions of local store: calling a module that is
// not there fetches it from main memory, in place of the present one. On an SPU the linker puts a module's
// functions into an overlay section, and calls of them go through backends/spu/modules.S; on cell_emu,
// SpuBase's enter_module() takes the time and counts the fetch; where memory is direct, a module is ordinary
// code.
//
// A module's functions may call each other and resident code, but no other module of the same region.
#pragma once

#include <stdint.h>

namespace celltrace {

struct CodeModule {
  const char* name;
  uint32_t number; ///< from 1, one for each module of a program
  uint32_t region; ///< from 0 up to kMaxModuleRegions
  uint32_t bytes;  ///< most bytes that it takes in the real SPU's build
};
constexpr uint32_t kMaxModuleRegions = 4;

} // namespace celltrace

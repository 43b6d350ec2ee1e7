// CELLTRACE_SPE_ENTRY, which makes a kernel the entry point of an SPE program for one SPU type.
// cmake/celltrace_spe_program.cmake defines the CELLTRACE_SPU_... macros.
#pragma once

#include CELLTRACE_SPU_HEADER

#include "celltrace/spe/types.hpp"

#define CELLTRACE_SPE_ENTRY_NAME_2(program, spu) program##_##spu
#define CELLTRACE_SPE_ENTRY_NAME(program, spu) CELLTRACE_SPE_ENTRY_NAME_2(program, spu)

/// Defines the function celltrace::PROGRAM_SPU, which runs `kernel`, a function template over the Spu type.
#define CELLTRACE_SPE_ENTRY(program, kernel)                                                                 \
  namespace celltrace {                                                                                      \
  void CELLTRACE_SPE_ENTRY_NAME(program, CELLTRACE_SPU_NAME)(void* spu, ea_t argument);                      \
  void CELLTRACE_SPE_ENTRY_NAME(program, CELLTRACE_SPU_NAME)(void* spu, ea_t argument) {                     \
    kernel(*static_cast<CELLTRACE_SPU_TYPE*>(spu), argument);                                                \
  }                                                                                                          \
  }

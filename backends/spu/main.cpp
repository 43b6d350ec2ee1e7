// main() of a program for a real SPE that runs a kernel. The build defines
//
//   CELLTRACE_SPU_KERNEL_HEADER   header of the kernel, for #include
//   CELLTRACE_SPU_KERNEL          the kernel, a function template over the Spu type, qualified
//   CELLTRACE_SPU_ARENA_BYTES     local store for the kernel's arena
#include CELLTRACE_SPU_KERNEL_HEADER

#include "backends/spu/spu.hpp"

#include <unistd.h>

namespace {

alignas(celltrace::kLineBytes) uint8_t arena[CELLTRACE_SPU_ARENA_BYTES];

} // namespace

/// The effective address of this program's ELF file, high word first, from which modules.S fetches code.
extern "C" {
extern uint32_t celltrace_program_image[4];
alignas(16) uint32_t celltrace_program_image[4];
}

// Replaces newlib's atexit(), whose lists of functions would take 2 KB of local store; nothing has to be done
// at exit.
extern "C" int atexit(void (*)()) {
  return 0;
}
extern "C" void exit(int status) {
  _exit(status);
}

/// Runs the kernel. crt0 passes the SPE's id in the PPE's library, and two arguments of spe_context_run().
int main(unsigned long long, unsigned long long control_block, unsigned long long) {
  celltrace::spu::Spu spu(control_block, arena, sizeof arena);
  celltrace_program_image[0] = static_cast<uint32_t>(spu.program_image() >> 32);
  celltrace_program_image[1] = static_cast<uint32_t>(spu.program_image());
  CELLTRACE_SPU_KERNEL(spu, spu.argument());
  return 0;
}

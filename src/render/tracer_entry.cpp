// The tracer compiled for one SPU type. The build compiles this file once per type, with the type's header, name and
// compiler flags.
#include CELLTRACE_SPU_HEADER

#include "kernel/tracer.hpp"

namespace celltrace {

void CELLTRACE_ENTRY(tracer_entry_, CELLTRACE_SPU_NAME)(void* spu, ea_t argument) {
  kernel::tracer(*static_cast<CELLTRACE_SPU_TYPE*>(spu), argument);
}

} // namespace celltrace

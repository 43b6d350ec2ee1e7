// The tracer with a uniform grid, compiled once per SPU type.
#include "kernel/entry/tracer.hpp"

#include "backends/spe_entry.hpp"

CELLTRACE_SPE_ENTRY(grid_tracer, celltrace::kernel::grid_tracer)

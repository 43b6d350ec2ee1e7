// The tracer, compiled once per SPU type.
#include "kernel/entry/tracer.hpp"

#include "backends/spe_entry.hpp"

CELLTRACE_SPE_ENTRY(tracer, celltrace::kernel::tracer)

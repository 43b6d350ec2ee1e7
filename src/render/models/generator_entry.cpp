// The generator, compiled once per SPU type.
#include "kernel/models/generator.hpp"

#include "backends/spe_entry.hpp"

CELLTRACE_SPE_ENTRY(stage_generator, celltrace::kernel::models::generator)

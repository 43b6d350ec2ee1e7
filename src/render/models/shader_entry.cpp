// The shader, compiled once per SPU type.
#include "kernel/models/shader.hpp"

#include "backends/spe_entry.hpp"

CELLTRACE_SPE_ENTRY(stage_shader, celltrace::kernel::models::shader)
